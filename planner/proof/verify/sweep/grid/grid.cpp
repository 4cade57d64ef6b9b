#include "planner/proof/verify/sweep/grid/grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::verify {

using geometry::CutterProfile;
using geometry::Vec2;
using geometry::Vec3;

Grid::Grid(Vec2 lo, Vec2 hi, double cell_mm, long maximum_cells) : lo_(lo) {
  const double w = std::max(hi.x - lo.x, 1e-3);
  const double h = std::max(hi.y - lo.y, 1e-3);
  cell_ = std::max(cell_mm, std::sqrt(w * h / static_cast<double>(maximum_cells)));
  cell_ = std::max({cell_, w / static_cast<double>(maximum_cells), h / static_cast<double>(maximum_cells)});
  const auto count = [&](double size) {
    return std::max(1, static_cast<int>(std::floor(size / cell_ + 0.5)));
  };
  nx_ = count(w);
  ny_ = count(h);
  stock.assign(index(0, ny_), kNothing);
  part.assign(index(0, ny_), kNothing);
  base.assign(index(0, ny_), kNothing);
  before_.assign(index(0, ny_), kNothing);
  touched_.assign(index(0, ny_), 0U);
}

std::pair<int, int> Grid::columns(double a, double b) const {
  const double first = std::ceil((a - lo_.x) / cell_ - 0.5);
  const double last = std::floor((b - lo_.x) / cell_ - 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(nx_))),
          static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(nx_)))};
}

std::pair<int, int> Grid::rows(double a, double b) const {
  const double first = std::ceil((a - lo_.y) / cell_ - 0.5);
  const double last = std::floor((b - lo_.y) / cell_ - 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(ny_))),
          static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(ny_)))};
}

void Grid::find_top() {
  top_ = kNothing;
  for (const double s : stock) top_ = std::max(top_, s);
}

double Grid::highest(Vec2 at, double radius_mm) const {
  double best = kNothing;
  const auto [y0, y1] = rows(at.y - radius_mm, at.y + radius_mm);
  for (int iy = y0; iy < y1; ++iy) {
    const double dy = centre(0, iy).y - at.y;
    const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - dy * dy));
    const auto [x0, x1] = columns(at.x - half, at.x + half);
    for (int ix = x0; ix < x1; ++ix) best = std::max(best, stock[index(ix, iy)]);
  }
  return best;
}

bool Grid::stands(Vec2 at, double radius_mm, double lo_mm, double hi_mm) const {
  const auto [y0, y1] = rows(at.y - radius_mm, at.y + radius_mm);
  for (int iy = y0; iy < y1; ++iy) {
    const double dy = centre(0, iy).y - at.y;
    const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - dy * dy));
    const auto [x0, x1] = columns(at.x - half, at.x + half);
    for (int ix = x0; ix < x1; ++ix) {
      const std::size_t i = index(ix, iy);
      if (stock[i] > lo_mm && base[i] < hi_mm) return true;
    }
  }
  return false;
}

double Grid::normal_depth(Vec2 at, double z_mm) const {
  const auto [x0, x1] = columns(at.x - 0.5 * cell_, at.x + 0.5 * cell_);
  const auto [y0, y1] = rows(at.y - 0.5 * cell_, at.y + 0.5 * cell_);
  if (x0 >= x1 || y0 >= y1) return 0.0;
  const double here = part[index(x0, y0)];
  double steepest = 0.0;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const int ix = x0 + dx;
    const int iy = y0 + dy;
    if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) continue;
    steepest = std::max(steepest, std::abs(part[index(ix, iy)] - here) / cell_);
  }
  return (here - z_mm) / std::sqrt(1.0 + 2.0 * steepest * steepest);
}

