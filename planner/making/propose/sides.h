#pragma once

#include <cstddef>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/plan.h"

// The side from which a feature is cut, and the set-up in which that side is up.

namespace capstan::propose {

/// Sine below which two tool axes are the same.
inline constexpr double kSameAxis = 1e-6;

/// The set-up in which this axis (workpiece frame) points up; past the last one if there is none.
[[nodiscard]] std::size_t setup_up(const std::vector<draft::SetupDraft>& setups, geometry::Vec3 z);

/// The set-up in which the axis of `s` points up. Makes one, in `setups` and in the nouns, if there is none.
/// Warns  PIP-TILT if the axis leans against that of a set-up by less than anybody would intend.
[[nodiscard]] std::size_t setup_for(model::Plan& plan, std::vector<draft::SetupDraft>& setups,
                                    const model::FeatureShape& s, Job& job);

/// A hole right through, seen from the other side where only that is up in some set-up, or where all features
/// that a tolerance ties to it are cut from there. Other shapes as they are.
[[nodiscard]] model::FeatureShape reachable_side(const piece::Piece& piece, const piece::Demands& demands,
                                                 const std::vector<draft::SetupDraft>& setups,
                                                 model::AnyRef f, const model::FeatureShape& s);

}  // namespace capstan::propose
