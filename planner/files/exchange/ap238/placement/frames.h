#pragma once

#include <string_view>

#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238::frames {

using geometry::Placement;
using geometry::Vec3;
using PlacementRef = model::Ref<model::Axis2Placement3d>;

/// Name of directions that exist only because AP238 requires them.
inline constexpr std::string_view kDerived = "derived";
/// Name of a course of travel made from a depth that was a length.
inline constexpr std::string_view kDerivedFromLength = "derived from a length";

/// Angle of sides that a plan leaves open: upright, as the model takes them; its last bit marks it.
inline constexpr double kUpright = 1.5707963267948968;

model::Ref<model::Direction> direction(model::Model& m, Vec3 d, std::string_view name = "");
PlacementRef placement(model::Model& m, const Placement& at, std::string_view name = "");
model::Ref<model::ElementarySurface> plane(model::Model& m, const Placement& at, std::string_view name);
/// The name of a direction that is set; empty otherwise.
[[nodiscard]] std::string name_of(const model::Model& m, model::AnyRef direction);
/// Another object with the same attributes.
model::AnyRef copy_of(model::Model& m, model::AnyRef at);
[[nodiscard]] inline Placement moved(const Placement& p, Vec3 local) {
  Placement out = p;
  out.origin = p.to_parent(local);
  return out;
}

/// "SLOT 'name'".
[[nodiscard]] std::string feature_name(const model::Model& m, model::AnyRef feature);
/// Slots and steps, whose frames turn (sweeps.cpp).
void sweep_to_ap238(model::Plan& plan, model::AnyRef feature, std::vector<std::string>& losses);
void sweep_to_model(Reader& reader, model::AnyRef feature);

}  // namespace capstan::exchange::ap238::frames
