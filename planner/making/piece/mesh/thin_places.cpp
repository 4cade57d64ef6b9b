#include "planner/making/piece/mesh/thin_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/mesh_form.h"

// Walls: from points of each steep triangle a level ray goes into the material; where it comes out is the
// wall's thickness, and what stands above the middle of it is the wall's height. A part that is cut from
// above is nowhere thicker above than below, so that the thickness is the greatest over that height. Beside
// that point, along the wall, the material must be as thin or end: a sharp edge of a thick block is no thin
// wall. Floors: a map of heights, and around each of its points the circle in which nothing is thicker.

namespace capstan::piece {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kLeastWall = 5.0, kLeastFloor = 10.0;  // ratios; less is not looked for; default, unsourced
/// Of unit normals: a wall at least five times as high as it is thick leans by less. Derived: atan(1 / 5).
constexpr double kSteepNormal = 0.2;
constexpr double kBeside = 1.0 / 8.0;  // of the height: how far aside a wall is held; default, unsourced
constexpr double kStiffer = 1.5;  // times as thick is what holds it: 3.4 times as stiff; default, unsourced
constexpr double kThinBefore = 0.5;      // of the raw piece's height; default, unsourced
constexpr double kSamplesAcross = 64.0;  // of the box's diagonal; default, unsourced
constexpr double kMapAcross = 200.0;     // cells along the longer side; default, unsourced
constexpr double kSelfMm = 1e-4;         // a ray begins on its own triangle; rounding of coordinates

/// Triangles by the squares of a grid that their boxes touch, seen from above.
class Bins {
 public:
  Bins(const geometry::Mesh& mesh, double sign) : mesh_(mesh), sign_(sign) {
    const geometry::Box3 box = geometry::bounds(mesh);
    lo_ = xy(box.lo);
    const double w = box.hi.x - box.lo.x, h = box.hi.y - box.lo.y;
    const double n = std::clamp(std::sqrt(static_cast<double>(mesh.triangles.size())), 8.0, 500.0);
    side_ = std::max({w, h, 1e-3}) / n;
    nx_ = static_cast<std::size_t>(w / side_) + 1;
    ny_ = static_cast<std::size_t>(h / side_) + 1;
    of_.resize(nx_ * ny_);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      tick();
      geometry::Box3 b;
      for (const std::uint32_t v : mesh.triangles[i]) b.add(mesh.vertices[v]);
      for (std::size_t y = row(b.lo.y); y <= row(b.hi.y); ++y) {
        for (std::size_t x = column(b.lo.x); x <= column(b.hi.x); ++x) of_[y * nx_ + x].push_back(i);
      }
    }
  }

  struct Hit {
    double mm = 0.0;
    bool out = false;  ///< the ray leaves the material there
  };
  /// The first triangle that a ray of unit direction d meets within `reach`.
  [[nodiscard]] std::optional<Hit> first(Vec3 p, Vec3 d, double reach) const {
    std::optional<Hit> found;
    const Vec3 end = p + reach * d;
    for (std::size_t y = row(std::min(p.y, end.y)); y <= row(std::max(p.y, end.y)); ++y) {
      for (std::size_t x = column(std::min(p.x, end.x)); x <= column(std::max(p.x, end.x)); ++x) {
        for (const std::uint32_t i : of_[y * nx_ + x]) {
          tick();
          const auto& t = mesh_.triangles[i];
          const Vec3 a = mesh_.vertices[t[0]], ab = mesh_.vertices[t[1]] - a, ac = mesh_.vertices[t[2]] - a;
          const Vec3 n = cross(ab, ac);
          const double along = dot(n, d);
          if (std::abs(along) <= 1e-9 * norm(n)) continue;
          const double mm = dot(n, a - p) / along;
          if (mm < kSelfMm || mm > (found ? found->mm : reach)) continue;
          const Vec3 q = p + mm * d - a;
          const double n2 = dot(n, n), v = dot(cross(q, ac), n) / n2, w = dot(cross(ab, q), n) / n2;
          if (v < -1e-9 || w < -1e-9 || v + w > 1.0 + 1e-9) continue;
          found = Hit{mm, sign_ * along > 0.0};
        }
      }
    }
    return found;
  }

