#include "planner/ground/base/memory/large_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace capstan {
namespace {

TEST(LargePages, MemoryThatIsAskedForKeepsWhatStandsInIt) {
  std::string text = "before";
  text.reserve(3 * kLargePage + 1);  // begins and ends within a page
  ask_for_large_pages(text.data(), text.capacity());
  text.resize(3 * kLargePage, 'x');
  EXPECT_EQ(text.substr(0, 7), "beforex");
  EXPECT_EQ(std::count(text.begin(), text.end(), 'x'), static_cast<std::ptrdiff_t>(text.size()) - 6);
}

TEST(LargePages, NothingAndLittleAreLeftAsTheyAre) {
  ask_for_large_pages(nullptr, 4 * kLargePage);
  std::string text(100, 'x');
  ask_for_large_pages(text.data(), text.size());
  EXPECT_EQ(text, std::string(100, 'x'));
}

}  // namespace
}  // namespace capstan
