#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::linuxcnc {

/// What `capstan plan` made of a part: the plan read back, and the files written.
struct Planned {
  std::string failed;  ///< what the command said when it did not succeed; empty: it did
  model::Plan plan;
  std::string program, tools;
};

/// Runs the built command: `capstan plan ARGUMENTS -o ...`. Names of files are relative to the source folder.
[[nodiscard]] Planned plan(const std::vector<std::string>& arguments);

}  // namespace capstan::linuxcnc