 private:
  [[nodiscard]] static std::size_t at(double v, double side, std::size_t n) {
    return static_cast<std::size_t>(std::clamp(v / side, 0.0, static_cast<double>(n - 1)));
  }
  [[nodiscard]] std::size_t column(double x) const { return at(x - lo_.x, side_, nx_); }
  [[nodiscard]] std::size_t row(double y) const { return at(y - lo_.y, side_, ny_); }

  const geometry::Mesh& mesh_;
  double sign_, side_ = 1.0;
  Vec2 lo_;
  std::size_t nx_ = 1, ny_ = 1;
  std::vector<std::vector<std::uint32_t>> of_;
};

constexpr Vec3 kUp{0.0, 0.0, 1.0};

class WallSearch {
 public:
  WallSearch(const geometry::Mesh& mesh, double sign) : bins_(mesh, sign), box_(geometry::bounds(mesh)) {}

  /// A point of the surface, and the level direction into the material there.
  void look(Vec3 p, Vec3 into) {
    const double reach = (box_.hi.z - p.z) / (best_ ? best_->ratio() : kLeastWall);
    if (reach <= kSelfMm) return;
    const auto out = bins_.first(p, into, reach);
    if (!out || !out->out) return;
    const Vec3 middle = p + 0.5 * out->mm * into;
    const auto top = bins_.first(middle, kUp, box_.hi.z - p.z + 1.0);
    if (!top || !top->out) return;
    const ThinPlace here{out->mm, top->mm, middle};
    if (here.ratio() < kLeastWall || (best_ && here.ratio() <= best_->ratio())) return;
    const Vec3 along = (kBeside * here.extent_mm) * Vec3{-into.y, into.x, 0.0};
    if (stiffer(middle + along, into, out->mm) || stiffer(middle - along, into, out->mm)) return;
    best_ = here;
  }
  [[nodiscard]] std::optional<ThinPlace> best() const { return best_; }

 private:
  /// Whether material stands at q that is thicker than a wall.
  [[nodiscard]] bool stiffer(Vec3 q, Vec3 across, double thickness_mm) const {
    const auto top = bins_.first(q, kUp, box_.hi.z - q.z + 1.0);
    if (!top || !top->out) return false;
    const double most = kStiffer * thickness_mm;
    const auto there = bins_.first(q, across, most), back = bins_.first(q, -1.0 * across, most);
    return !there || !back || there->mm + back->mm > most;
  }

  Bins bins_;
  geometry::Box3 box_;
  std::optional<ThinPlace> best_;
};

std::optional<ThinPlace> thin_wall(const geometry::Mesh& mesh, double sign) {
  const geometry::Box3 box = geometry::bounds(mesh);
  const double spacing = norm(box.hi - box.lo) / kSamplesAcross;
  std::optional<WallSearch> search;
  for (const auto& t : mesh.triangles) {
    tick();
    const Vec3 a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    const Vec3 n = sign * cross(ab, ac);
    if (!(norm(n) > 0.0) || std::abs(n.z) > kSteepNormal * norm(n)) continue;
    if (!search) search.emplace(mesh, sign);
    const Vec3 into = (-1.0 / std::hypot(n.x, n.y)) * Vec3{n.x, n.y, 0.0};
    const double longest = std::max({norm(ab), norm(ac), norm(ac - ab)});
    const int parts = std::clamp(static_cast<int>(longest / spacing) + 1, 1, 32);
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j)
        search->look(a + ((i + 1.0 / 3.0) / parts) * ab + ((j + 1.0 / 3.0) / parts) * ac, into);
    }
    if (parts == 1) continue;
    // The foot of a wall is where its height counts.
    constexpr double kNear = 0.01;
    for (const Vec3 corner : {Vec3{}, ab, ac})
      search->look(a + (1.0 - kNear) * corner + (kNear / 3.0) * (ab + ac), into);
  }
  return search ? search->best() : std::nullopt;
}

