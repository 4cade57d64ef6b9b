#include "planner/proof/verify/sweep/target/mesh_distance.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/stopping.h"

// Triangles lie in the square bins that their boxes touch, seen from above. Those around a place are asked in
// rings, until the ring is farther away than the nearest triangle that was found.

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kTrianglesInBin = 2.0;  // on average, of triangles spread evenly; default, unsourced
/// Entries of the bins for each triangle, at most: a long triangle across the axes has many bins in its box.
/// Where there are more the bins are made wider. Default, unsourced.
constexpr double kMostEntries = 16.0;

/// The nearest place to p between a and b.
Vec3 nearest_between(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  return a + t * d;
}

}  // namespace

Vec3 nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const double n2 = dot(n, n);
  if (n2 > 0.0) {
    const Vec3 q = p - (dot(p - a, n) / n2) * n;
    const bool within = dot(cross(b - a, q - a), n) >= 0.0 && dot(cross(c - b, q - b), n) >= 0.0 &&
                        dot(cross(a - c, q - c), n) >= 0.0;
    if (within) return q;
  }
  Vec3 out = nearest_between(p, a, b);
  for (const Vec3 q : {nearest_between(p, b, c), nearest_between(p, c, a)}) {
    if (norm(q - p) < norm(out - p)) out = q;
  }
  return out;
}

MeshDistance::MeshDistance(const geometry::Mesh& mesh) : mesh_(mesh) {
  const geometry::Box3 box = geometry::bounds(mesh);
  lo_ = xy(box.lo);
  const double w = std::max(1e-3, box.hi.x - box.lo.x), h = std::max(1e-3, box.hi.y - box.lo.y);
  const auto n = static_cast<double>(std::max<std::size_t>(1, mesh.triangles.size()));
  double bin_mm = std::max({std::sqrt(w * h * kTrianglesInBin / n), 1e-3 * w, 1e-3 * h});
  struct Bins {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  };
  const auto bins_of = [&](std::uint32_t i) {
    tick();
    geometry::Box3 around;
    for (const std::uint32_t v : mesh_.triangles[i]) around.add(mesh_.vertices[v]);
    return Bins{bin(around.lo.x, lo_.x, nx_), bin(around.lo.y, lo_.y, ny_), bin(around.hi.x, lo_.x, nx_),
                bin(around.hi.y, lo_.y, ny_)};
  };
  const auto take_width = [&](double mm) {
    bin_mm_ = mm;
    nx_ = static_cast<int>(w / bin_mm_) + 1;
    ny_ = static_cast<int>(h / bin_mm_) + 1;
    double entries = 0.0;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Bins b = bins_of(i);
      entries += static_cast<double>(b.x1 - b.x0 + 1) * static_cast<double>(b.y1 - b.y0 + 1);
    }
    return entries;
  };
  // Each triangle has one entry where a bin is wider than all of the mesh: this ends.
  while (take_width(bin_mm) > kMostEntries * n) bin_mm *= 2.0;
  const auto each = [&](const auto& f) {
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Bins b = bins_of(i);
      for (int y = b.y0; y <= b.y1; ++y) {
        for (int x = b.x0; x <= b.x1; ++x)
          f(static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x), i);
      }
    }
  };
  begin_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
  each([&](std::size_t at, std::uint32_t) { ++begin_[at + 1]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  triangles_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  each([&](std::size_t at, std::uint32_t i) { triangles_[next[at]++] = i; });
}

int MeshDistance::bin(double at, double begin, int most) const {
  return std::clamp(static_cast<int>(std::floor((at - begin) / bin_mm_)), 0, most - 1);
}

MeshDistance::Nearest MeshDistance::from(Vec3 p, double within_mm) const {
  Nearest out{within_mm, p};
  const int x0 = bin(p.x, lo_.x, nx_), y0 = bin(p.y, lo_.y, ny_);
  const auto look = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= nx_ || y >= ny_) return;
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
    for (std::uint32_t k = begin_[at]; k < begin_[at + 1]; ++k) {
      tick();
      const auto& t = mesh_.triangles[triangles_[k]];
      const Vec3 q = nearest_on_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
      const double d = norm(q - p);
      if (d < out.mm) out = {d, q};
    }
  };
  // A place beside the box is in none of the bins: those of ring n are then farther away still.
  for (int n = 0; n <= std::max(nx_, ny_); ++n) {
    if ((n - 1) * bin_mm_ >= out.mm) break;
    tick();
    for (int dy = -n; dy <= n; ++dy) {
      const int stride = std::abs(dy) == n ? 1 : 2 * n;
      for (int dx = -n; dx <= n; dx += std::max(1, stride)) look(x0 + dx, y0 + dy);
    }
  }
  return out;
}

}  // namespace capstan::verify
