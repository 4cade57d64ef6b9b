// The walls that stand at a height: the finished part's area there, less what the features take that reach so
// deep. Features that are apart from all others and lie within the part are subtracted by themselves, so that
// polygons are combined only among those whose boxes meet: n log n in features that are apart. Coordinates
// are those of one grid (kRegionGrid), whichever are combined together. Where only a part of a plan is
// checked, features that its tools do not come near are left out: their loops do not wind about a place
// beside them.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/packed.h"
#include "planner/ground/memo/remembered.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kApartMm = 1e-4;  ///< farther apart than this no polygons meet after rounding

/// The square of the distance between a point and a line's piece.
double squared_distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double n = dot(d, d);
  const double t = n > 0.0 ? std::clamp(dot(p - a, d) / n, 0.0, 1.0) : 0.0;
  const Vec2 apart = p - (a + t * d);
  return dot(apart, apart);
}

bool crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double s1 = cross(b - a, c - a), s2 = cross(b - a, d - a);
  const double s3 = cross(d - c, a - c), s4 = cross(d - c, b - c);
  return ((s1 > 0.0) != (s2 > 0.0)) && ((s3 > 0.0) != (s4 > 0.0));
}

/// Loops of one feature, or of several whose boxes meet.
struct Part {
  geometry::Box2 box;
  std::vector<geometry::Loop> loops;
};

/// The same loops, those together whose boxes meet, over others too: a sweep along x.
std::vector<Part> apart(std::vector<Part> all) {
  std::sort(all.begin(), all.end(), [](const Part& a, const Part& b) { return a.box.lo.x < b.box.lo.x; });
  std::vector<std::size_t> first(all.size()), open;
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const geometry::Box2& b = all[i].box;
    std::erase_if(open, [&](std::size_t k) { return all[k].box.hi.x < b.lo.x - kApartMm; });
    for (const std::size_t k : open) {
      if (all[k].box.lo.y > b.hi.y + kApartMm || all[k].box.hi.y < b.lo.y - kApartMm) continue;
      const std::size_t one = root(i), other = root(k);
      first[std::max(one, other)] = std::min(one, other);
    }
    open.push_back(i);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    Part& to = all[root(i)];
    if (&to == &all[i]) continue;
    to.box.lo = {std::min(to.box.lo.x, all[i].box.lo.x), std::min(to.box.lo.y, all[i].box.lo.y)};
    to.box.hi = {std::max(to.box.hi.x, all[i].box.hi.x), std::max(to.box.hi.y, all[i].box.hi.y)};
    std::move(all[i].loops.begin(), all[i].loops.end(), std::back_inserter(to.loops));
    all[i].loops.clear();
  }
  std::erase_if(all, [](const Part& p) { return p.loops.empty(); });
  return all;
}

}  // namespace

std::size_t Target::level(double z) const {
  return static_cast<std::size_t>(std::upper_bound(levels_.begin(), levels_.end(), z + allowed()) -
                                  levels_.begin());
}

std::size_t Target::Walls::strip(double y) const {
  const double at = std::clamp((y - y0_mm) / strip_mm, 0.0, static_cast<double>(strip_count) - 1.0);
  return static_cast<std::size_t>(at);
}

std::size_t Target::Walls::square_at(double at, double begin) const {
  return static_cast<std::size_t>(
      std::clamp((at - begin) / square_mm, 0.0, static_cast<double>(along) - 1.0));
}

bool Target::Walls::stands(Vec2 p) const {
  if (strips.size() == 0) return false;
  int winding = 0;
  for (const std::uint32_t i : strips.of(strip(p.y))) {
    const Edge& e = edges[i];
    if ((e.a.y <= p.y) == (e.b.y <= p.y)) continue;
    const double x = e.a.x + (p.y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x);
    if (x > p.x) winding += e.b.y > e.a.y ? 1 : -1;
  }
  return winding != 0;
}

namespace {

/// Bins of edges; `each(i, f)` calls f for each bin that edge i touches.
template <class Bins, class Each>
Bins binned(std::size_t bins, std::size_t edges, const Each& each) {
  Bins out;
  out.begin.assign(bins + 1, 0);
  for (std::uint32_t i = 0; i < edges; ++i) each(i, [&](std::size_t bin) { ++out.begin[bin + 1]; });
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.edges.resize(out.begin.back());
  std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
  for (std::uint32_t i = 0; i < edges; ++i) each(i, [&](std::size_t bin) { out.edges[next[bin]++] = i; });
  return out;
}

}  // namespace

