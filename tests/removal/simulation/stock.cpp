#include "tests/removal/simulation/stock.h"

#include <cmath>

namespace capstan::testing::removal {
namespace {

constexpr double kChordError = 0.002;  // mm, arcs are swept as chords
constexpr double kSlope = 0.02;        // mm of height in one piece of a slanted motion
constexpr double kClear = 0.03;        // mm: a rapid or a shank that only touches a wall is none through it

double component(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double distance(double x, double y, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double l2 = dx * dx + dy * dy;
  const double t = l2 > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / l2, 0.0, 1.0) : 0.0;
  return length(x - a.x - t * dx, y - a.y - t * dy);
}

}  // namespace

// A straight piece of a motion, with what all its columns share.
struct Stock::Piece {
  const Motion* motion;
  const CutterBody* body;
  StepRemoval* record;
  const Frame* frame;
  Point a, b;  ///< set-up coordinates; heights between them are all swept
  double z_lo, z_hi;
  double reach;  ///< what is farther from the way than this is not touched
};

Stock::Stock(Box block, double cell, double cell_z) : lo_(block.lo), cell_{cell, cell, cell_z} {
  for (int k = 0; k < 3; ++k) {
    const double size = component(block.hi, k) - component(block.lo, k);
    const auto u = static_cast<std::size_t>(k);
    n_[u] = std::max(1, static_cast<int>(std::lround(size / cell_[u])));
    cell_[u] = size / n_[u];
  }
  by_.assign(
      static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]),
      kPresent);
  const std::size_t columns = static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]);
  top_.assign(columns, static_cast<std::uint16_t>(n_[2]));
  bottom_.assign(columns, 0);
}

// Rows and columns are shifted against each other by golden sections, so that no wall or floor, however it
// lies, falls between all of them.
Point Stock::at(int x, int y, int z) const {
  constexpr double kGolden = 0.6180339887498949, kSilver = 0.41421356237309515, kThird = 0.7548776662466927;
  const auto part = [](double v) { return v - std::floor(v); };
  return {lo_.x + (x + part(0.5 + y * kGolden)) * cell_[0], lo_.y + (y + part(0.5 + x * kSilver)) * cell_[1],
          lo_.z + (z + part(0.5 + x * kThird + y * kGolden * kThird)) * cell_[2]};
}

void Stock::sweep(const Motion& m, const CutterBody& body, const Frame& frame, StepRemoval& record) {
  const double reach = std::max(body.radius() - (m.rapid ? kClear : 0.0), body.shank_radius() - kClear);
  Piece p{&m, &body, &record, &frame, m.from, m.to, 0.0, 0.0, reach};
  const auto piece = [&](const Point& a, const Point& b) {
    p.a = a;
    p.b = b;
    p.z_lo = std::min(a.z, b.z);
    p.z_hi = std::max(a.z, b.z);
    capsule(p);
  };
  if (m.arc) {
    const double r = length(m.from.x - m.centre_x, m.from.y - m.centre_y);
    const double a0 = std::atan2(m.from.y - m.centre_y, m.from.x - m.centre_x);
    const double most = 2.0 * std::acos(std::max(0.0, 1.0 - kChordError / std::max(r, kChordError)));
    const double height = std::abs(m.to.z - m.from.z);
    const int count = std::max({1, static_cast<int>(std::ceil(std::abs(m.sweep_rad) / std::max(most, 1e-3))),
                                static_cast<int>(std::ceil(height / kSlope))});
    Point before = m.from;
    for (int i = 1; i <= count; ++i) {
      const double t = static_cast<double>(i) / count;
      Point now{m.centre_x + r * std::cos(a0 + t * m.sweep_rad),
                m.centre_y + r * std::sin(a0 + t * m.sweep_rad), m.from.z + t * (m.to.z - m.from.z)};
      if (i == count) now = m.to;
      piece(before, now);
      before = now;
    }
    return;
  }
  const double across = length(m.to.x - m.from.x, m.to.y - m.from.y);
  const double height = std::abs(m.to.z - m.from.z);
  // Above everything nothing is cut: of a long way down only what comes near the lattice counts.
  if (across < 1e-6 || height < 1e-9) return piece(m.from, m.to);
  const int count = static_cast<int>(std::ceil(height / kSlope));
  Point before = m.from;
  for (int i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    const Point now{m.from.x + t * (m.to.x - m.from.x), m.from.y + t * (m.to.y - m.from.y),
                    m.from.z + t * (m.to.z - m.from.z)};
    piece(before, now);
    before = now;
  }
}

