#include "planner/making/toolpath/region/adaptive/clearing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/region/adaptive/way.h"
#include "planner/making/toolpath/region/area/work_area.h"

// Cleared ground C is what the cutter's discs have swept. The centres at which a disc reaches no deeper than
// k into the rest are C shrunk by r - k; where their boundary is none of the region's own, a front stands.
// From the beginning of the nearest front a pass is traced (tracer.h); C grows by its sweep; so on until no
// front is left. The first pass after a helix winds out as a spiral by itself, since its own sweep is its
// front. Material less deep than k stays along the walls, and one pass along them takes it: k is a part of
// the radial depth so small that three contacts of that depth, as an inner corner has them, are one straight
// cut's.

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;

namespace {

// acos(1 - x) grows as the root of x: three arcs of an eighth of the depth are 1.06 of the whole one's.
constexpr double kLeftPart = 0.125;
constexpr double kOffWall = 0.01;  // mm; passes keep this off the walls, which the last one meets exactly
constexpr double kFit = 0.004;     // mm between a pass and the lines and arcs that are written
constexpr double kCoarse = 0.02;   // mm; chords of the boundaries of where ways and fronts lie
constexpr double kSame = 0.0005;   // mm; vertices that say less are dropped
constexpr double kCusp = 0.02;     // mm; less along a wall is left; default, unsourced
constexpr double kLeadPart = 0.3;  // radius of the arc off a front, of the cutter's; default, unsourced
constexpr double kLeadTurn = 1.2;  // rad, likewise
constexpr double kLeftOver =
    0.02;  // of the radius squared: centres that fronts may miss, as in a corner's tip
constexpr std::size_t kMostPasses = 20'000;

/// A stretch of a front, in the sense of its loop: material on its right.
struct Front {
  std::size_t loop = 0, first = 0, edges = 0;  ///< vertex where it begins
  bool closed = false;
  double length_mm = 0.0;
};

class Clearing {
 public:
  Clearing(const Region& centres, const Bite& bite, const Region& cleared)
      : bite_(bite),
        left_mm_(kLeftPart * bite.radial_mm),
        wall_(centres),
        centres_(inset(centres, kOffWall, 0.25 * kOffWall)),
        walls_(centres_),
        ground_(cleared),
        fresh_(geometry::bounds(cleared)) {}

  tl::expected<std::vector<ClearingPass>, Unreached> run(const std::optional<ClearingStart>& start) {
    if (centres_.empty()) return out_;
    if (start) {
      at_ = start->at;
      stands_ = true;
      (void)pass({start->at, start->heading});
    }
    for (std::size_t n = 0;; ++n) {
      poll();
      if (n > kMostPasses) return tl::unexpected(unreached());
      refresh();
      if (free_.empty()) return tl::unexpected(unreached());
      if (!next()) break;
    }
    // Where no pass could go, the one along the walls must not either.
    for (const Region& left : geometry::pieces(geometry::subtract(centres_, done_))) {
      if (geometry::area(left) > kLeftOver * bite_.radius_mm * bite_.radius_mm)
        return tl::unexpected(unreached());
    }
    along_walls();
    return std::move(out_);
  }

 private:
  [[nodiscard]] Unreached unreached() const {
    Unreached out;
    for (const Region& left : geometry::pieces(geometry::subtract(centres_, done_))) {
      const double area = geometry::area(left);
      if (area <= out.area_mm2) continue;
      const auto box = geometry::bounds(left);
      out = {0.5 * (box.lo + box.hi), area};
    }
    return out;
  }

  /// Brings `free_` and `done_` up to the ground. Both only grow, and only near what was swept since: there
  /// they are made anew, of the ground about it.
  void refresh() {
    if (fresh_.lo.x > fresh_.hi.x) return;
    const double r = bite_.radius_mm;
    const auto grown = [&](double by) {
      return geometry::rectangle(fresh_.lo - Vec2{by, by}, fresh_.hi + Vec2{by, by});
    };
    // Where ways and fronts lie may be coarser than where material does.
    const double coarse = std::min(kCoarse, 0.2 * left_mm_);
    const auto shrunk = [&](double by) {
      const Region about = simplified(geometry::intersect(ground_, grown(2.0 * (r + by))), 0.5 * coarse);
      const Region inner = geometry::intersect(geometry::offset(about, -by, coarse), centres_);
      return geometry::intersect(inner, grown(r + by));
    };
    free_ = simplified(geometry::unite(free_, shrunk(r + kBesideWay)), kSame);
    done_ = simplified(geometry::unite(done_, shrunk(r - left_mm_)), kSame);
    fresh_ = {};
  }

