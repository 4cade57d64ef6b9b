#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "casebase/retain/executed.h"
#include "casebase/retain/lines.h"

/// What the tests of logs share: a log as text, split into steps.
namespace capstan::casebase::retain {

struct Split {
  Result<LogEnd> end;
  std::vector<Executed> steps;
  std::vector<Diagnostic> said;
};

inline Split split_trace(const std::string& text, SplitOptions options = {}) {
  std::istringstream in(text);
  Job job;
  Splitter splitter(std::move(options));
  auto end = read_trace(
      in, "log", kTraceUnits, [&](const Reading& r) { splitter.take(r); }, job);
  return {std::move(end), splitter.end(), job.take_diagnostics()};
}

inline Split split_table(const std::string& text, SplitOptions options = {.runs_unless_said = true},
                         const std::vector<std::string>& columns = {}, LogUnits units = {}) {
  std::istringstream in(text);
  Job job;
  Splitter splitter(std::move(options));
  auto end = read_table(
      in, "log.csv", units, columns, [&](const Reading& r) { splitter.take(r); }, job);
  return {std::move(end), splitter.end(), job.take_diagnostics()};
}

inline bool says(const std::vector<Diagnostic>& said, const std::string& code) {
  return std::any_of(said.begin(), said.end(), [&](const Diagnostic& d) { return d.code == code; });
}

}  // namespace capstan::casebase::retain