void Stock::capsule(const Piece& p) {
  const double less = p.motion->rapid ? kClear : 0.0;
  const double reach = p.reach;
  // The box of what is swept, in lattice indices; along the tool everything above the tip.
  const std::array<double, 3> lo{std::min(p.a.x, p.b.x) - reach, std::min(p.a.y, p.b.y) - reach, p.z_lo};
  const std::array<double, 3> hi{std::max(p.a.x, p.b.x) + reach, std::max(p.a.y, p.b.y) + reach, kFarAbove};
  std::array<int, 3> from{}, to{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int w = std::abs(p.frame->axis[k]) - 1;
    const auto u = static_cast<std::size_t>(w);
    const double sign = p.frame->axis[k] > 0 ? 1.0 : -1.0;
    const double base = component(p.frame->origin, w) - component(lo_, w);
    const double a = (base + sign * lo[k]) / cell_[u], b = (base + sign * hi[k]) / cell_[u];
    if (std::max(a, b) < 0.0 || std::min(a, b) > n_[u]) return;
    // An index covers one cell, and its point lies anywhere in it.
    from[u] = static_cast<int>(std::clamp(std::floor(std::min(a, b)), 0.0, n_[u] - 1.0));
    to[u] = static_cast<int>(std::clamp(std::floor(std::max(a, b)), 0.0, n_[u] - 1.0));
  }
  for (int y = from[1]; y <= to[1]; ++y) {
    for (int x = from[0]; x <= to[0]; ++x) {
      if (std::abs(p.frame->axis[2]) == 3) {
        if (!gone_above(p, x, y)) column(p, x, y, less);
      } else {
        for (int z = from[2]; z <= to[2]; ++z) single(p, x, y, z, less);
      }
    }
  }
}

Point Stock::in(const Frame& f, const Point& w) const {
  const Point d{w.x - f.origin.x, w.y - f.origin.y, w.z - f.origin.z};
  const auto along = [&](std::size_t k) {
    return (f.axis[k] > 0 ? 1.0 : -1.0) * component(d, std::abs(f.axis[k]) - 1);
  };
  return {along(0), along(1), along(2)};
}

// A point of index k lies between k and k + 1 cells above the bottom.
bool Stock::gone_above(const Piece& p, int x, int y) {
  const std::size_t where =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(n_[0]) + static_cast<std::size_t>(x);
  std::uint16_t &top = top_[where], &bottom = bottom_[where];
  const bool up = p.frame->axis[2] > 0;
  if (up) {
    while (top > 0 && !present(x, y, top - 1)) --top;
  } else {
    while (bottom < n_[2] && !present(x, y, bottom)) ++bottom;
  }
  const double end = lo_.z + (up ? top : bottom) * cell_[2];
  return top == 0 || bottom == n_[2] || (up ? end - p.frame->origin.z : p.frame->origin.z - end) < p.z_lo;
}

// Points one above the other, along the tool.
void Stock::column(const Piece& p, int x, int y, double less) {
  const Point foot = in(*p.frame, at(x, y, 0));
  const double r = distance(foot.x, foot.y, p.a, p.b);
  const double step = p.frame->axis[2] > 0 ? cell_[2] : -cell_[2];
  const auto span = [&](double lo, double hi, bool shank) {
    double a = (lo - foot.z) / step, b = (hi - foot.z) / step;
    if (a > b) std::swap(a, b);
    const int k0 = static_cast<int>(std::ceil(std::max(a, 0.0)));
    const int k1 = static_cast<int>(std::floor(std::min(b, n_[2] - 1.0)));
    for (int k = k0; k <= k1; ++k) take(p, x, y, k, shank);
  };
  if (r > p.reach) return;
  const CutterBody::Span edges = p.body->edges_at(r + less);
  if (!edges.empty()) span(p.z_lo + edges.lo + less, p.z_hi + edges.hi, false);
  const CutterBody::Span shank = p.body->shank_at(r + kClear);
  if (!shank.empty()) span(p.z_lo + shank.lo + kClear, p.z_hi + shank.hi, true);
}

void Stock::single(const Piece& p, int x, int y, int z, double less) {
  if (!present(x, y, z)) return;
  const Point q = in(*p.frame, at(x, y, z));
  const double r = distance(q.x, q.y, p.a, p.b);
  const CutterBody::Span edges = p.body->edges_at(r + less);
  if (!edges.empty() && q.z >= p.z_lo + edges.lo + less && q.z <= p.z_hi + edges.hi)
    return take(p, x, y, z, false);
  const CutterBody::Span shank = p.body->shank_at(r + kClear);
  if (!shank.empty() && q.z >= p.z_lo + shank.lo + kClear && q.z <= p.z_hi + shank.hi) take(p, x, y, z, true);
}

void Stock::take(const Piece& p, int x, int y, int z, bool shank) {
  const std::size_t where = index(x, y, z);
  if (by_[where] != kPresent) return;
  by_[where] = static_cast<std::uint16_t>(p.motion->step);
  StepRemoval& r = *p.record;
  ++r.points;
  if (p.motion->rapid && r.by_rapid++ == 0) r.rapid_at = at(x, y, z);
  if (shank && r.by_shank++ == 0) r.shank_at = at(x, y, z);
}

}  // namespace capstan::testing::removal
