#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "planner/ground/vocabulary/limit.h"
#include "planner/making/optimise/cut.h"
#include "planner/physics/mechanics/bending/wall_error.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/loads/section.h"
#include "planner/physics/mechanics/spindle.h"

/// The limits of a cut: what they are called, and how near to each a cut comes. Of this room.
namespace capstan::optimise {

/// A value and its upper limit. The limit is infinite if none is stated.
struct Measure {
  double value = 0.0;
  double limit = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool stated() const { return limit < std::numeric_limits<double>::infinity(); }
  /// value / limit - 1
  [[nodiscard]] double excess() const { return stated() ? value / limit - 1.0 : -1.0; }
};

/// One Measure per limit. A lower limit is stored as (lower limit, value): it must not exceed the value.
struct Measures {
  std::array<Measure, model::kLimitCount> all;
  [[nodiscard]] Measure& operator[](model::Limit l) { return all.at(model::index_of(l)); }
  [[nodiscard]] const Measure& operator[](model::Limit l) const { return all.at(model::index_of(l)); }
  [[nodiscard]] auto begin() const { return all.begin(); }
  [[nodiscard]] auto end() const { return all.end(); }
};
[[nodiscard]] Measures measures(const CutQuestion& q, const model::StepLoads& loads, double ap_mm,
                                double n_rpm, double feed_mm_min);

struct Range {
  double lo = 0.0, hi = 0.0;
};

/// What no variable of a search changes of a question's limits: names and presets are compared once.
struct FixedLimits {
  std::optional<mechanics::SpindleCurve> curve;
  Range rpm;
  double efficiency = 1.0;
  double largest_fz_mm = 0.0, thinnest_chip_mm = 0.0, deflection_mm = 0.0;
  double axis_feed_mm_min = 0.0, slender_depth_mm = 0.0;
  std::array<double, model::kLimitCount> ease{};  ///< factor of each limit
};
[[nodiscard]] FixedLimits fixed_limits(const CutQuestion& q);
/// As the one above, for many cuts of one question.
[[nodiscard]] Measures measures(const CutQuestion& q, const FixedLimits& fixed, const model::StepLoads& loads,
                                double ap_mm, double n_rpm, double feed_mm_min);

[[nodiscard]] inline int teeth_of(const CutQuestion& q) { return q.cutter.teeth > 0 ? q.cutter.teeth : 1; }

/// As the model's nouns have them: the force along the axis counts away from the work there, and towards it
/// in mechanics; a left-hand cutter is the mirror image of the one that mechanics computes.
[[nodiscard]] model::AxisForces axis_forces(const mechanics::ForceVector& f, double margin,
                                            const model::Cutter& cutter);

/// Where the force acts that bends a tool, above its tip, mm: half way up the head of a T-slot cutter, which
/// always cuts with all of it. Where it acts on others is not asked: at the tip, the safe side.
[[nodiscard]] double force_height_mm(const model::Cutter& cutter);

/// Loads of milling cuts of one question. Cuts of one depth and width share what their sections have at every
/// feed, so that a search that moves speed and feed costs little. Not for several threads at once.
class MillingLoads {
 public:
  /// The question must outlive it.
  explicit MillingLoads(const CutQuestion& q);
  /// A straight side cut, up or down milling, whichever is worse: the path may have both. Nothing outside the
  /// formulas' range.
  [[nodiscard]] std::optional<model::StepLoads> at(double ap_mm, double ae_mm, double n_rpm, double fz_mm);

