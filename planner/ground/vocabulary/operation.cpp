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
#define CAPSTAN_OPERATION(Noun, rank, traits, law) OperationRow{T::k##Noun, craft::rank, traits, law},
#include "planner/ground/vocabulary/operations.inc"
#undef CAPSTAN_OPERATION
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

std::string_view axial_law(TypeId operation) {
  const OperationRow* r = find(operation);
  return r == nullptr ? std::string_view() : r->law;
}

int craft_rank(TypeId operation) {
  const OperationRow* r = find(operation);
  return r == nullptr ? craft::kNone : r->rank;
}

}  // namespace capstan::model