namespace {

/// The cutter's outline with its flat part taken out of the loop.
struct Outline {
  explicit Outline(const CutterProfile& p) : profile(p), radius(p.radius_mm) {
    if (!p.pieces.empty() && p.pieces.front().radius_mm == 0.0 && p.pieces.front().slope == 0.0)
      flat = p.pieces.front().r1_mm;
  }
  [[nodiscard]] double height(double d) const {
    return d <= flat ? 0.0 : profile.height(std::min(d, radius));
  }
  /// Within this the cutter has no edge unless it cuts to its centre. Of a cone that is its tip's: its flank
  /// cuts. The share is a default, unsourced.
  [[nodiscard]] double middle() const {
    constexpr double kMiddle = 0.3;
    const auto& p = profile.pieces;
    const bool cone = flat > 0.0 && p.size() > 1 && p[1].radius_mm == 0.0 && p[1].slope > 0.0;
    return kMiddle * (cone ? flat : radius);
  }
  const CutterProfile& profile;
  double radius, flat = 0.0;
};

/// How far the pieces of a helix stay inside its arc.
constexpr double kChordMm = 0.002;

/// A point nearer to the rim than this at the start of a move is met by the move, not by what was before.
constexpr double kMetMm = 1e-6;

/// Takes cells down, and that is all.
struct Plane {
  Grid& grid;
  static constexpr bool kMeasures = false;
  void at(int ix, int iy, double, double z, double) {
    const std::size_t i = grid.index(ix, iy);
    if (z < grid.stock[i]) grid.stock[i] = z <= grid.base[i] ? Grid::kNothing : z;
  }
};

/// Takes cells down and keeps the account. What only the outermost rim takes may be what the pieces of a
/// helix left before: no depth of cut.
struct Knife {
  Grid& grid;
  double allowed;
  const GougeJudge* judge;
  Bite& bite;
  double core, rim;
  const Outline& outline;
  double advance;
  double head = 0.0;
  int judged = 0;
  static constexpr bool kMeasures = true;

  /// The chip at a centre that stands `above` the tip and of which no more than `deep` is taken.
  /// `meets(rho)`: cosine between the way and the direction from the axis to the centre, both level, as a
  /// circle of that radius meets it; below 0: it does not, or the cutter stood over it before the move.
  template <class Meets>
  void chip(int ix, int iy, double above, double deep, const Meets& meets) {
    if (advance <= 0.0 || deep <= 0.0) return;
    const double rho = outline.profile.radius_at(above);
    if (rho <= 0.0) return;
    const double cosine = meets(rho);
    if (cosine < 0.0) return;
    // How upright the surface is there.
    constexpr double kStep = 1e-4;
    const double lean = above > kStep ? (rho - outline.profile.radius_at(above - kStep)) / kStep : 0.0;
    const double upright = advance / std::sqrt(1.0 + lean * lean);
    const double thick = std::min(upright * cosine, deep);
    if (thick > bite.chip_mm) {
      bite.chip_mm = thick;
      bite.chip_at = grid.centre(ix, iy);
    }
    const double aside = std::max(0.0, std::sqrt(1.0 - std::min(1.0, cosine * cosine)) - grid.cell() / rho);
    bite.chip_most_mm = std::max(bite.chip_most_mm, std::min(upright * std::sqrt(1.0 - aside * aside), deep));
  }

