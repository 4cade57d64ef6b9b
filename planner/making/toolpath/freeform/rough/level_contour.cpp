#include "planner/making/toolpath/freeform/rough/level_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "planner/making/toolpath/freeform/surface_line.h"

namespace capstan::toolpath::freeform {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// A side of the grid: from its lower or left node, across (0: along x, 1: along y).
using Side = std::uint64_t;

class Marcher {
 public:
  Marcher(const DropGrid& grid, double level) : grid_(grid), level_(level) {}

  std::vector<std::vector<Side>> chains() {
    for (int iy = 0; iy + 1 < grid_.ny; ++iy) {
      for (int ix = 0; ix + 1 < grid_.nx; ++ix) cell(ix, iy);
    }
    std::vector<std::vector<Side>> out;
    // Open lines first: they begin where no piece ends.
    std::map<Side, Side> rest = next_;
    for (const auto& [from, to] : next_) {
      if (!entered_.contains(from)) out.push_back(follow(from, rest));
    }
    while (!rest.empty()) out.push_back(follow(rest.begin()->first, rest));
    return out;
  }

  [[nodiscard]] std::pair<Vec2, Vec2> free_and_blocked(Side s) const {
    const auto node = s / 2;
    const int ix = static_cast<int>(node % static_cast<std::uint64_t>(grid_.nx));
    const int iy = static_cast<int>(node / static_cast<std::uint64_t>(grid_.nx));
    const bool upright = s % 2 == 1;
    const int jx = upright ? ix : ix + 1;
    const int jy = upright ? iy + 1 : iy;
    const Vec2 a = grid_.place(ix, iy);
    const Vec2 b = grid_.place(jx, jy);
    return grid_.at(ix, iy) <= level_ ? std::pair{a, b} : std::pair{b, a};
  }

 private:
  [[nodiscard]] Side side(int ix, int iy, bool upright) const {
    return 2 * (static_cast<std::uint64_t>(iy) * static_cast<std::uint64_t>(grid_.nx) +
                static_cast<std::uint64_t>(ix)) +
           (upright ? 1 : 0);
  }

  void cell(int ix, int iy) {
    const std::array<double, 4> z{grid_.at(ix, iy), grid_.at(ix + 1, iy), grid_.at(ix + 1, iy + 1),
                                  grid_.at(ix, iy + 1)};
    for (const double v : z) {
      if (std::isnan(v)) return;
    }
    // Sides are counter-clockwise: side k joins corners k and k + 1. On the way round the cell, the border
    // leaves through a side that goes from free to blocked. It enters through the side before it that goes
    // from blocked to free. This keeps the free corner on its left.
    const std::array<Side, 4> sides{side(ix, iy, false), side(ix + 1, iy, true), side(ix, iy + 1, false),
                                    side(ix, iy, true)};
    for (std::size_t k = 0; k < 4; ++k) {
      const bool here = z[k] <= level_;
      const bool there = z[(k + 1) % 4] <= level_;
      if (here || !there) continue;  // side k: from blocked to free
      for (std::size_t j = 1; j < 4; ++j) {
        const std::size_t m = (k + j) % 4;
        if (z[m] <= level_ && z[(m + 1) % 4] > level_) {
          add(sides[m], sides[k]);
          break;
        }
      }
    }
  }

  void add(Side from, Side to) {
    next_[from] = to;
    entered_[to] = true;
  }

  static std::vector<Side> follow(Side from, std::map<Side, Side>& rest) {
    std::vector<Side> out{from};
    for (auto it = rest.find(from); it != rest.end(); it = rest.find(out.back())) {
      out.push_back(it->second);
      rest.erase(it);
    }
    return out;
  }

  const DropGrid& grid_;
  double level_;
  std::map<Side, Side> next_;
  std::map<Side, bool> entered_;
};

}  // namespace