 private:
  const CutQuestion& q_;
  mechanics::Tooth tooth_;
  mechanics::ForceLaw law_;
  double margin_ = 1.0;
  std::optional<mechanics::ToolBeam> beam_;  ///< nothing: the cutter has no diameter
  double compliance_mm_n_ = 0.0;
  double ap_mm_ = -1.0, ae_mm_ = -1.0;                             ///< of what is ready
  std::array<std::optional<mechanics::SectionAtFeeds>, 2> ready_;  ///< up, down
  std::array<std::optional<mechanics::WallAtFeeds>, 2> walls_;     ///< the same, where an error is limited
};

/// The margin of the question's forces: of a milling cut, and of drills, reamers and taps.
[[nodiscard]] mechanics::ForceMargin margin_of(const CutQuestion& q);
[[nodiscard]] mechanics::ForceMargin drilling_margin_of(const CutQuestion& q);
/// Where a measured set gives the forces: the power that the material's card expects of the same removal in
/// chips of this mean thickness, with a worn edge and the override. Two laws of one material differ by half;
/// whichever is right, the spindle must not stall: no power is counted below it. 0: no measured set.
[[nodiscard]] double power_by_card_w(const CutQuestion& q, double removal_mm3_min, double mean_chip_mm);

/// Slowest speed that is tried, as a fraction of the fastest. Default, unsourced.
inline constexpr double kSlowestSpeedShare = 0.25;

/// Speeds of machine and cutter, 1/min.
[[nodiscard]] Range speeds(const CutQuestion& q);

/// The machine's spindle curve; nothing if it states none or an invalid one.
[[nodiscard]] std::optional<mechanics::SpindleCurve> curve_of(const CutQuestion& q);

/// Largest feed per tooth to plan, mm.
[[nodiscard]] double largest_fz(const CutQuestion& q);
/// The thinnest chip that the cutter takes in the material (mechanics::least_chip_mm); no more than what its
/// presets hold it to cut (model::held_to_cut_mm).
[[nodiscard]] double least_chip_mm(const CutQuestion& q);
/// The thinnest chip that a milling cut is planned with: the cutter's own; 0 where the feed is given.
[[nodiscard]] double thinnest_chip_mm(const CutQuestion& q);
/// Least feed per tooth that the cutter states, mm; 0: none stated.
[[nodiscard]] double least_fz(const CutQuestion& q);
/// True if the maker states the least feed; false if it is derived or a default.
[[nodiscard]] bool least_fz_stated(const CutQuestion& q);

/// Whether a spindle that gives no more at this speed is short of torque rather than of power: below the
/// lowest speed at which it has (nearly) all its power.
[[nodiscard]] bool short_of_torque(const CutQuestion& q, double n_rpm);

/// `factor` of CutQuestion::eased for this limit.
[[nodiscard]] double ease_of(const CutQuestion& q, std::string_view limit);

/// Depth that a chosen rough level may have where no modes are known, by the cutter's slenderness; infinite
/// for what the rule does not speak of (finishing, given depths, drills). Narrow cuts of constant engagement
/// may be deeper.
[[nodiscard]] double slender_depth(const CutQuestion& q);

/// Depth of a level at most. A rough one: model::kDeepestSlotRatio diameters, sourced there for slots and
/// taken for wider cuts, too, whose ways begin and end in slots; in steel above 50 HRC model::kHardCut. Where
/// the engagement is constant there is no slot but the entry, which is a ramp or a helix. What the material
/// allows of either (model::Ramp) comes by CutQuestion::ap_most_mm.
[[nodiscard]] double deepest_level(const CutQuestion& q);

/// Depth of a slot, in diameters, up to which speed and feed are those of the table, and what remains of each
/// at model::kDeepestSlotRatio; between the two linear (derived).
/// Source    Dormer Pramet, milling catalogue 2021-22, p. 114, correction factors: 0.5 D at full speed and
///           feed, 1.5 D at half.
inline constexpr double kFullFeedSlotRatio = 0.5;
inline constexpr double kDeepestSlotShare = 0.5;
/// Contact from which a cut counts as a slot, rad: as wide as 0.994 D. Default, unsourced.
inline constexpr double kSlotArc = 0.95 * std::numbers::pi;

/// Share of the table's speed, and of its feed, in a slot of this depth; 1 where nothing is known.
[[nodiscard]] double deep_slot_share(double ap_mm, double diameter_mm);

}  // namespace capstan::optimise
