#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/making/piece/piece.h"
#include "planner/model/features/requirements.h"
#include "rules/rules.h"

// Tolerances and surface limits of each feature, and the facts that the rules get.

namespace capstan::piece {

struct Demands {
  std::optional<model::GeneralTolerance>
      general;                                 ///< for sizes without a tolerance: the user's, else the file's
  std::string general_from;                    ///< who stated it
  std::map<AnyRef, model::Quality> qualities;  ///< by feature
  std::vector<model::Tie> ties;                ///< features that a tolerance ties together
  double edge_break_mm = 0.0;  ///< for edges that the part leaves sharp; 0: edges are not broken
  int batch = 1;               ///< pieces
};

/// The demands of file and user. `general_tolerance` is the user's, "ISO 2768-m"; empty: the file's, or none.
/// Reports demands that are kept but not planned for (PIP-REQUIREMENT).
/// Fails  as model::parse_general for the user's.
[[nodiscard]] Result<Demands> demands_of(const model::Plan& plan, const std::string& general_tolerance,
                                         double edge_break_mm, int batch, Job& job);

/// The surroundings of a feature, for the rules: thinnest wall and floor of its shapes.
[[nodiscard]] rules::Context context_of(const Piece& piece, const Demands& demands, AnyRef feature,
                                        const std::vector<model::FeatureShape>& shapes);

}  // namespace capstan::piece
