#include "planner/files/exchange/ap238/placement/locations.h"

#include <optional>

#include "planner/files/exchange/ap238/placement/frames.h"
#include "planner/model/features/resolve.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Model;

namespace {

std::optional<geometry::Placement> base_frame(const Model& m, AnyRef pattern) {
  const auto* base =
      m.get<model::Two5dManufacturingFeature>(m.at<model::GeneralPattern>(pattern).replicate_base_feature);
  if (base == nullptr) return std::nullopt;
  const auto frame = model::placement_or_identity(m, base->feature_placement);
  return frame ? std::optional(*frame) : std::nullopt;
}

}  // namespace

Locations::Locations(const Model& m) {
  for (const AnyRef at : m.all(model::TypeId::kGeneralPattern)) {
    if (const auto frame = base_frame(m, at)) before_.emplace_back(at, *frame);
  }
}

void Locations::follow(Model& m) const {
  for (const auto& [at, before] : before_) {
    const auto after = base_frame(m, at);
    if (!after || *after == before) continue;
    const geometry::Placement change = compose(inverse(before), *after);
    const std::size_t n = m.at<model::GeneralPattern>(at).replicate_locations.size();
    for (std::size_t i = 0; i < n; ++i) {
      const frames::PlacementRef old = m.at<model::GeneralPattern>(at).replicate_locations[i];
      const auto frame = model::placement(m, old);
      if (!frame) continue;
      const std::string name = m.at<model::Axis2Placement3d>(old).name.value_or("");
      const frames::PlacementRef made = frames::placement(m, compose(*frame, change), name);
      m.at<model::GeneralPattern>(at).replicate_locations.items[i] = made;
    }
  }
}

}  // namespace capstan::exchange::ap238
