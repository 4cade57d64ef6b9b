#pragma once

#include <utility>
#include <vector>

#include "planner/ground/base/job.h"

namespace capstan {

/// Reports at the end of a scope what was said before it, whatever ends it.
class SaidBefore {
 public:
  explicit SaidBefore(Job& job) : job_(job), said_(job.take_diagnostics()) {}
  ~SaidBefore() {
    auto now = job_.take_diagnostics();
    for (auto& d : said_) job_.report(std::move(d));
    for (auto& d : now) job_.report(std::move(d));
  }
  SaidBefore(const SaidBefore&) = delete;
  SaidBefore& operator=(const SaidBefore&) = delete;

 private:
  Job& job_;
  std::vector<Diagnostic> said_;
};

}  // namespace capstan
