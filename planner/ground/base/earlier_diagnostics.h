#pragma once

#include <utility>
#include <vector>

#include "planner/ground/base/job.h"

namespace capstan {

/// Reports at the end of a scope what was said before it, whatever ends it.
class EarlierDiagnostics {
 public:
  explicit EarlierDiagnostics(Job& job) : job_(job), said_(job.take_diagnostics()) {}
  ~EarlierDiagnostics() {
    auto now = job_.take_diagnostics();
    for (auto& d : said_) job_.report(std::move(d));
    for (auto& d : now) job_.report(std::move(d));
  }
  EarlierDiagnostics(const EarlierDiagnostics&) = delete;
  EarlierDiagnostics& operator=(const EarlierDiagnostics&) = delete;

 private:
  Job& job_;
  std::vector<Diagnostic> said_;
};

}  // namespace capstan