  void at(int ix, int iy, double tip_z, double z, double from_axis) {
    const std::size_t i = grid.index(ix, iy);
    double& s = grid.stock[i];
    if (z >= s || (head > 0.0 && s > tip_z + head)) return;
    const double floor = grid.base[i];
    if (s > Grid::kNothing / 2) {
      bite.volume_mm3 += (s - std::max(z, floor)) * grid.cell() * grid.cell();
      const double taken = grid.before_move(i, s) - std::max(z, floor);
      if (from_axis <= rim) {
        bite.contact_mm = std::max(bite.contact_mm, s - tip_z);
        bite.thickest_mm = std::max(bite.thickest_mm, taken);
      }
      if (from_axis <= core) bite.core_mm = std::max(bite.core_mm, taken);
      ++bite.cells;
      const double below = grid.part[i] - z;
      if (below > allowed && below > bite.gouge_mm) gouge(ix, iy, z, below);
    }
    s = z <= floor ? Grid::kNothing : z;
  }
  void gouge(int ix, int iy, double z, double below) {
    constexpr int kMostJudged = 500;  // per move; a true gouge is found by the first
    if (judge != nullptr && (++judged > kMostJudged || !judge->guilty(grid.centre(ix, iy), z))) return;
    bite.gouge_mm = below;
    bite.gouge_at = grid.centre(ix, iy);
  }
};

/// Where along the way, `v` >= 0 mm past the point and downhill, a piece of the outline is lowest over a
/// point `d` beside the way: the zero of  -fall + dh/dv,  h(sqrt(d^2 + v^2)) the piece's height. Cones and
/// spheres have it in closed form; a torus is searched between `lo` and `hi`.
double lowest_of(const geometry::ProfilePiece& p, const Outline& o, double fall, double d, double lo,
                 double hi) {
  if (p.radius_mm <= 0.0) return p.slope > fall ? fall * d / std::sqrt(p.slope * p.slope - fall * fall) : hi;
  if (p.rc_mm == 0.0)
    return fall * std::sqrt(std::max(0.0, p.radius_mm * p.radius_mm - d * d) / (1.0 + fall * fall));
  // Golden section: 16 steps leave 1/2000 of the piece, an error of its square over the radius.
  constexpr double kGolden = 0.6180339887498949;
  const auto f = [&](double v) { return o.height(std::sqrt(d * d + v * v)) - fall * v; };
  double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 16; ++i) {
    if (fa < fb) {
      hi = std::exchange(b, a);
      fb = fa;
      a = hi - kGolden * (hi - lo);
      fa = f(a);
    } else {
      lo = std::exchange(a, b);
      fa = fb;
      b = lo + kGolden * (hi - lo);
      fb = f(b);
    }
  }
  return fa < fb ? a : b;
}

/// Lowest height of the cutter over a point while it runs along a line; `d` is the distance of the point
/// from the line, `foot` where its foot lies along it, `length` the line's in XY.
double lowest(const Outline& o, double z0, double dz, double foot, double d, double length) {
  const double reach = std::sqrt(std::max(0.0, o.radius * o.radius - d * d));
  const double from = std::clamp(foot - reach, 0.0, length), to = std::clamp(foot + reach, 0.0, length);
  const double fall = std::abs(dz) / length;
  // Downhill from the foot: before it the surface over the point only sinks.
  const double begin = dz < 0.0 ? from - foot : foot - to, end = dz < 0.0 ? to - foot : foot - from;
  const double z_foot = z0 + foot / length * dz;
  const auto f = [&](double v) { return z_foot - fall * v + o.height(std::sqrt(d * d + v * v)); };
  double best = f(end);
  if (end <= 0.0) return best;
  const double first = std::max(begin, 0.0);
  for (const geometry::ProfilePiece& p : o.profile.pieces) {
    const double lo = std::max(first, std::sqrt(std::max(0.0, p.r0_mm * p.r0_mm - d * d)));
    const double hi = std::min(end, std::sqrt(std::max(0.0, p.r1_mm * p.r1_mm - d * d)));
    if (p.r1_mm < d || lo > hi) continue;
    best = std::min(best, f(std::clamp(lowest_of(p, o, fall, d, lo, hi), lo, hi)));
  }
  return best;
}

