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
  bool whole_shop = false;  ///< the ordinary machine, the whole library
};

/// A part drawn from a seed: its file and its target from the same numbers. Features of any kind, each in a
/// field of 24 x 24 mm, what spans the block beside them, a face with a boss, outsides, what is cut from
/// below; placements, compounds, patterns, tolerances IT6 to IT12, the material, the machine, the tools.
[[nodiscard]] RandomPart random_part(unsigned seed);

struct Share {
  std::size_t planned = 0, drawn = 0;
};

/// How many features, those in compounds and patterns counted too, the program makes.
[[nodiscard]] Share planned_share(const RandomPart& part, const Outcome& outcome);

/// What is wrong with a plan of it: empty when either a program is written that the check finds no error in
/// and that the simulation agrees with, but for material that stays in features that are said not to be
/// planned, or none is written and it is said why.
[[nodiscard]] std::string broken_promise(const RandomPart& part, const Outcome& outcome);

}  // namespace capstan::testing::removal
