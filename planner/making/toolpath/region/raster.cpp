#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/region/patterns.h"

// Parallel passes. Scan lines a step-over apart are cut by the boundary of the centres into passes. From the
// end of a pass the cutter goes along the boundary, the shorter way, to a pass on the next line that is not
// cut yet, until none is left there; then the next chain begins.

namespace capstan::toolpath {

using geometry::Loop;
using geometry::Vec2;
using model::MoveRole;

namespace {

/// Where a scan line meets the boundary.
struct Crossing {
  double u = 0.0;
  std::size_t loop = 0, edge = 0;
};

/// A stretch of a scan line within the centres; u runs along the passes, v across.
struct Pass {
  double v = 0.0;
  Crossing a, b;  ///< a.u < b.u
  std::size_t line = 0;
  bool done = false;
};

class Raster {
 public:
  Raster(LevelCutter& cutter, const Level& level, const RasterOptions& options)
      : c_(cutter),
        level_(level),
        o_(options),
        e_(options.direction),
        n_{-e_.y, e_.x},
        lined_(level.centres) {
    if (!o_.step_left) n_ = -1.0 * n_;
  }

  Status run() {
    if (level_.centres.empty()) return {};
    if (o_.walls && o_.walls_first) {
      if (auto ok = walls(); !ok) return ok;
      // The ring has cut a radius to either side of it. What lies between two lines and no pass meets is
      // nearer than half a step to the boundary of where passes run.
      lined_ = inset(level_.centres, std::max(0.0, c_.radius_mm - 0.5 * step()), kWallChord);
      if (lined_.empty()) return {};
    }
    scan();
    for (std::size_t i = 0; i < passes_.size(); ++i) {
      if (passes_[i].done) continue;
      if (auto ok = chain(i); !ok) return ok;
    }
    if (o_.walls && !o_.walls_first) return walls();
    return {};
  }

 private:
  [[nodiscard]] double u(Vec2 p) const { return dot(p, e_); }
  [[nodiscard]] double v(Vec2 p) const { return dot(p, n_); }
  [[nodiscard]] Vec2 xy_of(double uu, double vv) const { return uu * e_ + vv * n_; }

  /// The most that lines are apart.
  [[nodiscard]] double step() const { return std::min(c_.step_mm, 1.98 * c_.radius_mm); }

