#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/piece/piece.h"

namespace capstan::piece {

/// Pairs of features that are the same at the same place, both ways; made once and reported (PIP-TWICE).
/// `index`: of those shapes.
[[nodiscard]] std::set<std::pair<Drawn, Drawn>> twins_of(const std::vector<model::FeatureShape>& whole,
                                                         const Neighbours& index, Job& job);
/// True if the shapes of two features are one removal drawn twice, whatever steps cut them.
[[nodiscard]] bool same_removal(const Shapes& shapes, const model::FeatureShape& a,
                                const model::FeatureShape& b);
/// Why a hole cannot be planned apart from another feature's: it lies wholly within that, or differs from it
/// at the same place. Empty if it can.
[[nodiscard]] std::string lies_within_another(const Shapes& shapes, const model::FeatureShape& hole);

}  // namespace capstan::piece
