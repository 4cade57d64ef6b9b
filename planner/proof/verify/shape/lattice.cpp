#include "planner/proof/verify/shape/lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::verify {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// Points of the lattice, about. Default, unsourced: a compromise of time and resolution.
constexpr double kPoints = 250'000.0;

/// How far a point is from a triangle.
double distance(Vec3 p, const std::array<Vec3, 3>& t) {
  // Source: Ericson, Real-Time Collision Detection (2005), 5.1.5.
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return norm(ap);
  const Vec3 bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return norm(ap - (d1 / (d1 - d3)) * ab);
  const Vec3 cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return norm(ap - (d2 / (d2 - d6)) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6)
    return norm(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
  const double all = va + vb + vc;
  return all == 0.0 ? norm(ap) : norm(ap - (vb / all) * ab - (vc / all) * ac);
}

/// How far a point is from the mesh, if that is less than `most`.
double distance(const geometry::Mesh& mesh, Vec3 p, double most) {
  double least = most;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners(mesh, i);
    bool far = false;
    for (double Vec3::*k : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      far = far || std::min({t[0].*k, t[1].*k, t[2].*k}) - p.*k > least ||
            p.*k - std::max({t[0].*k, t[1].*k, t[2].*k}) > least;
    }
    if (!far) least = std::min(least, distance(p, t));
  }
  return least;
}

}  // namespace

Lattice lattice_over(const geometry::Box3& raw) {
  Lattice out;
  const Vec3 size = raw.size();
  out.step_mm = std::cbrt(size.x * size.y * size.z / kPoints);
  const std::array<double, 3> sizes{size.x, size.y, size.z};
  // Up to the sides, for what is cut off edges lies there; a little off the middle, where floors lie.
  constexpr double kBeyond = 0.1, kOffMiddle = 0.49;
  for (std::size_t k = 0; k < 3; ++k)
    out.n[k] = std::max(1, static_cast<int>(std::ceil(sizes[k] / out.step_mm - kBeyond)));
  const Vec3 covered = out.box().size();
  out.lo = raw.lo + kOffMiddle * (size - covered);
  const std::size_t all = static_cast<std::size_t>(out.n[0]) * static_cast<std::size_t>(out.n[1]) *
                          static_cast<std::size_t>(out.n[2]);
  out.asked.assign(all, 0);
  out.gone.assign(all, 0);
  return out;
}

void mark_asked(const geometry::Mesh& mesh, Lattice& lattice) {
  std::vector<std::vector<std::pair<double, int>>> columns(static_cast<std::size_t>(lattice.n[0]) *
                                                           static_cast<std::size_t>(lattice.n[1]));
  // Columns stand a little beside the points, off edges that lie on round numbers.
  const Vec2 aside{1.3e-5, 0.7e-5};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners(mesh, i);
    const double area = cross(xy(t[1] - t[0]), xy(t[2] - t[0]));
    if (area == 0.0) continue;
    const auto range = [&](double a, double b, double c, double from, int n) {
      const double lo = (std::min({a, b, c}) - from) / lattice.step_mm - 1.0;
      const double hi = (std::max({a, b, c}) - from) / lattice.step_mm + 1.0;
      return std::pair(std::max(0, static_cast<int>(lo)), std::min(n - 1, static_cast<int>(hi)));
    };
    const auto [i0, i1] = range(t[0].x, t[1].x, t[2].x, lattice.lo.x, lattice.n[0]);
    const auto [j0, j1] = range(t[0].y, t[1].y, t[2].y, lattice.lo.y, lattice.n[1]);
    for (int x = i0; x <= i1; ++x) {
      for (int y = j0; y <= j1; ++y) {
        const Vec2 p = xy(lattice.at(x, y, 0)) + aside;
        const double a = cross(xy(t[2] - t[1]), p - xy(t[1])) / area;
        const double b = cross(xy(t[0] - t[2]), p - xy(t[2])) / area;
        const double c = 1.0 - a - b;
        if (a < 0.0 || b < 0.0 || c < 0.0) continue;
        columns[lattice.column(x, y)].emplace_back(a * t[0].z + b * t[1].z + c * t[2].z, area > 0.0 ? 1 : -1);
      }
    }
  }
  for (int x = 0; x < lattice.n[0]; ++x) {
    for (int y = 0; y < lattice.n[1]; ++y) {
      for (int z = 0; z < lattice.n[2]; ++z) {
        int above = 0;
        for (const auto& [h, up] : columns[lattice.column(x, y)]) above += h > lattice.at(x, y, z).z ? up : 0;
        lattice.asked[lattice.index(x, y, z)] = above > 0 ? 1 : 0;
      }
    }
  }
}

Surface::Surface(const geometry::Mesh& mesh, const Lattice& lattice, double near_mm)
    : mesh_(mesh), lattice_(lattice), near_mm_(near_mm) {
  columns_.resize(static_cast<std::size_t>(lattice.n[0]) * static_cast<std::size_t>(lattice.n[1]));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners(mesh, i);
    const auto range = [&](double a, double b, double c, double from, int n) {
      const double lo = (std::min({a, b, c}) - near_mm - from) / lattice.step_mm;
      const double hi = (std::max({a, b, c}) + near_mm - from) / lattice.step_mm;
      return std::pair(static_cast<int>(std::clamp(std::floor(lo), 0.0, static_cast<double>(n))),
                       static_cast<int>(std::clamp(std::floor(hi), -1.0, n - 1.0)));
    };
    const auto [i0, i1] = range(t[0].x, t[1].x, t[2].x, lattice.lo.x, lattice.n[0]);
    const auto [j0, j1] = range(t[0].y, t[1].y, t[2].y, lattice.lo.y, lattice.n[1]);
    for (int x = i0; x <= i1; ++x) {
      for (int y = j0; y <= j1; ++y) columns_[lattice.column(x, y)].push_back(static_cast<std::uint32_t>(i));
    }
  }
}

bool Surface::near(int x, int y, int z) const {
  const Vec3 p = lattice_.at(x, y, z);
  const auto& column = columns_[lattice_.column(x, y)];
  return std::any_of(column.begin(), column.end(), [&](std::uint32_t i) {
    const auto t = corners(mesh_, i);
    if (std::min({t[0].z, t[1].z, t[2].z}) - p.z > near_mm_) return false;
    if (p.z - std::max({t[0].z, t[1].z, t[2].z}) > near_mm_) return false;
    return distance(p, t) < near_mm_;
  });
}

void Deepest::look_at(Vec3 p) {
  const double bound = known_ ? distance_there_ + norm(p - there_) : most_;
  if (bound <= deepest_mm_) return;
  distance_there_ = distance(mesh_, p, most_);
  there_ = p;
  known_ = true;
  if (distance_there_ <= deepest_mm_) return;
  deepest_mm_ = distance_there_;
  at_ = p;
}

}  // namespace capstan::verify
