#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "planner/ground/vocabulary/noun_kind.h"

namespace capstan::model {

/// What is true of every operation of a kind.
///
///     roughs      leaves an allowance for a later operation
///     finishes    makes the surface that stays
///     plane       mills a plane from above
///     walls       mills along walls, with the flank
///     surface     mills a surface of any form
///     along_axis  the cutter goes down the hole's axis and back: drills, sinks, bores, reams
///     enlarges    widens a hole that is there, by the cutter's own diameter
///     cone_tip    the cutter's conical tip cuts, and is as wide there as it is deep
///     threads     makes a thread
enum class OperationTrait : std::uint16_t {
  kRoughs = 1U << 0U,
  kFinishes = 1U << 1U,
  kPlane = 1U << 2U,
  kWalls = 1U << 3U,
  kSurface = 1U << 4U,
  kAlongAxis = 1U << 5U,
  kEnlarges = 1U << 6U,
  kConeTip = 1U << 7U,
  kThreads = 1U << 8U,
};

/// Ranks in the order of the craft: of two steps that nothing else orders, the lower comes first.
namespace craft {
inline constexpr int kNone = 0, kMarks = 1, kDrills = 2, kRoughs = 3, kFinishes = 4, kSizes = 5;
}

struct OperationRow {
  TypeId value;
  int rank;  ///< in the order of the craft; 0: none
  std::uint16_t traits;
  std::string_view
      law;  ///< of its loads, where it cuts along the axis: a name of optimise/cut/law; empty: it mills
};

/// Operations that cut. Abstract ones and extensions are not here: they have no trait, rank 0. For people
/// they are called by their nouns' keywords.
[[nodiscard]] std::span<const OperationRow> operations();
[[nodiscard]] bool has(TypeId operation, OperationTrait t);
/// Whether it makes walls that stay, with the flank.
[[nodiscard]] bool finishes_walls(TypeId operation);
[[nodiscard]] int craft_rank(TypeId operation);
/// The law of its loads where it cuts along the axis; empty: it mills, or is no operation.
[[nodiscard]] std::string_view axial_law(TypeId operation);

}  // namespace capstan::model
