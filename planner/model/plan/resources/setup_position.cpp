#include "planner/model/plan/resources/setup_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/setup_place.h"

namespace capstan::model {
namespace {

using geometry::Vec3;

constexpr double kNear = 1.0 - 1e-6;

/// Axis (unit) and angle (0 to pi) of a rotation, by its matrix: the antisymmetric part is 2 sin(a) times the
/// axis; at half a turn that vanishes, and R + 1 = 2 n n^T.
struct Turn {
  Vec3 axis{0, 0, 1};
  double angle_rad = 0.0;
};
Turn turn_of(const geometry::Placement& r) {
  const double cosine = std::clamp(0.5 * (r.x.x + r.y.y + r.z.z - 1.0), -1.0, 1.0);
  Turn out;
  out.angle_rad = std::acos(cosine);
  const Vec3 skew{r.y.z - r.z.y, r.z.x - r.x.z, r.x.y - r.y.x};
  if (const double length = norm(skew); length > 1e-6) {
    out.axis = (1.0 / length) * skew;
    return out;
  }
  if (cosine > 0.0) return out;
  const Vec3 columns[3] = {r.x + Vec3{1, 0, 0}, r.y + Vec3{0, 1, 0}, r.z + Vec3{0, 0, 1}};
  const Vec3& widest = *std::max_element(std::begin(columns), std::end(columns),
                                         [](Vec3 a, Vec3 b) { return norm(a) < norm(b); });
  if (norm(widest) > 0.0) out.axis = (1.0 / norm(widest)) * widest;
  return out;
}

struct Sides {
  char axis;
  const char *low, *high, *below, *above;
};
constexpr std::array<Sides, 3> kSides = {{{'X', "left side", "right side", "left of", "right of"},
                                          {'Y', "front", "back", "in front of", "behind"},
                                          {'Z', "underside", "top", "below", "above"}}};

std::string one_zero(const Sides& s, double lo, double hi, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  const std::string axis = std::string(1, s.axis) + "0 ";
  if (std::abs(lo) < 0.5 * unit) return axis + "at its " + s.low;
  if (std::abs(hi) < 0.5 * unit) return axis + "at its " + s.high;
  if (lo > 0.0) return axis + trimmed(lo, decimals) + " mm " + s.below + " its " + s.low;
  if (hi < 0.0) return axis + trimmed(-hi, decimals) + " mm " + s.above + " its " + s.high;
  return axis + trimmed(-lo, decimals) + " mm " + s.above + " its " + s.low;
}

}  // namespace

geometry::Placement placed_in(const Plan& plan, std::size_t setup) {
  if (setup >= plan.setups.size()) return {};
  const auto frame =
      workpiece_in_program(plan.model, plan.setups[setup].setup, workpiece_of(plan.model, plan.project));
  return frame ? frame->value_or(geometry::Placement{}) : geometry::Placement{};
}

std::string axis_text(const geometry::Placement& workpiece, Vec3 direction) {
  const Vec3 v = workpiece.direction_to_local(direction);
  for (const auto& [value, name] : {std::pair{v.x, 'X'}, {v.y, 'Y'}, {v.z, 'Z'}}) {
    if (value > kNear) return std::string("+") + name;
    if (value < -kNear) return std::string("-") + name;
  }
  return "(" + trimmed(v.x, 3) + ", " + trimmed(v.y, 3) + ", " + trimmed(v.z, 3) + ")";
}

std::string turn_text(const geometry::Placement& before, const geometry::Placement& now) {
  const geometry::Placement change = compose(now, inverse(before));
  const Turn turn = turn_of(change);
  constexpr double kStill = 1e-6;
  if (turn.angle_rad < kStill) return "not turned";
  const bool half = turn.angle_rad > std::numbers::pi - kStill;
  std::string axis = axis_text(before, turn.axis);
  // Half a turn is the same both ways.
  if (half && axis.front() == '-') axis = axis_text(before, -1.0 * turn.axis);
  if (axis.front() == '+') axis.erase(0, 1);
  return std::string(change.z.z < -kNear ? "turned over, " : "turned ") +
         trimmed(turn.angle_rad * 180.0 / std::numbers::pi, 2) + " deg about its " + axis + " axis";
}

bool faces_axes(const geometry::Placement& workpiece) {
  const auto faces = [](Vec3 d) { return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) >= kNear; };
  return faces(workpiece.x) && faces(workpiece.y) && faces(workpiece.z);
}

std::string zero_text(const geometry::Box3& raw, const geometry::Placement& workpiece, int decimals) {
  if (raw.empty() || !faces_axes(workpiece)) return {};
  geometry::Box3 box;
  box.add(workpiece.to_parent(raw.lo));
  box.add(workpiece.to_parent(raw.hi));
  return one_zero(kSides[0], box.lo.x, box.hi.x, decimals) + ", " +
         one_zero(kSides[1], box.lo.y, box.hi.y, decimals) + ", " +
         one_zero(kSides[2], box.lo.z, box.hi.z, decimals);
}

}  // namespace capstan::model
