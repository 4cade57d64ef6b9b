#pragma once

#include <string>
#include <vector>

#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"

namespace capstan::service {

/// Which findings of a plan and its programs say what none before them said: what people are told, and what
/// the last line counts.
class Repeats {
 public:
  explicit Repeats(Verb verb) : verb_(verb) {}

  /// Asked of each finding once, those of the plan first. One of a program that repeats the plan's, but for
  /// the digits that a program rounds, says nothing, unless it names a line of a program that is there to be
  /// read (`check`). Programs are judged against the first plan.
  [[nodiscard]] bool is_new(const FileFinding& f);

 private:
  Verb verb_;
  std::vector<model::Finding> of_plan_;  ///< of the first plan's file
  std::string plan_file_;
};

}  // namespace capstan::service
