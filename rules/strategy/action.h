#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "planner/model/plan/proposal.h"
#include "rules/facts/facts.h"

namespace capstan::rules {

/// Input of an action while a chain is made, step after step.
struct Making {
  const RuleBase& base;
  const model::FeatureShape& shape;
  const Context& context;
  const FeatureFacts& known;
  const StepSpec& spec;
  double hole_mm = 0.0;  ///< diameter of the hole after the earlier steps of the chain; 0: none
  /// The spec's number, else the action's own default.
  [[nodiscard]] double number(std::string_view parameter) const;
};

/// A step, or why geometry rules this chain out.
using Made = tl::expected<model::ProposedStep, std::string>;
[[nodiscard]] inline Made no(std::string why) { return tl::unexpected(std::move(why)); }

struct ActionParameter {
  std::string_view name;
  double standard = 0.0;  ///< taken where the row says nothing; default, unsourced unless `meaning` says more
  std::string_view meaning;
};

/// Something a chain can do: the bridge from a row to an operation and its tool requirement. Each other
/// source file of this folder is a family: NAME.cpp gives its actions by `std::vector<Action>
/// NAME_actions()`, which the build finds by the file's name.
struct Action {
  std::string_view name;
  model::TypeId operation;
  std::vector<ActionParameter> parameters;
  Made (*make)(const Making&) = nullptr;
};

/// All families; the build writes this function from the names of the source files (rules/CMakeLists.txt).
/// Names of actions differ, so that the order of families is of no matter.
[[nodiscard]] std::vector<std::vector<Action>> families();

/// The action of this name; null if there is none.
[[nodiscard]] const Action* find_action(std::string_view name);

/// The cut of a cone along an edge or the wall of a hole.
struct Bevel {
  double depth_mm = 0.0, width_mm = 0.0;  ///< along the axis; across it
  double angle_rad = 0.0;                 ///< full angle of the cone
};
/// A pass with a chamfer mill or a countersink of that angle, its flank on the bevel.
[[nodiscard]] model::ProposedStep along_a_cone(const Making& m, const Bevel& bevel);

/// Room left between the tool's usable length and the depth, so that the holder stays clear of the face.
/// Default, unsourced.
inline constexpr double kReachClearanceMm = 2.0;
/// Height of a 118 degree tip per diameter, tan(31 deg) / 2: the longest of the usual drill points.
inline constexpr double kDrillTip = 0.30043;

}  // namespace capstan::rules
