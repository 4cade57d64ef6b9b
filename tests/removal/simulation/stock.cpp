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
  return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
}

}  // namespace

// A straight piece of a motion, with what all its columns share.
struct Stock::Piece {
  const Motion* motion;
  const CutterBody* body;
  StepRemoval* record;
  Point a, b;  ///< set-up coordinates; heights between them are all swept
  double z_lo, z_hi;
  std::array<int, 3> axis;        ///< workpiece axis of each of the set-up's, from 0
  std::array<double, 3> first, d;  ///< along the set-up's axes: that of lattice index 0, and the step
};

Stock::Stock(Box block, double cell, double cell_z) : lo_(block.lo), cell_{cell, cell, cell_z} {
  for (int k = 0; k < 3; ++k) {
    const double size = component(block.hi, k) - component(block.lo, k);
    const auto u = static_cast<std::size_t>(k);
    n_[u] = std::max(1, static_cast<int>(std::lround(size / cell_[u])));
    cell_[u] = size / n_[u];
  }
  by_.assign(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) *
                 static_cast<std::size_t>(n_[2]),
             kPresent);
}

Point Stock::at(int x, int y, int z) const {
  return {lo_.x + (x + 0.5) * cell_[0], lo_.y + (y + 0.5) * cell_[1], lo_.z + (z + 0.5) * cell_[2]};
}

void Stock::sweep(const Motion& m, const CutterBody& body, const Frame& frame, StepRemoval& record) {
  Piece p{&m, &body, &record, m.from, m.to, 0.0, 0.0, {}, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const int w = std::abs(frame.axis[k]) - 1;
    const double sign = frame.axis[k] > 0 ? 1.0 : -1.0;
    p.axis[k] = w;
    p.first[k] = sign * (component(lo_, w) + 0.5 * cell_[static_cast<std::size_t>(w)] -
                         component(frame.origin, w));
    p.d[k] = sign * cell_[static_cast<std::size_t>(w)];
  }
  const auto piece = [&](const Point& a, const Point& b) {
    p.a = a;
    p.b = b;
    p.z_lo = std::min(a.z, b.z);
    p.z_hi = std::max(a.z, b.z);
    capsule(p);
  };
  if (m.arc) {
    const double r = std::hypot(m.from.x - m.centre_x, m.from.y - m.centre_y);
    const double a0 = std::atan2(m.from.y - m.centre_y, m.from.x - m.centre_x);
    const double most = 2.0 * std::acos(std::max(0.0, 1.0 - kChordError / std::max(r, kChordError)));
    const double height = std::abs(m.to.z - m.from.z);
    const int count = std::max(
        {1, static_cast<int>(std::ceil(std::abs(m.sweep_rad) / std::max(most, 1e-3))),
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
  const double across = std::hypot(m.to.x - m.from.x, m.to.y - m.from.y);
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
  // The lattice's top and bottom along the tool.
  const auto wz = static_cast<std::size_t>(p.axis[2]);
  const double end = p.first[2] + p.d[2] * (n_[wz] - 1);
  if (p.z_lo > std::max(p.first[2], end) + cell_[wz]) return;
  const double less = p.motion->rapid ? kClear : 0.0;
  const double shank_less = kClear;
  const double reach = std::max(p.body->radius() - less, p.body->shank_radius() - shank_less);
  std::array<int, 2> lo{}, hi{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double a = component(p.a, static_cast<int>(k)), b = component(p.b, static_cast<int>(k));
    double from = (std::min(a, b) - reach - p.first[k]) / p.d[k];
    double to = (std::max(a, b) + reach - p.first[k]) / p.d[k];
    if (from > to) std::swap(from, to);
    const int count = n_[static_cast<std::size_t>(p.axis[k])];
    if (to < 0.0 || from > count - 1) return;
    lo[k] = static_cast<int>(std::ceil(std::max(from, 0.0)));
    hi[k] = static_cast<int>(std::floor(std::min(to, count - 1.0)));
  }
  for (int j = lo[1]; j <= hi[1]; ++j) {
    const double y = p.first[1] + j * p.d[1];
    for (int i = lo[0]; i <= hi[0]; ++i) {
      const double r = distance(p.first[0] + i * p.d[0], y, p.a, p.b);
      const CutterBody::Span edges = p.body->edges_at(r + less);
      if (!edges.empty()) cut(p, {i, j}, p.z_lo + edges.lo + less, p.z_hi + edges.hi, false);
      const CutterBody::Span shank = p.body->shank_at(r + shank_less);
      if (!shank.empty()) cut(p, {i, j}, p.z_lo + shank.lo + shank_less, p.z_hi + shank.hi, true);
    }
  }
}

void Stock::cut(const Piece& p, const std::array<int, 2>& column, double lo, double hi, bool shank) {
  const auto wz = static_cast<std::size_t>(p.axis[2]);
  double from = (lo - p.first[2]) / p.d[2], to = (hi - p.first[2]) / p.d[2];
  if (from > to) std::swap(from, to);
  const int k0 = static_cast<int>(std::ceil(std::max(from, 0.0)));
  const int k1 = static_cast<int>(std::floor(std::min(to, n_[wz] - 1.0)));
  if (k1 < k0) return;
  std::array<int, 3> at{};
  at[static_cast<std::size_t>(p.axis[0])] = column[0];
  at[static_cast<std::size_t>(p.axis[1])] = column[1];
  at[wz] = k0;
  const std::size_t stride = wz == 2   ? 1
                             : wz == 0 ? static_cast<std::size_t>(n_[2])
                                       : static_cast<std::size_t>(n_[2]) * static_cast<std::size_t>(n_[0]);
  std::size_t where = index(at[0], at[1], at[2]);
  for (int k = k0; k <= k1; ++k, where += stride) {
    if (by_[where] != kPresent) continue;
    by_[where] = static_cast<std::uint16_t>(p.motion->step);
    StepRemoval& r = *p.record;
    ++r.points;
    if (!shank && !p.motion->rapid) continue;
    at[wz] = k;
    const Point place = this->at(at[0], at[1], at[2]);
    if (p.motion->rapid && r.by_rapid++ == 0) r.rapid_at = place;
    if (shank && r.by_shank++ == 0) r.shank_at = place;
  }
}

}  // namespace capstan::testing::removal
