#pragma once

#include <array>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::app {

/// The path of each object: the shortest from the project, attributes in their order, so that it is the same
/// for one plan in any form; `/KEYWORD[i]` for what the project does not reach.
class Paths {
 public:
  explicit Paths(const model::Plan& plan);
  [[nodiscard]] std::string of(model::AnyRef at) const;

 private:
  struct From {
    model::AnyRef object;
    std::string step;  ///< "/its_elements[2]"; empty: not reached
  };
  [[nodiscard]] const From& from(model::AnyRef at) const;
  const model::Plan& plan_;
  std::array<std::vector<From>, model::kTypeCount> from_;
};

}  // namespace capstan::app
