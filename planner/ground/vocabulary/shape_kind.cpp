#include "planner/ground/vocabulary/shape_kind.h"

#include <array>

namespace capstan::model {
namespace {

constexpr std::uint16_t bit(ShapeTrait t) { return static_cast<std::uint16_t>(t); }

constexpr unsigned kRound = bit(ShapeTrait::kRound);
constexpr unsigned kWalled = bit(ShapeTrait::kWalled);
constexpr unsigned kOut = bit(ShapeTrait::kOutwards);
constexpr unsigned kEdge = bit(ShapeTrait::kEdge);
constexpr unsigned kFloor = bit(ShapeTrait::kFloor);
constexpr unsigned kIslands = bit(ShapeTrait::kIslands);
constexpr unsigned kRim = bit(ShapeTrait::kRim);
constexpr unsigned kClears = bit(ShapeTrait::kClears);
constexpr unsigned kBelow = bit(ShapeTrait::kBelowTop);
constexpr unsigned kBeyond = bit(ShapeTrait::kBeyond);

using K = ShapeKind;
constexpr std::array kRows{
    ShapeKindRow{K::kFace, "face", kFloor | kIslands | kClears | kBeyond},
    ShapeKindRow{K::kPocket, "pocket", kWalled | kFloor | kIslands | kRim | kClears | kBelow},
    ShapeKindRow{K::kSlot, "slot", kWalled | kFloor | kClears | kBelow},
    ShapeKindRow{K::kStep, "step", kOut | kFloor | kIslands | kClears | kBelow | kBeyond},
    ShapeKindRow{K::kHole, "hole", kRound | kWalled | kFloor | kRim | kClears | kBelow},
    ShapeKindRow{K::kOutside, "outside", kOut | kFloor | kIslands | kRim | kClears | kBelow | kBeyond},
    ShapeKindRow{K::kChamfer, "chamfer", kEdge | kBeyond},
    ShapeKindRow{K::kEdgeRound, "edge_round", kEdge},
    ShapeKindRow{K::kThread, "thread", kRound | kBelow},
    ShapeKindRow{K::kSphericalCap, "spherical_cap", kFloor},
    ShapeKindRow{K::kRoundedEnd, "rounded_end", kFloor},
    ShapeKindRow{K::kFreeform, "freeform", kFloor},
    ShapeKindRow{K::kToolpath, "toolpath", kFloor},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].value) != i) return false;
  }
  return kRows.size() == static_cast<std::size_t>(kLastShapeKind) + 1;
}
static_assert(in_order());

}  // namespace

std::span<const ShapeKindRow> shape_kinds() { return kRows; }
bool has(ShapeKind k, ShapeTrait t) { return (kRows.at(static_cast<std::size_t>(k)).traits & bit(t)) != 0; }
std::string_view to_text(ShapeKind k) { return kRows.at(static_cast<std::size_t>(k)).name; }

}  // namespace capstan::model