template <class Edge>
void cut_line(Edge& k, const Outline& o, Vec3 a, Vec3 b) {
  const Vec2 d = xy(b) - xy(a);
  const double length = norm(d);
  const double r = o.radius;
  const double zmin = std::min(a.z, b.z);
  const bool level = std::abs(b.z - a.z) < 1e-9 || length < 1e-9;
  const auto [y0, y1] = k.grid.rows(std::min(a.y, b.y) - r, std::max(a.y, b.y) + r);
  for (int iy = y0; iy < y1; ++iy) {
    const double y = k.grid.centre(0, iy).y;
    // Of the line only what lies within r of this row matters.
    double t0 = 0.0, t1 = 1.0;
    if (std::abs(d.y) > 1e-12) {
      t0 = (y - r - a.y) / d.y;
      t1 = (y + r - a.y) / d.y;
      if (t0 > t1) std::swap(t0, t1);
      t0 = std::clamp(t0, 0.0, 1.0);
      t1 = std::clamp(t1, 0.0, 1.0);
    }
    const double xa = a.x + t0 * d.x, xb = a.x + t1 * d.x;
    const auto [x0, x1] = k.grid.columns(std::min(xa, xb) - r, std::max(xa, xb) + r);
    for (int ix = x0; ix < x1; ++ix) {
      const double stands = k.grid.stock[k.grid.index(ix, iy)];
      if (stands <= zmin) continue;
      const Vec2 p = k.grid.centre(ix, iy);
      const double foot = length < 1e-9 ? 0.0 : dot(p - xy(a), d) / (length * length);
      const double t = std::clamp(foot, 0.0, 1.0);
      const Vec2 apart = p - (xy(a) + t * d);
      const double square = dot(apart, apart);
      if (square > r * r) continue;
      const double near = std::sqrt(square);
      // No lower than the cutter would be at its nearest, at the lower end.
      const double bound = zmin + o.height(near);
      if (stands <= bound) continue;
      if constexpr (Edge::kMeasures) {
        if (length > 1e-9) {
          const double along = foot * length;
          const double off2 = std::max(0.0, dot(p - xy(a), p - xy(a)) - along * along);
          // Where the rim of the full radius meets the centre: the tip's height there.
          const double met = along - std::sqrt(std::max(0.0, r * r - off2));
          const double tip = a.z + std::clamp(met / length, 0.0, 1.0) * (b.z - a.z);
          const double under = std::max(bound, k.grid.base[k.grid.index(ix, iy)]);
          k.chip(ix, iy, stands - tip, stands - under, [&](double rho) {
            if (off2 >= rho * rho) return -1.0;
            const double ahead = std::sqrt(rho * rho - off2);
            const double begins = along - ahead;
            return begins < -kMetMm || begins > length ? -1.0 : ahead / rho;
          });
        }
      }
      if (level) {
        k.at(ix, iy, zmin, bound, near);
        continue;
      }
      const Vec2 aside = p - (xy(a) + foot * d);
      const double z = lowest(o, a.z, b.z - a.z, foot * length, std::sqrt(dot(aside, aside)), length);
      k.at(ix, iy, a.z + t * (b.z - a.z), z, near);
    }
  }
}

template <class Edge>
void cut_level_arc(Edge& k, const Outline& o, const Move& m) {
  const double ra = 0.5 * (norm(xy(m.from) - m.centre) + norm(xy(m.to) - m.centre));
  const double r = o.radius;
  const double sweep = sweep_of(m);
  const double start = std::atan2(m.from.y - m.centre.y, m.from.x - m.centre.x);
  const double sign = m.kind == model::MoveKind::kArcCcw ? 1.0 : -1.0;
  const geometry::Box3 box = box_of(m);
  constexpr double kTurn = 6.283185307179586;
  const auto [y0, y1] = k.grid.rows(box.lo.y - r, box.hi.y + r);
  const auto [x0, x1] = k.grid.columns(box.lo.x - r, box.hi.x + r);
  for (int iy = y0; iy < y1; ++iy) {
    for (int ix = x0; ix < x1; ++ix) {
      if (k.grid.stock[k.grid.index(ix, iy)] <= m.to.z) continue;
      const Vec2 p = k.grid.centre(ix, iy);
      const Vec2 q = p - m.centre;
      const double radial = std::abs(norm(q) - ra);
      if (radial > r) continue;
      double ahead = std::fmod(sign * (std::atan2(q.y, q.x) - start), kTurn);
      if (ahead < 0.0) ahead += kTurn;
      const double near = ahead <= sweep ? radial : std::min(norm(p - xy(m.from)), norm(p - xy(m.to)));
      if (near > r) continue;
      if constexpr (Edge::kMeasures) {
        const std::size_t cell = k.grid.index(ix, iy);
        const double stands = k.grid.stock[cell];
        if (stands > m.to.z + o.height(near)) {
          const double away = norm(q);
          k.chip(ix, iy, stands - m.to.z, stands - std::max(m.to.z + o.height(near), k.grid.base[cell]),
                 [&](double rho) {
                   // The triangle of the arc's centre, the axis and the point: the axis is `early` before it.
                   if (away < 1e-9 || ra < 1e-9) return -1.0;
                   const double c = (away * away + ra * ra - rho * rho) / (2.0 * away * ra);
                   if (c >= 1.0 || c <= -1.0) return -1.0;
                   const double early = std::acos(c);
                   const double met = ahead - early;
                   if (met < -kMetMm / ra || met > sweep) return -1.0;
                   // Way and direction to the point at that time: away sin(early) / rho.
                   return std::min(1.0, away * std::sin(early) / rho);
                 });
        }
      }
      k.at(ix, iy, m.to.z, m.to.z + o.height(near), near);
    }
  }
}

}  // namespace

