#include "planner/ground/vocabulary/operation.h"

#include <algorithm>
#include <array>

namespace capstan::model {
namespace {

constexpr std::uint16_t bit(OperationTrait t) { return static_cast<std::uint16_t>(t); }

constexpr unsigned kRough = bit(OperationTrait::kRoughs);
constexpr unsigned kFinish = bit(OperationTrait::kFinishes);
constexpr unsigned kPlane = bit(OperationTrait::kPlane);
constexpr unsigned kWall = bit(OperationTrait::kWalls);
constexpr unsigned kSurface = bit(OperationTrait::kSurface);
constexpr unsigned kAxis = bit(OperationTrait::kAlongAxis);
constexpr unsigned kWider = bit(OperationTrait::kEnlarges);
constexpr unsigned kTip = bit(OperationTrait::kConeTip);
constexpr unsigned kThread = bit(OperationTrait::kThreads);

using T = TypeId;
constexpr std::array kRows{
    OperationRow{T::kCenterDrilling, craft::kMarks, kAxis | kTip},
    OperationRow{T::kDrilling, craft::kDrills, kAxis},
    OperationRow{T::kMultistepDrilling, craft::kDrills, kAxis},
    OperationRow{T::kCounterSinking, craft::kNone, kAxis | kTip},
    OperationRow{T::kBoring, craft::kSizes, kAxis | kWider},
    OperationRow{T::kReaming, craft::kSizes, kAxis | kWider},
    OperationRow{T::kBackBoring, craft::kSizes, kAxis},
    OperationRow{T::kTapping, craft::kSizes, kThread},
    OperationRow{T::kThreadDrilling, craft::kSizes, kThread},
    OperationRow{T::kPlaneRoughMilling, craft::kRoughs, kRough | kPlane},
    OperationRow{T::kPlaneFinishMilling, craft::kFinishes, kFinish | kPlane},
    OperationRow{T::kSideRoughMilling, craft::kRoughs, kRough | kWall},
    OperationRow{T::kSideFinishMilling, craft::kFinishes, kFinish | kWall},
    OperationRow{T::kBottomAndSideRoughMilling, craft::kRoughs, kRough | kWall},
    OperationRow{T::kBottomAndSideFinishMilling, craft::kFinishes, kFinish | kWall},
    OperationRow{T::kFreeformRoughMilling, craft::kRoughs, kRough | kSurface},
    OperationRow{T::kFreeformFinishMilling, craft::kFinishes, kFinish | kSurface},
};

const OperationRow* find(TypeId operation) {
  const auto it =
      std::find_if(kRows.begin(), kRows.end(), [&](const OperationRow& r) { return r.value == operation; });
  return it == kRows.end() ? nullptr : &*it;
}

}  // namespace

std::span<const OperationRow> operations() { return kRows; }

bool has(TypeId operation, OperationTrait t) {
  const OperationRow* r = find(operation);
  return r != nullptr && (r->traits & bit(t)) != 0;
}

bool finishes_walls(TypeId operation) {
  return has(operation, OperationTrait::kFinishes) && has(operation, OperationTrait::kWalls);
}

int craft_rank(TypeId operation) {
  const OperationRow* r = find(operation);
  return r == nullptr ? craft::kNone : r->rank;
}

}  // namespace capstan::model
