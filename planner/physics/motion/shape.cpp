#include "planner/physics/motion/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/vocabulary/control_rows.h"

namespace capstan::motion {
namespace {

using geometry::Vec3;
using model::CutterPath;
using model::Machine;
using model::MoveKind;
using model::MoveRole;

std::array<double, 3> array_of(Vec3 v) { return {v.x, v.y, v.z}; }

// The largest length along u that keeps every axis within its limit.
double along(const std::array<double, 3>& limit, Vec3 u) {
  const auto c = array_of(u);
  double out = kNoSpeed;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(c[i]) > 1e-12) out = std::min(out, limit[i] / std::abs(c[i]));
  }
  return out;
}

// Acceleration or speed that every axis can reach in any direction of the plane spanned by the orthonormal u
// and v.
double within_plane(const std::array<double, 3>& limit, Vec3 u, Vec3 v) {
  const auto a = array_of(u);
  const auto b = array_of(v);
  double out = kNoSpeed;
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach = std::hypot(a[i], b[i]);
    if (reach > 1e-12) out = std::min(out, limit[i] / reach);
  }
  return out;
}

Shape line_shape(const CutterPath& path, std::size_t i, double feed_mm_s, const Limits& limits) {
  Shape out;
  const Vec3 step = path.point(i) - path.point(i - 1);
  const double length = norm(step);
  if (length <= 0.0) return out;
  const Vec3 u = (1.0 / length) * step;
  out.first = out.last = u;
  out.turning_mm_s = kNoSpeed;
  const bool rapid = path.kind[i] == MoveKind::kRapid;
  out.axes_mm_s = along(rapid ? limits.rapid_mm_s : limits.feed_mm_s, u);
  out.segment.length_mm = length;
  out.segment.acceleration_mm_s2 = along(limits.acceleration, u);
  out.segment.jerk_mm_s3 = along(limits.jerk, u);
  out.segment.speed_mm_s = rapid ? out.axes_mm_s : std::min(feed_mm_s, out.axes_mm_s);
  return out;
}

Shape arc_shape(const CutterPath& path, std::size_t i, double feed_mm_s, const Limits& limits) {
  Shape out;
  const double radius = std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]);
  const double turned = model::arc_sweep(path, i) * radius;
  const double rise = path.z[i] - path.z[i - 1];
  const double length = std::hypot(turned, rise);
  if (length <= 0.0 || radius <= 0.0) return out;
  const double flat = turned / length;
  const double steep = rise / length;
  const double sign = path.kind[i] == MoveKind::kArcCcw ? 1.0 : -1.0;
  const auto tangent = [&](double x, double y) {
    const double k = sign * flat / std::hypot(x - path.cx[i], y - path.cy[i]);
    return Vec3{-k * (y - path.cy[i]), k * (x - path.cx[i]), steep};
  };
  out.first = tangent(path.x[i - 1], path.y[i - 1]);
  out.last = tangent(path.x[i], path.y[i]);
  // Somewhere on the arc (or close to it) either axis carries all of the motion.
  const Vec3 in_x{flat, 0.0, steep};
  const Vec3 in_y{0.0, flat, steep};
  const double a = std::min(along(limits.acceleration, in_x), along(limits.acceleration, in_y));
  const double bend_mm = radius / (flat * flat);  // radius of curvature of a helix
  out.axes_mm_s = std::min(along(limits.feed_mm_s, in_x), along(limits.feed_mm_s, in_y));
  out.turning_mm_s = std::sqrt(limits.turning_share * a * bend_mm);
  const double v = std::min({feed_mm_s, out.axes_mm_s, out.turning_mm_s});
  const double used = v * v / (bend_mm * a);
  const double share = std::max(limits.along_share, std::sqrt(std::max(0.0, 1.0 - used * used)));
  out.segment = {length, v, a * share, 0.0, std::min(along(limits.jerk, in_x), along(limits.jerk, in_y))};
  return out;
}

}  // namespace

Result<Limits> limits_of(const Machine& machine) {
  Limits out;
  for (std::size_t i = 0; i < 3; ++i) {
    const model::LinearAxis& axis = machine.axes[i];
    if (!(axis.acceleration_mm_s2 > 0.0) || !(axis.rapid_mm_min > 0.0) || !std::isfinite(axis.rapid_mm_min) ||
        !std::isfinite(axis.acceleration_mm_s2)) {
      return fail(Diagnostic{.code = "MOT-MACHINE",
                             .message = "axis " + axis.name + " has no rapid speed or no acceleration",
                             .path = "axes",
                             .hint = "state rapid and acceleration of each axis in the machine's file"});
    }
    out.rapid_mm_s[i] = axis.rapid_mm_min / 60.0;
    out.feed_mm_s[i] = axis.feed_max_mm_min > 0.0 ? axis.feed_max_mm_min / 60.0 : out.rapid_mm_s[i];
    out.acceleration[i] = axis.acceleration_mm_s2;
    const bool jerk = axis.jerk_mm_s3 && *axis.jerk_mm_s3 > 0.0 && std::isfinite(*axis.jerk_mm_s3);
    out.jerk[i] = jerk ? *axis.jerk_mm_s3 : kNoJerk;
    out.has_jerk = out.has_jerk || jerk;
  }
  out.tolerance_mm = machine.control.path_tolerance_mm;
  out.block_s = machine.control.block_time_s;
  const model::ControlRow& follows = model::control_row(machine.control.dialect);
  out.turning_share = follows.turning_share;
  out.along_share = follows.along_share;
  return out;
}

Shape shape_of(const CutterPath& path, std::size_t i, double feed_mm_s, const Limits& limits) {
  return is_arc(path.kind[i]) ? arc_shape(path, i, feed_mm_s, limits)
                              : line_shape(path, i, feed_mm_s, limits);
}

// With the corner rounded within the tolerance.
Junction junction(const Shape& before, const Shape& after, const Limits& limits) {
  const double both = std::min(before.segment.speed_mm_s, after.segment.speed_mm_s);
  const double cosine = std::clamp(dot(before.last, after.first), -1.0, 1.0);
  const Vec3 aside = after.first - cosine * before.last;
  const double sine = norm(aside);
  if (sine < 1e-9) return {cosine > 0.0 ? both : 0.0, false};
  const double half = 0.5 * (std::numbers::pi - std::atan2(sine, cosine));
  const double s = std::sin(half);
  const double by_tolerance = limits.tolerance_mm * s / (1.0 - s);
  const double by_length = std::tan(half) * 0.5 * std::min(before.segment.length_mm, after.segment.length_mm);
  const double radius = std::min(by_tolerance, by_length);
  if (!(radius > 0.0)) return {0.0, true};
  const double a = within_plane(limits.acceleration, before.last, (1.0 / sine) * aside);
  const double v = std::sqrt(limits.turning_share * a * radius);
  return {std::min(both, v), v < both && by_tolerance <= by_length};
}

bool stops_between(const CutterPath& path, std::size_t before, std::size_t after) {
  return (path.kind[before] == MoveKind::kRapid) != (path.kind[after] == MoveKind::kRapid) ||
         path.role[before] == MoveRole::kTap || path.role[after] == MoveRole::kTap;
}

}  // namespace capstan::motion
