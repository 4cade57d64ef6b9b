#pragma once

#include <string>
#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/proposal.h"

// Features that the raw piece does not let be made as they are drawn.

namespace capstan::piece {

/// Why a feature cannot be cut from this raw piece: material above its top, or its drill's point would come
/// out on the other side. Empty if it can.
[[nodiscard]] std::string not_in_piece(const Piece& piece, const model::FeatureShape& shape);
/// Why no cutter up to that diameter comes from one end of a shape to the other within the machine's travel
/// in X and Y, however the piece is turned about the tool's axis; empty: one may, or the travel is not known.
[[nodiscard]] std::string beyond_travel(const Piece& piece, const model::FeatureShape& shape,
                                        double widest_mm);
/// The radius that may stay in the inner corners of a step, an outside or a pocket that are drawn sharp and
/// state none, mm; 0: there are none. Corners at a pocket's mouth are none: a mill runs out there.
[[nodiscard]] double sharp_corner_of(const Piece& piece, const model::FeatureShape& shape);
/// The radius of a pocket's corners that limits its cutters, mm: the stated one where one of these corners
/// lies in the raw piece; where all lie beside it, half the width of the pocket.
[[nodiscard]] double corner_in_material(const Piece& piece, const model::FeatureShape& pocket);
/// Inside corners that a mill leaves round, in words (model::drawn_square); empty: none, or the part is a
/// mesh.
[[nodiscard]] std::string drawn_square(const Piece& piece, const model::FeatureShape& shape);
/// The diameter of the narrowest mill among the steps of a shape that the plan executes, of a surface that of
/// the last ball that finishes it, mm; 0: none.
[[nodiscard]] double narrowest_mill_mm(const Piece& piece, const std::vector<draft::StepDraft>& steps,
                                       const model::FeatureShape& shape);
/// The first of some places, in words, and how many more there are.
[[nodiscard]] std::string some_places(const std::vector<geometry::Vec3>& at);
/// Reports the radius that stays in corners drawn sharp without a stated radius (PIP-CORNER).
void tell_corners(const Piece& piece, const std::vector<draft::StepDraft>& steps, Job& job);
/// A hole at an edge of the raw piece is milled, or not made: its chains that drill are rejected.
[[nodiscard]] model::Proposal without_drills_at_edges(const Piece& piece, const model::FeatureShape& hole,
                                                      const model::Proposal& proposal);

}  // namespace capstan::piece
