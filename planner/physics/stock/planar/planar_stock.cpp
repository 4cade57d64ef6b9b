#include "planner/physics/stock/planar/planar_stock.h"

#include "planner/ground/base/memory/grow.h"
#include "planner/ground/base/stopping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

// The stock is the raw piece less the trails of all moves: bands of lines, sectors of arcs, discs of plunges.
// No polygon is computed, so that nothing is rounded and walls that touch stay as they are.
//
// 1. `take` enters a trail into the tiles of a grid that it reaches. A trail that covers a whole tile removes
//    the trails above it there; a trail whose track covers another's removes that one.
// 2. A tile with many trails drops those that deeper ones cover together (`thin`). `covered` decides this by
//    halving a square: the distance to a track is 1-Lipschitz, so the middle of a square with half diagonal c
//    decides for all of it when it lies deeper than c inside or outside. What stays open is not covered.
// 3. `heights` looks along a probe (a line, or the front half circle of a cutter). It collects the trails of
//    the tiles nearby, deepest floor first, and lowers the probe's pieces where it crosses each trail. It
//    ends as soon as every piece is at `above_mm` or lower than all trails that are left.
//
// Level floors are exact; sloping and round floors are read in strips (Trail::lower).
// Source  derived: the union of the swept areas of discs; no published algorithm is followed.

namespace capstan::stock {
namespace {

using geometry::Box3;
using geometry::CutterProfile;
using geometry::Vec2;
using geometry::Vec3;
using model::CutterPath;
using model::MoveKind;

constexpr double kMostTiles = 1e6;
constexpr double kTilesAlong = 48.0;  // default, from the planar benchmark's pocket of 60 mm
constexpr double kLeastTile = 1.0;    // mm

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// How far from the axis an outline is lower than a height above its tip, never too little.
double reach_of(const CutterProfile& outline, double radius_mm, double height_mm) {
  if (outline.height(radius_mm) <= height_mm) return radius_mm;
  double inside = 0.0;
  double outside = radius_mm;
  if (outline.height(0.0) >= height_mm) return 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (outline.height(middle) < height_mm ? inside : outside) = middle;
  }
  return outside;
}

/// Shows `look` rectangles (lo, hi) that hold all of the trail, whose own is lo to hi. A long skew track
/// crosses few of the tiles in that: it is shown in stretches.
template <class Look>
void in_stretches(const Trail& trail, Vec2 lo, Vec2 hi, double tile_mm, Look&& look) {
  const double stretch = std::max(16.0 * tile_mm, 2.0 * trail.radius_mm);
  if (trail.arc || trail.length_mm <= 2.0 * stretch) return look(lo, hi);
  const int n = static_cast<int>(std::ceil(std::min(trail.length_mm / stretch, 1e4)));
  const Vec2 r{trail.radius_mm, trail.radius_mm};
  for (int k = 0; k < n; ++k) {
    const Vec2 p = trail.a + (trail.length_mm * k / n) * trail.along;
    const Vec2 q = trail.a + (trail.length_mm * (k + 1) / n) * trail.along;
    look(Vec2{std::min(p.x, q.x), std::min(p.y, q.y)} - r, Vec2{std::max(p.x, q.x), std::max(p.y, q.y)} + r);
  }
}

}  // namespace

PlanarStock PlanarStock::from_box(const Box3& box, double tile_mm) {
  if (box.empty()) throw std::logic_error("a stock needs a piece");
  PlanarStock s;
  s.box_ = box;
  const Vec3 size = box.size();
  s.tile_mm_ = tile_mm > 0.0 ? tile_mm : std::max(kLeastTile, std::max(size.x, size.y) / kTilesAlong);
  s.tile_mm_ = std::max(s.tile_mm_, std::sqrt(size.x * size.y / kMostTiles));
  s.nx_ = std::max(1, static_cast<int>(std::ceil(size.x / s.tile_mm_)));
  s.ny_ = std::max(1, static_cast<int>(std::ceil(size.y / s.tile_mm_)));
  Tile whole;
  whole.highest_mm = box.hi.z;
  grow(s.tiles_, static_cast<std::size_t>(s.nx_) * static_cast<std::size_t>(s.ny_), whole);
  grow(s.reaching_, s.tiles_.size());
  return s;
}

