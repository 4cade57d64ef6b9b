#pragma once

#include <string>

#include "capstan/capstan.h"
#include "tests/removal/drawing.h"
#include "tests/removal/simulation/compare.h"

namespace capstan::testing::removal {

/// A part twice: as a file for the planner, and as what must come out of it, both from the drawing's numbers.
struct Part {
  std::string name;
  std::string text;  ///< ISO 14649
  Box block;
  Target target;
  Grid grid = {};
  PlanOptions options = {};
};

/// A block from the underside at z = -height to a raw top `raw` above z = 0, its corner at x = y = 0.
[[nodiscard]] Box block(double length_x, double width_y, double height, double raw = 0.0);
/// What is left of a block when all above z = 0 is gone.
[[nodiscard]] Depth body(const Box& block);

struct Outcome {
  PlanOutput plan;
  Verdict verdict;  ///< empty when there is no program
  [[nodiscard]] bool written() const { return !plan.linuxcnc.empty(); }
  /// Findings, unplanned features, verdict: one line each.
  [[nodiscard]] std::string text() const;
};

/// Plans a part and simulates what was written. Where CAPSTAN_REMOVAL_KEEP names a folder, file and program
/// are left there.
[[nodiscard]] Outcome plan_and_simulate(const Part& part);

/// What the forms of a plan say when they are read: the same program each. Empty where they do.
[[nodiscard]] std::string lost_in_a_form(const Part& part, const PlanOutput& plan);

}  // namespace capstan::testing::removal
