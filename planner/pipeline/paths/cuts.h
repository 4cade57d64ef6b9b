#pragma once

#include <map>
#include <memory>

#include "planner/optimise/cut.h"
#include "planner/pipeline/work.h"

// The optimiser, asked once for each question; only planner/pipeline/*.cpp include this.

namespace capstan::pipeline {

class Cuts {
 public:
  explicit Cuts(Work& w);
  ~Cuts();
  Cuts(const Cuts&) = delete;
  Cuts& operator=(const Cuts&) = delete;
  [[nodiscard]] Result<optimise::CutAnswer> answer(const optimise::CutQuestion& q);

 private:
  struct Known;
  Work& w_;
  optimise::Options options_;
  std::unique_ptr<Known> known_;
};

}  // namespace capstan::pipeline