  void scan() {
    double lo = 1e300;
    double hi = -1e300;
    for (const Loop& loop : lined_.loops) {
      for (const Vec2 p : loop) {
        lo = std::min(lo, v(p));
        hi = std::max(hi, v(p));
      }
    }
    // Just inside, so that an edge along a pass is met once.
    const double margin = std::min(0.0005, 0.25 * (hi - lo));
    lo += margin;
    hi -= margin;
    // Beyond an open side the first line is where the pass would only touch the piece; it is not cut.
    const auto [from, to] = met_by_passes(lo, hi);
    const bool air_before = from > lo, air_behind = to < hi;
    lo = from;
    hi = to;
    const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil((hi - lo) / step() - 1e-9)));
    const std::size_t first = air_before && n > 0 ? 1 : 0;
    const std::size_t last = air_behind && n > first ? n - 1 : n;
    std::vector<std::vector<Crossing>> met(n + 1);
    const auto height = [&](std::size_t k) {
      return lo + (hi - lo) * static_cast<double>(k) / static_cast<double>(n);
    };
    for (std::size_t l = 0; l < lined_.loops.size(); ++l) {
      const Loop& loop = lined_.loops[l];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i];
        const Vec2 b = loop[(i + 1) % loop.size()];
        const double va = v(a);
        const double vb = v(b);
        const double inv = static_cast<double>(n) / std::max(hi - lo, 1e-12);
        const double f = std::floor((std::min(va, vb) - lo) * inv) - 1.0;
        for (auto k = static_cast<std::size_t>(std::max(0.0, f)); k <= n; ++k) {
          const double h = height(k);
          if (h > std::max(va, vb)) break;
          if ((va <= h) == (vb <= h)) continue;
          met[k].push_back({u(a) + (u(b) - u(a)) * (h - va) / (vb - va), l, i});
        }
      }
    }
    for (std::size_t k = first; k <= last; ++k) {
      std::sort(met[k].begin(), met[k].end(), [](const Crossing& x, const Crossing& y) {
        if (x.u != y.u) return x.u < y.u;
        return x.loop != y.loop ? x.loop < y.loop : x.edge < y.edge;
      });
      for (std::size_t i = 0; i + 1 < met[k].size(); i += 2) {
        passes_.push_back({height(k), met[k][i], met[k][i + 1], k, false});
      }
    }
  }

  /// The lines between which passes meet the piece at all, of those from lo to hi.
  [[nodiscard]] std::pair<double, double> met_by_passes(double lo, double hi) const {
    if (!c_.area.open || c_.task.stock.empty()) return {lo, hi};
    const geometry::Region there =
        geometry::intersect(c_.area.material, geometry::offset(lined_, c_.radius_mm));
    double near = 1e300, far = -1e300;
    for (const Loop& loop : there.loops) {
      for (const Vec2 p : loop) {
        near = std::min(near, v(p));
        far = std::max(far, v(p));
      }
    }
    if (!(near < far)) return {lo, hi};
    return {std::max(lo, near - c_.radius_mm), std::min(hi, far + c_.radius_mm)};
  }

  [[nodiscard]] Vec2 point(const Pass& p, bool at_b) const { return xy_of(at_b ? p.b.u : p.a.u, p.v); }

  static bool overlap(const Pass& x, const Pass& y) { return x.a.u < y.b.u && y.a.u < x.b.u; }

  /// Unvisited pass on the next line that the current end leads to.
  [[nodiscard]] std::size_t next_of(std::size_t i, bool at_b) const {
    const Pass& p = passes_[i];
    std::size_t best = passes_.size();
    double least = 1e300;
    for (std::size_t k = i + 1; k < passes_.size() && passes_[k].line <= p.line + 1; ++k) {
      const Pass& q = passes_[k];
      if (q.line != p.line + 1 || q.done || !overlap(p, q)) continue;
      const double d = std::abs((at_b ? q.b.u : q.a.u) - (at_b ? p.b.u : p.a.u));
      if (d < least) {
        least = d;
        best = k;
      }
    }
    return best;
  }

  /// Along the boundary from one crossing to another of the same loop, the shorter way.
  [[nodiscard]] std::vector<Vec2> along_wall(const Crossing& from, const Crossing& to, Vec2 start,
                                             Vec2 end) const {
    if (from.loop != to.loop) return {};
    const Loop& loop = lined_.loops[from.loop];
    const std::size_t n = loop.size();
    const double most = 6.0 * c_.radius_mm + 4.0 * c_.step_mm;
    std::vector<Vec2> best;
    double shortest = most;
    for (const bool ahead : {true, false}) {
      std::vector<Vec2> line = {start};
      double length = 0.0;
      std::size_t k = ahead ? (from.edge + 1) % n : from.edge;
      const std::size_t stop = ahead ? (to.edge + 1) % n : to.edge;
      bool closed = from.edge == to.edge;
      for (std::size_t guard = 0; !closed && guard <= n && length < shortest; ++guard) {
        length += norm(loop[k] - line.back());
        line.push_back(loop[k]);
        k = ahead ? (k + 1) % n : (k + n - 1) % n;
        closed = k == stop;
      }
      length += norm(end - line.back());
      line.push_back(end);
      if (closed && length < shortest) {
        shortest = length;
        best = std::move(line);
      }
    }
    return best;
  }

  /// The place on the rings along the walls that is nearest.
  [[nodiscard]] Vec2 on_ring(Vec2 p) const {
    Vec2 best = p;
    double least = 1e300;
    for (const Loop& loop : level_.centres.loops) {
      const Vec2 q = nearest(track_of(loop), p).point;
      if (norm(q - p) < least) {
        least = norm(q - p);
        best = q;
      }
    }
    return best;
  }

  /// Begins a pass: from a neighbouring line that is cut already, or into the solid along the pass.
  Status begin(std::size_t i, bool from_b) {
    const Pass& p = passes_[i];
    const Vec2 start = point(p, from_b);
    const Vec2 end = point(p, !from_b);
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      const Pass& q = passes_[k];
      const std::size_t apart = q.line > p.line ? q.line - p.line : p.line - q.line;
      if (!q.done || apart > 1 || !overlap(p, q) || k == i) continue;
      const Vec2 anchor = xy_of(std::clamp(u(start), q.a.u, q.b.u), q.v);
      if (!level_.inside.contains(anchor, start)) continue;
      c_.go_cleared(level_, anchor);
      if (c_.cut_to(level_, start)) return {};
    }
    if (o_.walls_first) {  // from the ring along the wall
      c_.go_cleared(level_, on_ring(start));
      if (c_.cut_to(level_, start)) return {};
    }
    Track t{
        .start = start, .segments = {{.to = end, .centre = {}, .bend = Bend::kStraight}}, .closed = false};
    auto in = c_.enter(level_, t, nullptr);
    if (!in) return tl::unexpected(in.error());
    return {};
  }

  void cut(std::size_t i, bool to_b) {
    const Vec2 end = point(passes_[i], to_b);
    c_.writer.line({end.x, end.y, level_.z_mm}, MoveRole::kCut);
    passes_[i].done = true;
  }

  Status chain(std::size_t i) {
    bool to_b = true;
    if (auto ok = begin(i, !to_b); !ok) return ok;
    cut(i, to_b);
    while (!o_.one_way) {
      const std::size_t k = next_of(i, to_b);
      if (k == passes_.size()) return {};
      const Pass& p = passes_[i];
      const Pass& q = passes_[k];
      const Vec2 from = point(p, to_b);
      const Vec2 to = point(q, to_b);
      if (norm(to - from) <= 3.0 * c_.step_mm && level_.inside.contains(from, to)) {
        c_.writer.line({to.x, to.y, level_.z_mm}, MoveRole::kCut);
      } else {
        const auto line = along_wall(to_b ? p.b : p.a, to_b ? q.b : q.a, from, to);
        if (line.empty()) return {};
        c_.writer.follow(track_of_line(line), level_.z_mm, MoveRole::kCut);
      }
      to_b = !to_b;
      cut(k, to_b);
      i = k;
    }
    return {};
  }

  /// Whether roughing passes ran along all of a wall's track but what is beside the piece.
  [[nodiscard]] bool cut_by_passes(const Track& t) const {
    if (!(c_.task.allowance_side_mm > 0.0) || !c_.area.open || c_.task.stock.empty() || o_.walls_first)
      return false;
    constexpr double kApart = 0.25;  // of the radius
    constexpr double kMost = 4000.0;
    const double length = length_of(t), pieces = std::ceil(length / (kApart * c_.radius_mm));
    if (!(pieces <= kMost)) return false;
    const auto on_pass = [&](Vec2 p) {
      return std::any_of(passes_.begin(), passes_.end(), [&](const Pass& q) {
        return q.done && std::abs(v(p) - q.v) <= kInsideSlack && u(p) >= q.a.u - kInsideSlack &&
               u(p) <= q.b.u + kInsideSlack;
      });
    };
    for (double k = 0.0; k <= pieces; k += 1.0) {
      const Vec2 p = at_length(t, length * k / std::max(1.0, pieces)).point;
      if (!level_.material.clear_of(p, c_.radius_mm) && !on_pass(p)) return false;
    }
    return true;
  }

  Status walls() {
    for (std::size_t l = 0; l < level_.centres.loops.size(); ++l) {
      if (o_.wall_of != nullptr) {
        const Inside wall(*o_.wall_of);
        const Loop& loop = level_.centres.loops[l];
        if (std::none_of(loop.begin(), loop.end(), [&](Vec2 p) { return wall.boundary_within(p, 1e-3); }))
          continue;
      }
      Track t = track_of(level_.centres.loops[l]);
      if (cut_by_passes(t)) continue;
      if (!walls_on_right(c_.task)) t = reversed(t);
      // A pass that ends on this loop has cleared the way to it.
      const Pass* meets = nullptr;
      for (const Pass& p : passes_) {
        if (p.done && (p.a.loop == l || p.b.loop == l)) meets = &p;
      }
      if (c_.writer.begun() && c_.cut_to(level_, nearest(t, xy(c_.writer.at())).point)) {
        t = begun_at(t, nearest(t, xy(c_.writer.at())));
      } else if (meets != nullptr) {
        const Vec2 p = point(*meets, meets->a.loop != l);
        c_.go_cleared(level_, p);
        t = begun_at(t, nearest(t, p));
        (void)c_.cut_to(level_, t.start);
      } else {
        auto in = c_.enter(level_, t, nullptr);
        if (!in) return tl::unexpected(in.error());
        t = *in;
      }
      c_.follow(level_, t);
    }
    return {};
  }

  LevelCutter& c_;
  const Level& level_;
  RasterOptions o_;
  Vec2 e_, n_;
  geometry::Region lined_;  ///< where passes run: the centres, or inside the ring along their walls
  std::vector<Pass> passes_;
};

}  // namespace

Status cut_raster(LevelCutter& cutter, const Level& level, const RasterOptions& options) {
  return Raster(cutter, level, options).run();
}

}  // namespace capstan::toolpath
