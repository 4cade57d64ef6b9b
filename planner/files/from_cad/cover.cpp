#include "planner/files/from_cad/cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/feature.h"

namespace capstan::from_cad {
namespace {

/// Points of the lattice, about. Default, unsourced: a hundredth of a second, and a thousandth of the volume.
constexpr double kPoints = 60'000.0;
/// Layers of it across the thinnest side of the raw piece, at least. Default, unsourced.
constexpr int kLeastLayers = 4;
/// A place that lies this far within both counts as cut, mm: twice the chord of the mesh.
constexpr double kWithinMm = 0.04;
/// How far below a face of the part it is looked whether a feature reaches, mm: beyond what counts as cut and
/// the chord of the mesh. A fillet of 1 mm in chords of 0.02 mm has a middle of a triangle 34 degrees from
/// its floor, where it is 0.2 mm thick; one of 0.8 mm is surely seen.
constexpr double kBelowMm = 0.1;
/// The lattice lies askew to surfaces that stand on round numbers.
constexpr std::array<double, 3> kAskew = {0.4142, 0.5772, 0.6180};

/// Points in a box, each inside the part or not.
struct Lattice {
  Vec3 origin;
  std::array<double, 3> step_mm{};  ///< along x, y, z
  std::array<int, 3> n{};
  std::vector<bool> inside;
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(n[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n[2]) +
           static_cast<std::size_t>(k);
  }
  [[nodiscard]] Vec3 at(int i, int j, int k) const {
    return origin + Vec3{i * step_mm[0], j * step_mm[1], k * step_mm[2]};
  }
  [[nodiscard]] double each_mm3() const { return step_mm[0] * step_mm[1] * step_mm[2]; }
};

/// Where an upright line meets a triangle, and whether it looks up.
bool meets(const std::array<Vec3, 3>& t, Vec2 p, double& z, int& up) {
  const auto side = [&](const Vec3& a, const Vec3& b) { return cross(xy(b) - xy(a), p - xy(a)); };
  const double a = side(t[1], t[2]);
  const double b = side(t[2], t[0]);
  const double c = side(t[0], t[1]);
  const bool in = (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
  const double all = a + b + c;
  if (!in || all == 0.0) return false;
  z = (a * t[0].z + b * t[1].z + c * t[2].z) / all;
  up = all > 0.0 ? 1 : -1;
  return true;
}

std::array<Vec3, 3> corners(const geometry::Mesh& mesh, std::size_t i) {
  const auto& [a, b, c] = mesh.triangles[i];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// The triangles of a mesh by the place below them, so that a place is held against those over it alone.
class Over {
 public:
  explicit Over(const geometry::Mesh& mesh) : mesh_(mesh) {
    const geometry::Box3 box = geometry::bounds(mesh);
    lo_ = xy(box.lo);
    const Vec2 size = xy(box.hi) - lo_;
    side_mm_ = std::max({std::sqrt(size.x * size.y / static_cast<double>(mesh.triangles.size() + 1)),
                         size.x / kMostCells, size.y / kMostCells, 1e-6});
    nx_ = 1 + static_cast<int>(size.x / side_mm_);
    ny_ = 1 + static_cast<int>(size.y / side_mm_);
    first_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
    each_cell([&](std::size_t cell, std::size_t) { ++first_[cell + 1]; });
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    triangles_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each_cell([&](std::size_t cell, std::size_t t) { triangles_[next[cell]++] = t; });
  }

  /// Whether a place is in the solid that the mesh bounds.
  [[nodiscard]] bool inside(Vec3 p) const {
    tick();
    const int i = cell_of(p.x - lo_.x), j = cell_of(p.y - lo_.y);
    if (i < 0 || i >= nx_ || j < 0 || j >= ny_) return false;
    const std::size_t cell = index(i, j);
    int above = 0;
    for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) {
      double z = 0.0;
      int up = 0;
      if (meets(corners(mesh_, triangles_[k]), xy(p), z, up) && z > p.z) above += up;
    }
    return above > 0;
  }

 private:
  static constexpr double kMostCells = 1000.0;  // along a side; default, unsourced

  [[nodiscard]] int cell_of(double from_lo) const { return static_cast<int>(std::floor(from_lo / side_mm_)); }
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(j);
  }
  template <class F>
  void each_cell(const F& f) const {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      tick();
      const auto c = corners(mesh_, t);
      const int i0 = cell_of(std::min({c[0].x, c[1].x, c[2].x}) - lo_.x);
      const int i1 = cell_of(std::max({c[0].x, c[1].x, c[2].x}) - lo_.x);
      const int j0 = cell_of(std::min({c[0].y, c[1].y, c[2].y}) - lo_.y);
      const int j1 = cell_of(std::max({c[0].y, c[1].y, c[2].y}) - lo_.y);
      for (int i = std::max(0, i0); i <= std::min(nx_ - 1, i1); ++i)
        for (int j = std::max(0, j0); j <= std::min(ny_ - 1, j1); ++j) f(index(i, j), t);
    }
  }

