#include "planner/making/toolpath/freeform/task.h"

#include <cmath>
#include <string>
#include <utility>

#include "planner/ground/base/number.h"

namespace capstan::toolpath::freeform {

Result<MillEnd> checked_cutter(const FreeformJob& task) {
  const std::optional<MillEnd> cutter = mill_end_of(model::profile_of(task.cutter));
  const auto is = [&](model::CutterTrait t) { return model::has(task.cutter.cutter_class, t); };
  if (is(model::CutterTrait::kAlongAxis) || is(model::CutterTrait::kCone)) {
    return fail("FRF-CUTTER", "cutter '" + task.cutter.id + "' is a " +
                                  std::string(model::words_of(task.cutter.cutter_class)) +
                                  ", which does not mill surfaces; name a flat, bull or ball nosed end mill");
  }
  if (!cutter) {
    return fail("FRF-CUTTER", "cutter '" + task.cutter.id +
                                  "' has a hollow outline; name a flat, bull or ball nosed end mill");
  }
  if (task.surface == nullptr || task.surface->triangles.empty()) {
    return fail("FRF-EMPTY", "there is no surface to machine");
  }
  for (const geometry::Vec3& v : task.surface->vertices) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      return fail("FRF-VALUE", "the surface has a vertex that is not finite");
    }
  }
  for (const auto& t : task.surface->triangles) {
    for (const std::uint32_t v : t) {
      if (v >= task.surface->vertices.size()) {
        return fail("FRF-VALUE", "a triangle names vertex " + std::to_string(v) + ", which is not there");
      }
    }
  }
  const std::pair<const char*, double> not_negative[] = {{"allowance", task.allowance_mm},
                                                         {"clearance", task.clearance_mm},
                                                         {"axial depth", task.axial_depth_mm},
                                                         {"stepover", task.stepover_mm},
                                                         {"scallop", task.scallop_mm}};
  for (const auto& [name, value] : not_negative) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      return fail("FRF-VALUE", std::string(name) + " is not a length");
    }
  }
  if (!(task.tolerance_mm > 0.0)) return fail("FRF-VALUE", "a path tolerance above 0 is needed");
  if (!(task.security_z_mm >= task.top_z_mm)) {
    return fail("FRF-VALUE", "the security plane (z " + trimmed(task.security_z_mm, 3) +
                                 ") lies below the top of the material (z " + trimmed(task.top_z_mm, 3) +
                                 ")");
  }
  const double highest = geometry::bounds(*task.surface).hi.z + task.allowance_mm + task.tolerance_mm;
  if (task.security_z_mm < highest) {
    return fail("FRF-VALUE", "the security plane (z " + trimmed(task.security_z_mm, 3) +
                                 ") does not clear the surface (z " + trimmed(highest, 3) + ")");
  }
  return *cutter;
}

geometry::Region area_of(const FreeformJob& task, const DropCutter& drop) {
  if (!task.area.empty()) return task.area;
  return geometry::rectangle(xy(drop.bounds().lo), xy(drop.bounds().hi));
}

geometry::Region kept_out(const FreeformJob& task, const MillEnd& cutter) {
  if (task.avoid.empty()) return {};
  // Over a corner a chord of length s comes as near as s^2 / 8 r.
  return geometry::offset(task.avoid, (1.0 + kProbedShare * kProbedShare / 8.0) * cutter.radius());
}

Follower follower_of(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter) {
  return {.drop = &drop,
          .cutter = cutter,
          .allowance_mm = task.allowance_mm,
          .tolerance_mm = task.tolerance_mm,
          .bottom_z_mm = task.bottom_z_mm,
          .beside_is_free = task.beside_is_free};
}

}  // namespace capstan::toolpath::freeform
