#include "planner/controls/gcode/moves/face_cycles.h"

#include <algorithm>
#include <cmath>

#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/gcode/moves/slot_feed.h"
#include "planner/ground/base/number.h"
#include "planner/ground/geometry/region.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/edit/cycles.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Box3;
using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::CutterPath;
using model::MoveKind;

/// Between the cutter and the edge where a stroke begins and ends: planning's own
/// (making/toolpath/defaults.h, kAirBeyond).
constexpr double kOutMm = 1.0;
/// By which path and feature may be apart; a program's own accuracy, mm.
constexpr double kAgreeMm = 0.002;
constexpr double kSame = 1e-6;
/// Of the cutter's radius by which strokes along an edge go over it: planning's own for a single pass
/// (making/toolpath/region/form/face.cpp).
constexpr double kOverEdge = 0.1;

FaceOfStep no(std::string why) { return {std::nullopt, std::move(why), {}}; }

/// The box of another frame's box.
Box3 box_in(const Placement& there, const Box3& box) {
  Box3 out;
  for (const double x : {box.lo.x, box.hi.x})
    for (const double y : {box.lo.y, box.hi.y})
      for (const double z : {box.lo.z, box.hi.z}) out.add(there.to_parent({x, y, z}));
  return out;
}

/// The widest that a tool is anywhere, its holder included, mm.
double widest(const model::Cutter& c) {
  double out = std::max({c.cutting_diameter_mm, c.shank_diameter_mm, c.holder_diameter_mm,
                         2.0 * model::profile_of(c).radius_at(c.maximum_depth_of_cut_mm)});
  for (const auto& s : c.holder) out = std::max({out, s.lower_diameter_mm, s.upper_diameter_mm});
  return 0.5 * out;
}

/// The face's own figures; why not, where it is none for a cycle.
FaceOfStep rectangle(const model::Plan& plan, const model::StepResult& step,
                     const model::MachiningWorkingstep& ws) {
  const model::Model& m = plan.model;
  if (m.get<model::PlanarFace>(ws.its_feature) == nullptr) return {};
  const auto shapes = model::shapes_of(m, ws.its_feature);
  if (!shapes || shapes->size() != 1) return no("it is one of several");
  const model::FeatureShape& s = shapes->front();
  if (!s.islands.empty()) return no("material stands on it");
  const auto* feature = m.get<model::ManufacturingFeature>(ws.its_feature);
  const auto* piece = m.get<model::Workpiece>(feature->its_workpiece);
  const auto there = model::workpiece_in_program(m, plan.setups[step.setup].setup, piece);
  const Placement at = geometry::compose(there && *there ? **there : Placement{}, s.frame);
  if (at.z.z < 1.0 - kSame) return no("it is not upright in the set-up");
  FaceCycle c;
  c.lo = {1e300, 1e300};
  c.hi = {-1e300, -1e300};
  for (const auto& loop : s.area.loops) {
    for (const Vec2 q : loop) {
      const Vec3 p = at.to_parent({q.x, q.y, 0.0});
      c.lo = {std::min(c.lo.x, p.x), std::min(c.lo.y, p.y)};
      c.hi = {std::max(c.hi.x, p.x), std::max(c.hi.y, p.y)};
    }
  }
  const Vec2 size = c.hi - c.lo;
  if (!(size.x > 0.0) || std::abs(geometry::area(s.area) - size.x * size.y) > kAgreeMm * (size.x + size.y))
    return no("it is no rectangle along the axes of the set-up");
  if (plan.stock.box.empty()) return no("the raw piece is not known");
  const Box3 raw = box_in(model::placed_in(plan, step.setup), plan.stock.box);
  if (raw.lo.x < c.lo.x - kAgreeMm || raw.lo.y < c.lo.y - kAgreeMm || raw.hi.x > c.hi.x + kAgreeMm ||
      raw.hi.y > c.hi.y + kAgreeMm)
    return no("the raw piece reaches beyond it");
  c.reference_z = std::max(raw.hi.z, at.origin.z);
  c.floor_z = at.origin.z - s.depth_mm;
  return {c, {}, {}};
}

