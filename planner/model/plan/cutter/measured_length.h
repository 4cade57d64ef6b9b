#pragma once

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// Gives the cutter a length from the gage line that somebody measured, or stated for the tool as it is
/// loaded. A stick-out that is assumed was assumed with the old length, holder and all: a tool that is
/// shorter than that stands out by so much less, for its holder is as long as before; one that is longer
/// stands out no farther, for its holder may be the longer one. A stick-out that is stated is kept, up to the
/// length. The tool reaches no farther than it stands out, nor do flutes whose length is assumed. Where the
/// holder takes up the whole length a trace is left over, for a stick-out of 0 says that none is known.
void take_measured_length(Cutter& c, double length_mm, const std::string& source);

}  // namespace capstan::model
