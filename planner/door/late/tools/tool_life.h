#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/late/late.h"
#include "planner/door/late/tools/tool_state.h"
#include "planner/door/pipeline/pipeline.h"

namespace capstan::late {

/// A binding that is looked at for the lives of its tools.
struct OfLives {
  const ToldTools& told;
  /// Minutes that each tool cut since its life was told, by number: of steps of the plan that are cut.
  std::map<int, double> used_min;
  /// The loaded tools, as they are measured; those of out_of_use are not among them.
  const std::vector<model::Cutter>& magazine;
};

/// What is to be bound anew, for a tool's life ends before its steps do.
struct Relieved {
  model::Plan plan;                   ///< with the sisters in their place, and tools open where there is none
  std::vector<model::Edit> kept_off;  ///< the tools that those steps may not have (Inputs::kept_off)
  std::vector<std::string> why;       ///< a sentence for each step, in order
  std::string first;                  ///< the first of them, with step, tool and minutes
};

/// Holds the lives of tools against the cutting times of the steps that were bound, in their order: nothing
/// where all last. Else a step that takes more than is left gets a loaded tool that equals its own and whose
/// life lasts, the lowest number first; the steps behind it have that one, too, where its life lasts. Where
/// there is none the step's tool is open again.
///
/// A tool whose life nobody told lasts for all. Time of cutting is that of the schedule, without rapids.
[[nodiscard]] std::optional<Relieved> relieve(const LateOutcome& bound, const OfLives& lives);

/// Minutes that the plan's steps from one to before another, counted from 0, cut with each tool, by number.
[[nodiscard]] std::map<int, double> minutes_of(const model::Plan& plan, std::size_t from, std::size_t to);

}  // namespace capstan::late
