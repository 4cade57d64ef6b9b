#pragma once

#include <string>
#include <vector>

#include "tests/validation/freecad/rivals.h"

// The record of roughing on LinuxCNC's simulated machine: lines of part, material, path, measured and
// predicted seconds, as capstan_rival_times writes them.

namespace capstan::validation {

/// The path of our own plan.
inline constexpr const char* kOurs = "ours";

struct SimulatedRoughing {
  std::string part, material, path;
  double measured_s = 0.0, predicted_s = 0.0;
};

/// "pocket 10 mm", "with boss, 20 mm".
[[nodiscard]] std::string part_name(const RivalCase& c);

/// Empty for a text that is no such record.
[[nodiscard]] std::vector<SimulatedRoughing> simulated_of(const std::string& text);
[[nodiscard]] std::string text_of(const std::vector<SimulatedRoughing>& record);

}  // namespace capstan::validation
