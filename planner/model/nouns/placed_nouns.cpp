#include "planner/model/nouns/placed_nouns.h"

#include <string>
#include <utility>
#include <vector>

namespace capstan::model {
namespace {

/// Adding zero turns minus zero into zero.
std::vector<double> numbers(geometry::Vec3 v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

}  // namespace

Ref<CartesianPoint> add_point(Model& m, geometry::Vec3 at, std::string_view name) {
  CartesianPoint out;
  out.name = std::string(name);
  out.coordinates = {numbers(at), true};
  return m.add(std::move(out));
}

Ref<Direction> add_direction(Model& m, geometry::Vec3 along, std::string_view name) {
  Direction out;
  out.name = std::string(name);
  out.direction_ratios = {numbers(along), true};
  return m.add(std::move(out));
}

Ref<Axis2Placement3d> add_placement(Model& m, const geometry::Placement& at, std::string_view name) {
  Axis2Placement3d out;
  out.name = std::string(name);
  out.location = add_point(m, at.origin);
  out.axis = add_direction(m, at.z);
  out.ref_direction = add_direction(m, at.x);
  return m.add(std::move(out));
}

Ref<Axis2Placement3d> add_placement_at(Model& m, geometry::Vec3 at, std::string_view name) {
  Axis2Placement3d out;
  out.name = std::string(name);
  out.location = add_point(m, at);
  return m.add(std::move(out));
}

}  // namespace capstan::model