/// Along which axis the path's longest cut goes.
bool goes_along_y(const CutterPath& p) {
  double longest = 0.0;
  bool out = false;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.kind[i] != MoveKind::kLine) continue;
    const double x = std::abs(p.x[i] - p.x[i - 1]), y = std::abs(p.y[i] - p.y[i - 1]);
    if (std::max(x, y) <= longest + kSame) continue;
    longest = std::max(x, y);
    out = y > x;
  }
  return out;
}

/// What of the holding is in the way; empty: nothing is.
std::string in_the_way(const model::Workholding& holding, const FaceCycle& c) {
  if (holding.solids.empty()) return "nobody has said what holds the piece";
  const double low = c.floor_z + c.bottom_mm - holding.clearance_mm;
  for (const model::FixtureSolid& s : holding.solids) {
    if (s.outline.empty() || s.top_mm < low) continue;
    Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
    for (const Vec2 q : s.outline) {
      lo = {std::min(lo.x, q.x), std::min(lo.y, q.y)};
      hi = {std::max(hi.x, q.x), std::max(hi.y, q.y)};
    }
    if (lo.x < c.free_hi.x && hi.x > c.free_lo.x && lo.y < c.free_hi.y && hi.y > c.free_lo.y)
      return s.id + " stands beside it, as high as its floor";
  }
  return {};
}

/// Rounded as the control writes it: the rectangle and the overrun no smaller, feeds and distances no larger.
void round_to(FaceCycle& c, const model::Control& control) {
  c.decimals = control.decimals;
  c.feed_decimals = control.feed_decimals;
  const double unit = std::pow(10.0, -c.decimals), feeds = std::pow(10.0, -c.feed_decimals);
  const auto down = [](double v, double u) { return std::floor(v / u + 1e-6) * u; };
  const auto up = [](double v, double u) { return std::ceil(v / u - 1e-6) * u; };
  c.lo = {down(c.lo.x, unit), down(c.lo.y, unit)};
  c.hi = {up(c.hi.x, unit), up(c.hi.y, unit)};
  for (double* v : {&c.back_z, &c.start_z, &c.floor_z, &c.bottom_mm}) *v = rounded(*v, c.decimals);
  c.reference_z = up(c.reference_z, unit);
  c.level_mm = up(c.level_mm, unit);
  c.out_mm = up(c.out_mm, unit);
  c.over_mm = down(c.over_mm, unit);
  c.feed_mm_min = down(c.feed_mm_min, feeds);
}

}  // namespace

