#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/plan.h"

namespace capstan::json {

/// A hash of each part of a plan ("the machine", "tool 'END MILL 12'", "step 'POCKET'", "objects of kind
/// plane"), written beside it, so that a reader finds edited parts: results computed from an old value are no
/// longer true. No secret: it finds slips, not forgery.
///
/// Counts      numbers by value, choices, references, ids.
/// Does not    words for people (descriptions, sources, reasons' texts, labels), where an object stood in its
///             file.
/// Cost        linear.
[[nodiscard]] std::map<std::string, std::uint64_t> seals_of(const model::Plan& plan);
/// The names of two kinds of parts.
[[nodiscard]] std::string part_of_kind(model::TypeId kind);
[[nodiscard]] std::string part_of_step(const std::string& step_id);
/// Which lists of the plan are among the edited parts of a file (model/plan/decision/edited.h).
[[nodiscard]] std::set<model::Listed> listed_among(const std::vector<std::string>& edited_parts);

}  // namespace capstan::json
