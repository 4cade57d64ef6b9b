#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/door/service/session.h"
#include "tests/door/late/brought.h"

// What a control says of its running machine, by the options that C and `capstan bind` share.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;

/// A part bound with one option more.
struct Bound {
  service::Code code = service::Code::kFault;
  std::string message, program;
  double machining_s = 0.0;
};
Bound bound(const std::string& option, const std::string& value, const std::string& part = kPlate,
            const std::string& tools = kMagazine) {
  service::Session session;
  Bound out;
  (void)session.set("tools", tools);
  if (!option.empty() && session.set(option, value) != service::Code::kDone)
    return {session.code(), session.message(), {}, 0.0};
  out.code = session.bind(testing::slurp(part), std::chrono::hours(1));
  out.message = session.message();
  if (const std::string* program = session.output("linuxcnc")) out.program = *program;
  out.machining_s = session.machining_s();
  return out;
}

TEST(LateState, OfASpindleThatMayGiveLessTheStepsTakeLonger) {
  const std::string part = testing::source_dir() + "/examples/bracket.p21";
  const std::string tools = testing::scratch_file("bracket.tbl");
  std::ofstream(tools) << brought(part, pipeline::Format::kJson).table;
  const Bound whole = bound({}, {}, part, tools), less = bound("spindle-power", "1.5", part, tools);
  ASSERT_EQ(whole.code, service::Code::kDone) << whole.message;
  ASSERT_EQ(less.code, service::Code::kDone) << less.message;
  EXPECT_GT(less.machining_s, whole.machining_s);
}

TEST(LateState, AnOverrideAboveTheWholeFeedIsRefusedAndALowerOneIsTold) {
  EXPECT_EQ(bound("feed-override", "120").code, service::Code::kUsage);
  const Bound lower = bound("feed-override", "50");
  ASSERT_EQ(lower.code, service::Code::kDone) << lower.message;
  EXPECT_THAT(lower.message, HasSubstr("50 % of the programmed feeds"));
  EXPECT_EQ(lower.program, bound({}, {}).program);
}

}  // namespace
}  // namespace capstan::late