  const geometry::Mesh& mesh_;
  Vec2 lo_;
  double side_mm_ = 1.0;
  int nx_ = 1, ny_ = 1;
  std::vector<std::size_t> first_, triangles_;  ///< of each cell, in the mesh's order
};

Lattice lattice_of(const Part& part, const Over& solid) {
  Lattice out;
  const Vec3 size = part.raw().size();
  const std::array<double, 3> sizes{size.x, size.y, size.z};
  // From the thinnest side on, what is left of the points is shared by the sides that are left.
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  double points = kPoints;
  double volume = size.x * size.y * size.z;
  for (std::size_t done = 0; done < 3; ++done) {
    const std::size_t k = order[done];
    const double step = std::pow(volume / points, 1.0 / static_cast<double>(3 - done));
    out.n[k] = std::max(kLeastLayers, static_cast<int>(sizes[k] / step));
    out.step_mm[k] = sizes[k] / out.n[k];
    points = std::max(1.0, points / out.n[k]);
    volume /= sizes[k];
  }
  out.origin = part.raw().lo +
               Vec3{kAskew[0] * out.step_mm[0], kAskew[1] * out.step_mm[1], kAskew[2] * out.step_mm[2]};
  out.inside.resize(static_cast<std::size_t>(out.n[0]) * static_cast<std::size_t>(out.n[1]) *
                    static_cast<std::size_t>(out.n[2]));
  for (int i = 0; i < out.n[0]; ++i) {
    for (int j = 0; j < out.n[1]; ++j) {
      for (int k = 0; k < out.n[2]; ++k) out.inside[out.index(i, j, k)] = solid.inside(out.at(i, j, k));
    }
  }
  return out;
}

/// By how many points a count in the lattice may be wrong: of the cells that the part's surface meets, each
/// is in or out by chance, so the root of their number.
double surface_error(const Part& part, const Lattice& lattice) {
  double cells = 0.0;
  const auto& [x, y, z] = lattice.step_mm;
  const exchange::Body& b = part.body();
  for (std::uint32_t f = b.first_face; f < b.first_face + b.face_count; ++f) {
    for (const Part::Spot& s : part.spots(f))
      cells += s.area_mm2 * (std::abs(s.normal.x) / (y * z) + std::abs(s.normal.y) / (x * z) +
                             std::abs(s.normal.z) / (x * y));
  }
  return std::sqrt(cells);
}

struct Shape {
  AnyRef feature;
  model::FeatureShape shape;
  geometry::Box2 box;
};

std::vector<Shape> shapes_in(const model::Model& m) {
  std::vector<Shape> out;
  const auto parts = model::parts_of_others(m);
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    if (parts.count(f) != 0) continue;
    const auto shapes = model::shapes_of(m, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    for (const model::FeatureShape& s : *shapes) {
      geometry::Box2 box = geometry::bounds(s.area);
      const Vec2 beside{s.chamfer_width_mm + s.round_radius_mm, s.chamfer_width_mm + s.round_radius_mm};
      out.push_back({f, s, {box.lo - beside, box.hi + beside}});
    }
  }
  return out;
}

/// How high above the floor of a shape a place lies; nothing: it is not above it.
bool above_floor(const Shape& s, Vec3 at, double* below_top = nullptr) {
  const Vec3 p = s.shape.frame.to_local(at);
  if (p.x < s.box.lo.x || p.x > s.box.hi.x || p.y < s.box.lo.y || p.y > s.box.hi.y) return false;
  if (below_top != nullptr) *below_top = -p.z;
  const auto floor = model::floor_at(s.shape, xy(p));
  return floor && p.z > *floor;
}

/// Whether a place and those beside it, across the shape's axis, lie above its floor and in the part.
bool cuts(const Over& solid, const Shape& s, Vec3 at) {
  for (const Vec3 d : {s.shape.frame.x, -1.0 * s.shape.frame.x, s.shape.frame.y, -1.0 * s.shape.frame.y,
                       s.shape.frame.z, -1.0 * s.shape.frame.z}) {
    const Vec3 p = at + kWithinMm * d;
    if (!above_floor(s, p) || !solid.inside(p)) return false;
  }
  return true;
}

bool cuts_at(const Over& solid, const Shape& s, Vec3 at) { return above_floor(s, at) && cuts(solid, s, at); }

}  // namespace

