// The part that is wanted, for a view: not what the paths leave, but what the features say.
#include "planner/door/report/part.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/region.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/feature.h"

namespace capstan::report {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::FeatureShape;

/// How near a feature looks along Z of the workpiece.
constexpr double kUpright = 0.9999;

std::vector<AnyRef> features_in(const model::Plan& plan) {
  return plan.model.all_below(model::TypeId::kManufacturingFeature);
}
std::vector<FeatureShape> shapes_in(const model::Plan& plan, AnyRef feature) {
  return model::shapes_of(plan.model, model::Ref<model::ManufacturingFeature>(feature))
      .value_or(std::vector<FeatureShape>());
}

/// Heights under or over the cells of a raw piece.
class Columns {
 public:
  explicit Columns(const model::Stock& stock) : box_(stock.box) {
    if (box_.empty()) return;
    const double longer = std::max(box_.size().x, box_.size().y), cell = longer / kPartColumns;
    if (!(longer > 0.0)) return;
    out.nx = 1 + std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(box_.size().x / cell - 1e-9)));
    out.ny = 1 + std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(box_.size().y / cell - 1e-9)));
    out.top.assign(out.nx * out.ny, static_cast<float>(box_.hi.z));
    out.bottom.assign(out.nx * out.ny, static_cast<float>(box_.lo.z));
    if (!stock.cylinder_radius_mm) return;
    const Vec2 middle = 0.5 * (geometry::xy(box_.lo) + geometry::xy(box_.hi));
    each(box_.lo, box_.hi, [&](std::size_t n, Vec2 p) {
      if (geometry::norm(p - middle) > *stock.cylinder_radius_mm) out.top[n] = out.bottom[n];
    });
  }

  /// Calls f(column, place) for the columns over a box.
  template <class F>
  void each(Vec3 lo, Vec3 hi, const F& f) const {
    if (out.nx == 0) return;
    const Vec3 size = box_.size();
    const double dx = size.x / static_cast<double>(out.nx - 1), dy = size.y / static_cast<double>(out.ny - 1);
    const auto first = [](double at, double d) {
      return d > 0.0 && at > 0.0 ? static_cast<std::size_t>(std::ceil(at / d)) : std::size_t{0};
    };
    const auto end = [](double at, double d, std::size_t n) {
      return at < 0.0 ? std::size_t{0}
                      : std::min(n, d > 0.0 ? static_cast<std::size_t>(std::floor(at / d)) + 1 : n);
    };
    for (std::size_t j = first(lo.y - box_.lo.y, dy); j < end(hi.y - box_.lo.y, dy, out.ny); ++j)
      for (std::size_t i = first(lo.x - box_.lo.x, dx); i < end(hi.x - box_.lo.x, dx, out.nx); ++i)
        f(j * out.nx + i,
          Vec2{box_.lo.x + dx * static_cast<double>(i), box_.lo.y + dy * static_cast<double>(j)});
  }

  void lower(std::size_t n, double z) {
    out.top[n] = std::max(out.bottom[n], std::min(out.top[n], static_cast<float>(z)));
  }
  void raise(std::size_t n, double z) {
    out.bottom[n] = std::min(out.top[n], std::max(out.bottom[n], static_cast<float>(z)));
  }

  PartHeights out;

 private:
  geometry::Box3 box_;
};

/// Around all that a shape takes away, workpiece frame.
geometry::Box3 box_of(const FeatureShape& s) {
  geometry::Box2 b = geometry::bounds(s.area);
  // Leaning walls and the mouths of holes reach beyond the area of the bottom.
  const double more = std::max({s.slope_rad > 0.0 ? s.depth_mm * std::tan(s.slope_rad) : 0.0,
                                0.5 * s.diameter.nominal_mm, s.chamfer_width_mm, s.round_radius_mm, 0.0});
  geometry::Box3 out;
  for (const double x : {b.lo.x - more, b.hi.x + more})
    for (const double y : {b.lo.y - more, b.hi.y + more})
      for (const double z : {-s.depth_mm, 0.0}) out.add(s.frame.to_parent({x, y, z}));
  return out;
}

