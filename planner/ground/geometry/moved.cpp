#include "planner/ground/geometry/moved.h"

#include <algorithm>
#include <utility>

namespace capstan::geometry {

Region moved(const Region& r, const Placement& to) {
  Region out;
  for (const Loop& loop : r.loops) {
    Loop q;
    for (const Vec2 p : loop) q.push_back(xy(to.to_parent({p.x, p.y, 0.0})));
    if (to.z.z < 0.0) std::reverse(q.begin(), q.end());
    out.loops.push_back(std::move(q));
  }
  return out;
}

}  // namespace capstan::geometry
