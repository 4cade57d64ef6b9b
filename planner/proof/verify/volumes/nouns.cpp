#include "planner/proof/verify/volumes/nouns.h"

#include <cmath>

#include "planner/model/nouns/all.h"

namespace capstan::verify::volumes {

using geometry::Placement;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

std::optional<Vec3> triple(const std::vector<double>& c) {
  if (c.size() < 2 || c.size() > 3) return std::nullopt;
  const Vec3 v{c[0], c[1], c.size() == 3 ? c[2] : 0.0};
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return std::nullopt;
  return v;
}

std::optional<Vec3> unit(Vec3 v) {
  const double n = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  if (!(n > 1e-12) || !std::isfinite(n)) return std::nullopt;
  return Vec3{v.x / n, v.y / n, v.z / n};
}

}  // namespace

std::optional<Vec3> point_of(const Model& m, AnyRef r) {
  const auto* p = m.get<model::CartesianPoint>(r);
  return p == nullptr ? std::nullopt : triple(p->coordinates.items);
}

std::optional<Vec3> unit_of(const Model& m, AnyRef r) {
  const auto* d = m.get<model::Direction>(r);
  if (d == nullptr) return std::nullopt;
  const auto v = triple(d->direction_ratios.items);
  return v ? unit(*v) : std::nullopt;
}

std::optional<Placement> frame_of(const Model& m, AnyRef r) {
  const auto* a = m.get<model::Axis2Placement3d>(r);
  if (a == nullptr) return std::nullopt;
  const auto origin = point_of(m, a->location);
  const auto z = a->axis.set() ? unit_of(m, a->axis) : Vec3{0.0, 0.0, 1.0};
  if (!origin || !z) return std::nullopt;
  Vec3 towards{1.0, 0.0, 0.0};
  if (a->ref_direction.set()) {
    const auto given = unit_of(m, a->ref_direction);
    if (!given) return std::nullopt;
    towards = *given;
  } else if (std::abs(std::abs(z->x) - 1.0) < 1e-12) {
    towards = {0.0, 1.0, 0.0};
  }
  const auto x = unit(towards - dot(towards, *z) * *z);
  if (!x) return std::nullopt;
  return Placement{*origin, *x, cross(*z, *x), *z};
}

std::optional<Placement> frame_or_same(const Model& m, AnyRef r) {
  return r.set() ? frame_of(m, r) : Placement{};
}

std::optional<double> size_of(const Model& m, AnyRef r) {
  const auto* t = m.get<model::TolerancedLengthMeasure>(r);
  if (t == nullptr || !t->theoretical_size || !std::isfinite(*t->theoretical_size)) return std::nullopt;
  return t->theoretical_size;
}

std::optional<double> number_of(const Model& m, AnyRef r) {
  const auto* n = m.get<model::NumericParameter>(r);
  if (n == nullptr || !n->its_parameter_value || !std::isfinite(*n->its_parameter_value)) return std::nullopt;
  return n->its_parameter_value;
}

}  // namespace capstan::verify::volumes
