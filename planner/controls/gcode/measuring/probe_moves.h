#pragma once

#include <vector>

#include "planner/controls/gcode/measuring/touch.h"
#include "planner/controls/gcode/words.h"

namespace capstan::controls::gcode {

/// The moves that make these workpiece_probings before step `next` (null: behind the last), on a control with
/// a move that ends where the probe touches (`Words::probe`): the probe is called once, and for each touch it
/// goes over the start at the top of Z, straight down at `probe_way_mm_min`, at `probe_feed_mm_min` along the
/// axis until it touches, `probe_overtravel_mm` beyond the expected wall at the latest, back to the start and
/// up. Z is of the lowest place of the ball, to which the probe's length is measured. Written where
/// `in_the_way` finds nothing, behind a step of the same set-up, with a probe of the tool list whose length
/// is measured. Nothing where the machine states no `probe_feed_mm_min`.
[[nodiscard]] TouchBlocks probe_moves(const model::Plan& plan, const std::vector<model::AnyRef>& touches,
                                      const model::StepResult* next, Standing standing, const Words& words);

}  // namespace capstan::controls::gcode