  /// The place of `free_` that is nearest, a little within, so that no rounding puts it outside.
  [[nodiscard]] static Vec2 stand(const Walls& free, Vec2 p) {
    const double within = 0.2 * kBesideWay;
    const Vec2 q = free.kept(p);
    if (free.nearest(q, within).distance_mm >= within) return q;
    Vec2 best = q;
    double most = 0.0;
    for (int i = 0; i < 16; ++i) {
      const double t = i * std::numbers::pi / 8.0;
      const Vec2 c = q + within * Vec2{std::cos(t), std::sin(t)};
      if (!free.contains(c)) continue;
      const double d = std::min(free.nearest(c, within).distance_mm, within);
      if (d > most) {
        most = d;
        best = c;
      }
    }
    return best;
  }

  void grow(const std::vector<Vec2>& line) {
    if (line.empty()) return;
    const Region swept = line.size() == 1 ? geometry::disc(line.front(), bite_.radius_mm, bite_.chord_mm)
                                          : geometry::stroke(line, bite_.radius_mm, true, bite_.chord_mm);
    ground_ = simplified(geometry::unite(ground_, swept), 0.5 * bite_.chord_mm);
    for (const Vec2 p : line) {
      fresh_.lo = {std::min(fresh_.lo.x, p.x), std::min(fresh_.lo.y, p.y)};
      fresh_.hi = {std::max(fresh_.hi.x, p.x), std::max(fresh_.hi.y, p.y)};
    }
  }

  void grow(const Track& t) { grow(points_of(t, bite_.chord_mm)); }

  /// Cuts from the aim on; false: it met nothing.
  bool pass(const ClearingStart& aim) {
    const double before = geometry::area(ground_);
    Tracer tracer(walls_, bite_, aim.at, aim.heading);
    std::size_t swept = 0;
    for (;;) {
      ContactMeter meter(ground_, bite_.radius_mm - bite_.blind_mm);
      const auto end = tracer.run(meter);
      const auto& line = tracer.line();
      const std::size_t till =
          end == Tracer::End::kFurther ? line.size() : std::max<std::size_t>(tracer.cut(), 1);
      if (till > swept + 1) {
        const std::vector<Vec2> piece(line.begin() + static_cast<std::ptrdiff_t>(swept),
                                      line.begin() + static_cast<std::ptrdiff_t>(till));
        grow(track_of_line(piece, bite_.chord_mm));
        swept = till - 1;
      }
      if (end != Tracer::End::kFurther) break;
    }
    if (tracer.cut() < 2) return false;
    std::vector<Vec2> line(tracer.line().begin(),
                           tracer.line().begin() + static_cast<std::ptrdiff_t>(tracer.cut()));
    if (geometry::area(ground_) - before < 1e-3 * bite_.radius_mm * bite_.radial_mm) return false;
    lead_off(line);
    add(track_of_line(line, kFit));
    return true;
  }

  /// A short arc to the left, away from the front, as far as it is free.
  void lead_off(std::vector<Vec2>& line) {
    ContactMeter meter(ground_, bite_.radius_mm - bite_.blind_mm);
    const double radius = kLeadPart * bite_.radius_mm;
    Vec2 p = line.back();
    Vec2 d = p - line[line.size() - 2];
    d = (1.0 / norm(d)) * d;
    const int n = 12;
    for (int i = 0; i < n; ++i) {
      const double by = kLeadTurn / n;
      d = {std::cos(by) * d.x - std::sin(by) * d.y, std::sin(by) * d.x + std::cos(by) * d.y};
      p = p + (radius * by) * d;
      if (!walls_.contains(p) || meter.arc(p, d) > 0.0) return;
      line.push_back(p);
    }
  }

  void add(Track track) {
    ClearingPass p;
    if (!stands_) {
      p.over = true;
    } else if (norm(track.start - at_) > 1e-9) {
      const Vec2 from = stand(Walls(free_), at_);
      auto way = Ways(free_).between(from, track.start);
      if (way) {
        p.way = std::move(*way);
      } else {
        p.over = true;
      }
    }
    at_ = track.end();
    stands_ = true;
    p.track = std::move(track);
    out_.push_back(std::move(p));
  }

