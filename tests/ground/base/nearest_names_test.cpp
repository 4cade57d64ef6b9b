#include "planner/ground/base/nearest_names.h"

#include <gtest/gtest.h>

namespace capstan {
namespace {

// "steel" is one edit away from each at most; "brass" more than half of the letters.
TEST(NearestNames, CountsEachChangeOfALetterOnce) {
  for (const char* asked : {"steel", "steeel", "stel", "stael", "setel", "S-T.E e L"}) {
    const auto near = nearest_names(asked, {"brass", "steel"});
    ASSERT_EQ(near.size(), 1U) << asked;
    EXPECT_EQ(near[0], "steel") << asked;
  }
  // Of three letters at most one may be wrong: half of them, whole.
  EXPECT_EQ(nearest_names("abc", {"abd"}).size(), 1U);
  EXPECT_TRUE(nearest_names("abc", {"ade"}).empty());
  // Of two, the one of fewer edits comes first, whatever their order.
  EXPECT_EQ(nearest_names("steell", {"stool", "steel"}).front(), "steel");
}

TEST(NearestNames, FindsWhatWasMeantNearestFirst) {
  const std::vector<std::string> known = {"generic_vmc", "small_router", "tormach_1100mx", "big_router"};
  EXPECT_EQ(nearest_names("smal_router", known), (std::vector<std::string>{"small_router", "big_router"}));
  EXPECT_EQ(nearest_names("smal_router", known, 1), std::vector<std::string>{"small_router"});
  EXPECT_TRUE(nearest_names("lathe", known).empty());
}

TEST(NearestNames, AWordOfALongerNameIsNearToo) {
  EXPECT_EQ(nearest_names("steeel", {"brass", "mild steel"}), std::vector<std::string>{"mild steel"});
}

TEST(UnknownName, SaysTheNearestAndHowToListThem) {
  const Diagnostic d = unknown_name("material", "steeel", {"mild steel", "brass"}, "capstan materials list");
  EXPECT_EQ(
      to_text(d),
      "error: unknown material 'steeel'. Did you mean 'mild steel'? `capstan materials list` shows all "
      "[NAME-UNKNOWN]");
  EXPECT_EQ(unknown_name("machine", "lathe", {"mill"}, "capstan machines list").message,
            "unknown machine 'lathe'");
}

}  // namespace
}  // namespace capstan
