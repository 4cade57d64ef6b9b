#pragma once

#include <string>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/kept_outlines.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

/// Does a check; outlines that come again are made once in it. A stop before its end is an error finding,
/// whatever was found by then. `check` gives false where it said so itself.
template <class Check>
void check_to_its_end(const Job& job, Findings& findings, Check check) {
  geometry::KeptOutlines outlines;
  const geometry::KeptOutlinesScope scope(&outlines);
  stoppable(
      job,
      [&] {
        if (check()) poll();
      },
      [&] {
        findings.error(11, std::string(kStopped), {Findings::kWhole, "", -1},
                       "the check was stopped before its end: nothing is proven of what it had not reached");
      });
}

}  // namespace capstan::verify
