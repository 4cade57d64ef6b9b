#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/mutation/classes.h"

namespace capstan::mutation {

/// What became of the edits of one class.
struct Row {
  Class of = {};
  int edits = 0;
  int same = 0;         ///< the machine does the same: by LinuxCNC's interpreter, or by what the class is
  int found = 0;        ///< with plan, program and table at hand
  int found_alone = 0;  ///< with program and table
  int dangerous_missed = 0, different_missed = 0, benign_blamed = 0;
  std::vector<std::string> told;  ///< of what went wrong: program, seed, what
};

struct Options {
  int edits = 4;  ///< of each class and program
  std::uint64_t first_seed = 1;
  bool whole = false;                ///< what is not found goes through the removal of stock, too
  bool planned = false;              ///< the planned plate, too: its program changes with the planner
  std::string dialect = "linuxcnc";  ///< of the programs; only LinuxCNC has an interpreter to ask
  bool by_interpreter = true;        ///< ask LinuxCNC's interpreter what it makes of benign and unknown edits
};

/// Edits every program by every class. Deterministic: the same options, the same rows.
[[nodiscard]] std::vector<Row> study(const Options& options);

}  // namespace capstan::mutation
