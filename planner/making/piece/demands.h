#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/making/piece/piece.h"
#include "planner/model/features/requirements.h"
#include "rules/rules.h"

// What is asked of the features, and what rules are told of them.

namespace capstan::piece {

struct Demands {
  std::optional<model::GeneralTolerance> general;  ///< of what states none: the user's, else the file's
  std::string general_from;                        ///< who stated it
  std::map<AnyRef, model::Quality> qualities;      ///< by feature
  std::vector<model::Tie> ties;                    ///< features that a tolerance ties together
  double edge_break_mm = 0.0;                      ///< edges that the part leaves sharp; 0: left
  int batch = 1;                                   ///< pieces
};

/// What file and user ask. `general_tolerance` is the user's, "ISO 2768-m"; empty: the file's, or none. Says
/// what is kept and not planned for (PIP-REQUIREMENT).
/// Fails  as model::parse_general for the user's.
[[nodiscard]] Result<Demands> demands_of(const model::Plan& plan, const std::string& general_tolerance,
                                         double edge_break_mm, int batch, Job& job);

/// What surrounds a feature, for the rules: thinnest wall and floor of its shapes.
[[nodiscard]] rules::Context context_of(const Piece& piece, const Demands& demands, AnyRef feature,
                                        const std::vector<model::FeatureShape>& shapes);

}  // namespace capstan::piece