std::vector<Target::Walls::Edge> Target::edges_at(double z) const {
  std::vector<Walls::Edge> out;
  std::vector<Part> parts;
  for (const Cavity& c : cavities_) {
    tick();
    if (c.floor_mm > z + allowed() && !c.open_bottom) continue;
    Region r = c.area;
    for (const auto& [island, top] : c.islands) {
      if (top > z + allowed()) r = geometry::subtract(r, island);
    }
    if (!r.empty()) parts.push_back({c.box, std::move(r.loops)});
  }
  Region part = outline(part_.part);
  if (round_)
    part = geometry::intersect(part, geometry::disc(0.5 * (xy(stock_.lo) + xy(stock_.hi)), *round_));
  const auto add = [&](const Region& region, bool taken) {
    for (const auto& loop : region.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
        out.push_back(taken ? Walls::Edge{b, a} : Walls::Edge{a, b});
      }
    }
  };
  std::vector<geometry::Loop> across;
  for (Part& p : apart(std::move(parts))) {
    tick();
    const bool within = !round_ && !turned_ && p.box.lo.x > part_box_.lo.x + kApartMm &&
                        p.box.lo.y > part_box_.lo.y + kApartMm && p.box.hi.x < part_box_.hi.x - kApartMm &&
                        p.box.hi.y < part_box_.hi.y - kApartMm;
    if (within)
      add(geometry::clean(p.loops), true);
    else
      across.insert(across.end(), p.loops.begin(), p.loops.end());
  }
  add(across.empty() ? part : geometry::subtract(part, geometry::clean(across)), false);
  return out;
}

void Target::Walls::sort_in(const geometry::Box3& part) {
  // About half as many strips, and as many squares, as edges, so that heights with few edges cost little.
  constexpr double kMostStrips = 512.0, kMostAlong = 128.0;
  const auto n = static_cast<double>(edges.size());
  strip_count = static_cast<std::size_t>(std::clamp(0.5 * n, 1.0, kMostStrips));
  y0_mm = part.lo.y;
  strip_mm = std::max((part.hi.y - part.lo.y) / static_cast<double>(strip_count), 1e-3);
  strips = binned<Bins>(strip_count, edges.size(), [&](std::uint32_t i, const auto& touch) {
    const Edge& e = edges[i];
    const std::size_t last = strip(std::max(e.a.y, e.b.y));
    for (std::size_t k = strip(std::min(e.a.y, e.b.y)); k <= last; ++k) touch(k);
  });
  along = static_cast<std::size_t>(std::clamp(std::sqrt(n), 1.0, kMostAlong));
  x0_mm = part.lo.x;
  square_mm = std::max({part.hi.x - part.lo.x, part.hi.y - part.lo.y, 0.1}) / static_cast<double>(along);
  squares = binned<Bins>(along * along, edges.size(), [&](std::uint32_t i, const auto& touch) {
    const Edge& e = edges[i];
    const std::size_t last_y = square_at(std::max(e.a.y, e.b.y), y0_mm);
    const std::size_t last_x = square_at(std::max(e.a.x, e.b.x), x0_mm);
    for (std::size_t y = square_at(std::min(e.a.y, e.b.y), y0_mm); y <= last_y; ++y)
      for (std::size_t x = square_at(std::min(e.a.x, e.b.x), x0_mm); x <= last_x; ++x) touch(y * along + x);
  });
}

const Target::Walls& Target::walls(double z) {
  const std::size_t at = level(z);
  const auto found = walls_.find(at);
  if (found != walls_.end()) return found->second;
  Walls out;
  // Of an area alone they are soon made, and another check asks for another area.
  memo::Memo* const memo = near_ ? nullptr : memo_;
  const memo::Key key = memo::key_of(memo::Stage::kPart, of_setup_, std::string("walls"), at);
  std::optional<std::vector<Walls::Edge>> known;
  if (memo != nullptr) {
    if (const auto bytes = memo->find(memo::Stage::kPart, key))
      known = memo::unpacked<std::vector<Walls::Edge>>(*bytes);
  }
  if (known) {
    out.edges = *std::move(known);
  } else {
    out.edges = edges_at(z);
    if (memo != nullptr) {
      std::string bytes;
      memo::pack(bytes, out.edges);
      memo->keep(memo::Stage::kPart, key, std::move(bytes));
    }
  }
  out.sort_in(part_box_);
  return walls_.emplace(at, std::move(out)).first->second;
}