FaceOfStep face_of(const model::Plan& plan, std::size_t n) {
  const model::StepResult& step = plan.steps[n];
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
  if (cutter == nullptr || !step.path || step.path->size() < 2 || step.setup >= plan.setups.size()) return {};
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::PlaneMilling>(ws->its_operation);
  if (op == nullptr) return {};
  FaceOfStep out = rectangle(plan, step, *ws);
  if (!out.cycle) return out;
  for (std::size_t i = 0; i < n; ++i) {
    const auto* before = plan.model.get<model::MachiningWorkingstep>(plan.steps[i].step);
    if (before != nullptr && before->its_feature == ws->its_feature)
      return no("a step before has cut it: the cycle would cut it all again");
  }
  FaceCycle& c = *out.cycle;
  const CutterPath& p = *step.path;
  c.cutter_mm = cutter->cutting_diameter_mm;
  c.tool = cutter->pocket;
  c.bottom_mm = op->allowance_bottom.value_or(0.0);
  c.along_y = goes_along_y(p);
  const double corner = model::end_radius_mm(*cutter), flat = c.cutter_mm - 2.0 * corner;
  const int decimals = plan.machine.control.decimals;
  if (!(kRingShare * flat > std::pow(10.0, -decimals)))
    return no("its mill is round at the end: strokes would leave ridges");
  double lowest = 1e300, start = 1e300;
  for (std::size_t i = 1; i < p.size(); ++i) {
    lowest = std::min(lowest, p.z[i]);
    if (start > 1e299 && p.kind[i] != MoveKind::kRapid && p.kind[i] != MoveKind::kDwell) start = p.z[i - 1];
    if (step.schedule && step.schedule->spindle_rpm[i] != step.schedule->spindle_rpm[1])
      return no("its path changes the speed");
  }
  if (std::abs(lowest - c.floor_z - c.bottom_mm) > kAgreeMm) return no("its path does not go down to it");
  c.back_z = p.z[0];
  c.start_z = start;
  if (c.back_z < c.start_z || c.start_z < c.reference_z) return no("its path does not begin above the piece");
  // Strokes along an edge leave nothing on it wherever the control counts from: the flat front reaches over
  // it.
  const double depth = c.reference_z - c.floor_z - c.bottom_mm;
  const double sides = corner + kOverEdge * 0.5 * c.cutter_mm;
  double& lo = c.along_y ? c.lo.x : c.lo.y;
  double& hi = c.along_y ? c.hi.x : c.hi.y;
  const double grown = std::max(sides, 0.5 * (c.cutter_mm - (hi - lo)));
  lo -= grown;
  hi += grown;
  const double beside = model::profile_of(*cutter).radius_at(std::max(depth, 0.0));
  c.out_mm = std::max(kOutMm, beside - 0.5 * c.cutter_mm);
  c.over_mm = kRingShare * flat;
  const double rpm = step.schedule ? step.schedule->spindle_rpm[1] : step.spindle_rpm;
  const auto slot = slot_levels(plan, step, *cutter, depth, step.axial_depth_mm, std::abs(rpm),
                                plan.machine.control.feed_decimals);
  if (!slot) return no("no feed keeps the step's loads in a slot as wide as the cutter");
  c.levels = slot->levels;
  c.level_mm = depth / slot->levels;
  c.feed_mm_min = slot->feed_mm_min;
  c.planned_s = step.cutting_s;
  round_to(c, plan.machine.control);
  const model::Workholding& holding = plan.setups[step.setup].holding;
  // By its clearance, too, the control may begin beside the edge: texts say it, and no list does.
  const double out_mm = std::max(c.out_mm, c.start_z - c.reference_z);
  const double reach = 0.5 * c.cutter_mm + out_mm + widest(*cutter) + holding.clearance_mm;
  c.free_lo = c.lo - Vec2{reach, reach};
  c.free_hi = c.hi + Vec2{reach, reach};
  if (std::string why = in_the_way(holding, c); !why.empty()) return no(std::move(why));
  return out;
}

std::vector<FaceOfStep> asked_faces(const model::Plan& plan, const FaceWords* words) {
  std::vector<FaceOfStep> out(plan.steps.size());
  const std::vector<std::string> cycles = model::cycles_by_step(plan);
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    if (!model::asks_for_pocket_cycle(plan.machine, cycles[n])) continue;
    out[n] = face_of(plan, n);
    if (!out[n].cycle) continue;
    if (words == nullptr) {
      out[n] = no("it has none");
    } else {
      out[n].text = words->text(*out[n].cycle);
    }
  }
  return out;
}

double estimated_s(const FaceCycle& c) {
  const Vec2 size = c.hi - c.lo;
  const double along = (c.along_y ? size.y : size.x) + c.cutter_mm + 2.0 * c.out_mm;
  const double across = std::max(0.0, (c.along_y ? size.x : size.y) - c.cutter_mm);
  const double strokes = 1.0 + std::ceil(across / c.over_mm - kSame);
  return 60.0 * c.levels * (strokes * along + across) / c.feed_mm_min;
}

}  // namespace capstan::controls::gcode