bool DropGrid::blocks(Vec2 from, Vec2 to, double level) const {
  const int n = std::max(1, static_cast<int>(std::ceil(norm(to - from) / step_mm)));
  for (int k = 1; k < n; ++k) {
    const Vec2 p = from + (static_cast<double>(k) / n) * (to - from);
    const int ix = static_cast<int>(std::lround((p.x - origin.x) / step_mm));
    const int iy = static_cast<int>(std::lround((p.y - origin.y) / step_mm));
    if (ix < 0 || iy < 0 || ix >= nx || iy >= ny || !(at(ix, iy) > level)) continue;
    // A border between the way and the point is nearer to the level at one of its neighbours.
    const bool beside = (ix > 0 && at(ix - 1, iy) <= level) || (ix + 1 < nx && at(ix + 1, iy) <= level) ||
                        (iy > 0 && at(ix, iy - 1) <= level) || (iy + 1 < ny && at(ix, iy + 1) <= level);
    if (!beside) return true;
  }
  return false;
}

std::vector<std::vector<Vec2>> level_contour(const DropGrid& grid, double level,
                                             const std::function<Vec2(Vec2, Vec2)>& border) {
  Marcher marcher(grid, level);
  std::vector<std::vector<Vec2>> out;
  for (const auto& chain : marcher.chains()) {
    std::vector<Vec2> line;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (i > 0 && chain[i] == chain.front()) {
        line.push_back(line.front());
        break;
      }
      const auto [free, blocked] = marcher.free_and_blocked(chain[i]);
      line.push_back(border(free, blocked));
    }
    out.push_back(std::move(line));
  }
  return out;
}

Lines::iterator nearest(Lines& lines, Vec2 here) {
  auto out = lines.begin();
  std::size_t at = 0;
  double least = 1e300;
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    const std::size_t n = line->front() == line->back() ? line->size() : 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double d = norm((*line)[i] - here);
      if (d < least) {
        out = line;
        at = i;
        least = d;
      }
    }
  }
  if (at > 0) {
    out->pop_back();
    std::rotate(out->begin(), out->begin() + static_cast<std::ptrdiff_t>(at), out->end());
    out->push_back(out->front());
  }
  return out;
}

namespace {

constexpr int kMostHalvings = 8;

struct Refiner {
  double within_mm;
  const std::function<bool(Vec2)>& is_free;
  const std::function<Vec2(Vec2, Vec2)>& border;
  std::vector<Vec3>& out;

  void between(Vec2 a, Vec2 b, int halvings) const {
    const double length = norm(b - a);
    if (length > within_mm && halvings < kMostHalvings) {
      const Vec2 d = b - a;
      // A square corner lies half a chord away, and both ends of the chord may lie off the border.
      const Vec2 right = (0.5 + within_mm / length) * Vec2{d.y, -d.x};
      const Vec2 m = 0.5 * (a + b);
      // The border lies to the right of a chord through free ground, to its left where that is blocked.
      const bool free = is_free(m);
      const Vec2 far = free ? m + right : m - right;
      if (is_free(far) != free) {
        const Vec2 p = free ? border(m, far) : border(far, m);
        if (norm(p - m) > within_mm) {
          between(a, p, halvings + 1);
          between(p, b, halvings + 1);
          return;
        }
      }
    }
    out.push_back({b.x, b.y, 0.0});
  }
};

}  // namespace

std::vector<Vec2> refined(const std::vector<Vec2>& line, double within_mm,
                          const std::function<bool(Vec2)>& is_free,
                          const std::function<Vec2(Vec2, Vec2)>& border) {
  if (line.empty()) return {};
  std::vector<Vec3> fine = {{line.front().x, line.front().y, 0.0}};
  const Refiner refiner{within_mm, is_free, border, fine};
  for (std::size_t i = 1; i < line.size(); ++i) refiner.between(line[i - 1], line[i], 0);
  std::vector<Vec2> out;
  for (const Vec3& p : thinned(fine, 0.1 * within_mm)) out.push_back(xy(p));
  return out;
}

}  // namespace capstan::toolpath::freeform
