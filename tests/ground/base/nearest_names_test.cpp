#include "planner/ground/base/nearest_names.h"

#include <gtest/gtest.h>

namespace capstan {
namespace {

TEST(EditDistance, CountsEachChangeOfALetterOnce) {
  EXPECT_EQ(edit_distance("steel", "steel"), 0u);
  EXPECT_EQ(edit_distance("steeel", "steel"), 1u);  // one out
  EXPECT_EQ(edit_distance("stel", "steel"), 1u);    // one in
  EXPECT_EQ(edit_distance("stael", "steel"), 1u);   // one replaced
  EXPECT_EQ(edit_distance("setel", "steel"), 1u);   // two neighbours exchanged
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("EN AW-6061", "enaw6061"), 0u);  // case and punctuation do not count
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
      "error: unknown material 'steeel'. Did you mean 'mild steel'?; `capstan materials list` shows all "
      "[NAME-UNKNOWN]");
  EXPECT_EQ(unknown_name("machine", "lathe", {"mill"}, "capstan machines list").message,
            "unknown machine 'lathe'");
}

}  // namespace
}  // namespace capstan
