#include "planner/model/plan/cutter_path.h"

#include <cmath>
#include <stdexcept>

#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::model {
namespace {

using geometry::Vec2;
using geometry::Vec3;

void push(CutterPath& p, Vec3 to, Vec2 centre, MoveKind kind, MoveRole why) {
  if (p.x.empty() && why != MoveRole::kApproach) throw std::logic_error("a path begins with start()");
  p.x.push_back(to.x);
  p.y.push_back(to.y);
  p.z.push_back(to.z);
  p.cx.push_back(centre.x);
  p.cy.push_back(centre.y);
  p.kind.push_back(kind);
  p.role.push_back(why);
}

}  // namespace

void CutterPath::start(Vec3 p) {
  if (!x.empty()) throw std::logic_error("a path starts once");
  push(*this, p, {}, MoveKind::kRapid, MoveRole::kApproach);
}

void CutterPath::line(Vec3 to, MoveRole why) { push(*this, to, {}, MoveKind::kLine, why); }
void CutterPath::rapid(Vec3 to, MoveRole why) { push(*this, to, {}, MoveKind::kRapid, why); }
void CutterPath::arc(Vec3 to, Vec2 centre, bool clockwise, MoveRole why) {
  push(*this, to, centre, clockwise ? MoveKind::kArcCw : MoveKind::kArcCcw, why);
}
void CutterPath::dwell() { push(*this, point(size() - 1), {}, MoveKind::kDwell, MoveRole::kDrill); }

double arc_sweep(const CutterPath& path, std::size_t i) {
  const double a0 = std::atan2(path.y[i - 1] - path.cy[i], path.x[i - 1] - path.cx[i]);
  const double a1 = std::atan2(path.y[i] - path.cy[i], path.x[i] - path.cx[i]);
  double sweep = path.kind[i] == MoveKind::kArcCcw ? a1 - a0 : a0 - a1;
  while (sweep <= 1e-9) sweep += kRadPerTurn;
  while (sweep > kRadPerTurn + 1e-9) sweep -= kRadPerTurn;
  return sweep;
}

double move_length(const CutterPath& path, std::size_t i) {
  if (i == 0 || path.kind[i] == MoveKind::kDwell) return 0.0;
  if (!is_arc(path.kind[i])) return norm(path.point(i) - path.point(i - 1));
  const double radius = std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]);
  return std::hypot(radius * arc_sweep(path, i), path.z[i] - path.z[i - 1]);
}

Vec3 point_on_move(const CutterPath& path, std::size_t i, double t) {
  const Vec3 a = path.point(i - 1);
  const Vec3 b = path.point(i);
  if (!is_arc(path.kind[i])) return a + t * (b - a);
  const double sign = path.kind[i] == MoveKind::kArcCcw ? 1.0 : -1.0;
  const double radius0 = std::hypot(a.x - path.cx[i], a.y - path.cy[i]);
  const double radius1 = std::hypot(b.x - path.cx[i], b.y - path.cy[i]);
  const double radius = radius0 + t * (radius1 - radius0);
  const double angle = std::atan2(a.y - path.cy[i], a.x - path.cx[i]) + sign * t * arc_sweep(path, i);
  return {path.cx[i] + radius * std::cos(angle), path.cy[i] + radius * std::sin(angle),
          a.z + t * (b.z - a.z)};
}

geometry::Box3 bounds(const CutterPath& path) {
  geometry::Box3 box;
  for (std::size_t i = 0; i < path.size(); ++i) {
    box.add(path.point(i));
    if (i == 0 || !is_arc(path.kind[i])) continue;
    // An arc's extrema lie where its angle passes a quarter turn.
    const double radius = std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]);
    const double sweep = arc_sweep(path, i);
    const double a0 = std::atan2(path.y[i - 1] - path.cy[i], path.x[i - 1] - path.cx[i]);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double at = quarter * kRadPerTurn / 4.0;
      double ahead = path.kind[i] == MoveKind::kArcCcw ? at - a0 : a0 - at;
      while (ahead < 0.0) ahead += kRadPerTurn;
      while (ahead >= kRadPerTurn) ahead -= kRadPerTurn;
      if (ahead > sweep) continue;
      box.add({path.cx[i] + radius * std::cos(at), path.cy[i] + radius * std::sin(at), path.z[i]});
    }
  }
  return box;
}

}  // namespace capstan::model
