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
constexpr unsigned kMeasure = bit(OperationTrait::kMeasures);

using T = TypeId;
constexpr std::array kRows{
    OperationRow{T::kCenterDrilling, "centre drilling", craft::kMarks, kAxis | kTip},
    OperationRow{T::kDrilling, "drilling", craft::kDrills, kAxis},
    OperationRow{T::kMultistepDrilling, "drilling with retracts", craft::kDrills, kAxis},
    OperationRow{T::kCounterSinking, "countersinking", craft::kNone, kAxis | kTip},
    OperationRow{T::kBoring, "boring", craft::kSizes, kAxis | kWider},
    OperationRow{T::kReaming, "reaming", craft::kSizes, kAxis | kWider},
    OperationRow{T::kBackBoring, "back boring", craft::kSizes, kAxis},
    OperationRow{T::kTapping, "tapping", craft::kSizes, kThread},
    OperationRow{T::kThreadDrilling, "thread milling", craft::kSizes, kThread},
    OperationRow{T::kPlaneRoughMilling, "plane rough milling", craft::kRoughs, kRough | kPlane},
    OperationRow{T::kPlaneFinishMilling, "plane finish milling", craft::kFinishes, kFinish | kPlane},
    OperationRow{T::kSideRoughMilling, "side rough milling", craft::kRoughs, kRough | kWall},
    OperationRow{T::kSideFinishMilling, "side finish milling", craft::kFinishes, kFinish | kWall},
    OperationRow{T::kBottomAndSideRoughMilling, "bottom and side rough milling", craft::kRoughs,
                 kRough | kWall},
    OperationRow{T::kBottomAndSideFinishMilling, "bottom and side finish milling", craft::kFinishes,
                 kFinish | kWall},
    OperationRow{T::kFreeformRoughMilling, "surface rough milling", craft::kRoughs, kRough | kSurface},
    OperationRow{T::kFreeformFinishMilling, "surface finish milling", craft::kFinishes, kFinish | kSurface},
    OperationRow{T::kWorkpieceProbing, "probing", craft::kNone, kMeasure},
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
