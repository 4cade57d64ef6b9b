#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::json {

/// What lies beside the moves of a step, s, by name: "link_s" the way from the step before, "tool_change_s"
/// the change that it begins with, "spindle_s" its changes of speed. With its cutting_s and rapid_s they are
/// its share of the plan's time; those of all steps add up to "total_s".
using TimesBeside = std::vector<std::pair<std::string_view, double>>;

/// A step in words for readers that do not follow references.
struct StepSummary {
  std::string id;
  std::vector<std::pair<std::string_view, std::string>> words;  ///< "operation" its kind, "feature" its name
  int tool_number = 0;                                          ///< T; 0: not in a magazine
  TimesBeside times;                                            ///< empty where the plan's time is not known
};

/// What is derived of a whole plan and written for readers that do not add up themselves.
struct Summary {
  /// Numbers of steps and tool changes, and times in s; times between steps only where the steps have paths.
  std::vector<std::pair<std::string, double>> totals;
  std::vector<StepSummary> steps;  ///< parallel to the plan's
};
[[nodiscard]] Summary summary_of(const model::Plan& plan);
/// Whether it is known of any tool that it is in the magazine.
[[nodiscard]] bool has_magazine(const model::Plan& plan);
/// Tools to be put into the magazine, by id; none where nothing is known of it.
[[nodiscard]] std::vector<std::string> to_load(const model::Plan& plan);

/// The names of what is derived of a step, for schema and reader.
inline constexpr std::string_view kDerivedOfStep[] = {"id",     "tool_number",   "operation", "feature",
                                                      "link_s", "tool_change_s", "spindle_s", "peak"};

}  // namespace capstan::json