  [[nodiscard]] bool on_wall(Vec2 a, Vec2 b) const {
    for (const Vec2 p : {a, b, 0.5 * (a + b)}) {
      if (walls_.nearest(p, kOffWall).distance_mm > 0.3 * kOffWall) return false;
    }
    return true;
  }

  [[nodiscard]] std::vector<Front> fronts(const Region& done) const {
    std::vector<Front> out;
    for (std::size_t l = 0; l < done.loops.size(); ++l) {
      const auto& loop = done.loops[l];
      const std::size_t n = loop.size();
      std::vector<bool> wall(n);
      std::size_t begin = n;
      for (std::size_t i = 0; i < n; ++i) {
        wall[i] = on_wall(loop[i], loop[(i + 1) % n]);
        if (wall[i]) begin = i;
      }
      const bool closed = begin == n;
      if (closed) begin = 0;
      Front f;
      for (std::size_t k = 0; k <= n; ++k) {
        const std::size_t i = (begin + k) % n;
        if (k < n && !wall[i]) {
          if (f.edges++ == 0) f.first = i;
          f.length_mm += norm(loop[(i + 1) % n] - loop[i]);
          continue;
        }
        if (f.edges > 0 && f.length_mm > left_mm_) {
          f.loop = l;
          f.closed = closed;
          out.push_back(f);
        }
        f = {};
      }
    }
    return out;
  }

  /// Begins before the front, so that the curl to it ends where it begins; later on it, when that failed.
  [[nodiscard]] ClearingStart aim_at(const Region& done, const Front& f, int tried) const {
    const auto& loop = done.loops[f.loop];
    const std::size_t n = loop.size();
    std::size_t i = f.first;
    if (f.closed) {
      for (std::size_t k = 0; k < n; ++k) {
        if (norm(loop[k] - at_) < norm(loop[i] - at_)) i = k;
      }
    }
    if (tried > 0) i = (i + f.edges / 2) % n;
    double back = 1.2 * std::sqrt(bite_.radius_mm * (left_mm_ + kBesideWay));
    Vec2 p = loop[i];
    Vec2 heading = loop[(i + 1) % n] - loop[i];
    for (std::size_t k = 0; k < n && back > 0.0; ++k) {
      const Vec2 q = loop[(i + n - 1) % n];
      const double l = norm(p - q);
      if (l > 1e-9) heading = p - q;
      if (l >= back) {
        p = p + (back / l) * (q - p);
        break;
      }
      back -= l;
      p = q;
      i = (i + n - 1) % n;
    }
    return {p, (1.0 / norm(heading)) * heading};
  }

  /// The next pass; false: no front is left that a pass could take.
  bool next() {
    const Region& done = done_;
    auto all = fronts(done);
    std::stable_sort(all.begin(), all.end(), [&](const Front& a, const Front& b) {
      return norm(done.loops[a.loop][a.first] - at_) < norm(done.loops[b.loop][b.first] - at_);
    });
    const Walls free(free_);
    for (const Front& f : all) {
      const Vec2 begin = done.loops[f.loop][f.first];
      for (;;) {
        const auto tried = static_cast<int>(std::count_if(
            failed_.begin(), failed_.end(), [&](Vec2 p) { return norm(p - begin) < 0.1 * bite_.radius_mm; }));
        if (tried > 1) break;
        ClearingStart aim = aim_at(done, f, tried);
        aim.at = stand(free, aim.at);
        if (pass(aim)) return true;
        failed_.push_back(begin);
      }
    }
    return false;
  }