/// The heights of a mesh over the cells of a grid; nothing stands at kNone.
struct Map {
  static constexpr double kNone = -1e300;
  Vec2 lo;
  double cell = 1.0;
  int nx = 1, ny = 1;
  std::vector<double> z;
  [[nodiscard]] double at(int x, int y) const {
    if (x < 0 || y < 0 || x >= nx || y >= ny) return kNone;
    return z[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  }
};

Map map_of(const geometry::Mesh& mesh, double sign) {
  const geometry::Box3 box = geometry::bounds(mesh);
  const double w = box.hi.x - box.lo.x, h = box.hi.y - box.lo.y;
  Map m;
  m.lo = xy(box.lo);
  m.cell = std::max({w, h, 1e-3}) / kMapAcross;
  m.nx = static_cast<int>(w / m.cell) + 1;
  m.ny = static_cast<int>(h / m.cell) + 1;
  m.z.assign(static_cast<std::size_t>(m.nx) * static_cast<std::size_t>(m.ny), Map::kNone);
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

/// Radius of the circle around a cell in which all stands and nothing is higher than z, mm; 0 where it is
/// less than `least_mm`.
double circle(const Map& m, int x, int y, double z, double least_mm) {
  const auto free = [&](int i, int j) { return m.at(i, j) > Map::kNone && m.at(i, j) <= z; };
  const int least = static_cast<int>(least_mm / m.cell);
  for (const int s : {-1, 1}) {  // most are told from these
    if (!free(x + s * least, y) || !free(x, y + s * least)) return 0.0;
  }
  double r2 = 1e300;
  for (int n = 1; n * n < r2; ++n) {
    for (int dy = -n; dy <= n; ++dy) {
      const int stride = std::abs(dy) == n ? 1 : 2 * n;
      for (int dx = -n; dx <= n; dx += stride)
        if (!free(x + dx, y + dy)) r2 = std::min(r2, static_cast<double>(dx * dx + dy * dy));
    }
    if (n <= least && r2 < 1e300 && std::sqrt(r2) < least) return 0.0;
  }
  return (std::sqrt(r2) - 0.5) * m.cell;
}

std::optional<ThinPlace> thin_floor(const geometry::Mesh& mesh, double sign, const geometry::Box3& raw) {
  const geometry::Box3 box = geometry::bounds(mesh);
  const double thick = kThinBefore * (raw.hi.z - raw.lo.z);
  const double widest = std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
  const auto can_be_thin = [&](double mm) { return mm > 0.0 && mm < thick && kLeastFloor * mm < widest; };
  const auto low = [&](const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Vec3 n = cross(b - a, c - a);
    return sign * n.z > kSteepNormal * norm(n) && can_be_thin(std::min({a.z, b.z, c.z}) - raw.lo.z);
  };
  if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), low)) return std::nullopt;
  const Map m = map_of(mesh, sign);
  std::optional<ThinPlace> best;
  for (int y = 0; y < m.ny; ++y) {
    poll();
    for (int x = 0; x < m.nx; ++x) {
      const double here = m.at(x, y) - raw.lo.z;
      if (!can_be_thin(here)) continue;
      for (const double up_to : {1.1, 1.5, 2.0}) {  // of a floor that is a bowl, the middle of it
        const double mm = here * up_to;
        if (mm >= thick) break;
        const double thickness_mm = up_to > 1.1 ? mm : here;
        const double least = 0.5 * thickness_mm * (best ? best->ratio() : kLeastFloor);
        const double r = circle(m, x, y, raw.lo.z + mm, least);
        if (r <= least) continue;
        best = ThinPlace{
            thickness_mm, 2.0 * r, {m.lo.x + (x + 0.5) * m.cell, m.lo.y + (y + 0.5) * m.cell, m.at(x, y)}};
      }
    }
  }
  return best;
}

}  // namespace

ThinPlaces thin_places(const geometry::Mesh& mesh, const geometry::Box3& raw) {
  if (mesh.triangles.empty()) return {};
  const geometry::MeshForm form = geometry::form_of(mesh);
  const double sign = form.inside_out || form.faces_down ? -1.0 : 1.0;
  // What lies below a sheet is not said: its lowest place may be the underside of a raw piece that was
  // guessed.
  if (form.kind == geometry::MeshForm::Kind::kSheet) return {thin_wall(mesh, sign), std::nullopt};
  return {thin_wall(mesh, sign), thin_floor(mesh, sign, raw)};
}

}  // namespace capstan::piece
