#include <gtest/gtest.h>

#include <algorithm>

#include "planner/door/pipeline/pipeline.h"
#include "tests/sweep/sweep.h"

// A thread mill of the library is a ring of teeth on a neck. Heights hold no groove, so that the check looks
// at the neck and takes off what the ring alone cuts.

namespace capstan::testing::sweep {
namespace {

/// M8 in C45, on a machine whose control does not synchronise spindle and feed.
const Outcome& milled_thread() {
  static const Outcome made = [] {
    Case c;
    for (std::size_t i = 0; i < features().size(); ++i)
      if (features()[i].name == "tapped hole") c.feature = i;
    c.material = 0;
    c.machine = 1;
    return Sweep().plan(c);
  }();
  return made;
}

bool has(const std::vector<model::Finding>& findings, const std::string& code) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const auto& f) { return f.code == code && f.severity == Severity::kError; });
}

/// What the check says of the plan with another neck behind the teeth.
std::vector<model::Finding> with_neck(double diameter_mm) {
  model::Plan plan = milled_thread().made.plan;
  for (model::Cutter& c : plan.cutters)
    if (c.cutter_class == model::CutterClass::kThreadMill) c.neck_diameter_mm = diameter_mm;
  Job quiet;
  return pipeline::checked(std::move(plan), quiet).findings;
}

TEST(ThreadMill, MakesAThreadWhereTheMachineDoesNotTap) {
  const Outcome& o = milled_thread();
  ASSERT_TRUE(o.failed.empty()) << o.failed;
  ASSERT_TRUE(o.whole()) << o.made.plan.unplanned.front().reason;
  EXPECT_TRUE(std::any_of(o.made.plan.cutters.begin(), o.made.plan.cutters.end(),
                          [](const auto& c) { return c.cutter_class == model::CutterClass::kThreadMill; }));
  for (const auto& f : o.findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(ThreadMill, WhoseNeckDoesNotPassTheCoreIsFound) {
  EXPECT_FALSE(has(with_neck(3.4), "CHK-NECK"));
  // Its path leaves the axis by (8 - 5.3) / 2 mm; the core is 6.75 mm wide, so that 4.05 mm would pass.
  EXPECT_TRUE(has(with_neck(5.3), "CHK-NECK"));
}

TEST(ThreadMill, WhoseNeckIsNotStatedCutsWithAllOfItsLength) {
  EXPECT_TRUE(has(with_neck(0.0), "CHK-FLUTE"));
}

}  // namespace
}  // namespace capstan::testing::sweep
