// Plans held against a control's profile by the check, and by planning.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/door/service/check.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

using namespace ::testing;

Outcome<CheckResult> plate_for(const std::string& profile) {
  Request request;
  EXPECT_TRUE(set(request, "profile", profile));
  Job job;
  return check(request, {{.name = testing::source_dir() + "/examples/plate_bound.p21"}}, {}, job);
}

TEST(CheckProfile, SaysWhatTheControlCannotDoAndWhatThePlanDoesNotSay) {
  const auto result = plate_for("grbl_alone");
  ASSERT_TRUE(result) << to_text(result.error().what);
  std::vector<std::string> codes;
  for (const auto& f : result->findings) codes.push_back(f.finding.code);
  EXPECT_THAT(codes, IsSupersetOf({"FIT-OPEN", "FIT-TOOL-CHANGE", "FIT-TOLERANCE"}));
  EXPECT_FALSE(result->clean());
}

TEST(CheckProfile, AnUnknownControlIsWrongUsage) {
  const auto result = plate_for("grlb");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Code::kUsage);
  EXPECT_THAT(to_text(result.error().what), HasSubstr("grbl"));
}

// The figure of the machine's file is LinuxCNC's; no word of a program of Fanuc or Mach3 states it, one of
// Haas's does.
TEST(PlanForAControl, ThatCannotStateItsToleranceIsWarnedOfOnce) {
  for (const char* control : {"fanuc", "haas", "siemens", "heidenhain", "grbl", "mach3"}) {
    Request request;
    EXPECT_TRUE(set(request, "control", control));
    Job job;
    const auto planned =
        plan(request, {.name = testing::source_dir() + "/examples/reference_pocket.p21"}, job);
    ASSERT_TRUE(planned) << to_text(planned.error().what);
    const auto assumed = std::count_if(planned->findings.begin(), planned->findings.end(),
                                       [](const model::Finding& f) { return f.code == "FIT-TOLERANCE"; });
    const bool states_none = std::string(control) == "fanuc" || std::string(control) == "mach3";
    EXPECT_EQ(assumed, states_none ? 1 : 0) << control;
    // Nobody named a machine: whose the program is made for is said.
    const auto all = job.diagnostics();
    EXPECT_EQ(std::count_if(all.begin(), all.end(),
                            [](const Diagnostic& d) {
                              return d.code == "SHOP-MACHINE" &&
                                     d.message.find("generic_vmc") != std::string::npos;
                            }),
              1)
        << control;
  }
}

}  // namespace
}  // namespace capstan::service
