#include "planner/making/step/record/grouped_reasons.h"

#include <gtest/gtest.h>

namespace capstan::step {
namespace {

TEST(GroupedReasons, SayOnceWhatIsTheSameForMany) {
  GroupedReasons r;
  r.add("em10", "it is too short");
  r.add("em12", "it is too wide");
  r.add("em8", "it is too short");
  EXPECT_EQ(r.text(), "em10: it is too short, the same for 1 more cutter; em12: it is too wide");
  r.add("em6", "it is too short");
  EXPECT_EQ(r.text(), "em10: it is too short, the same for 2 more cutters; em12: it is too wide");
}

}  // namespace
}  // namespace capstan::step
