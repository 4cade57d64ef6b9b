#pragma once

#include <map>
#include <memory>

#include "planner/optimise/cut.h"
#include "planner/pipeline/work.h"

// The optimiser, asked once for each question, in all tries at a plan; only planner/pipeline/*.cpp include
// this.

namespace capstan::pipeline {

class Cuts {
 public:
  explicit Cuts(Work& w);
  Cuts(const Cuts&) = delete;
  Cuts& operator=(const Cuts&) = delete;
  [[nodiscard]] Result<optimise::CutAnswer> answer(const optimise::CutQuestion& q);
  /// As above; where a stated speed or feed that stays (StepWork::keep_speed) allows no cut within the limits
  /// and one of its own would, it is let go of, in `q` too, and `let_go` says what and why.
  [[nodiscard]] Result<optimise::CutAnswer> answer(const StepWork& step, optimise::CutQuestion& q,
                                                   std::string& let_go);

 private:
  Work& w_;
  optimise::Options options_;
  std::shared_ptr<CutsKnown> known_;
};

}  // namespace capstan::pipeline
