#include "planner/proof/verify/touches/way.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/sweep/apart.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/nouns.h"

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kAlong = 0.999999;  ///< cosine

}  // namespace

std::optional<TouchWay> way_of(const model::Plan& plan, model::AnyRef touch, std::size_t setup) {
  const model::Model& m = plan.model;
  const auto& p = m.at<model::WorkpieceProbing>(touch);
  const auto start = volumes::frame_of(m, p.start_position);
  const auto direction = volumes::unit_of(m, p.direction);
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  const auto* probe = m.get<model::TouchProbe>(p.its_probe);
  if (!start || !direction || expected == nullptr || !expected->theoretical_size || probe == nullptr ||
      !probe->ball_radius)
    return std::nullopt;
  const geometry::Placement piece = workpiece_in(plan, setup);
  TouchWay w;
  w.ball = *probe->ball_radius;
  w.stem = std::max(w.ball, probe->stylus_diameter.value_or(0.0) / 2.0);
  w.start = piece.to_parent(start->origin);
  w.wall = piece.to_parent(start->origin + (*expected->theoretical_size + w.ball) * *direction);
  const Vec3 d = w.wall - w.start;
  for (const char axis : {'X', 'Y', 'Z'}) {
    if (std::abs(along(d, axis)) > kAlong * norm(d)) {
      w.axis = axis;
      return w;
    }
  }
  return std::nullopt;
}

std::string in_the_way(const model::Plan& plan, const TouchWay& w, std::size_t setup) {
  const double head = model::control_number(plan.machine, "probe_radius_mm", 0.0);
  const double stylus = model::control_number(plan.machine, "probe_stylus_mm", 0.0);
  if (!(head > 0.0) || !(stylus > 0.0)) return "the probe, whose sizes the machine's file does not state";
  const model::Workholding& holding = plan.setups[setup].holding;
  if (holding.solids.empty()) return "what holds the piece, which nobody has said";
  if (plan.stock.box.empty()) return "the raw piece, which is not known";
  const geometry::Box3 raw = placed(plan.stock.box, workpiece_in(plan, setup));
  const std::vector<Vec2> sides{
      {raw.lo.x, raw.lo.y}, {raw.hi.x, raw.lo.y}, {raw.hi.x, raw.hi.y}, {raw.lo.x, raw.hi.y}};
  const std::vector<Vec2> begin{xy(w.start)}, way{xy(w.start), xy(w.wall)};
  const double low = std::min(w.start.z, w.wall.z), gap = holding.clearance_mm;
  const bool under_start = w.start.z - w.ball < raw.hi.z + gap, under_head = low + stylus < raw.hi.z + gap;
  if ((under_start && apart(begin, sides) < w.stem + gap) || (under_head && apart(way, sides) < head + gap))
    return "the piece";
  for (const model::FixtureSolid& s : holding.solids) {
    if (s.outline.empty()) continue;
    const double off = apart(way, s.outline);
    if ((low - w.ball < s.top_mm + gap && off < w.stem + gap) ||
        (low + stylus < s.top_mm + gap && off < head + gap))
      return s.id;
  }
  return {};
}

StandsBetween between_steps(const ProgramCase& c, long line) {
  const auto step_at = [&](std::size_t marker) -> const model::StepResult* {
    const long i = marker < c.step_of_marker.size() ? c.step_of_marker[marker] : -1;
    return i < 0 ? nullptr : &c.plan->steps[static_cast<std::size_t>(i)];
  };
  std::size_t next = 0;
  while (next < c.program.markers.size() && c.program.markers[next].line < line) ++next;
  Block at;
  at.marker = static_cast<int>(next) - 1;
  at.line = line;
  StandsBetween out;
  out.where = c.where(at);
  out.behind = next == 0 ? nullptr : step_at(next - 1);
  out.then = step_at(next);
  out.next = next;
  out.at_end = next == c.program.markers.size();
  return out;
}

bool stands_right(const StandsBetween& at, model::AnyRef before, std::size_t setup) {
  return at.behind != nullptr && (at.then == nullptr) == at.at_end &&
         (at.then == nullptr ? model::AnyRef{} : model::AnyRef(at.then->step)) == before &&
         at.behind->setup == setup;
}

bool calls_no_tool(const ProgramCase& c, const StandsBetween& at) {
  if (at.at_end) return false;
  return std::none_of(c.program.blocks.begin(), c.program.blocks.end(), [&](const Block& b) {
    return b.marker == static_cast<int>(at.next) && b.kind == Block::Kind::kToolChange;
  });
}

}  // namespace capstan::verify
