#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/plan.h"
#include "planner/physics/mechanics/loads/margin.h"

namespace capstan::piece {

/// The caller's choice of material, raw piece and margin. Unset fields are taken from the file.
struct WorkpieceWish {
  std::optional<std::string> material;            ///< overrides the file's
  const std::vector<model::WorkMaterial>& known;  ///< materials
  std::optional<geometry::Box3> raw;              ///< overrides the file's, workpiece coordinates, mm
  std::optional<double> allowance_mm;             ///< raw piece: the finished part grown by this
  std::optional<mechanics::MarginPolicy> margin;  ///< of loads against their limits
};

/// The material by the caller's name, else the part's; by default only where neither names one. Says of each
/// property that the part states whether the card was chosen by it.
/// Fails  as tooling::choose_material.
[[nodiscard]] Result<model::WorkMaterial> material_of(const model::Plan& plan, const WorkpieceWish& wish,
                                                      Job& job);

/// The margin, and who named it.
struct Margin {
  mechanics::MarginPolicy policy = mechanics::usual_margin();
  model::Provenance said;
};
/// The margin that the plan was made with, by what it says; none where it names one that nobody knows.
[[nodiscard]] std::optional<mechanics::MarginPolicy> margin_said(const model::Plan& plan);
/// The margin of loads: the caller's, else the one that the plan was made with.
/// Fails  NAME-UNKNOWN for a name in the plan that no margin has.
[[nodiscard]] Result<Margin> margin_of(const model::Plan& plan, const WorkpieceWish& wish, Job& job);

/// The raw piece: the caller's, else the file's, else the box of the surface or of the features (said).
/// Fails  PIP-NOTHING   there is neither a raw piece nor a feature whose size is known
///        PIP-SHEET     a surface that is a sheet does not cover it
///        PIP-STOCK-SIZE  it is larger than any machine
[[nodiscard]] Result<model::Stock> raw_piece_of(const model::Plan& plan, const WorkpieceWish& wish, Job& job);

/// An open outside profile says its side by the raw piece. States a raw piece that the caller names in the
/// nouns, if the file states none.
void state_raw_piece(model::Model& m, const geometry::Box3& box);

/// The shapes of all features as their nouns say them, whatever the raw piece is; what has none has the
/// fault.
using StatedShapes = std::map<AnyRef, Result<std::vector<model::FeatureShape>>>;
[[nodiscard]] StatedShapes stated_shapes(const model::Model& model);

/// The shapes of all features in this raw piece, from those that `stated` has of the plan's; faces that
/// `bans` leaves out stay. Reports twins (PIP-TWICE).
[[nodiscard]] Shapes shapes_of_all(const model::Plan& plan, StatedShapes stated, double grown_mm,
                                   const draft::Bans& bans, Job& job);

/// Says which features the raw piece does not hold (PIP-OUTSIDE).
void report_outside(const model::Plan& plan, const StatedShapes& stated, Job& job);

}  // namespace capstan::piece
