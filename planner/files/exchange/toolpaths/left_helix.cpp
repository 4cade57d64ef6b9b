#include "planner/files/exchange/toolpaths/left_helix.h"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

#include "planner/ground/base/number.h"

namespace capstan::exchange::curves {

using geometry::Vec3;

namespace {

constexpr std::string_view kName = "LEFT-HANDED HELIX";
constexpr double kSameMm = 1e-6;  // rounding of a point's coordinates, far below any edit; default, unsourced
constexpr double kUnit = 1e-9;    // of a direction's length

}  // namespace

std::string left_helix_name(const Segment& helix) {
  std::string out(kName);
  for (const double v : {helix.centre.x, helix.centre.y, helix.centre.z, helix.axis.x, helix.axis.y,
                         helix.axis.z, helix.sweep})
    out += " " + shortest(v + 0.0);
  return out;
}

std::optional<Segment> left_helix(const std::string& name, const std::vector<Vec3>& points) {
  if (!name.starts_with(kName) || points.size() < 2) return std::nullopt;
  std::istringstream in(name.substr(kName.size()));
  std::array<double, 7> v{};
  for (double& number : v) {
    std::string word;
    in >> word;
    const auto read = parse_double(word);
    if (!read || !std::isfinite(*read)) return std::nullopt;
    number = *read;
  }
  Segment s{.from = points.front(),
            .to = points.back(),
            .arc = true,
            .centre = {v[0], v[1], v[2]},
            .axis = {v[3], v[4], v[5]},
            .sweep = v[6]};
  if (std::abs(norm(s.axis) - 1.0) > kUnit || s.sweep == 0.0) return std::nullopt;
  const auto n = static_cast<double>(points.size() - 1);
  // Whole turns between two points would not change the points: no chord of ours spans half a turn.
  if (!(std::abs(s.sweep) < std::numbers::pi * n)) return std::nullopt;
  for (std::size_t i = 1; i < points.size(); ++i) {
    // Also where the numbers are beyond any arithmetic.
    if (!(norm(at(s, static_cast<double>(i) / n) - points[i]) <= kSameMm)) return std::nullopt;
  }
  s.u_to = n;
  return s;
}

}  // namespace capstan::exchange::curves
