#include "planner/files/exchange/toolpaths/section_points.h"

#include <cmath>
#include <vector>

#include "planner/model/nouns/all.h"

namespace capstan::exchange {
namespace {

constexpr double kStraightMm = 1e-5;  // written numbers have less than this

bool straight_on(const model::CutterPath& p, std::size_t a, std::size_t at, std::size_t b) {
  const auto whole = p.point(b) - p.point(a);
  const auto part = p.point(at) - p.point(a);
  const double length = norm(whole);
  if (!(length > 0.0)) return false;
  const double t = dot(part, whole) / (length * length);
  return t > 0.0 && t < 1.0 && norm(part - t * whole) < kStraightMm;
}

template <class T>
void keep_only(std::vector<T>& column, std::size_t from, const std::vector<bool>& keep) {
  std::size_t to = from;
  for (std::size_t i = from; i < column.size(); ++i) {
    if (i - from >= keep.size() || keep[i - from]) column[to++] = column[i];
  }
  column.resize(to);
}

}  // namespace

void join_at_section_points(const model::Model& m, model::AnyRef curve, const MoveParameters& moves,
                            StepPath& step) {
  const auto* line = m.get<model::Polyline>(curve);
  auto& p = step.path;
  if (line == nullptr || moves.from.size() < 3 || p.size() < moves.from.size()) return;
  const std::size_t first = p.size() - moves.from.size();  // the point that the moves begin at
  const auto named = [&](double u) {
    const auto k = static_cast<std::size_t>(std::max(0.0, std::round(u)));
    const auto* point = std::abs(u - std::round(u)) < 1e-9 && k < line->points.items.size()
                            ? m.get<model::CartesianPoint>(line->points[k])
                            : nullptr;
    return point != nullptr && point->name == kSectionPoint;
  };
  std::vector<bool> keep(moves.from.size(), true);
  std::size_t start = first;  // where the present line begins
  bool any = false;
  for (std::size_t i = 1; i + 1 < moves.from.size(); ++i) {
    const std::size_t a = first + i, b = a + 1;
    const bool one = named(moves.to[i]) && moves.from[i + 1] == moves.to[i] &&
                     p.kind[a] == model::MoveKind::kLine && p.kind[b] == model::MoveKind::kLine &&
                     p.role[a] == p.role[b] && step.schedule.feed_mm_min[a] == step.schedule.feed_mm_min[b] &&
                     step.schedule.spindle_rpm[a] == step.schedule.spindle_rpm[b] &&
                     straight_on(p, start, a, b);
    keep[i] = !one;
    any = any || one;
    if (!one) start = a;
  }
  if (!any) return;
  // Of each old move: its number now, and how far from the new move's start it begins.
  std::vector<std::size_t> number(keep.size());
  std::vector<double> from(keep.size(), 0.0);
  std::size_t n = first + 1;
  double begun = 0.0;
  for (std::size_t i = 1; i < keep.size(); ++i) {
    number[i] = n;
    from[i] = begun;
    begun = keep[i] ? 0.0 : begun + model::move_length(p, first + i);
    if (keep[i]) ++n;
  }
  auto& s = step.sections;
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (s.move[k] <= first) continue;
    const std::size_t i = s.move[k] - first;
    s.move[k] = static_cast<std::uint32_t>(number[i]);
    s.at_mm[k] += from[i];
  }
  for (auto* column : {&p.x, &p.y, &p.z, &p.cx, &p.cy, &step.schedule.feed_mm_min, &step.schedule.spindle_rpm,
                       &step.schedule.dwell_s})
    keep_only(*column, first, keep);
  keep_only(p.kind, first, keep);
  keep_only(p.role, first, keep);
}

}  // namespace capstan::exchange
