#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planner/door/pipeline/step/steps.h"
#include "planner/model/plan/resources/workholding.h"

// How the piece is held, and paths that keep clear of what holds it; only planner/door/pipeline/*.cpp include
// this.

namespace capstan::pipeline {

/// A move that comes nearer to a solid than the clearance.
struct NearMove {
  std::size_t move = 0;
  std::string text;  ///< move, part of the tool, solid and distance
};
/// The worst move of a path, or nothing when all keep clear. Rapids are taken as the box between their ends;
/// the tool as upright cylinders
/// (flutes, shank, holder), each at all heights that the move takes it through.
[[nodiscard]] std::optional<NearMove> near_move_of(const model::CutterPath& path, const model::Cutter& cutter,
                                                   const model::Workholding& holding);

/// Makes a path; when it comes near what holds the piece, again with higher links, then around it.
/// Fails  PIP-HOLDING, naming move and solid, when none of these keeps clear or some of the feature would
/// stay
///        uncut under a clamp.
[[nodiscard]] Result<toolpath::GeneratedPath> kept_clear(
    const Work& w, const StepDraft& step, const toolpath::PathJob& job,
    const std::function<Result<toolpath::GeneratedPath>(const toolpath::PathJob&)>& make);

/// Where each step of a set-up cuts, and how low, set-up frame.
struct Footprint {
  geometry::Region area;
  double low_mm = 0.0;
};
[[nodiscard]] std::vector<Footprint> footprints(const Work& w, std::size_t setup);
/// The first solid that what is cut would come near to; null: none.
[[nodiscard]] const model::FixtureSolid* in_the_way(const model::Workholding& holding,
                                                    const std::vector<Footprint>& cuts);

}  // namespace capstan::pipeline
