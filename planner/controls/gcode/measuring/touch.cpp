#include "planner/controls/gcode/measuring/touch.h"

#include <algorithm>
#include <cmath>

#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::controls::gcode {

using geometry::Box3;
using geometry::Vec3;

namespace {

constexpr double kAlong = 0.999999;  ///< cosine: along an axis
constexpr double kHigh = 1e6;        ///< above all that stands on a machine, mm

double& on(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::string name_of(const std::string& id) {
  std::string out;
  for (const char c : id) {
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    out += plain ? c : '_';
  }
  return out;
}

/// The box of an upright cylinder whose axis goes from one place to another, from `low` up.
Box3 swept(Vec3 from, Vec3 to, double radius, double low, double high) {
  Box3 out;
  out.add({std::min(from.x, to.x) - radius, std::min(from.y, to.y) - radius, low});
  out.add({std::max(from.x, to.x) + radius, std::max(from.y, to.y) + radius, high});
  return out;
}

bool meet(const Box3& a, const Box3& b, double clearance) {
  return a.lo.x < b.hi.x + clearance && b.lo.x < a.hi.x + clearance && a.lo.y < b.hi.y + clearance &&
         b.lo.y < a.hi.y + clearance && a.lo.z < b.hi.z + clearance && b.lo.z < a.hi.z + clearance;
}

}  // namespace

std::optional<Touch> touch_of(const model::Plan& plan, model::AnyRef probing, std::size_t setup,
                              std::string& why_not) {
  const model::Model& m = plan.model;
  const auto& p = m.at<model::WorkpieceProbing>(probing);
  const auto start = model::placement(m, p.start_position);
  const auto along = model::direction(m, p.direction);
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  const auto* probe = m.get<model::TouchProbe>(p.its_probe);
  if (!start || !along || expected == nullptr || !expected->theoretical_size) {
    why_not = "its start, direction or distance is not stated";
    return std::nullopt;
  }
  if (probe == nullptr || !(probe->ball_radius.value_or(0.0) > 0.0)) {
    why_not = "the radius of the probe's ball is not stated";
    return std::nullopt;
  }
  const auto here = model::placed_in(plan, setup);
  const Vec3 way = here.direction_to_parent(*along);
  Touch t;
  t.axis = std::abs(way.x) > kAlong ? 0 : std::abs(way.y) > kAlong ? 1 : 2;
  if (std::abs(on(way, t.axis)) <= kAlong) {
    why_not = "it touches along no axis of the set-up";
    return std::nullopt;
  }
  t.feature = name_of(p.its_id.value_or(""));
  const auto* usage = m.get<model::ToolUsage>(probe->its_usage);
  t.probe = usage == nullptr ? "" : usage->its_position.value_or("");
  t.ball = *probe->ball_radius;
  t.stem = std::max(t.ball, 0.5 * probe->stylus_diameter.value_or(0.0));
  t.start = t.wall = here.to_parent(start->origin);
  t.sense = on(way, t.axis) > 0.0 ? 1 : -1;
  on(t.wall, t.axis) += t.sense * (*expected->theoretical_size + t.ball);
  return t;
}

std::string in_the_way(const model::Plan& plan, const Touch& t, std::size_t setup, double beyond_mm) {
  const double body = model::control_number(plan.machine, "probe_radius_mm", 0.0);
  const double stylus = model::control_number(plan.machine, "probe_stylus_mm", 0.0);
  if (!(body > 0.0) || !(stylus > 0.0))
    return "the machine's file states no probe_radius_mm or probe_stylus_mm";
  const model::Workholding& holding = plan.setups[setup].holding;
  if (plan.stock.box.empty()) return "the raw piece is not known";
  if (holding.solids.empty()) return "nobody has said what holds the piece";
  const auto here = model::placed_in(plan, setup);
  Vec3 end = t.wall;
  on(end, t.axis) += t.sense * beyond_mm;
  Box3 raw;
  for (const double x : {plan.stock.box.lo.x, plan.stock.box.hi.x})
    for (const double y : {plan.stock.box.lo.y, plan.stock.box.hi.y})
      for (const double z : {plan.stock.box.lo.z, plan.stock.box.hi.z}) raw.add(here.to_parent({x, y, z}));
  const double low = std::min(t.start.z, end.z);
  const Box3 stem_down = swept(t.start, t.start, t.stem, t.start.z - t.ball, kHigh);
  const Box3 stem = swept(t.start, end, t.stem, low - t.ball, kHigh);
  const Box3 head = swept(t.start, end, body, low + stylus, kHigh);
  const double apart = holding.clearance_mm;
  if (meet(stem_down, raw, apart) || meet(head, raw, apart))
    return "its way is not proven clear of the piece";
  for (const model::FixtureSolid& s : holding.solids) {
    Box3 solid;
    for (const geometry::Vec2 c : s.outline) {
      solid.add({c.x, c.y, s.bottom_mm});
      solid.add({c.x, c.y, s.top_mm});
    }
    if (!solid.empty() && (meet(stem, solid, apart) || meet(head, solid, apart)))
      return "its way is not proven clear of " + s.id;
  }
  return {};
}

std::string not_here(const model::StepResult* next, Standing standing) {
  if (standing.tool == 0 || (next != nullptr && next->setup != standing.setup))
    return "it stands before the first step of its set-up";
  return {};
}

}  // namespace capstan::controls::gcode
