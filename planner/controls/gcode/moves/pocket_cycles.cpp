#include "planner/controls/gcode/moves/pocket_cycles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/controls/gcode/moves/slot_feed.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::CutterPath;
using model::MoveKind;
using model::MoveRole;
using std::numbers::pi;

constexpr double kDegrees = 180.0 / pi;
/// All that is cut lies so far below where the tool is fed from: planning comes down by rapid no nearer
/// (making/toolpath/defaults.h, kAirAbove).
constexpr double kClearanceMm = 0.2;
/// By which path and feature may be apart; a program's own accuracy, mm.
constexpr double kAgreeMm = 0.002;
constexpr double kSame = 1e-6;

PocketOfStep no(std::string why) { return {std::nullopt, std::move(why)}; }

/// What the path says of its way in: helices of one radius, one way round.
struct WayIn {
  double radius_mm = 0.0, turn_mm = 1e300, feed_mm_min = 1e300, rpm = 0.0;
  double start_z = 0.0;
};

/// Nothing where it does not go in so.
std::optional<WayIn> way_in(const model::StepResult& step) {
  const CutterPath& p = *step.path;
  WayIn out;
  bool any = false;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.role[i] == MoveRole::kPlunge) return std::nullopt;
    if (p.role[i] != MoveRole::kRamp) continue;
    if (p.kind[i] != MoveKind::kArcCw && p.kind[i] != MoveKind::kArcCcw) return std::nullopt;
    const double radius = norm(Vec2{p.x[i] - p.cx[i], p.y[i] - p.cy[i]});
    const double drop = p.z[i - 1] - p.z[i];
    const double rpm = step.schedule ? step.schedule->spindle_rpm[i] : step.spindle_rpm;
    if (!any) out.start_z = p.z[i - 1];
    if (any && (std::abs(radius - out.radius_mm) > kAgreeMm || rpm != out.rpm)) return std::nullopt;
    any = true;
    out.radius_mm = radius;
    out.rpm = rpm;
    if (drop > 0.0) out.turn_mm = std::min(out.turn_mm, drop / model::arc_sweep(p, i) * 2.0 * pi);
    out.feed_mm_min =
        std::min(out.feed_mm_min, step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min);
  }
  if (!any || out.turn_mm >= 1e300 || !(out.radius_mm > kSame)) return std::nullopt;
  return out;
}

/// How far the path's cuts reach from the pocket's middle, along its length and across, or about it; and how
/// deep.
struct Reach {
  double along_mm = 0.0, across_mm = 0.0, about_mm = 0.0, lowest_z = 1e300;
};

Reach reach_of(const CutterPath& p, const PocketCycle& c) {
  const Vec2 u{std::cos(c.angle_deg / kDegrees), std::sin(c.angle_deg / kDegrees)};
  Reach out;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.kind[i] == MoveKind::kRapid || p.kind[i] == MoveKind::kDwell) continue;
    // Arcs of the corners stay within the box of their ends; others are at home well within it.
    for (const double t : {0.0, 0.5, 1.0}) {
      const Vec2 at = xy(model::point_on_move(p, i, t)) - c.centre;
      out.along_mm = std::max(out.along_mm, std::abs(dot(at, u)));
      out.across_mm = std::max(out.across_mm, std::abs(u.x * at.y - u.y * at.x));
      out.about_mm = std::max(out.about_mm, norm(at));
    }
    out.lowest_z = std::min(out.lowest_z, p.z[i]);
  }
  return out;
}

bool in_the_middle(const model::Toleranced& t) { return std::abs(t.middle() - t.nominal_mm) < kSame; }

