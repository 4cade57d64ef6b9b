#include "planner/proof/verify/moves.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::verify {
namespace {

double start_angle(const Move& m) { return std::atan2(m.from.y - m.centre.y, m.from.x - m.centre.x); }

/// `sweep_of`, where its start is known: arc tangents are most of what moves cost.
double sweep_from(const Move& m, double start) {
  const double end = std::atan2(m.to.y - m.centre.y, m.to.x - m.centre.x);
  double sweep = end - start;
  if (m.kind == model::MoveKind::kArcCw) sweep = -sweep;
  sweep = std::fmod(sweep, kRadPerTurn);
  if (sweep < 0.0) sweep += kRadPerTurn;
  return sweep <= 1e-9 ? kRadPerTurn : sweep;
}

}  // namespace

double sweep_of(const Move& m) { return sweep_from(m, start_angle(m)); }

double length_of(const Move& m) {
  if (m.kind == model::MoveKind::kDwell) return 0.0;
  if (!is_arc(m.kind)) return norm(m.to - m.from);
  return std::hypot(norm(xy(m.to) - m.centre) * sweep_of(m), m.to.z - m.from.z);
}

geometry::Vec3 point_of(const Move& m, double t) {
  if (!is_arc(m.kind)) return m.from + t * (m.to - m.from);
  const double r0 = norm(xy(m.from) - m.centre);
  const double r = r0 + t * (norm(xy(m.to) - m.centre) - r0);
  const double start = start_angle(m);
  const double a = start + (m.kind == model::MoveKind::kArcCcw ? t : -t) * sweep_from(m, start);
  return {m.centre.x + r * std::cos(a), m.centre.y + r * std::sin(a), m.from.z + t * (m.to.z - m.from.z)};
}

geometry::Box3 box_of(const Move& m) {
  geometry::Box3 box;
  box.add(m.from);
  box.add(m.to);
  if (!is_arc(m.kind)) return box;
  const double r = norm(xy(m.to) - m.centre);
  const double start = start_angle(m), sweep = sweep_from(m, start);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double at = quarter * kRadPerTurn / 4.0;
    double ahead = at - start;
    if (m.kind == model::MoveKind::kArcCw) ahead = -ahead;
    ahead = std::fmod(ahead, kRadPerTurn);
    if (ahead < 0.0) ahead += kRadPerTurn;
    if (ahead <= sweep) box.add({m.centre.x + r * std::cos(at), m.centre.y + r * std::sin(at), m.to.z});
  }
  return box;
}

int pieces_of(const Move& m, double chord_mm) {
  if (!is_arc(m.kind)) return 1;
  const double r = std::max(norm(xy(m.from) - m.centre), norm(xy(m.to) - m.centre));
  if (r <= chord_mm) return 4;
  const double step = 2.0 * std::acos(1.0 - chord_mm / r);  // sagitta r (1 - cos(step / 2))
  return static_cast<int>(std::clamp(std::ceil(sweep_of(m) / std::max(step, 1e-9)), 1.0, 20000.0));
}

}  // namespace capstan::verify
