#pragma once

#include <optional>

#include "planner/ground/geometry/vec.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

/// The workpiece that the project makes; the first of the file where the project names none; null: there is
/// none.
[[nodiscard]] const Workpiece* workpiece_of(const Model& model, Ref<Project> project);

/// Above this a stated general tolerance is hardly meant: no workpiece is that rough. mm; default, unsourced.
inline constexpr double kLargestGlobalTolerance = 5.0;

/// The widest that a general tolerance lets a surface be from where it should be: beyond it a check finds
/// nothing any more. mm; default, unsourced.
inline constexpr double kWidestJudged = 0.5;

/// The part's general tolerance, +- mm; nothing where none is stated, or one that is hardly meant: that
/// widens no check and no allowance.
[[nodiscard]] std::optional<double> global_tolerance_of(const Workpiece& piece);

/// The box of a block or a cylinder, workpiece coordinates; nothing for what is neither or has no size.
[[nodiscard]] std::optional<geometry::Box3> box_of(const Model& model, AnyRef solid);

/// What states the raw piece: the bounding geometry of the piece's raw piece, else its own.
[[nodiscard]] AnyRef raw_solid(const Model& model, const Workpiece& piece);

/// The box of the raw piece that the file states for a feature's own workpiece, else for the one that the
/// first project makes; nothing where none is stated, or it is neither a block nor a cylinder.
[[nodiscard]] std::optional<geometry::Box3> stated_raw(const Model& model, AnyRef feature = {});

}  // namespace capstan::model