/// The pocket's own figures; why not, where it is none for a cycle.
PocketOfStep contour(const model::Plan& plan, const model::StepResult& step,
                     const model::MachiningWorkingstep& ws) {
  const model::Model& m = plan.model;
  const auto* pocket = m.get<model::ClosedPocket>(ws.its_feature);
  if (pocket == nullptr) return {};
  const bool round = m.holds<model::CircularClosedProfile>(pocket->feature_boundary);
  if (!round && !m.holds<model::RectangularClosedProfile>(pocket->feature_boundary))
    return no("its contour is neither a rectangle nor a circle");
  const auto shapes = model::shapes_of(m, ws.its_feature);
  if (!shapes || shapes->size() != 1) return no("it is one of several");
  const model::FeatureShape& s = shapes->front();
  if (!s.islands.empty()) return no("material stands in it");
  if (s.slope_rad != 0.0 || s.bottom_radius_mm > 0.0) return no("its walls lean, or are round at the foot");
  if (s.through) return no("it goes through");
  if (!in_the_middle(s.width) || !in_the_middle(s.length) || !in_the_middle(s.depth_tolerance))
    return no("its tolerances lie to one side");
  const auto* feature = m.get<model::ManufacturingFeature>(ws.its_feature);
  const auto* piece = m.get<model::Workpiece>(feature->its_workpiece);
  const auto there = model::workpiece_in_program(m, plan.setups[step.setup].setup, piece);
  const Placement at = geometry::compose(there && *there ? **there : Placement{}, s.frame);
  if (at.z.z < 1.0 - kSame) return no("it is not upright in the set-up");
  const auto box = geometry::bounds(s.area);
  PocketCycle c;
  c.round = round;
  c.length_mm = round ? s.width.nominal_mm : box.hi.x - box.lo.x;
  c.width_mm = round ? s.width.nominal_mm : box.hi.y - box.lo.y;
  const auto is = [](double a, double b) { return std::abs(a - b) < kSame; };
  if (!round && !(is(c.length_mm, s.length.nominal_mm) && is(c.width_mm, s.width.nominal_mm)) &&
      !(is(c.length_mm, s.width.nominal_mm) && is(c.width_mm, s.length.nominal_mm)))
    return no("its profile is turned in its own frame");
  c.corner_mm = round ? 0.5 * c.length_mm : s.corner_radius_mm;
  c.centre = xy(at.to_parent({0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y), 0.0}));
  c.angle_deg = round ? 0.0 : std::atan2(at.x.y, at.x.x) * kDegrees;
  c.floor_z = at.origin.z - s.depth_mm;
  return {c, {}};
}

/// What the step leaves; whether its path reaches as far as these and the pocket say.
std::string left_by(const model::Plan& plan, const model::StepResult& step,
                    const model::MachiningWorkingstep& ws, PocketCycle& c) {
  const auto* op = plan.model.get<model::BottomAndSideMilling>(ws.its_operation);
  if (op == nullptr) return "its operation does not mill floor and walls";
  c.side_mm = op->allowance_side.value_or(0.0);
  c.bottom_mm = op->allowance_bottom.value_or(0.0);
  const Reach r = reach_of(*step.path, c);
  const double inset = 0.5 * c.cutter_mm + c.side_mm;
  const auto apart = [](double a, double b) { return std::abs(a - b) > kAgreeMm; };
  const bool walls =
      c.round ? apart(r.about_mm, 0.5 * c.length_mm - inset)
              : apart(r.along_mm, 0.5 * c.length_mm - inset) || apart(r.across_mm, 0.5 * c.width_mm - inset);
  if (walls || apart(r.lowest_z, c.floor_z + c.bottom_mm))
    return "its path does not reach as far as the pocket";
  if (c.corner_mm < inset) return "its corners are narrower than the cutter";
  return {};
}

/// Rounded as the control writes it; the last heights so that levels come out whole.
void round_to(PocketCycle& c, const model::Control& control) {
  c.decimals = control.decimals;
  c.feed_decimals = control.feed_decimals;
  for (double* v : {&c.centre.x, &c.centre.y, &c.length_mm, &c.width_mm, &c.corner_mm, &c.back_z, &c.start_z,
                    &c.reference_z, &c.floor_z, &c.side_mm, &c.bottom_mm})
    *v = rounded(*v, c.decimals);
  const double unit = std::pow(10.0, -c.decimals), feeds = std::pow(10.0, -c.feed_decimals);
  const auto down = [](double v, double u) { return std::floor(v / u + 1e-6) * u; };
  // A level is rounded up, so that the control counts no level more.
  c.level_mm = std::ceil(c.level_mm / unit - 1e-6) * unit;
  c.over_mm = down(c.over_mm, unit);
  c.helix_mm = down(c.helix_mm, unit);
  c.turn_mm = down(c.turn_mm, unit);
  c.feed_mm_min = down(c.feed_mm_min, feeds);
  c.ramp_feed_mm_min = down(c.ramp_feed_mm_min, feeds);
}

}  // namespace

