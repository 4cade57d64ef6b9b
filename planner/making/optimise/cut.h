#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/optimise/solver/solver.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "planner/physics/mechanics/loads/margin.h"

namespace capstan::optimise {

/// Milling that roughs or finishes; or a cut along the axis, by the law that CutQuestion::law names.
enum class CutKind : std::uint8_t { kRough, kFinish, kAxial };
/// Whether it cuts sideways: then depth, width and the feeds along the path follow its sections.
[[nodiscard]] constexpr bool is_milling(CutKind k) { return k != CutKind::kAxial; }

/// The objective to minimise.
///
///     kTime    t
///     kCost    r t + edges               r: machine's rate; edges: t / T (price + r times the change)
///     kProfit  (r + earning) t + edges   earning: what a minute of this machine earns above its rate
///
/// The last is Dinkelbach's parametric form of "most profit per time": with the earning that comes out, (sale
/// - cost) / time is at its largest. A caller that does not know the earning starts from zero and puts in
/// what the plan then earns, until it stays (a few times). Source  W. Dinkelbach, On nonlinear fractional
/// programming, Management Science 13 (1967) 492-498.
enum class Aim : std::uint8_t { kTime, kCost, kProfit };

/// A limit that is taken larger or smaller than it is: what if there were more of it?
struct Eased {
  std::string name;     ///< of the limit, as in CutAnswer::active
  double factor = 1.0;  ///< 1.1: a tenth more (of a lower limit: a tenth less)
  friend bool operator==(const Eased&, const Eased&) = default;
};

/// Input of the cut optimiser: depth, width and speed limits before there is a path. Given values are kept.
struct CutQuestion {
  CutKind kind = CutKind::kRough;
  std::string law = "drilling";  ///< kAxial: of the loads, a name of cut/law
  model::Cutter cutter;
  model::WorkMaterial material;
  model::Machine machine;
  double vc_start_m_min = 0.0;       ///< from catalogue or table: also the most that is taken
  double vc_table_m_min = 0.0;       ///< what the table says where spindle or cutter turn too slowly for it
  double fz_start_mm = 0.0;          ///< the same; chip thickness stays at or below it
  double depth_mm = 0.0;             ///< to remove along the axis, in all
  double width_mm = 0.0;             ///< to remove across the feed, at most: the slot's width, the allowance
  double pre_hole_mm = 0.0;          ///< drilling family
  double engaged_diameter_mm = 0.0;  ///< centre drills, countersinks: the widest that cuts; 0: all of it
  bool slot = false;                 ///< milling: the cutter is engaged over its whole diameter
  double least_feed_ratio = 0.1;     ///< of the start value: below, an edge rubs rather than cuts
  double ap_most_mm = 0.0;  ///< depth per level at most, where something else than the cutter says so
  double deflection_limit_mm = 0.0;  ///< of the tip, beside the strength of the tool; 0: no other
  std::optional<double> ap_mm, ae_mm, n_rpm, feed_mm_min, fz_mm;  ///< given, kept
  Aim aim = Aim::kTime;
  double earning_per_min = 0.0;   ///< kProfit: what a minute of this machine earns, net of its own cost
  bool override_locked = false;   ///< the operator cannot turn the feed up: no margin for it
  bool feed_by_planning = false;  ///< feed_mm_min was chosen by planning before: the margin holds for it, too
  double surface_ra_um = 0.0;     ///< required Ra of the surface that this cut leaves, um; 0: none
  double wall_error_limit_mm = 0.0;  ///< largest error of the wall by bending, mm; 0: no limit
  double peak_force_limit_n = 0.0;   ///< largest force that the workholding holds, N; 0: unknown
  /// The largest diameter that cuts: of a ball or bull nose that is not in with all of its radius, and of a
  /// cone's point, the one that cutting speed is counted at. 0: the cutter's.
  double speed_diameter_mm = 0.0;
  /// The path keeps the width of its cut, in corners too, and never cuts a slot but where it enters: as deep
  /// as edge and stability allow, as wide as is quickest, faster where the edge is in the cut for a short arc
  /// (mechanics/life/arc_speed.h), and no feed but the chip's bounds it.
  bool constant_engagement = false;
  bool as_measured =
      false;  ///< depth and width are those of the path's sections: each may ask for its own feed
  double margin_deviations =
      mechanics::kUsualMargin.deviations;  ///< of the load's margin (mechanics/loads/margin.h)
  Eased eased;
  friend bool operator==(const CutQuestion&, const CutQuestion&) = default;
};

/// Ra of milled surfaces over that of geometry alone, where Ra is demanded.
/// Source: 318 f^2 / (4 D) um in Tolouei-Rad & Bidhendi 1997, against 256.6 f^2 / (4 D) of the parabola.
inline constexpr double kRoughnessOverGeometry = 1.24;
/// Time of a level beside its cutting: moving over, down, and back to speed, s. Default, unsourced.
inline constexpr double kLevelOverheadS = 2.0;

/// Largest deflection of the tip in facing, mm, where bending moves the edge along the face. Default,
/// unsourced.
inline constexpr double kFaceDeflectionMm = 0.2;
/// Least feed at which a drill, reamer or countersink is worth choosing, as a fraction of the start value.
/// Default, unsourced.
inline constexpr double kLeastDrillFeed = 0.4;
/// Thin cuts and air on the way of a cut go no faster than this times the feed of the largest chip: by chip
/// thinning that chip is then kept up to a width of 0.029 D, so a sliver that the section missed does no
/// harm. Default, unsourced.
inline constexpr double kMostThinning = 3.0;
/// Rate of a machine that states none, per hour. Default, unsourced.
inline constexpr double kMachinePerHour = 60.0;

struct CutAnswer {
  bool feasible = false;
  double ap_mm = 0.0, ae_mm = 0.0;
  int levels = 1;
  double vc_m_min = 0.0, fz_mm = 0.0, n_rpm = 0.0, feed_mm_min = 0.0;
  model::StepLoads loads;
  /// shadow_price: fraction of the objective (of Aim) saved per 1 % more of the limit. saves_s is left at
  /// zero: it is saved_by_tenth times the step's cutting time, which only the path knows.
  std::vector<model::ActiveConstraint> active;
  /// Of active, one by one: fraction of the cutting time that 10 % more of this limit alone saves, found by
  /// solving again; below zero where cost or profit is the aim and more time is the cheaper way.
  std::vector<double> saved_by_tenth;
  double life_min = 0.0;              ///< cutting time of an edge, as the cost counts it
  std::string method;                 ///< of the solver
  std::vector<std::string> violated;  ///< when not feasible: by name, with the numbers
};

/// By how much a cut of this width may exceed the speed of the table: 1 unless the engagement is constant.
[[nodiscard]] double speed_by_arc(const CutQuestion& q, double ae_mm);

/// The diameter that cutting speed is counted at.
[[nodiscard]] inline double speed_diameter_mm(const CutQuestion& q) {
  return q.speed_diameter_mm > 0.0 ? q.speed_diameter_mm : q.cutter.cutting_diameter_mm;
}

/// Depth, width, speed and feed that cut fastest (or cheapest, or to most profit) within every limit: spindle
/// speed range, power and torque at that speed, tip deflection (the stated limit, and what the tool's own
/// material endures: mechanics::enduring_bend_mm), wall error, surface, peak force, largest and least chip,
/// depths, cutting length, axis feed. Forces carry the margin of mechanics/loads/margin.h: the spread of
/// their coefficients, a worn edge and the operator's override; limits are thus never met on average values.
///
/// Levels are whole: they are enumerated, and the other variables solved for each. Where the spindle's curve
/// or the immersion has a corner, the pieces between are solved one by one: no smooth method shows an optimum
/// at a corner.
///
/// Where the engagement is constant and the width is open, the best of a row of widths, each with its own
/// fastest speed.
///
/// Determinism  same question, same answer. Numbers are rounded towards the safe side: n and feed down,
///              depths down to 1 um. What is answered is measured again after rounding.
/// Outcomes     not feasible, with what is violated: also given values that are no cut at all.
/// Fails        OPT-QUESTION when the question itself is not one (no diameter, no material); what `solve`
///              fails with.
[[nodiscard]] Result<CutAnswer> cut(const CutQuestion& question, const Options& options, Job& job);

/// How far the operator may turn the feed up: it counts in the margin of forces, and the cutter's
/// largest permitted chip holds there. 1 where overrides are locked, for taps, and for a feed that is given
/// (it is executed as it is).
[[nodiscard]] double feed_override(const CutQuestion& q);

/// The loads of a cut of these dimensions, the margin included (chip and removal rate: as planned); nothing
/// when it is outside the formulas' range.
[[nodiscard]] std::optional<model::StepLoads> loads_of(const CutQuestion& q, double ap_mm, double ae_mm,
                                                       double n_rpm, double feed_mm_min);

/// Relative excess over the limits: the largest of load / limit - 1 over power, torque, deflection, chip
/// thickness, wall error, surface and peak force; negative when all hold; infinite for loads that are no
/// numbers.
[[nodiscard]] double worst_excess(const CutQuestion& q, const model::StepLoads& loads, double n_rpm);

/// The limit of worst_excess by name, with its numbers; "load" without numbers where it is infinite.
struct WorstLoad {
  double excess = -1.0;
  std::string name;
  double value = 0.0, limit = 0.0;
  std::string unit;
};
[[nodiscard]] WorstLoad worst_load(const CutQuestion& q, const model::StepLoads& loads, double n_rpm);

}  // namespace capstan::optimise
