#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/features/fit/general.h"
#include "planner/model/features/quality.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/proposal.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "rules/engine/check.h"
#include "rules/engine/table.h"

namespace capstan::rules {

/// Surroundings of a feature: material, general statements of the file, abilities of the machine.
struct Context {
  model::WorkMaterial material;
  /// The workpiece's general tolerance, +-mm, for sizes without one.
  std::optional<double> global_tolerance_mm;
  /// The drawing's general tolerances (ISO 2768, ISO 22081), by size; they precede global_tolerance_mm.
  std::optional<model::GeneralTolerance> general;
  /// Grade taken for such sizes when the file gives no general tolerance either. Default, unsourced.
  int general_grade = 13;
  double stock_above_mm = 0.0;  ///< raw material above the feature's top when its steps begin
  /// Diameter of a smaller coaxial hole that continues below this one's bottom, or of the hole that a thread
  /// is cut into; 0: none, or unknown. `propose_members` fills it within a compound.
  double core_diameter_mm = 0.0;
  bool core_above = false;  ///< that hole is the only way in from above: this one lies below it
  /// Threads: depth of that hole below the thread's top; 0: the shape's own. With core_above: how far it goes
  /// down below this one's top.
  double core_depth_mm = 0.0;
  /// Holes: distance from the axis to the nearest wall that is higher than the mouth; unset: none is near.
  std::optional<double> clear_radius_mm;
  /// Steps that end at walls on both sides: the distance of these walls; 0: they do not.
  double between_ends_mm = 0.0;
  /// Steps, outsides and faces with inner corners drawn sharp: the largest radius that may stay there; 0:
  /// they have none.
  double sharp_corner_mm = 0.0;
  double core_height_mm = 0.0;     ///< with core_above: how high above this one's top it begins
  double surface_radius_mm = 0.0;  ///< freeform: smallest concave radius; 0 not known
  /// Freeform: true if it has upright walls within the raw piece; true if it has more than walls and level
  /// floors; the least radius of the walls' inside corners; 0: none, or sharp.
  bool surface_walls = false, surface_curved = true;
  double surface_corner_mm = 0.0;
  /// Of walls and level floors only: the largest cutter that passes everywhere (0: no limit), and the largest
  /// radius that may stay in the walls' sharp inside corners (0: it has none).
  double surface_passage_mm = 0.0, surface_sharp_mm = 0.0;
  /// Freeform: the height of its thinnest wall by its thickness, the width of its thinnest floor by its own; 0:
  /// none is thin, or not known.
  double surface_wall_ratio = 0.0, surface_floor_ratio = 0.0;
  /// Depth of the walls from the top of the surface to the underside of the raw piece; 0: it has none.
  double surface_height_mm = 0.0;
  bool has_coolant = true;
  model::Quality quality;  ///< surface texture and geometric tolerances of the feature
  model::MachineAbilities abilities;
  bool has_through_coolant = false;
  std::optional<double> wall_thickness_mm;  ///< thinnest wall that stays beside the feature; unset: not known
  std::optional<double> floor_thickness_mm;  ///< what stays below its bottom; unset: not known
  int batch = 1;                             ///< pieces
  double edge_break_mm = 0.0;                ///< the shop's rule: size of the chamfer on outer edges; 0: none
};

/// The proposal of the rules for one feature: chains in order of preference, each step with its tool
/// requirement, strategy, allowances and the row that proposed it; or in `cannot` why there is none. Chains
/// that geometry rules out are in `rejected` with the reason. One of `chains` and `cannot` is always set.
///
/// Units   mm, rad, as in ProposedStep. `depth_mm` of centre drilling, spot drills and tapping is that of the
/// tip, of
///         all other drilling that of the full diameter; 0 for a countersink at the top of a hole, where it
///         follows from the cone and tip of the cutter chosen. How far a tool passes a through bottom is the
///         path's to say. diameter_min/max of drills are diameter_exact_mm -+ diameter_tolerance_mm, all of
///         it within tolerance.
[[nodiscard]] model::Proposal propose(const RuleBase& base, const model::FeatureShape& shape,
                                      const Context& context);

/// Shapes of one feature as they are drilled. A narrower hole that starts at the bottom of a coaxial wider
/// one (a counterbore, a countersink) is made first, so its frame moves up to where the wider one starts, and
/// its depth grows by as much. The extra volume lies within the wider hole. Call it once, before any other
/// use of the shapes.
[[nodiscard]] std::vector<model::FeatureShape> from_the_top(std::vector<model::FeatureShape> shapes);

/// One proposal per shape of one feature, in their order: members of a compound know of each other's holes.
/// Members of a pattern that are alike are proposed once and copied.
[[nodiscard]] std::vector<model::Proposal> propose_members(const RuleBase& base,
                                                           std::span<const model::FeatureShape> shapes,
                                                           const Context& context);

/// For each shape of one feature the coaxial hole that removes all of it with a tolerance at least as tight
/// (itself, if there is none); of two equal ones the first.
[[nodiscard]] std::vector<std::size_t> made_within(std::span<const model::FeatureShape> shapes);

/// Pairs (first, second) of shapes of one feature, first to be finished before second begins: of coaxial
/// holes the narrower first (it is the pilot of the wider), holes before the thread in them.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> member_order(
    std::span<const model::FeatureShape> shapes);

}  // namespace capstan::rules
