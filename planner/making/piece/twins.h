#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/piece/piece.h"

namespace capstan::piece {

/// Which features are the same at the same place, both ways; they are made once, and it is said (PIP-TWICE).
[[nodiscard]] std::set<std::pair<Drawn, Drawn>> twins_of(const std::vector<model::FeatureShape>& whole,
                                                         Job& job);
/// Whether two features' shapes are one removal, drawn twice; as they are drawn, however they are cut.
[[nodiscard]] bool same_removal(const Shapes& shapes, const model::FeatureShape& a,
                                const model::FeatureShape& b);
/// Why a hole cannot be told from another feature's: it lies wholly within that, or differs from it at the
/// same place. Empty when it can.
[[nodiscard]] std::string lies_within_another(const Shapes& shapes, const model::FeatureShape& hole);

}  // namespace capstan::piece
