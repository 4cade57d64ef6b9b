// Plans held against a control's profile by the check.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/door/service/check.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

using namespace ::testing;

Outcome<CheckResult> plate_for(const std::string& profile) {
  Request request;
  request.profile = profile;
  Job job;
  return check(request, {{.name = testing::source_dir() + "/examples/plate_bound.p21"}}, {}, job);
}

TEST(CheckProfile, SaysWhatTheControlCannotDoAndWhatThePlanDoesNotSay) {
  const auto result = plate_for("grbl");
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

}  // namespace
}  // namespace capstan::service
