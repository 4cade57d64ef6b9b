#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/files/from_cad/asked/threads.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::from_cad {

/// The raw piece that a caller names; a CAD file has none.
struct RawPiece {
  std::optional<geometry::Box3> box;  ///< workpiece coordinates, mm
  double allowance_mm = 0.0;          ///< on each side of the part's own box
};

/// What a caller states of a part beside its file.
struct Stated {
  RawPiece raw = {};
  std::vector<StatedThread> threads = {};
  std::string threads_from = "--tapped";  ///< what the caller stated them with
};

/// A plan whose part is a CAD model: its recognised features as nouns of ISO 14649, every operation open.
///
/// Features    bound by recognition: the ledger says from which faces, why, and what else they could be.
/// Raw piece   as named; else the box that just holds the part, whose sides stay as they are.
/// Left out    what is not recognised, or not reached along any axis, is a region with the reason
///             (model/plan/decision/not_recognised.h): it stays unplanned, and the plan is not complete.
/// Frame       the workpiece's is the file's; where the part lies askew in it, that of the raw piece.
/// Units       mm, whatever the file has.
/// Threads     as stated (threads.h); a CAD file has none.
/// Fails       CAD-BODIES (no solid, or several), CAD-STOCK (the named raw piece does not hold the part),
///             CAD-THREAD.
/// Source      derived; a place is reached where nothing of the part lies above it.
[[nodiscard]] Result<model::Plan> plan_of_part(const exchange::Brep& brep, const std::string& name,
                                               const Stated& stated, Job& job);

/// The same shape in the workpiece's frame of `plan_of_part`.
[[nodiscard]] exchange::Brep straightened(exchange::Brep brep);

}  // namespace capstan::from_cad