Bite cut(Grid& grid, const Move& m, const CutterProfile& cutter, double allowed_mm, const GougeJudge* judge,
         double advance_mm, double head_mm) {
  Bite bite;
  if (m.kind == model::MoveKind::kDwell) return bite;
  if (std::min(m.from.z, m.to.z) >= grid.top()) return bite;
  grid.begin_move();
  const Outline o(cutter);
  Knife k{grid, allowed_mm, judge, bite, o.middle(), o.radius - 2.0 * kChordMm, o, advance_mm, head_mm};
  if (!is_arc(m.kind)) {
    cut_line(k, o, m.from, m.to);
  } else if (std::abs(m.from.z - m.to.z) < 1e-9) {
    cut_level_arc(k, o, m);
  } else {
    const int n = pieces_of(m, kChordMm);
    Vec3 a = m.from;
    for (int i = 1; i <= n; ++i) {
      const Vec3 b = point_of(m, static_cast<double>(i) / n);
      cut_line(k, o, a, b);
      a = b;
    }
  }
  return bite;
}

void lower(Grid& grid, const Move& m, const CutterProfile& cutter) {
  if (m.kind == model::MoveKind::kDwell || std::min(m.from.z, m.to.z) >= grid.top()) return;
  const Outline o(cutter);
  Plane k{grid};
  if (!is_arc(m.kind)) return cut_line(k, o, m.from, m.to);
  if (std::abs(m.from.z - m.to.z) < 1e-9) return cut_level_arc(k, o, m);
  // The lowest piece first: most cells below the others are then lower than they.
  const int n = pieces_of(m, kChordMm);
  const bool falls = m.to.z < m.from.z;
  for (int i = 0; i < n; ++i) {
    const int piece = falls ? n - 1 - i : i;
    cut_line(k, o, piece == 0 ? m.from : point_of(m, static_cast<double>(piece) / n),
             point_of(m, static_cast<double>(piece + 1) / n));
  }
}

double rapid_collision(const Grid& grid, const Move& m, const CutterProfile& cutter, double clearance_mm,
                       Vec2& at) {
  constexpr double kGrazing = 0.01;  // mm: a wall the cutter has just made is not hit by leaving it
  const double zmin = std::min(m.from.z, m.to.z);
  const bool vertical = norm(xy(m.to) - xy(m.from)) < 1e-9;
  if (vertical && m.to.z >= m.from.z) return 0.0;
  if (zmin >= grid.top() + clearance_mm) return 0.0;
  const Outline o(cutter);
  const double r = std::max(0.0, o.radius - kGrazing);
  const double xa = std::min(m.from.x, m.to.x), xb = std::max(m.from.x, m.to.x);
  const double ya = std::min(m.from.y, m.to.y), yb = std::max(m.from.y, m.to.y);
  double worst = 0.0;
  const auto [y0, y1] = grid.rows(ya - r, yb + r);
  for (int iy = y0; iy < y1; ++iy) {
    const double y = grid.centre(0, iy).y;
    const double dy = y - std::clamp(y, ya, yb);
    const double half = std::sqrt(std::max(0.0, r * r - dy * dy));
    const auto [x0, x1] = grid.columns(xa - half, xb + half);
    for (int ix = x0; ix < x1; ++ix) {
      const double s = grid.stock[grid.index(ix, iy)];
      if (s + clearance_mm <= zmin) continue;
      const double x = grid.centre(ix, iy).x;
      // A point may stand anywhere in the cell: the tip of a cone is taken as that much nearer.
      const double d = std::hypot(x - std::clamp(x, xa, xb), dy);
      const double z = zmin + o.height(std::max(0.0, d - 0.71 * grid.cell()));
      const double dip = s + clearance_mm - z;
      if (dip > worst) {
        worst = dip;
        at = grid.centre(ix, iy);
      }
    }
  }
  return worst;
}

}  // namespace capstan::verify
