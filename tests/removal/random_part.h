#pragma once

#include <string>
#include <vector>

#include "tests/removal/planned.h"

namespace capstan::testing::removal {

/// A feature by its name in the file, and the space that it takes.
struct Space {
  std::string name;
  Box around;
};

struct RandomPart {
  Part part;
  std::vector<Space> features;
};

/// A part drawn from a seed: its file and its target from the same numbers. One to four features of any kind,
/// each in a field of 24 x 24 mm, what spans the block beside them; placements, compounds, patterns,
/// tolerances, the material and the machine.
[[nodiscard]] RandomPart random_part(unsigned seed);

/// What is wrong with a plan of it: empty when either a program is written that the check finds no error in
/// and that the simulation agrees with, but for material that stays in features that are said not to be
/// planned, or none is written and it is said why.
[[nodiscard]] std::string broken_promise(const RandomPart& part, const Outcome& outcome);

}  // namespace capstan::testing::removal
