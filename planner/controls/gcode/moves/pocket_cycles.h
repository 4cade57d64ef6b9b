#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// A pocket as a control's own cycle roughs it. What is stated bounds any path that the cycle takes: the
/// contour and the floor where it may be, the depth of a level, and a feed that keeps the step's loads where
/// the cutter is in a slot as wide as it is (slot_feed.h).
/// Frame  the set-up's. Units  mm, mm/min, degrees.
struct PocketCycle {
  bool round = false, slot = false;  ///< slot: of a slot along a line, round at both ends
  geometry::Vec2 centre;
  double length_mm = 0.0, width_mm = 0.0;  ///< along the angle and across; of a round one both its diameter
  double corner_mm = 0.0;                  ///< radius of its corners
  double angle_deg = 0.0;                  ///< of its length from +X; 0 and above, below 180
  double back_z = 0.0;                     ///< where the tool is before and behind
  double start_z = 0.0;                    ///< from where it is fed
  double reference_z = 0.0;                ///< below that; all that is cut lies below it
  double floor_z = 0.0;                    ///< of the finished pocket
  double side_mm = 0.0, bottom_mm = 0.0;   ///< what the step leaves
  int levels = 1;                          ///< alike, from `reference_z` to what is left on the floor
  double level_mm = 0.0;
  double over_mm = 0.0;  ///< from ring to ring at most
  double feed_mm_min = 0.0;
  double ramp_feed_mm_min = 0.0;
  double slope = 0.0;  ///< of the way in at most: down by what it goes along
  /// The way in along a helix: radius of the cutter's centre, and down per turn; 0 in a slot too narrow for
  /// one.
  double helix_mm = 0.0, turn_mm = 0.0;
  bool climbs = true;                    ///< along the walls, as the plan's path
  double cutter_mm = 0.0, flat_mm = 0.0;  ///< its diameter, and that of its flat front
  int tool = 0;                          ///< its number
  int decimals = 0, feed_decimals = 0;   ///< of the control
  double planned_s = 0.0;                ///< time of the plan's own path
};

/// The share of the diameter from ring to ring at most, of a mill with a corner radius of that of its flat
/// part, so that no ridges stay on the floor. Source: POCKET3 and POCKET4 take 80 % where
/// nothing is stated (SINUMERIK, cycles, _MIDA).
inline constexpr double kRingShare = 0.8;

/// The cycle for step `n` of the plan, or why its pocket is explicit moves. A cycle is for the first step of
/// a closed pocket, rectangular with one radius of corners that the cutter fits into or round, or of a slot
/// with round ends, which is a rectangle whose corners are half as wide as it is; with upright walls, a level
/// floor and nothing standing in it, whose sizes are made in the middle of their tolerances, and whose path
/// goes in along a ramp.
struct PocketOfStep {
  std::optional<PocketCycle> cycle;
  std::string why_not;  ///< empty: a cycle, or the step makes no pocket at all
  std::string text;     ///< the cycle in the control's words (`asked_pockets`)
};
[[nodiscard]] PocketOfStep pocket_of(const model::Plan& plan, std::size_t n);

/// What a control says of pockets in its own way.
struct PocketWords {
  /// A pocket as a cycle, the tool at `back_z` somewhere within it; it ends there, over the middle. One or
  /// more lines. Nothing where the control has none for it.
  std::optional<std::string> (*text)(const PocketCycle& pocket) = nullptr;
  /// A comment, which the check reads: what the operator's tool table must say of tool `tool`, whose way in
  /// is as steep as that says, so that it goes down by `slope` times what it goes along at most. Empty: no
  /// figure of the table is so flat. Null: each cycle states its own.
  std::string (*table)(int tool, double slope) = nullptr;
};

/// The pockets of a plan that are asked for as cycles.
struct AskedPockets {
  std::vector<PocketOfStep> of_step;  ///< nothing of the others
  /// By tool with such pockets: PocketWords::table, for the flattest way in of them, which all then have.
  std::map<int, std::string> tables;
};
/// `words`: the control's; null where it has no such cycles.
[[nodiscard]] AskedPockets asked_pockets(const model::Plan& plan, const PocketWords* words);

/// Seconds that a path by rings at the cycle's feeds takes, the way in included: an estimate, for the path is
/// the control's.
[[nodiscard]] double estimated_s(const PocketCycle& c);

}  // namespace capstan::controls::gcode
