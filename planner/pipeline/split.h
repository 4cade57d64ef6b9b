#pragma once

#include "planner/model/cutter_path.h"
#include "planner/optimise/feeds.h"

namespace capstan::pipeline {

/// Cuts straight feed moves where the measured section changes, so that a heavy corner at the end of a long
/// move does not slow all of it: a feed is one per move. The way itself stays as it is.
///
/// Needs  sections of this very path, `at_mm` from the start of each move, and factors of `feeds` per move.
/// Shape  sections and factors are renumbered with the moves; a dwell stays at the end of the last piece.
void split_uneven(double cutting_diameter_mm, model::CutterPath& path, model::SectionSeries& sections,
                  optimise::FeedQuestion& feeds);

}  // namespace capstan::pipeline
