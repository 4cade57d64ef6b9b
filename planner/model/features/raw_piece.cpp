#include "planner/model/features/raw_piece.h"

#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::model {

using geometry::Box3;
using geometry::Vec3;

namespace {

Box3 placed(Vec3 lo, Vec3 hi, const geometry::Placement& at) {
  Box3 out;
  for (const double x : {lo.x, hi.x}) {
    for (const double y : {lo.y, hi.y}) {
      for (const double z : {lo.z, hi.z}) out.add(at.to_parent({x, y, z}));
    }
  }
  return out;
}

}  // namespace

const Workpiece* workpiece_of(const Model& model, Ref<Project> project) {
  if (const auto* p = model.get<Project>(project)) {
    for (std::size_t i = 0; i < p->its_workpieces.size(); ++i) {
      if (const auto* w = model.get<Workpiece>(p->its_workpieces[i])) return w;
    }
  }
  const auto all = model.all(TypeId::kWorkpiece);
  return all.empty() ? nullptr : model.get<Workpiece>(all.front());
}

std::optional<double> global_tolerance_of(const Workpiece& piece) {
  const auto& t = piece.global_tolerance;
  if (!t || !(*t > 0.0 && *t <= kLargestGlobalTolerance)) return std::nullopt;
  return t;
}

std::optional<Box3> box_of(const Model& m, AnyRef solid) {
  if (const auto* b = m.get<Block>(solid)) {
    const auto frame = placement_or_identity(m, b->position);
    if (!frame || !b->x || !b->y || !b->z) return std::nullopt;
    if (!(*b->x > 0.0 && *b->y > 0.0 && *b->z > 0.0)) return std::nullopt;
    return placed({0, 0, 0}, {*b->x, *b->y, *b->z}, *frame);
  }
  if (const auto* c = m.get<RightCircularCylinder>(solid)) {
    const auto* at = m.get<Axis1Placement>(c->position);
    if (at == nullptr || !c->height || !c->radius) return std::nullopt;
    const auto origin = point(m, at->location);
    if (!origin) return std::nullopt;
    const auto axis = direction(m, at->axis);
    const auto frame = geometry::make_placement(*origin, axis ? *axis : Vec3{0, 0, 1});
    if (!frame) return std::nullopt;
    const double r = *c->radius;
    return placed({-r, -r, 0}, {r, r, *c->height}, *frame);
  }
  return std::nullopt;
}

AnyRef raw_solid(const Model& model, const Workpiece& piece) {
  const auto* raw = model.get<Workpiece>(piece.its_rawpiece);
  if (raw != nullptr && raw->its_bounding_geometry.set()) return raw->its_bounding_geometry;
  return piece.its_bounding_geometry;
}

std::optional<Box3> stated_raw(const Model& m, AnyRef feature) {
  const auto* f = m.get<ManufacturingFeature>(feature);
  const Workpiece* piece = f == nullptr ? nullptr : m.get<Workpiece>(f->its_workpiece);
  if (piece == nullptr) {
    const auto projects = m.all(TypeId::kProject);
    piece = workpiece_of(m, projects.empty() ? Ref<Project>{} : Ref<Project>(projects.front()));
  }
  return piece == nullptr ? std::nullopt : box_of(m, raw_solid(m, *piece));
}

}  // namespace capstan::model
