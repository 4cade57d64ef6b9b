#include "planner/making/piece/mesh/mesh_heights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/mesh_form.h"

namespace capstan::piece {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kAcross = 200.0;  // cells along the longer side; default, unsourced

/// Of each number of a row the highest within n to either side.
/// Source  van Herk: maxima from the left and from the right of blocks as long as the window.
std::vector<double> highest_within(const std::vector<double>& row, std::size_t n) {
  const std::size_t window = 2 * n + 1;
  const std::size_t size = (row.size() + 2 * n + window - 1) / window * window;
  std::vector<double> from_left(size, MeshHeights::kNone);
  std::copy(row.begin(), row.end(), from_left.begin() + static_cast<std::ptrdiff_t>(n));
  std::vector<double> from_right = from_left;
  for (std::size_t i = 1; i < size; ++i)
    if (i % window != 0) from_left[i] = std::max(from_left[i], from_left[i - 1]);
  for (std::size_t i = size - 1; i-- > 0;)
    if (i % window != window - 1) from_right[i] = std::max(from_right[i], from_right[i + 1]);
  std::vector<double> out(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) out[i] = std::max(from_right[i], from_left[i + window - 1]);
  return out;
}

}  // namespace

MeshHeights heights_of(const geometry::Mesh& mesh, double sign) {
  const geometry::Box3 box = geometry::bounds(mesh);
  const double w = box.hi.x - box.lo.x, h = box.hi.y - box.lo.y;
  MeshHeights m;
  m.lo = xy(box.lo);
  m.cell = std::max({w, h, 1e-3}) / kAcross;
  m.nx = static_cast<int>(w / m.cell) + 1;
  m.ny = static_cast<int>(h / m.cell) + 1;
  m.z.assign(static_cast<std::size_t>(m.nx) * static_cast<std::size_t>(m.ny), MeshHeights::kNone);
  const auto cells = [&](double from, double to, double begin, int n) {
    const auto i = [&](double v) { return std::clamp((v - begin) / m.cell - 0.5, 0.0, n - 1.0); };
    return std::pair(static_cast<int>(std::floor(i(from))), static_cast<int>(std::ceil(i(to))));
  };
  for (const auto& t : mesh.triangles) {
    tick();
    const Vec3 a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    const Vec3 n = cross(ab, ac);
    if (!(sign * n.z > 1e-9 * norm(n))) continue;
    const auto [x0, x1] =
        cells(a.x + std::min({0.0, ab.x, ac.x}), a.x + std::max({0.0, ab.x, ac.x}), m.lo.x, m.nx);
    const auto [y0, y1] =
        cells(a.y + std::min({0.0, ab.y, ac.y}), a.y + std::max({0.0, ab.y, ac.y}), m.lo.y, m.ny);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 q{m.lo.x + (x + 0.5) * m.cell - a.x, m.lo.y + (y + 0.5) * m.cell - a.y};
        const double v = (q.x * ac.y - q.y * ac.x) / n.z, u = (ab.x * q.y - ab.y * q.x) / n.z;
        if (v < -1e-9 || u < -1e-9 || u + v > 1.0 + 1e-9) continue;
        double& z =
            m.z[static_cast<std::size_t>(y) * static_cast<std::size_t>(m.nx) + static_cast<std::size_t>(x)];
        z = std::max(z, a.z + v * ab.z + u * ac.z);
      }
    }
  }
  return m;
}

double depth_beside(const geometry::Mesh& mesh, double radius_mm) {
  if (mesh.triangles.empty()) return 0.0;
  const geometry::MeshForm form = geometry::form_of(mesh);
  const MeshHeights m = heights_of(mesh, form.inside_out || form.faces_down ? -1.0 : 1.0);
  std::vector<double> highest(m.z.size(), MeshHeights::kNone);
  std::vector<double> row(static_cast<std::size_t>(m.nx));
  const int reach = static_cast<int>(std::min(radius_mm / m.cell, static_cast<double>(m.ny)));
  const auto begin = [&](int y) { return static_cast<std::ptrdiff_t>(y) * m.nx; };
  for (int y = 0; y < m.ny; ++y) {
    poll();
    std::copy_n(m.z.begin() + begin(y), m.nx, row.begin());
    for (int dy = -reach; dy <= reach; ++dy) {
      if (y + dy < 0 || y + dy >= m.ny) continue;
      const double aside = m.cell * dy;
      const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - aside * aside));
      const std::vector<double> best =
          highest_within(row, static_cast<std::size_t>(std::min(half / m.cell, static_cast<double>(m.nx))));
      for (int x = 0; x < m.nx; ++x) {
        double& z = highest[static_cast<std::size_t>(begin(y + dy) + x)];
        z = std::max(z, best[static_cast<std::size_t>(x)]);
      }
    }
  }
  double out = 0.0;
  for (std::size_t i = 0; i < m.z.size(); ++i) {
    if (m.z[i] > MeshHeights::kNone) out = std::max(out, highest[i] - m.z[i]);
  }
  return out;
}

}  // namespace capstan::piece
