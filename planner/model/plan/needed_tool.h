#pragma once

#include <string>
#include <vector>

#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/plan.h"

namespace capstan::model {

/// A tool that a feature lacks: the least cutter that would do.
struct NeededTool {
  AnyRef feature;
  std::string feature_name;
  Cutter cutter;
  std::string words;  ///< "a 6.6 mm twist drill with 34 mm reach"
};

/// Of one kind, for all the features that ask for it: as long as the longest of them needs it.
struct NeededKind {
  Cutter cutter;
  std::string words;
  std::vector<std::string> features;  ///< by name, each once, in the order in which they ask
};

/// The kinds among the tools that the plan's unplanned features lack, and those that keep rest material in
/// their corners (corner_rest.h): cutters that differ in length alone are one.
[[nodiscard]] std::vector<NeededKind> needed_kinds(const Plan& plan, const std::vector<NeededTool>& needed);

/// The row of provenance that names the n-th kind: "needed tool 1", the cutter as an entry of a shop's own
/// tool list (tooling/data/README.md), and for which features.
[[nodiscard]] Provenance provenance_of(const NeededKind& kind, std::size_t number);

/// "twist_drill 6.6 mm, usable length 34 mm, flutes 34 mm, for 'HOLE1', 'HOLE2'"
[[nodiscard]] std::string text_of(const NeededKind& kind);

/// An entry of a shop's own tool list, on one line.
[[nodiscard]] std::string list_entry(const Cutter& c);

}  // namespace capstan::model
