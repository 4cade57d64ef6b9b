#include "planner/ground/geometry/lines/open_line.h"

#include <algorithm>

namespace capstan::geometry {

double distance_to_line(const std::vector<Vec2>& line, Vec2 p) {
  double best = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 d = line[i + 1] - line[i];
    const double t = std::clamp(dot(p - line[i], d) / dot(d, d), 0.0, 1.0);
    best = std::min(best, norm(p - (line[i] + t * d)));
  }
  return best;
}

}  // namespace capstan::geometry
