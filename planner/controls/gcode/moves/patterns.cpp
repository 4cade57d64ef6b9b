#include "planner/controls/gcode/moves/patterns.h"

#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"

// Patterns found in the places of equal holes. A row goes from the first place to the last in equal steps; a
// ring's centre is that of the circle through three of the places far from each other. Either is taken only
// where each place that its rounded numbers give lies within half a unit of the place that the program would
// name alone.

namespace capstan::controls::gcode {
namespace {

using geometry::Vec2;

constexpr double kDegrees = 180.0 / std::numbers::pi;

double written(double v) { return rounded(v, kPatternDecimals); }

bool is_at(Vec2 made, Vec2 planned, int decimals) {
  const double half = 0.5 * std::pow(10.0, -decimals);
  return std::abs(made.x - rounded(planned.x, decimals)) <= half &&
         std::abs(made.y - rounded(planned.y, decimals)) <= half;
}

/// Above -180, to 180.
double turned(double degrees) {
  const double d = std::remainder(degrees, 360.0);
  return d <= -180.0 ? d + 360.0 : d;
}

}  // namespace

std::optional<Row> row_of(std::span<const Vec2> places, int decimals) {
  if (places.size() < 3) return std::nullopt;
  const Vec2 along = places.back() - places.front();
  Row out;
  out.first = {rounded(places.front().x, decimals), rounded(places.front().y, decimals)};
  out.angle_deg = turned(written(kDegrees * std::atan2(along.y, along.x)));
  out.step_mm = written(norm(along) / static_cast<double>(places.size() - 1));
  if (!(out.step_mm > 0.0)) return std::nullopt;
  const double angle = out.angle_deg / kDegrees;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double s = static_cast<double>(i) * out.step_mm;
    if (!is_at({out.first.x + s * std::cos(angle), out.first.y + s * std::sin(angle)}, places[i], decimals))
      return std::nullopt;
  }
  return out;
}

std::optional<Ring> ring_of(std::span<const Vec2> places, int decimals) {
  const std::size_t n = places.size();
  if (n < 3) return std::nullopt;
  const Vec2 a = places[0], b = places[n / 3] - a, c = places[2 * n / 3] - a;
  const double twice_area = 2.0 * (b.x * c.y - b.y * c.x);
  if (!(std::abs(twice_area) > 0.0)) return std::nullopt;
  const double bb = b.x * b.x + b.y * b.y, cc = c.x * c.x + c.y * c.y;
  Ring out;
  out.centre = {written(a.x + (c.y * bb - b.y * cc) / twice_area),
                written(a.y + (b.x * cc - c.x * bb) / twice_area)};
  const auto angle_of = [&](Vec2 p) { return kDegrees * std::atan2(p.y - out.centre.y, p.x - out.centre.x); };
  out.radius_mm = written(norm(a - out.centre));
  out.first_deg = turned(written(angle_of(a)));
  double way = 0.0;
  for (std::size_t i = 1; i < n; ++i) way += turned(angle_of(places[i]) - angle_of(places[i - 1]));
  out.step_deg = written(way / static_cast<double>(n - 1));
  const bool even = std::abs(out.step_deg * static_cast<double>(n) - 360.0) < 1e-3;
  if (!(out.step_deg > 0.0) || !(out.radius_mm > 0.0) || (n == 3 && !even)) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = (out.first_deg + static_cast<double>(i) * out.step_deg) / kDegrees;
    if (!is_at(
            {out.centre.x + out.radius_mm * std::cos(angle), out.centre.y + out.radius_mm * std::sin(angle)},
            places[i], decimals))
      return std::nullopt;
  }
  return out;
}

std::string place_blocks(std::span<const Vec2> places, int decimals, std::string_view begin,
                         const std::function<std::string(double, int)>& number) {
  std::string out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vec2 from{rounded(places[i - 1].x, decimals), rounded(places[i - 1].y, decimals)};
    const Vec2 to{rounded(places[i].x, decimals), rounded(places[i].y, decimals)};
    std::string block(begin);
    if (to.x != from.x) block += (block.empty() ? "X" : " X") + number(to.x, decimals);
    if (to.y != from.y) block += (block.empty() ? "Y" : " Y") + number(to.y, decimals);
    out += "\n" + block;
  }
  return out;
}

}  // namespace capstan::controls::gcode
