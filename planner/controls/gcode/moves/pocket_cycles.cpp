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
#include "planner/model/plan/edit/cycles.h"

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
constexpr double kChordMm = 0.0005;
/// The helix's radius over that of the cutter's flat front: near it, and no core is left. Default, unsourced.
constexpr double kHelixShare = 0.9;
/// Of the diameter: a smaller helix is hardly one. Default, unsourced.
constexpr double kLeastHelix = 0.05;

constexpr const char* kNoHelix = "no helix has room in it";

PocketOfStep no(std::string why) { return {std::nullopt, std::move(why), {}}; }

/// What the path says of its way in: along ramps.
struct WayIn {
  double slope = 1e300, feed_mm_min = 1e300, rpm = 0.0;
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
    if (!any) {
      out.start_z = p.z[i - 1];
      out.rpm = step.schedule ? step.schedule->spindle_rpm[i] : step.spindle_rpm;
    }
    any = true;
    const double drop = p.z[i - 1] - p.z[i], length = model::move_length(p, i);
    const double run = std::sqrt(std::max(0.0, length * length - drop * drop));
    if (run > kAgreeMm && drop > 0.0) out.slope = std::min(out.slope, drop / run);
    out.feed_mm_min =
        std::min(out.feed_mm_min, step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min);
  }
  if (out.slope >= 1e300) return std::nullopt;
  return out;
}

/// How far the path's cuts reach from the pocket's middle, along its length and across, or about it; and how
/// deep.
struct Reach {
  double along_mm = 0.0, across_mm = 0.0, about_mm = 0.0, lowest_z = 1e300;
  double turned = 0.0;  ///< twice the area that it goes round; above 0 counter-clockwise
};

Reach reach_of(const CutterPath& p, const PocketCycle& c) {
  const Vec2 u{std::cos(c.angle_deg / kDegrees), std::sin(c.angle_deg / kDegrees)};
  Reach out;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.kind[i] == MoveKind::kRapid || p.kind[i] == MoveKind::kDwell) continue;
    Vec2 before = xy(p.point(i - 1)) - c.centre;
    // Chords of an arc lie within it by kChordMm at most.
    const bool arc = model::is_arc(p.kind[i]);
    const double radius = arc ? norm(Vec2{p.x[i] - p.cx[i], p.y[i] - p.cy[i]}) : 0.0;
    const double chord = 2.0 * std::sqrt(2.0 * kChordMm / std::max(radius, kChordMm));
    const int pieces = arc ? static_cast<int>(std::ceil(model::arc_sweep(p, i) / chord)) : 1;
    for (int k = 0; k <= pieces; ++k) {
      const Vec2 at = xy(model::point_on_move(p, i, static_cast<double>(k) / pieces)) - c.centre;
      out.turned += before.x * at.y - before.y * at.x;
      before = at;
      out.along_mm = std::max(out.along_mm, std::abs(dot(at, u)));
      out.across_mm = std::max(out.across_mm, std::abs(u.x * at.y - u.y * at.x));
      out.about_mm = std::max(out.about_mm, norm(at));
    }
    out.lowest_z = std::min(out.lowest_z, p.z[i]);
  }
  return out;
}

bool in_the_middle(const model::Toleranced& t) { return std::abs(t.middle() - t.nominal_mm) < kSame; }

bool is(double a, double b) { return std::abs(a - b) < kSame; }

/// A slot along a line, round at both ends, as a rectangle in its own frame; false: it is none.
bool slot(const model::Model& m, const model::Slot& noun, const model::FeatureShape& s, PocketCycle& c,
          Vec2& middle, double& turned) {
  const auto& ends = noun.end_conditions.items;
  const bool round = ends.size() == 2 && m.holds<model::RadiusedSlotEndType>(ends[0]) &&
                     m.holds<model::RadiusedSlotEndType>(ends[1]);
  if (!round || s.spine.size() != 2 || !s.slot_profile.empty() || s.slot_bottom_radius_mm > 0.0) return false;
  const Vec2 way = s.spine[1] - s.spine[0];
  c.slot = true;
  c.width_mm = s.width.nominal_mm;
  c.length_mm = norm(way) + c.width_mm;
  c.corner_mm = 0.5 * c.width_mm;
  middle = s.spine[0] + 0.5 * way;
  turned = std::atan2(way.y, way.x);
  return true;
}

