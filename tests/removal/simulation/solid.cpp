#include "tests/removal/simulation/solid.h"

#include <limits>
#include <utility>

namespace capstan::testing::removal {
namespace {

double to_segment(double x, double y, std::pair<double, double> a, std::pair<double, double> b) {
  const double dx = b.first - a.first, dy = b.second - a.second;
  const double l2 = dx * dx + dy * dy;
  const double t = l2 > 0.0 ? std::clamp(((x - a.first) * dx + (y - a.second) * dy) / l2, 0.0, 1.0) : 0.0;
  return length(x - a.first - t * dx, y - a.second - t * dy);
}

}  // namespace

Depth2 rectangle(double x0, double y0, double x1, double y1) {
  return [=](double x, double y) { return std::min(std::min(x - x0, x1 - x), std::min(y - y0, y1 - y)); };
}

Depth2 rounded_rectangle(double x0, double y0, double x1, double y1, double radius) {
  const double cx = 0.5 * (x0 + x1), cy = 0.5 * (y0 + y1);
  const double hx = 0.5 * (x1 - x0) - radius, hy = 0.5 * (y1 - y0) - radius;
  return [=](double x, double y) {
    const double dx = std::abs(x - cx) - hx, dy = std::abs(y - cy) - hy;
    return radius - length(std::max(dx, 0.0), std::max(dy, 0.0)) - std::min(std::max(dx, dy), 0.0);
  };
}

Depth2 disc(double cx, double cy, double radius) {
  return [=](double x, double y) { return radius - length(x - cx, y - cy); };
}

Depth2 polygon(std::vector<std::pair<double, double>> points) {
  return [points = std::move(points)](double x, double y) {
    double nearest = std::numeric_limits<double>::max();
    bool inside = false;
    for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
      const auto& a = points[i];
      const auto& b = points[j];
      nearest = std::min(nearest, to_segment(x, y, a, b));
      if ((a.second > y) != (b.second > y) &&
          x < (b.first - a.first) * (y - a.second) / (b.second - a.second) + a.first)
        inside = !inside;
    }
    return inside ? nearest : -nearest;
  };
}

Depth2 stroke(std::vector<std::pair<double, double>> points, double width) {
  return [points = std::move(points), width](double x, double y) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      nearest = std::min(nearest, to_segment(x, y, points[i], points[i + 1]));
    return 0.5 * width - nearest;
  };
}

Depth2 both(Depth2 a, Depth2 b) {
  return [a = std::move(a), b = std::move(b)](double x, double y) { return std::min(a(x, y), b(x, y)); };
}

Depth2 without(Depth2 a, Depth2 b) {
  return [a = std::move(a), b = std::move(b)](double x, double y) { return std::min(a(x, y), -b(x, y)); };
}

Depth box(Point lo, Point hi) { return prism(rectangle(lo.x, lo.y, hi.x, hi.y), lo.z, hi.z); }

Depth prism(Depth2 base, double z0, double z1) {
  return [base = std::move(base), z0, z1](const Point& p) {
    const double h = std::min(p.z - z0, z1 - p.z);
    return std::min(h, base(p.x, p.y));
  };
}

Depth along(Point from, Point to, Depth2 section) {
  const double whole = length(to.x - from.x, to.y - from.y);
  const double ux = (to.x - from.x) / whole, uy = (to.y - from.y) / whole;
  return [=, section = std::move(section)](const Point& p) {
    const double s = (p.x - from.x) * ux + (p.y - from.y) * uy;
    const double across = (p.y - from.y) * ux - (p.x - from.x) * uy;
    return std::min(std::min(s, whole - s), section(across, p.z));
  };
}

Depth turned(double x, double y, Depth2 section) {
  return
      [x, y, section = std::move(section)](const Point& p) { return section(length(p.x - x, p.y - y), p.z); };
}

Depth cylinder(double x, double y, double radius, double z0, double z1) {
  return prism(disc(x, y, radius), z0, z1);
}

Depth cone(double x, double y, double z0, double r0, double z1, double r1) {
  const double slope = (r1 - r0) / (z1 - z0);
  const double norm = length(1.0, slope);
  return [=](const Point& p) {
    const double side = (r0 + slope * (p.z - z0) - length(p.x - x, p.y - y)) / norm;
    return std::min(side, std::min(p.z - z0, z1 - p.z));
  };
}

Depth sphere(Point centre, double radius) {
  return [=](const Point& p) { return radius - length(p.x - centre.x, p.y - centre.y, p.z - centre.z); };
}

Depth both(Depth a, Depth b) {
  return [a = std::move(a), b = std::move(b)](const Point& p) { return std::min(a(p), b(p)); };
}

Depth either(std::vector<Depth> all) {
  return [all = std::move(all)](const Point& p) {
    double most = -std::numeric_limits<double>::max();
    for (const Depth& d : all) most = std::max(most, d(p));
    return most;
  };
}

Depth without(Depth a, Depth b) {
  return [a = std::move(a), b = std::move(b)](const Point& p) { return std::min(a(p), -b(p)); };
}

Depth grown(Depth a, double d) {
  return [a = std::move(a), d](const Point& p) { return a(p) + d; };
}

Depth moved(Depth a, double dx, double dy, double dz) {
  return [=, a = std::move(a)](const Point& p) { return a({p.x - dx, p.y - dy, p.z - dz}); };
}

Depth rotated(Depth a, double x, double y, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return [=, a = std::move(a)](const Point& p) {
    const double dx = p.x - x, dy = p.y - y;
    return a({x + c * dx + s * dy, y - s * dx + c * dy, p.z});
  };
}

void Target::cut(Depth least, Depth most) {
  least_.push_back(std::move(least));
  most_.push_back(std::move(most));
}

double Target::stays(const Point& p) const {
  double d = body_(p);
  for (const Depth& hollow : most_) d = std::min(d, -hollow(p));
  return d;
}

double Target::goes(const Point& p) const {
  double d = -body_(p);
  for (const Depth& hollow : least_) d = std::max(d, hollow(p));
  return d;
}

}  // namespace capstan::testing::removal
