#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/region.h"
#include "planner/making/piece/piece.h"

// Surroundings of a feature: material beside, below and above it.

namespace capstan::piece {

/// Height of raw material above a feature when its steps begin, mm; above the lowest place of a surface that
/// is seen. Faces are cut first.
[[nodiscard]] double stock_above(const Piece& piece, const model::FeatureShape& shape);
/// Height of the raw piece above a feature's top, along the feature's axis, mm; at least 0.
[[nodiscard]] double raw_above(const geometry::Box3& raw, const geometry::Placement& feature);

/// Thickness of material beside and below a feature when all features are made, mm; unset: none, or unknown.
/// Considers features of the same and of the opposite side and the raw piece, not features across.
struct Thickness {
  std::optional<double> wall_mm, floor_mm;
};
[[nodiscard]] Thickness thickness_beside(const Piece& piece, const model::FeatureShape& shape);
/// Distance from a hole's axis to the nearest wall above its mouth when its surroundings are cut, mm; unset:
/// no wall is near. A tool wider than the hole must fit there.
[[nodiscard]] std::optional<double> clear_beside(const Piece& piece, const model::FeatureShape& hole);
/// The least of each over several shapes.
[[nodiscard]] Thickness thinnest_beside(const Piece& piece, const std::vector<model::FeatureShape>& shapes);
[[nodiscard]] std::optional<double> least_clear_beside(const Piece& piece,
                                                       const std::vector<model::FeatureShape>& shapes);
/// How far the walls are apart at which a step ends on both sides, mm; 0: it runs out on one.
[[nodiscard]] double between_ends(const Piece& piece, const model::FeatureShape& step);

/// Ends the reach of a face where the part is higher than its floor beside it; elsewhere a cutter may leave
/// the face over its sides. Needs the shapes of all features; without any, nothing changes.
void stop_at_walls(const Piece& piece, model::FeatureShape& face);
/// The area that stays beside a feature with open sides at its depth: the part's box less the feature's own
/// area and those of features cut as deep there. A cutter leaves the feature only where this is empty.
[[nodiscard]] geometry::Region stays_beside(const Piece& piece, const model::FeatureShape& shape);

/// Why a face cannot be cut as drawn: it crosses a boss of another feature that is higher than the face's
/// floor. Empty if it can.
[[nodiscard]] std::string crosses_a_wall(const Piece& piece, const model::FeatureShape& face);

}  // namespace capstan::piece
