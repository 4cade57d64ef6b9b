#pragma once

#include <utility>
#include <vector>

#include "planner/ground/base/job.h"

namespace capstan {

/// Takes the diagnostics reported so far and puts them back, before those of its scope, when the scope ends.
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