PlanarStock PlanarStock::from_cylinder(const Box3& box, double radius_mm, double tile_mm) {
  if (!(radius_mm > 0.0)) throw std::logic_error("a bar needs a radius");
  Box3 around = box;
  const double cx = 0.5 * (box.lo.x + box.hi.x);
  const double cy = 0.5 * (box.lo.y + box.hi.y);
  around.lo = {cx - radius_mm, cy - radius_mm, box.lo.z};
  around.hi = {cx + radius_mm, cy + radius_mm, box.hi.z};
  PlanarStock s = from_box(around, tile_mm);
  s.bar_radius_mm_ = radius_mm;
  return s;
}

void PlanarStock::tiles_of(Vec2 lo, Vec2 hi, int& x0, int& x1, int& y0, int& y1) const {
  // Clamped before it becomes an integer: any rectangle will do.
  const auto cell = [&](double p, double origin, int n) {
    return static_cast<int>(std::clamp(std::floor((p - origin) / tile_mm_), -1.0, static_cast<double>(n)));
  };
  x0 = std::max(0, cell(lo.x, box_.lo.x, nx_));
  x1 = std::min(nx_ - 1, cell(hi.x, box_.lo.x, nx_));
  y0 = std::max(0, cell(lo.y, box_.lo.y, ny_));
  y1 = std::min(ny_ - 1, cell(hi.y, box_.lo.y, ny_));
}

const CutterProfile* PlanarStock::keep(const CutterProfile& profile) {
  if (is_flat(profile)) return nullptr;
  for (const auto& o : outlines_) {
    if (*o == profile) return o.get();
  }
  outlines_.push_back(std::make_shared<const CutterProfile>(profile));
  return outlines_.back().get();
}

void PlanarStock::place(std::uint32_t id, Vec2 lo, Vec2 hi) {
  const Trail& t = trails_[id];
  const double half_diagonal = tile_mm_ * std::numbers::sqrt2 / 2.0;
  int x0, x1, y0, y1;
  tiles_of(lo, hi, x0, x1, y0, y1);
  for (int y = y0; y <= y1; ++y) {
    tick(1U + static_cast<unsigned>(std::max(0, x1 - x0)) / 4U);
    for (int x = x0; x <= x1; ++x) {
      Tile& tile = tiles_[number_of(x, y)];
      if (t.lowest_mm >= tile.highest_mm) continue;
      if (!tile.trails.empty() && tile.trails.back() == id) continue;
      const Vec2 middle{box_.lo.x + (x + 0.5) * tile_mm_, box_.lo.y + (y + 0.5) * tile_mm_};
      const double d = t.distance(middle);
      if (d >= t.radius_mm + half_diagonal) continue;
      if (tile.noted < marks_) {
        changes_.emplace_back(static_cast<std::size_t>(&tile - tiles_.data()), tile);
        tile.noted = marks_;
      }
      if (d + half_diagonal <= t.radius_mm && t.highest_mm < tile.highest_mm) {
        std::erase_if(tile.trails, [&](std::uint32_t o) { return trails_[o].lowest_mm >= t.highest_mm; });
        tile.highest_mm = t.highest_mm;
      }
      std::erase_if(tile.trails, [&](std::uint32_t o) { return t.covers(trails_[o]); });
      tile.trails.push_back(id);
      if (tile.trails.size() >= tile.thin_at) thin(tile, middle);
    }
  }
}

