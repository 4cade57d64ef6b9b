#pragma once

#include <vector>

#include "capstan/capstan.h"
#include "planner/ground/base/job.h"

namespace capstan::facade {

/// A diagnostic as callers have it.
[[nodiscard]] inline PlanMessage message(const Diagnostic& d) {
  return {to_text(d.severity), d.code, to_text(d)};
}

/// All that a job said, behind what is there.
inline void tell(const Job& job, std::vector<PlanMessage>& diagnostics) {
  for (const Diagnostic& d : job.diagnostics()) diagnostics.push_back(message(d));
}

}  // namespace capstan::facade
