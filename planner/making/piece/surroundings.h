#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/region.h"
#include "planner/making/piece/piece.h"

// What surrounds a feature: what stays beside and below it, what stands above it.

namespace capstan::piece {

/// How much raw material stands above a feature when its steps begin, mm: faces are cut first.
[[nodiscard]] double stock_above(const Piece& piece, const model::FeatureShape& shape);
/// How far the raw piece stands above a feature's top, along the feature's axis, mm; at least 0.
[[nodiscard]] double raw_above(const geometry::Box3& raw, const geometry::Placement& feature);

/// What stays beside and below a feature when all are made, mm; unset where there is nothing or it is not
/// known. Features of the same and of the opposite side are seen, and the raw piece; not those across.
struct Thickness {
  std::optional<double> wall_mm, floor_mm;
};
[[nodiscard]] Thickness thickness_beside(const Piece& piece, const model::FeatureShape& shape);
/// From a hole's axis to the nearest wall that stands above its mouth when what is around is cut, mm; unset:
/// none is near. Tools wider than the hole must pass there.
[[nodiscard]] std::optional<double> clear_beside(const Piece& piece, const model::FeatureShape& hole);
/// Of several shapes, the least of each.
[[nodiscard]] Thickness thinnest_beside(const Piece& piece, const std::vector<model::FeatureShape>& shapes);
[[nodiscard]] std::optional<double> least_clear_beside(const Piece& piece,
                                                       const std::vector<model::FeatureShape>& shapes);
/// How far the walls are apart at which a step ends on both sides, mm; 0: it runs out on one.
[[nodiscard]] double between_ends(const Piece& piece, const model::FeatureShape& step);

/// A face is left over its sides, but not where the part stands beside it above its floor: there its reach
/// ends. Needs the shapes of all features; without any, nothing is changed.
void stop_at_walls(const Piece& piece, model::FeatureShape& face);
/// A feature with open sides may be left through them, but only where the part has nothing in the way: what
/// stays beside it at its depth is the part's box less its own area and those of the features that are cut as
/// deep there.
[[nodiscard]] geometry::Region stays_beside(const Piece& piece, const model::FeatureShape& shape);

/// Why a face cannot be cut as it is drawn: it crosses a boss that another feature leaves standing above the
/// face's floor. Empty when it can.
[[nodiscard]] std::string crosses_a_wall(const Piece& piece, const model::FeatureShape& face);

}  // namespace capstan::piece