/// A pocket's rectangle or circle, in its own frame; why not.
std::string pocket(bool round, const model::FeatureShape& s, PocketCycle& c, Vec2& middle) {
  const auto box = geometry::bounds(s.area);
  middle = {0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y)};
  c.round = round;
  c.length_mm = round ? s.width.nominal_mm : box.hi.x - box.lo.x;
  c.width_mm = round ? s.width.nominal_mm : box.hi.y - box.lo.y;
  c.corner_mm = round ? 0.5 * c.length_mm : s.corner_radius_mm;
  const double along = s.length.nominal_mm, across = s.width.nominal_mm;
  if (!round && !(is(c.length_mm, along) && is(c.width_mm, across)) &&
      !(is(c.length_mm, across) && is(c.width_mm, along)))
    return "its profile is turned in its own frame";
  return {};
}

/// The feature's own figures; why not, where it is none for a cycle.
PocketOfStep contour(const model::Plan& plan, const model::StepResult& step,
                     const model::MachiningWorkingstep& ws) {
  const model::Model& m = plan.model;
  const auto* closed = m.get<model::ClosedPocket>(ws.its_feature);
  const auto* noun = m.get<model::Slot>(ws.its_feature);
  if (closed == nullptr && noun == nullptr) return {};
  const auto shapes = model::shapes_of(m, ws.its_feature);
  if (!shapes || shapes->size() != 1) return no("it is one of several");
  const model::FeatureShape& s = shapes->front();
  if (s.open) return {};
  PocketCycle c;
  Vec2 middle;
  double turned = 0.0;
  if (closed != nullptr) {
    const bool round = m.holds<model::CircularClosedProfile>(closed->feature_boundary);
    if (!round && !m.holds<model::RectangularClosedProfile>(closed->feature_boundary))
      return no("its contour is neither a rectangle nor a circle");
    if (std::string why = pocket(round, s, c, middle); !why.empty()) return no(std::move(why));
  } else if (!slot(m, *noun, s, c, middle, turned)) {
    return no("it is no square slot along a line with both ends round");
  }
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
  c.centre = xy(at.to_parent({middle.x, middle.y, 0.0}));
  c.angle_deg = c.round ? 0.0 : (std::atan2(at.x.y, at.x.x) + turned) * kDegrees;
  c.floor_z = at.origin.z - s.depth_mm;
  return {c, {}, {}};
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
  c.climbs = (r.turned > 0.0) == (step.spindle_rpm >= 0.0);
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
  // Rounded apart, corners of a slot might come out rounder than half its width.
  c.corner_mm = std::min(c.corner_mm, down(0.5 * std::min(c.length_mm, c.width_mm), unit));
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
  const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
  if (cutter == nullptr || !step.path || step.path->size() < 2 || step.setup >= plan.setups.size()) return {};
  if (ws == nullptr || !model::has(ws->its_operation.type, model::OperationTrait::kRoughs)) return {};
  PocketOfStep out = contour(plan, step, *ws);
  if (!out.cycle) return out;
  for (std::size_t i = 0; i < n; ++i) {
    const auto* before = plan.model.get<model::MachiningWorkingstep>(plan.steps[i].step);
    if (before != nullptr && before->its_feature == ws->its_feature)
      return no("a step before has cut in it: the cycle would cut it all again");
  }
  PocketCycle& c = *out.cycle;
  c.cutter_mm = cutter->cutting_diameter_mm;
  c.flat_mm = c.cutter_mm - 2.0 * model::end_radius_mm(*cutter);
  c.tool = cutter->pocket;
  // Rings farther apart than its front is flat leave ridges on the floor.
  if (!(kRingShare * c.flat_mm > std::pow(10.0, -plan.machine.control.decimals)))
    return no("its mill is round at the end: rings would leave ridges on the floor");
  if (std::string why = left_by(plan, step, *ws, c); !why.empty()) return no(std::move(why));
  const auto in = way_in(step);
  if (!in) return no("its path does not go in along a ramp");
  const double first =
      step.schedule && step.path->size() > 1 ? step.schedule->spindle_rpm[1] : step.spindle_rpm;
  if (first != in->rpm || !(in->rpm > 0.0)) return no("its path does not begin at the speed of its way in");
  const double narrow = 0.5 * std::min(c.length_mm, c.width_mm) - 0.5 * c.cutter_mm - c.side_mm;
  // Any circle with the path's slope goes in as steeply as the path.
  c.helix_mm = std::min(kHelixShare * 0.5 * c.flat_mm, narrow);
  if (c.helix_mm < kLeastHelix * c.cutter_mm) c.helix_mm = 0.0;
  if (c.helix_mm == 0.0 && !c.slot) return no(kNoHelix);
  c.turn_mm = in->slope * 2.0 * pi * c.helix_mm;
  c.angle_deg -= 180.0 * std::floor((c.angle_deg + kSame) / 180.0);
  c.angle_deg = std::max(0.0, c.angle_deg);
  c.back_z = step.path->z[0];
  c.start_z = in->start_z;
  c.reference_z = c.start_z - kClearanceMm;
  const double depth = c.reference_z - c.floor_z - c.bottom_mm;
  const auto slot = slot_levels(plan, step, *cutter, depth, step.axial_depth_mm, in->rpm,
                                plan.machine.control.feed_decimals);
  if (!slot) return no("no feed keeps the step's loads in a slot as wide as the cutter");
  c.levels = slot->levels;
  c.level_mm = depth / slot->levels;
  c.feed_mm_min = slot->feed_mm_min;
  c.ramp_feed_mm_min = std::min(in->feed_mm_min, slot->feed_mm_min);
  c.over_mm = kRingShare * c.flat_mm;
  c.planned_s = step.cutting_s;
  round_to(c, plan.machine.control);
  c.slope = c.helix_mm > 0.0 ? std::min(in->slope, c.turn_mm / (2.0 * pi * c.helix_mm)) : in->slope;
  if (c.back_z < c.start_z || !(depth > 0.0)) return no("it does not begin above what it cuts");
  return out;
}

