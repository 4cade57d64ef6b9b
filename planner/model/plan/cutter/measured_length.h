#pragma once

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// Sets the cutter's length from the gage line to one that somebody measured, or stated for the tool as it is
/// loaded, mm. An assumed stick-out changes with it. If the tool is shorter than was assumed, the stick-out
/// is less by the difference, because the holder is as long as before. If it is longer, the stick-out stays,
/// because the holder may be the longer part. A stated stick-out stays, up to the length. Reach, and an
/// assumed flute length, are at most the stick-out. Where the holder is as long as the tool, a small
/// stick-out remains, because 0 means that none is known.
void take_measured_length(Cutter& c, double length_mm, const std::string& source);

}  // namespace capstan::model
