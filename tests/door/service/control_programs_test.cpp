// Programs of shipped parts for controls, read back by the check.

#include <gtest/gtest.h>

#include <string>

#include "planner/controls/controls.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

model::Plan planned(const std::string& control, const std::string& part) {
  Request request;
  EXPECT_TRUE(set(request, "control", control));
  Job job;
  const auto out = plan(request, {.name = testing::source_dir() + "/examples/" + part}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error().what));
  return out ? out->plan : model::Plan{};
}

/// What the check has against the program of a plan; empty: nothing.
std::string blamed(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  if (!text) return to_text(text.error());
  std::string out;
  for (const auto& f :
       verify::check_program({"program", *text, ""}, &plan, plan.machine, plan.cutters, job)) {
    if (f.severity != Severity::kNote) out += f.code + " " + f.message + "\n";
  }
  return out;
}

// The check follows the plan's path in both: cycles make the moves that explicit ones are.
TEST(ControlPrograms, OfShippedPartsAreCleanWithCyclesAndWithExplicitMoves) {
  for (const char* control : {"siemens", "heidenhain"}) {
    for (const char* part : {"reference_pocket.p21", "bracket.p21", "two_setups.p21"}) {
      model::Plan plan = planned(control, part);
      ASSERT_FALSE(plan.steps.empty()) << part;
      EXPECT_EQ(blamed(plan), "") << control << " " << part;
      plan.machine.control_options = model::ControlOptions{{{"cycles", "explicit"}}};
      EXPECT_EQ(blamed(plan), "") << control << " " << part << ", explicit";
    }
  }
}

}  // namespace
}  // namespace capstan::service