void PlanarStock::thin(Tile& tile, Vec2 middle) {
  constexpr int kQuarterings = 3;  // to squares of an eighth of the tile; default, unsourced
  std::vector<std::uint32_t> others;
  for (std::size_t i = 0; i < tile.trails.size();) {  // oldest first
    const Trail& t = trails_[tile.trails[i]];
    tick(4);
    others.clear();
    for (std::size_t k = 0; k < tile.trails.size(); ++k) {
      if (k != i && trails_[tile.trails[k]].highest_mm <= t.lowest_mm) others.push_back(tile.trails[k]);
    }
    if (!others.empty() && covered(t, others, middle, 0.5 * tile_mm_, kQuarterings)) {
      tile.trails.erase(tile.trails.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  tile.thin_at = std::max(kThinAt, 2 * tile.trails.size());
}

// Distance to a track changes by no more than the place does: a square lies inside a trail or outside of it
// when its middle does so by half its diagonal. What stays open after a few quarterings counts as not
// covered.
bool PlanarStock::covered(const Trail& trail, const std::vector<std::uint32_t>& others, Vec2 middle,
                          double half_mm, int quarterings) const {
  const double corner = half_mm * std::numbers::sqrt2;
  const double own = trail.distance(middle);
  if (own - corner >= trail.radius_mm) return true;
  std::vector<std::uint32_t> near;
  bool inside = false;
  for (const std::uint32_t id : others) {
    const Trail& o = trails_[id];
    const double d = o.distance(middle);
    if (d + corner <= o.radius_mm) return true;
    if (d - corner >= o.radius_mm) continue;
    inside = inside || d <= o.radius_mm;
    near.push_back(id);
  }
  if (near.empty() || quarterings == 0 || (!inside && own <= trail.radius_mm)) return false;
  const double q = 0.5 * half_mm;
  for (const double dx : {-q, q}) {
    for (const double dy : {-q, q}) {
      if (!covered(trail, near, middle + Vec2{dx, dy}, q, quarterings - 1)) return false;
    }
  }
  return true;
}

void PlanarStock::take(Trail trail) {
  tick();
  if (trail.outline != nullptr) {  // what of it goes over the piece's top matters to nobody
    const double most = reach_of(*trail.outline, trail.radius_mm, box_.hi.z - trail.za);
    if (!(most > kTouch)) return;
    trail.radius_mm = most;
    trail.settle();
  }
  Vec2 lo, hi;
  bounds_of(trail, lo, hi);
  if (trail.lowest_mm >= box_.hi.z || lo.x >= box_.hi.x || hi.x <= box_.lo.x || lo.y >= box_.hi.y ||
      hi.y <= box_.lo.y)
    return;
  const auto id = static_cast<std::uint32_t>(trails_.size());
  trails_.push_back(trail);
  in_stretches(trail, lo, hi, tile_mm_, [&](Vec2 from, Vec2 to) { note(id, from, to); });
  if (highest(lo, hi) <= trail.lowest_mm) return;
  in_stretches(trail, lo, hi, tile_mm_, [&](Vec2 from, Vec2 to) { place(id, from, to); });
}

void PlanarStock::note(std::uint32_t id, Vec2 lo, Vec2 hi) {
  int x0, x1, y0, y1;
  tiles_of(lo, hi, x0, x1, y0, y1);
  for (int y = y0; y <= y1; ++y) {
    tick(1U + static_cast<unsigned>(std::max(0, x1 - x0)) / 4U);
    for (int x = x0; x <= x1; ++x) {
      auto& there = reaching_[number_of(x, y)];
      if (!there.empty() && there.back() == id) continue;  // by the stretch before
      there.push_back(id);
      reached_.push_back(number_of(x, y));
    }
  }
}

PlanarStock::Mark PlanarStock::mark() {
  ++marks_;
  return {changes_.size(), trails_.size(), reached_.size(), lost_};
}

void PlanarStock::put_back(const Mark& mark) {
  while (changes_.size() > mark.changes) {
    tiles_[changes_.back().first] = std::move(changes_.back().second);
    changes_.pop_back();
  }
  trails_.resize(mark.trails);
  while (reached_.size() > mark.reached) {
    reaching_[reached_.back()].pop_back();
    reached_.pop_back();
  }
  lost_ = mark.lost;
}

PlanarStock::Undone PlanarStock::take_out(const Mark& mark) {
  Undone out;
  out.lost_ = lost_;
  while (changes_.size() > mark.changes) {
    auto& [tile, before] = changes_.back();
    std::swap(tiles_[tile], before);
    out.tiles_.push_back(std::move(changes_.back()));
    changes_.pop_back();
  }
  out.trails_.assign(trails_.begin() + static_cast<std::ptrdiff_t>(mark.trails), trails_.end());
  for (std::size_t k = reached_.size(); k-- > mark.reached;) {
    auto& there = reaching_[reached_[k]];
    out.reached_.emplace_back(reached_[k], there.back());
    there.pop_back();
  }
  reached_.resize(mark.reached);
  put_back(mark);
  return out;
}

void PlanarStock::put_in(Undone undone) {
  ++marks_;
  for (auto t = undone.tiles_.rbegin(); t != undone.tiles_.rend(); ++t) {
    std::swap(tiles_[t->first], t->second);
    tiles_[t->first].noted = marks_;
    changes_.push_back(std::move(*t));
  }
  trails_.insert(trails_.end(), undone.trails_.begin(), undone.trails_.end());
  for (auto r = undone.reached_.rbegin(); r != undone.reached_.rend(); ++r) {
    reaching_[r->first].push_back(r->second);
    reached_.push_back(r->first);
  }
  lost_ = std::move(undone.lost_);
}

void PlanarStock::forget() {
  changes_.clear();
  reached_.clear();
}

double PlanarStock::highest(Vec2 lo, Vec2 hi) const {
  tick();
  double best = box_.lo.z;
  if (hi.x <= box_.lo.x || lo.x >= box_.hi.x || hi.y <= box_.lo.y || lo.y >= box_.hi.y) return best;
  int x0, x1, y0, y1;
  tiles_of(lo, hi, x0, x1, y0, y1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      best = std::max(best, tiles_[number_of(x, y)].highest_mm);
    }
  }
  return best;
}

std::string PlanarStock::cannot_hold(const CutterProfile& profile, const CutterPath& path) const {
  const bool flat = is_flat(profile);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 centre{path.cx[i], path.cy[i]};
    if (!finite(path.point(i)) || !std::isfinite(centre.x) || !std::isfinite(centre.y))
      return "point " + std::to_string(i) + " of the path is not finite";
    if (i == 0 || flat || path.kind[i] == MoveKind::kDwell) continue;
    const Vec3 a = path.point(i - 1);
    const Vec3 b = path.point(i);
    const bool upright = norm(xy(b) - xy(a)) <= kTouch && !is_arc(path.kind[i]);
    if (upright || a.z == b.z) continue;
    for (const Trail& t : trails_of(path, i, profile.radius_mm, nullptr)) {
      Vec2 lo, hi;
      bounds_of(t, lo, hi);
      if (highest(lo, hi) > t.lowest_mm)
        return "move " + std::to_string(i) + " slopes and the cutter is not flat below";
    }
  }
  return {};
}

Status PlanarStock::cut(const CutterProfile& profile, const CutterPath& path) {
  if (lost_.empty()) lost_ = cannot_hold(profile, path);
  if (!lost_.empty()) return fail("STK-NOT-PLANAR", lost_);
  const CutterProfile* outline = keep(profile);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i == 0) {
      Trail t;
      t.a = t.b = {path.x[0], path.y[0]};
      t.za = t.zb = path.z[0];
      t.radius_mm = profile.radius_mm;
      t.outline = outline;
      t.settle();
      take(t);
      continue;
    }
    if (path.kind[i] == MoveKind::kDwell) continue;
    for (const Trail& t : trails_of(path, i, profile.radius_mm, outline)) take(t);
  }
  return {};
}

