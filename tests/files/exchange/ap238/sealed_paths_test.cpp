#include "planner/files/exchange/records/seal.h"

#include "tests/files/exchange/ap238/support.h"
#include "tests/support/paths/long_paths.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A file of 1,200 points, whose points, lines and paths are sealed as they are printed.
struct SealOfLongPaths : ::testing::Test {
  model::Plan plan = capstan::testing::long_paths_plan(1200);
  std::string text = written(plan).bytes;
  std::vector<std::string> said;

  /// Replaces the first `from` behind `behind`.
  void edit(const std::string& behind, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from, text.find(behind));
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  }
  double read_sum() { return capstan::testing::sum_of_paths(read_text(text, &said)); }
};

TEST_F(SealOfLongPaths, IsThatOfTheFileParsed) {
  std::string unsealed;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    if (text.compare(at, 13, "!CAPSTAN_SEAL") != 0) unsealed.append(text, at, end - at);
    at = end;
  }
  ASSERT_LT(unsealed.size(), text.size());
  const auto sealed = with_seal(unsealed);
  ASSERT_TRUE(sealed.has_value());
  EXPECT_EQ(*sealed, text);
}

TEST_F(SealOfLongPaths, HoldsForTheFileAsItWasWritten) {
  EXPECT_EQ(read_sum(), capstan::testing::sum_of_paths(plan));
  EXPECT_THAT(said, Not(Contains(HasSubstr("EXC-EDITED"))));
}

TEST_F(SealOfLongPaths, HoldsWhereAPointIsSpelledOtherwise) {
  edit("=CARTESIAN_POINT('',(", "(", " ( /* here */ ");
  edit("\n!CAPSTAN_PATH(", ",(", ", ( ");
  edit("=POLYLINE(", "#", "#00");
  EXPECT_EQ(read_sum(), capstan::testing::sum_of_paths(plan));
  EXPECT_THAT(said, Not(Contains(HasSubstr("EXC-EDITED"))));
}

TEST_F(SealOfLongPaths, HoldsWhereTheLastParenthesesStandApart) {
  edit("=CARTESIAN_POINT('',(", "));", ") ) ;");
  EXPECT_EQ(read_sum(), capstan::testing::sum_of_paths(plan));
  EXPECT_THAT(said, Not(Contains(HasSubstr("EXC-EDITED"))));
}

TEST_F(SealOfLongPaths, DoesNotHoldWhereAPointWasMoved) {
  edit("=CARTESIAN_POINT('',(", "',(", "',(1");
  read_sum();
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("EXC-EDITED"), HasSubstr("CARTESIAN_POINT"))));
}

TEST_F(SealOfLongPaths, DoesNotHoldWhereALineLeavesAPointOut) {
  edit("=POLYLINE('',(", "(#", "(#1,#");
  read_sum();
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("EXC-EDITED"), HasSubstr("POLYLINE"))));
}

TEST_F(SealOfLongPaths, DoesNotHoldWhereTheExactPathWasChanged) {
  edit("\n!CAPSTAN_PATH(", "',", "1',");
  read_sum();
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("EXC-EDITED"), HasSubstr("!CAPSTAN_PATH"))));
}

}  // namespace
}  // namespace capstan::exchange::ap238