  /// What the passes left along the boundary: once round, or the stretches where there is some.
  void along_walls() {
    const Walls inside(inset(wall_, -0.002, 0.0005));
    for (const auto& loop : wall_.loops) {
      const Track track = track_of(loop);
      const double length = length_of(track);
      const int n = std::max(8, static_cast<int>(std::ceil(length / (0.1 * bite_.radius_mm))));
      ContactMeter meter(ground_, bite_.radius_mm);
      std::vector<bool> need(static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i) {
        need[static_cast<std::size_t>(i)] =
            meter.touches(at_length(track, length * i / n).point, bite_.radius_mm - kCusp);
      }
      // A run-in of half the radius on both sides; short gaps are cut through.
      const int grow_by = 6;
      std::vector<bool> wide(need.size(), false);
      for (int i = 0; i < n; ++i) {
        if (!need[static_cast<std::size_t>(i)]) continue;
        for (int k = -grow_by; k <= grow_by; ++k) wide[static_cast<std::size_t>((i + k + n) % n)] = true;
      }
      const auto count = std::count(wide.begin(), wide.end(), true);
      if (count == 0) continue;
      if (10 * count > 7 * n && ring(track)) continue;
      int begin = 0;
      while (begin < n && wide[static_cast<std::size_t>(begin)]) ++begin;
      if (begin == n) {
        stretch(track, inside);
        continue;
      }
      for (int k = 1; k <= n; ++k) {
        int i = (begin + k) % n;
        if (!wide[static_cast<std::size_t>(i)]) continue;
        int many = 0;
        while (wide[static_cast<std::size_t>((i + many) % n)]) ++many;
        const Track turned = begun_at(track, at_length(track, length * i / n));
        stretch(part_of(turned, 0.0, length * (many - 1) / n), inside);
        k += many;
      }
    }
  }

  /// The whole loop, met and left on quarter arcs; false: they fit nowhere.
  bool ring(const Track& track) {
    const Walls free(free_);
    Vec2 from = track.start;
    std::vector<std::pair<double, Spot>> spots;
    for (std::size_t i = 0; i < track.segments.size(); ++i) {
      const Segment& s = track.segments[i];
      const Vec2 middle = point_at(from, s, 0.5);
      // The nearest of the longer pieces.
      if (length_of(from, s) > 0.5 * bite_.radius_mm)
        spots.push_back(
            {norm(middle - at_), Spot{.segment = i, .t = 0.5, .point = middle, .distance_mm = 0.0}});
      from = s.to;
    }
    std::stable_sort(spots.begin(), spots.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first - 1e-6; });
    for (const double part : {0.5, 0.2}) {
      const double radius = part * bite_.radius_mm;
      for (const auto& [d, spot] : spots) {
        Track t = begun_at(track, spot);
        if (t.segments.empty()) continue;
        const Vec2 along = direction_at(t.start, t.segments.front(), 0.0);
        const Vec2 centre = t.start + radius * left_of(along);
        const Vec2 in = centre - radius * along;
        const Vec2 off = centre + radius * along;
        if (!free.contains(in) || !free.contains(off)) continue;
        const Vec2 begin = t.start;
        Track whole{.start = in, .segments = {}, .closed = false};
        whole.segments.push_back({.to = begin, .centre = centre, .bend = Bend::kCcw});
        whole.segments.insert(whole.segments.end(), t.segments.begin(), t.segments.end());
        whole.segments.push_back({.to = off, .centre = centre, .bend = Bend::kCcw});
        grow(t);
        add(std::move(whole));
        return true;
      }
    }
    return false;
  }

  void stretch(const Track& t, const Walls& inside) {
    const Walls free(free_);
    const auto beside = [&](Vec2 p) {
      const Vec2 q = stand(free, p);
      return norm(q - p) < 0.5 * bite_.radius_mm && inside.contains(q, p) ? q : p;
    };
    const Vec2 in = beside(t.start);
    const Vec2 off = beside(t.end());
    Track whole{.start = in, .segments = {}, .closed = false};
    if (norm(in - t.start) > 1e-9)
      whole.segments.push_back({.to = t.start, .centre = {}, .bend = Bend::kStraight});
    whole.segments.insert(whole.segments.end(), t.segments.begin(), t.segments.end());
    if (norm(off - t.end()) > 1e-9)
      whole.segments.push_back({.to = off, .centre = {}, .bend = Bend::kStraight});
    grow(t);
    add(std::move(whole));
  }

  Bite bite_;
  double left_mm_;
  Region wall_, centres_;
  Walls walls_;
  Region ground_;
  geometry::Box2 fresh_;  ///< about the centres swept since the last refresh
  Region free_;           ///< centres at which the cutter stands free of everything
  Region done_;           ///< centres at which it reaches no deeper than `left_mm_`
  Vec2 at_;
  bool stands_ = false;  ///< whether the cutter is at `at_`, down on the level
  std::vector<Vec2> failed_;
  std::vector<ClearingPass> out_;
};

}  // namespace

tl::expected<std::vector<ClearingPass>, Unreached> clearing_passes(
    const Region& centres, const Bite& bite, const Region& cleared,
    const std::optional<ClearingStart>& start) {
  return Clearing(centres, bite, cleared).run(start);
}

}  // namespace capstan::toolpath