void PlanarStock::gather(Vec2 lo, Vec2 hi, Nearby& out) const {
  const Vec2 middle = 0.5 * (lo + hi);
  const double corner = 0.5 * norm(hi - lo);
  out.trails.clear();
  if (out.seen.size() < trails_.size()) out.seen.resize(trails_.size() + trails_.size() / 2 + 64, 0);
  if (++out.round == 0) {
    std::fill(out.seen.begin(), out.seen.end(), 0);
    out.round = 1;
  }
  int x0, x1, y0, y1;
  tiles_of(lo, hi, x0, x1, y0, y1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Tile& tile = tiles_[number_of(x, y)];
      for (const std::uint32_t id : tile.trails) {
        if (out.seen[id] == out.round) continue;
        out.seen[id] = out.round;
        const Trail& t = trails_[id];
        if (t.distance(middle) < t.radius_mm + corner) out.trails.push_back(id);
      }
    }
  }
  std::sort(out.trails.begin(), out.trails.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (trails_[a].lowest_mm != trails_[b].lowest_mm) return trails_[a].lowest_mm < trails_[b].lowest_mm;
    return a > b;
  });
}

bool PlanarStock::even(const Nearby& near, double from_mm, double to_mm) const {
  const auto apart = [&](double lowest, double highest) {
    return highest <= from_mm + kTouch || lowest >= to_mm - kTouch;
  };
  if (!apart(box_.lo.z, box_.lo.z) || !apart(box_.hi.z, box_.hi.z)) return false;
  return std::all_of(near.trails.begin(), near.trails.end(),
                     [&](std::uint32_t id) { return apart(trails_[id].lowest_mm, trails_[id].highest_mm); });
}

