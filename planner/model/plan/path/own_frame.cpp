#include "planner/model/plan/path/own_frame.h"

#include <cstddef>
#include <numbers>

namespace capstan::model {

using geometry::Vec2;

Vec2 own_origin(const CutterPath& path) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (is_arc(path.kind[i])) return {path.cx[i], path.cy[i]};
  return path.size() > 0 ? Vec2{path.x[0], path.y[0]} : Vec2{};
}

CutterPath in_own_frame(const CutterPath& path, Vec2 origin) {
  CutterPath out = path;
  const auto centre_of = [&](std::size_t i) { return Vec2{path.cx[i], path.cy[i]}; };
  const auto own_centre = [&](std::size_t i) { return on_own_grid(centre_of(i) - origin); };
  const auto arc_at = [&](std::size_t i) { return i > 0 && i < path.size() && is_arc(path.kind[i]); };
  // Ends of an arc that are no farther apart are one place, or it is no arc at all.
  constexpr double kOnePlace = 16.0 * kOwnGrid;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 p{path.x[i], path.y[i]};
    Vec2 q;
    const double apart = i > 0 ? norm(p - Vec2{path.x[i - 1], path.y[i - 1]}) : 1.0;
    const bool closes =
        apart == 0.0 || (arc_at(i) && apart <= kOnePlace && arc_sweep(path, i) > std::numbers::pi);
    if (closes) {
      q = {out.x[i - 1], out.y[i - 1]};
    } else if (arc_at(i)) {
      q = own_centre(i) + on_own_grid(p - centre_of(i));
    } else if (arc_at(i + 1)) {
      q = own_centre(i + 1) + on_own_grid(p - centre_of(i + 1));
    } else {
      q = on_own_grid(p - origin);
    }
    out.x[i] = q.x;
    out.y[i] = q.y;
    out.z[i] = on_own_grid(path.z[i]);
    if (!arc_at(i)) continue;
    if (!closes && apart <= kOnePlace) {
      out.kind[i] = MoveKind::kLine;
      out.cx[i] = out.cy[i] = 0.0;
      continue;
    }
    out.cx[i] = own_centre(i).x;
    out.cy[i] = own_centre(i).y;
  }
  return out;
}

}  // namespace capstan::model