void cut(Columns& columns, const FeatureShape& s) {
  const bool up = s.frame.z.z > 0.0;
  const geometry::Box3 box = box_of(s);
  columns.each(box.lo, box.hi, [&](std::size_t n, Vec2 p) {
    const Vec3 local = s.frame.to_local({p.x, p.y, s.frame.origin.z});
    const auto floor = model::floor_at(s, geometry::xy(local));
    if (!floor) return;
    if (up)
      columns.lower(n, s.frame.origin.z + *floor);
    else
      columns.raise(n, s.frame.origin.z - *floor);
  });
}

/// The height of a triangle over a place; nothing beside it, or where it stands upright.
std::optional<double> height_at(Vec3 a, Vec3 b, Vec3 c, Vec2 p) {
  const Vec2 u = geometry::xy(b) - geometry::xy(a), v = geometry::xy(c) - geometry::xy(a),
             w = p - geometry::xy(a);
  const double all = geometry::cross(u, v);
  if (std::abs(all) < 1e-12) return std::nullopt;
  const double s = geometry::cross(w, v) / all, t = geometry::cross(u, w) / all;
  constexpr double kEdge = 1e-9;
  if (s < -kEdge || t < -kEdge || s + t > 1.0 + kEdge) return std::nullopt;
  return a.z + s * (b.z - a.z) + t * (c.z - a.z);
}

/// The highest and the lowest of the surface over each column. Beside a surface that has an underside is
/// nothing; a sheet says nothing of what lies beside it, or under it.
void take_mesh(Columns& columns, const geometry::Mesh& mesh) {
  const std::size_t n = columns.out.top.size();
  std::vector<double> high(n, -1e300), low(n, 1e300);
  bool closed = false;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    if (geometry::cross(b - a, c - a).z < 0.0) closed = true;
    geometry::Box3 box;
    for (const Vec3 v : {a, b, c}) box.add(v);
    columns.each(box.lo, box.hi, [&](std::size_t i, Vec2 p) {
      const auto z = height_at(a, b, c, p);
      if (!z) return;
      high[i] = std::max(high[i], *z);
      low[i] = std::min(low[i], *z);
    });
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (high[i] > -1e299) {
      columns.lower(i, high[i]);
      if (closed) columns.raise(i, low[i]);
    } else if (closed) {
      columns.out.top[i] = columns.out.bottom[i];
    }
  }
}

std::string name_of(const model::Plan& plan, AnyRef feature) {
  const auto* f = plan.model.get<model::ManufacturingFeature>(feature);
  return f == nullptr ? std::string() : f->its_id.value_or("");
}

}  // namespace

std::vector<FeatureSolids> feature_solids(const model::Plan& plan) {
  std::vector<FeatureSolids> out;
  for (const AnyRef f : features_in(plan)) {
    FeatureSolids solids{name_of(plan, f), {}};
    if (solids.id.empty()) continue;
    for (const FeatureShape& s : shapes_in(plan, f)) {
      for (const geometry::Loop& loop : s.area.loops) {
        if (geometry::signed_area(loop) <= 0.0) continue;
        FeatureSolids::Prism prism{{}, s.frame.direction_to_parent({0.0, 0.0, -s.depth_mm})};
        for (const Vec2 p : loop) prism.outline.push_back(s.frame.to_parent({p.x, p.y, 0.0}));
        solids.prisms.push_back(std::move(prism));
      }
    }
    out.push_back(std::move(solids));
  }
  return out;
}

PartHeights part_heights(const model::Plan& plan) {
  Columns columns(plan.stock);
  if (columns.out.nx == 0) return columns.out;
  if (plan.target_mesh != nullptr) take_mesh(columns, *plan.target_mesh);
  const std::set<AnyRef> parts = model::parts_of_others(plan.model);
  for (const AnyRef f : features_in(plan)) {
    if (parts.contains(f)) continue;
    bool beside = false;
    for (const FeatureShape& s : shapes_in(plan, f)) {
      using model::ShapeKind, model::ShapeTrait;
      if (s.kind == ShapeKind::kToolpath || s.kind == ShapeKind::kThread || s.area.empty()) continue;
      if (s.kind == ShapeKind::kFreeform && plan.target_mesh != nullptr) continue;
      if (std::abs(s.frame.z.z) < kUpright || has(s.kind, ShapeTrait::kSurface))
        beside = true;
      else
        cut(columns, s);
    }
    if (beside) columns.out.beside.push_back(name_of(plan, f));
  }
  return columns.out;
}

}  // namespace capstan::report