/// Edges whose boxes meet a box; one that lies in several squares may come again. `f` says whether to go on.
template <class F>
void Target::Walls::each_near(Vec2 lo, Vec2 hi, const F& f) const {
  const std::size_t last_y = square_at(hi.y, y0_mm), last_x = square_at(hi.x, x0_mm);
  for (std::size_t iy = square_at(lo.y, y0_mm); iy <= last_y; ++iy) {
    for (std::size_t ix = square_at(lo.x, x0_mm); ix <= last_x; ++ix) {
      for (const std::uint32_t index : squares.of(iy * along + ix)) {
        const Edge& e = edges[index];
        if (std::max(e.a.x, e.b.x) < lo.x || std::min(e.a.x, e.b.x) > hi.x || std::max(e.a.y, e.b.y) < lo.y ||
            std::min(e.a.y, e.b.y) > hi.y) {
          continue;
        }
        if (!f(e)) return;
      }
    }
  }
}

bool Target::clear_of_walls(const Move& m, double z, double reach) {
  const geometry::Box3 box = box_of(m);
  const double off = is_arc(m.kind) ? std::abs(norm(xy(m.from) - m.centre) - norm(xy(m.to) - m.centre)) : 0.0;
  const Vec2 more{reach + off, reach + off};
  const Walls& w = walls(z);
  bool clear = true;
  w.each_near(xy(box.lo) - more, xy(box.hi) + more, [&](const Walls::Edge&) { return clear = false; });
  return clear && !w.stands(xy(m.to));
}

double Target::wall_gouge(const Move& m, double radius, double height_mm, Vec2& at) {
  if (plan_.target_mesh) return 0.0;
  const double low = std::min(m.from.z, m.to.z) + height_mm;
  if (low + allowed() >= part_box_.hi.z) return 0.0;
  const bool changes = level(m.from.z + height_mm) != level(m.to.z + height_mm);
  const int n = std::max(pieces_of(m, kChordMm), changes ? 16 : 1);
  const double reach = radius - allowed();
  // With no wall within the box of all of it, the way need not be taken to pieces.
  if (!changes && n > 1 && clear_of_walls(m, low, std::max(reach, kChordMm))) return 0.0;
  double worst = 0.0;
  Vec3 a = m.from;
  // Pieces that fall in one place past the same walls are as far from them.
  struct Fallen {
    const Walls* walls = nullptr;
    Vec2 from, to;
    double squared = 0.0;
  } last;
  for (int i = 1; i <= n; ++i) {
    tick();
    const Vec3 b = point_of(m, static_cast<double>(i) / n);
    // While falling from one level to the next the higher end decides; the last piece is judged at its end.
    const double z = (i == n ? std::min(a.z, b.z) : std::max(a.z, b.z)) + height_mm;
    if (z + allowed() < part_box_.hi.z) {
      const Walls& w = walls(z);
      const Vec2 p = i == n && changes ? xy(b) : xy(a);
      const Vec2 lo{std::min(p.x, b.x) - reach, std::min(p.y, b.y) - reach};
      const Vec2 hi{std::max(p.x, b.x) + reach, std::max(p.y, b.y) + reach};
      const bool again = last.walls == &w && last.from == p && last.to == xy(b);
      double squared = again ? last.squared : 1e300;
      if (!again)
        w.each_near(lo, hi, [&](const Walls::Edge& e) {
          if (crossing(p, xy(b), e.a, e.b)) squared = 0.0;
          squared = std::min({squared, squared_distance(p, e.a, e.b), squared_distance(xy(b), e.a, e.b),
                              squared_distance(e.a, p, xy(b)), squared_distance(e.b, p, xy(b))});
          return true;
        });
      last = {&w, p, xy(b), squared};
      const double near = std::sqrt(squared);
      double into = radius - near;
      if (near > std::max(reach, kChordMm)) {
        // No edge lies between the two ends: what is known of one holds for the other.
        const bool known = stood_.walls == &w && stood_.at.x == p.x && stood_.at.y == p.y;
        stood_ = {&w, xy(b), known ? stood_.stands : w.stands(xy(b))};
        if (stood_.stands) into = radius;
      }
      if (into > allowed() && into > worst) {
        worst = into;
        at = xy(b);
      }
    }
    a = b;
  }
  return worst;
}

}  // namespace capstan::verify