AskedPockets asked_pockets(const model::Plan& plan, const PocketWords* words) {
  AskedPockets out;
  out.of_step.resize(plan.steps.size());
  const std::vector<std::string> cycles = model::cycles_by_step(plan);
  std::map<int, double> slopes;  // by tool, the least
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    if (!model::asks_for_pocket_cycle(plan.machine, cycles[n])) continue;
    PocketOfStep& pocket = out.of_step[n] = pocket_of(plan, n);
    if (!pocket.cycle) continue;
    const PocketCycle& c = *pocket.cycle;
    const auto text = words != nullptr ? words->text(c) : std::nullopt;
    if (!text || (words->table != nullptr && words->table(c.tool, c.slope).empty())) {
      pocket = no(words != nullptr && c.helix_mm == 0.0 ? kNoHelix : "it has none");
      continue;
    }
    pocket.text = *text;
    const auto [least, first] = slopes.emplace(c.tool, c.slope);
    if (!first) least->second = std::min(least->second, c.slope);
  }
  if (words == nullptr || words->table == nullptr) return out;
  for (const auto& [tool, slope] : slopes) out.tables[tool] = words->table(tool, slope);
  for (PocketOfStep& pocket : out.of_step) {
    if (!pocket.cycle) continue;
    pocket.cycle->slope = slopes[pocket.cycle->tool];
    pocket.cycle->turn_mm = 2.0 * pi * pocket.cycle->helix_mm * pocket.cycle->slope;
  }
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
  const double turn = 2.0 * pi * c.helix_mm;
  const double in =
      c.helix_mm > 0.0 ? turn * (std::ceil(c.level_mm / c.turn_mm) + 1.0) : c.level_mm / c.slope;
  return 60.0 * c.levels * (ways / c.feed_mm_min + in / c.ramp_feed_mm_min);
}

}  // namespace capstan::controls::gcode
