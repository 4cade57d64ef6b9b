#pragma once

#include <gtest/gtest.h>

#include <string>

#include "planner/controls/linuxcnc/linuxcnc.h"
#include "tests/support/empty_plan.h"
#include "tests/support/rs274.h"

/// Programs of plans, and what the interpreter makes of them.
namespace capstan::controls::linuxcnc {

using model::CutterPath;
using model::MoveRole;
using model::Plan;
using testing::Rs274Run;

inline constexpr double kCanonUnit = 1e-4;  // the interpreter prints four decimals

inline std::string program_of(const Plan& plan) {
  Job job;
  const auto text = kDialect.write_program(plan, job, {});
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

inline Rs274Run run(const Plan& plan) { return testing::run_rs274(write_tool_table(plan), program_of(plan)); }

/// A square with a rounded corner, a helix, a full circle, a diagonal rapid: 3 mm deep.
inline CutterPath contour() {
  CutterPath p;
  p.start({-12, -12, 5});
  p.rapid({-12, -12, 1});
  p.line({-12, -12, -3}, MoveRole::kPlunge);
  p.line({50.123456, -12, -3}, MoveRole::kCut);
  p.arc({60.123456, -2, -3}, {50.123456, -2}, false, MoveRole::kCut);
  p.line({60.123456, 40, -3}, MoveRole::kCut);
  p.arc({60.123456, 40, -5}, {50.123456, 40}, true, MoveRole::kRamp);
  p.arc({60.123456, 40, -5}, {50.123456, 40}, false, MoveRole::kCut);
  p.line({-12, 40, -5}, MoveRole::kCut);
  p.rapid({-12, 40, 5}, MoveRole::kRetract);
  return p;
}

}  // namespace capstan::controls::linuxcnc
