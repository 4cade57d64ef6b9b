#pragma once

#include <string>

#include "planner/ground/base/number.h"

// Names of one tool at several diameters: a boring head that is set to them, a mill that has worn. The size
// stands behind the name of the library: "boring_head@20.5".

namespace capstan::model {

inline constexpr char kBeforeSize = '@';

[[nodiscard]] inline std::string name_without_size(const std::string& id) {
  return id.substr(0, id.find(kBeforeSize));
}

[[nodiscard]] inline std::string name_with_size(const std::string& id, double diameter_mm) {
  return name_without_size(id) + kBeforeSize + trimmed(diameter_mm, 4);
}

}  // namespace capstan::model