bool PlanarStock::cleared(const Nearby& near, Vec2 centre, double radius_mm, double z_mm) const {
  constexpr int kQuarterings = 4;  // to squares of an eighth of the radius; default, unsourced
  std::vector<std::uint32_t> deep;
  for (const std::uint32_t id : near.trails) {
    const Trail& t = trails_[id];
    if (t.highest_mm <= z_mm && t.distance(centre) < t.radius_mm + radius_mm) deep.push_back(id);
  }
  if (deep.empty()) return false;
  Trail disc;
  disc.a = disc.b = centre;
  disc.radius_mm = radius_mm;
  disc.settle();
  return covered(disc, deep, centre, radius_mm, kQuarterings);
}

void PlanarStock::heights(const Probe& probe, Nearby& near, double above_mm, Heights& out,
                          double most_mm) const {
  tick();
  out.reset(probe.lo, probe.hi, std::max(std::min(box_.hi.z, most_mm), above_mm));
  near.in_strips = false;
  if (box_.hi.z <= above_mm) return;
  const Vec2 lo = xy(box_.lo);
  const Vec2 hi = xy(box_.hi);
  const Vec2 middle = 0.5 * (lo + hi);
  const auto inside = [&](Vec2 p) {
    // What merely touches the outline is outside.
    if (bar_radius_mm_ > 0.0) return norm(p - middle) < bar_radius_mm_ - kTouch;
    return p.x > lo.x + kTouch && p.x < hi.x - kTouch && p.y > lo.y + kTouch && p.y < hi.y - kTouch;
  };
  const double r = std::max(probe.radius_mm, std::max(std::abs(probe.lo), std::abs(probe.hi)));
  const bool amid = bar_radius_mm_ > 0.0 ? norm(probe.origin - middle) + r <= bar_radius_mm_
                                         : probe.origin.x - r >= lo.x && probe.origin.x + r <= hi.x &&
                                               probe.origin.y - r >= lo.y && probe.origin.y + r <= hi.y;
  if (!amid) {
    Cuts cuts;
    cuts.add(probe.lo);
    cuts.add(probe.hi);
    if (bar_radius_mm_ > 0.0) {
      probe.cross_circle(middle, bar_radius_mm_, cuts);
    } else {
      probe.cross_line({1.0, 0.0}, lo.x, cuts);
      probe.cross_line({1.0, 0.0}, hi.x, cuts);
      probe.cross_line({0.0, 1.0}, lo.y, cuts);
      probe.cross_line({0.0, 1.0}, hi.y, cuts);
    }
    cuts.sort();
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (!(cuts[i + 1] > cuts[i])) continue;
      if (!inside(probe.at(0.5 * (cuts[i] + cuts[i + 1])))) out.lower(cuts[i], cuts[i + 1], above_mm);
    }
  }
  // What still stands is looked at as a few circles that hold it: most trails are near none of them.
  constexpr std::size_t kCircles = 4;
  std::array<Vec2, kCircles> about;
  std::array<double, kCircles> reach{};
  Heights::Piece left{1e300, -1e300, 0.0};  // none yet
  const auto look_again = [&] {
    const Heights::Piece was = std::exchange(left, out.standing(above_mm));
    if (left.x0 > left.x1) return false;
    if (left.x0 == was.x0 && left.x1 == was.x1) return true;  // within the same circles
    Vec2 from = probe.at(left.x0);
    for (std::size_t i = 0; i < kCircles; ++i) {
      const double step = (left.x1 - left.x0) / kCircles;
      const Vec2 to = probe.at(i + 1 == kCircles ? left.x1 : left.x0 + step * static_cast<double>(i + 1));
      about[i] = probe.at(left.x0 + step * (static_cast<double>(i) + 0.5));
      const Vec2 a = from - about[i];
      const Vec2 b = to - about[i];
      reach[i] = std::sqrt(std::max(dot(a, a), dot(b, b)));
      from = to;
    }
    return true;
  };
  const auto is_near = [&](const Trail& t) {
    for (std::size_t i = 0; i < kCircles; ++i) {
      if (t.distance(about[i]) < t.radius_mm + reach[i]) return true;
    }
    return false;
  };
  near.helped.clear();
  bool open = look_again();
  const auto take_down = [&](std::uint32_t id) {
    const Trail& t = trails_[id];
    if (!is_near(t) || !t.lower(probe, above_mm, out)) return;
    near.helped.push_back(id);
    near.in_strips = near.in_strips || !t.level();
    open = look_again();
  };
  for (std::size_t i = 0; open && i < near.first.size(); ++i) take_down(near.first[i]);
  for (std::size_t i = 0; open && i < near.trails.size(); ++i) {
    if (trails_[near.trails[i]].lowest_mm >= left.z_mm) break;  // the rest lie higher
    take_down(near.trails[i]);
  }
  // Those that came last took away what the others had left.
  constexpr std::size_t kKept = 6;
  near.first.assign(near.helped.rbegin(),
                    near.helped.rbegin() + static_cast<std::ptrdiff_t>(std::min(kKept, near.helped.size())));
}

double PlanarStock::height_at(Vec2 p) const {
  if (p.x < box_.lo.x || p.x > box_.hi.x || p.y < box_.lo.y || p.y > box_.hi.y) return box_.lo.z;
  if (bar_radius_mm_ > 0.0 && norm(p - 0.5 * (xy(box_.lo) + xy(box_.hi))) > bar_radius_mm_) return box_.lo.z;
  int x0, x1, y0, y1;
  tiles_of(p, p, x0, x1, y0, y1);
  double z = box_.hi.z;
  if (x0 > x1 || y0 > y1) return z;
  for (const std::uint32_t id :
       tiles_[static_cast<std::size_t>(y0) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x0)]
           .trails) {
    const Trail& t = trails_[id];
    if (t.lowest_mm < z && t.distance(p) <= t.radius_mm + kTouch) z = std::min(z, t.floor_at(p));
  }
  return std::max(z, box_.lo.z);
}

}  // namespace capstan::stock
