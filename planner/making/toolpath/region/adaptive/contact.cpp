#include "planner/making/toolpath/region/adaptive/contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// The circle is cut with the edges of the cleared ground; between two crossings it lies on one side. Edges
// stand in square cells; those near the circle are kept while it moves by less than a tenth of its radius.

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

constexpr double kSlackPart = 0.1;  // of the radius: how far a gathering holds
constexpr std::size_t kMostCells = 1U << 18U;

double distance2(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double l2 = dot(d, d);
  const double t = l2 > 0.0 ? std::clamp(dot(p - a, d) / l2, 0.0, 1.0) : 0.0;
  const Vec2 q = p - (a + t * d);
  return dot(q, q);
}

}  // namespace

ContactMeter::ContactMeter(const geometry::Region& cleared, double radius_mm) : radius_(radius_mm) {
  const auto box = geometry::bounds(cleared);
  lo_ = box.lo;
  const Vec2 size = box.hi - box.lo;
  cell_ = std::max({0.5 * radius_mm, 1e-6, std::sqrt(size.x * size.y / static_cast<double>(kMostCells))});
  columns_ = static_cast<std::size_t>(std::max(0.0, size.x / cell_)) + 1;
  rows_ = static_cast<std::size_t>(std::max(0.0, size.y / cell_)) + 1;
  cells_.resize(columns_ * rows_);
  for (const auto& loop : cleared.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Edge e{loop[i], loop[(i + 1) % loop.size()]};
      const auto index = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back(e);
      // Long edges: cell by cell of their pieces, so that a diagonal does not fill its whole box.
      const int n = std::max(1, static_cast<int>(std::ceil(norm(e.b - e.a) / cell_)));
      for (int k = 0; k < n; ++k) {
        const Vec2 a = e.a + (static_cast<double>(k) / n) * (e.b - e.a);
        const Vec2 b = e.a + (static_cast<double>(k + 1) / n) * (e.b - e.a);
        for (std::size_t y = row(std::min(a.y, b.y)); y <= row(std::max(a.y, b.y)); ++y) {
          for (std::size_t x = column(std::min(a.x, b.x)); x <= column(std::max(a.x, b.x)); ++x) {
            auto& cell = cells_[y * columns_ + x];
            if (cell.empty() || cell.back() != index) cell.push_back(index);
          }
        }
      }
    }
  }
  seen_.assign(edges_.size(), 0);
}

std::size_t ContactMeter::column(double x) const {
  return static_cast<std::size_t>(
      std::clamp(std::floor((x - lo_.x) / cell_), 0.0, static_cast<double>(columns_ - 1)));
}

std::size_t ContactMeter::row(double y) const {
  return static_cast<std::size_t>(
      std::clamp(std::floor((y - lo_.y) / cell_), 0.0, static_cast<double>(rows_ - 1)));
}

void ContactMeter::gather(Vec2 p) {
  const double slack = kSlackPart * radius_;
  if (norm(p - gathered_at_) <= slack) return;
  gathered_at_ = p;
  near_.clear();
  ++gathering_;
  const double far = radius_ + slack;
  const double close = radius_ - slack;
  for (std::size_t y = row(p.y - far); y <= row(p.y + far); ++y) {
    for (std::size_t x = column(p.x - far); x <= column(p.x + far); ++x) {
      for (const std::uint32_t i : cells_[y * columns_ + x]) {
        if (seen_[i] == gathering_) continue;
        seen_[i] = gathering_;
        const Edge& e = edges_[i];
        if (distance2(p, e.a, e.b) > far * far) continue;
        const Vec2 a = e.a - p;
        const Vec2 b = e.b - p;
        if (std::max(dot(a, a), dot(b, b)) < close * close) continue;
        near_.push_back(e);
      }
    }
  }
}

void ContactMeter::take_visited(Vec2 p, Vec2 direction) {
  for (const Vec2 c : visited_) {
    if (spans_.empty()) return;
    const Vec2 to = c - p;
    const double d2 = dot(to, to);
    if (d2 < 1e-18 || d2 >= 4.0 * radius_ * radius_) continue;
    const double d = std::sqrt(d2);
    const double half = std::acos(0.5 * d / radius_);
    const double middle = std::atan2(cross(direction, to), dot(direction, to));
    for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi}) {
      const double from = middle - half + turn;
      const double till = middle + half + turn;
      for (std::size_t i = spans_.size(); i-- > 0;) {
        const Span s = spans_[i];
        if (till <= s.from || from >= s.to) continue;
        spans_.erase(spans_.begin() + static_cast<std::ptrdiff_t>(i));
        if (s.from < from) spans_.push_back({s.from, from});
        if (till < s.to) spans_.push_back({till, s.to});
      }
    }
  }
}

double ContactMeter::arc(Vec2 p, Vec2 direction) {
  gather(p);
  crossings_.clear();
  for (const Edge& e : near_) {
    const Vec2 a = e.a - p;
    const Vec2 d = e.b - e.a;
    const double dd = dot(d, d);
    if (dd == 0.0) continue;
    const double ad = dot(a, d);
    const double root = ad * ad - dd * (dot(a, a) - radius_ * radius_);
    if (root <= 0.0) continue;
    const double s = std::sqrt(root);
    for (const double sign : {-1.0, 1.0}) {
      const double t = (-ad + sign * s) / dd;
      if (t < 0.0 || t >= 1.0) continue;
      const Vec2 q = a + t * d;
      // Cleared ground lies left of the edge; the first crossing leads into the circle along the edge.
      const Vec2 round{-q.y, q.x};
      crossings_.push_back({std::atan2(cross(direction, q), dot(direction, q)), cross(d, round) > 0.0});
    }
  }
  if (crossings_.empty()) return 0.0;
  std::sort(crossings_.begin(), crossings_.end(),
            [](const Crossing& a, const Crossing& b) { return a.angle < b.angle; });
  spans_.clear();
  double from = -std::numbers::pi;
  bool on_cleared = !crossings_.front().into;
  const auto close = [&](double to) {
    const double lo = std::max(from, -0.5 * std::numbers::pi);
    const double hi = std::min(to, 0.5 * std::numbers::pi);
    if (!on_cleared && hi > lo) spans_.push_back({lo, hi});
  };
  for (const Crossing& c : crossings_) {
    close(c.angle);
    from = c.angle;
    on_cleared = c.into;
  }
  close(std::numbers::pi);
  if (!visited_.empty()) take_visited(p, direction);
  double sum = 0.0;
  for (const Span& s : spans_) sum += s.to - s.from;
  return sum;
}

bool ContactMeter::touches(Vec2 p, double radius_mm) {
  for (std::size_t y = row(p.y - radius_mm); y <= row(p.y + radius_mm); ++y) {
    for (std::size_t x = column(p.x - radius_mm); x <= column(p.x + radius_mm); ++x) {
      for (const std::uint32_t i : cells_[y * columns_ + x]) {
        if (distance2(p, edges_[i].a, edges_[i].b) < radius_mm * radius_mm) return true;
      }
    }
  }
  return false;
}

}  // namespace capstan::toolpath
