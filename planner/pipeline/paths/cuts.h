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

 private:
  Work& w_;
  optimise::Options options_;
  std::shared_ptr<CutsKnown> known_;
};

}  // namespace capstan::pipeline