PocketOfStep pocket_of(const model::Plan& plan, std::size_t n) {
  const model::StepResult& step = plan.steps[n];
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  if (ws == nullptr || !model::has(ws->its_operation.type, model::OperationTrait::kRoughs)) return {};
  PocketOfStep out = contour(plan, step, *ws);
  if (!out.cycle) return out;
  for (std::size_t i = 0; i < n; ++i) {
    const auto* before = plan.model.get<model::MachiningWorkingstep>(plan.steps[i].step);
    if (before != nullptr && before->its_feature == ws->its_feature)
      return no("a step before has cut in it: the cycle would cut it all again");
  }
  PocketCycle& c = *out.cycle;
  const model::Cutter& cutter = *model::find_cutter(plan, step.cutter_id);
  c.cutter_mm = cutter.cutting_diameter_mm;
  c.tool = cutter.pocket;
  if (std::string why = left_by(plan, step, *ws, c); !why.empty()) return no(std::move(why));
  const auto in = way_in(step);
  if (!in) return no("its path does not go in along helices of one radius and speed");
  const double first =
      step.schedule && step.path->size() > 1 ? step.schedule->spindle_rpm[1] : step.spindle_rpm;
  if (first != in->rpm || !(in->rpm > 0.0)) return no("its path does not begin at the speed of its way in");
  const double narrow = 0.5 * std::min(c.length_mm, c.width_mm) - 0.5 * c.cutter_mm - c.side_mm;
  c.helix_mm = std::min(in->radius_mm, narrow);
  // A smaller circle with the same slope goes down less in a turn.
  c.turn_mm = in->turn_mm * c.helix_mm / in->radius_mm;
  if (!(c.helix_mm > 0.0)) return no("no helix has room in it");
  if (c.angle_deg < 0.0) c.angle_deg += 180.0;
  if (c.angle_deg >= 180.0 - kSame) c.angle_deg -= 180.0;
  c.angle_deg = std::max(0.0, c.angle_deg);
  c.back_z = step.path->z[0];
  c.start_z = in->start_z;
  c.reference_z = c.start_z - kClearanceMm;
  const double depth = c.reference_z - c.floor_z - c.bottom_mm;
  const auto slot = slot_levels(plan, step, cutter, depth, step.axial_depth_mm, in->rpm,
                                plan.machine.control.feed_decimals);
  if (!slot) return no("no feed keeps the step's loads in a slot as wide as the cutter");
  c.levels = slot->levels;
  c.level_mm = depth / slot->levels;
  c.feed_mm_min = slot->feed_mm_min;
  c.ramp_feed_mm_min = std::min(in->feed_mm_min, slot->feed_mm_min);
  c.over_mm = kRingShare * c.cutter_mm;
  c.planned_s = step.cutting_s;
  round_to(c, plan.machine.control);
  if (c.back_z < c.start_z || !(depth > 0.0)) return no("it does not begin above what it cuts");
  return out;
}

double estimated_s(const PocketCycle& c) {
  const double inset = 0.5 * c.cutter_mm + c.side_mm;
  const double across = 0.5 * c.width_mm - inset, along = 0.5 * c.length_mm - inset;
  const int rings = std::max(1, static_cast<int>(std::ceil(across / c.over_mm)));
  double ways = c.round ? 0.0 : 2.0 * (along - across);
  for (int k = 1; k <= rings; ++k) {
    const double out = across * k / rings;
    ways += c.round ? 2.0 * pi * out : 4.0 * (along - across + 2.0 * out);
  }
  const double turns = std::ceil(c.level_mm / c.turn_mm) + 1.0;
  return 60.0 * c.levels * (ways / c.feed_mm_min + turns * 2.0 * pi * c.helix_mm / c.ramp_feed_mm_min);
}

}  // namespace capstan::controls::gcode