std::vector<Cut> cuts_into(const Part& part, const model::Model& m) {
  const Over solid(part.mesh());
  const Lattice lattice = lattice_of(part, solid);
  const std::vector<Shape> shapes = shapes_in(m);
  const double each = lattice.each_mm3();
  std::map<AnyRef, double> found;
  for (int i = 0; i < lattice.n[0]; ++i) {
    for (int j = 0; j < lattice.n[1]; ++j) {
      for (int k = 0; k < lattice.n[2]; ++k) {
        tick();
        if (!lattice.inside[lattice.index(i, j, k)]) continue;
        const Vec3 at = lattice.at(i, j, k);
        for (const Shape& s : shapes) {
          if (cuts_at(solid, s, at)) found[s.feature] += each;
        }
      }
    }
  }
  // What is thinner than the lattice's spacing: a fillet of 5 mm at the foot of an island of a part
  // of 800 mm.
  std::map<AnyRef, double> below;
  const exchange::Body& body = part.body();
  for (std::uint32_t f = body.first_face; f < body.first_face + body.face_count; ++f) {
    for (const Part::Spot& spot : part.spots(f)) {
      tick();
      for (const Shape& s : shapes) {
        double deep = 0.0;
        for (double next = kBelowMm; cuts_at(solid, s, spot.at - next * spot.normal); next *= 2.0)
          deep = next;
        if (deep > 0.0) below[s.feature] += spot.area_mm2 * deep;
      }
    }
  }
  for (const auto& [feature, volume] : below) {
    double whole = 0.0;  // a triangle that is cut at its middle is not cut all over
    for (const Shape& s : shapes)
      if (s.feature == feature) whole += geometry::area(s.shape.area) * s.shape.depth_mm;
    found[feature] = std::max(found[feature], std::min(volume, whole));
  }
  std::vector<Cut> out;
  for (const auto& [feature, volume] : found) out.push_back({feature, volume});
  return out;
}

Missing not_covered(const Part& part, const model::Model& m, bool all) {
  const Over solid(part.mesh());
  const Lattice lattice = lattice_of(part, solid);
  const std::vector<Shape> shapes = shapes_in(m);
  const double each = lattice.each_mm3();
  std::size_t points = 0;
  Vec3 sum;
  for (int i = 0; i < lattice.n[0]; ++i) {
    for (int j = 0; j < lattice.n[1]; ++j) {
      for (int k = 0; k < lattice.n[2]; ++k) {
        tick();
        if (lattice.inside[lattice.index(i, j, k)]) continue;
        const Vec3 at = lattice.at(i, j, k);
        const bool in_one = std::any_of(shapes.begin(), shapes.end(), [&](const Shape& s) {
          double depth = 0.0;
          return above_floor(s, at, &depth) && depth > -kLevelMm;
        });
        if (in_one) continue;
        // Beside a wall the chords of meshes and shapes differ.
        bool part_near = false;
        for (const Vec3 d :
             {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
          part_near = part_near || solid.inside(at + kWithinMm * d);
        }
        if (part_near) continue;
        ++points;
        sum = sum + at;
      }
    }
  }
  if (static_cast<double>(points) < (all ? 1.0 : 1.0 + surface_error(part, lattice))) return {};
  return {each * static_cast<double>(points), (1.0 / static_cast<double>(points)) * sum};
}

}  // namespace capstan::from_cad
