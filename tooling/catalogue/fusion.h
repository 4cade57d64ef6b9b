#pragma once

#include <string>
#include <vector>

#include "planner/base/job.h"
#include "planner/model/cutter.h"
#include "tooling/catalogue/tree.h"

namespace capstan::tooling {

/// The tools of a Fusion library (`.json`: a map with "data"), millimetres and inches.
///
/// Read     geometry DC, RE, LCF, LB (stick-out), shoulder-length, SFDM, NOF, SIG, TA (chamfer mills: half
/// the
///          angle), TP, HAND, tip-diameter, assemblyGaugeLength; BMC, description, the tool number.
/// Left     holders' outlines, presets, expressions, links: not read, said once in a note.
/// A tool of a kind that no cutter describes, or with faults of value, is left out with a warning.
[[nodiscard]] std::vector<model::Cutter> read_fusion(const Node& root, const std::string& file, Job& job,
                                                     const std::vector<model::Cutter>& generic);

}  // namespace capstan::tooling
