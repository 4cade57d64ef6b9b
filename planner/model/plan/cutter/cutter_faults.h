#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// What is wrong with the values of one cutter, each as a sentence with its numbers; empty when nothing is:
/// each value in its range, angles too.
[[nodiscard]] std::vector<std::string> value_faults_of(const Cutter& c);
/// These, or what does not go together: corner radius at most D/2, flutes not longer than the tool sticks
/// out, the stick-out not longer than gage line to tip, neither longer than the tool, teeth 1 to 60, a pitch
/// for taps.
[[nodiscard]] std::vector<std::string> faults_of(const Cutter& c);

}  // namespace capstan::model
