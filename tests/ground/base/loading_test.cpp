// Libraries that are opened when they are needed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "planner/ground/base/loading/beside.h"
#include "planner/ground/base/loading/library.h"

namespace capstan {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Library, GivesTheFunctionsThatItHas) {
  const auto library = Library::open("libm.so.6");
  ASSERT_TRUE(library) << to_text(library.error());
  double (*root)(double) = nullptr;
  ASSERT_TRUE(library->take("sqrt", root));
  EXPECT_EQ(root(49.0), 7.0);
}

TEST(Library, SaysWhichFunctionItHasNot) {
  const auto library = Library::open("libm.so.6");
  ASSERT_TRUE(library);
  void (*none)() = nullptr;
  const Status taken = library->take("capstan_has_none", none);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, "LIB-OPEN");
  EXPECT_THAT(taken.error().message, HasSubstr("capstan_has_none"));
  EXPECT_EQ(none, nullptr);
}

TEST(Library, ThatIsNotThereIsNamed) {
  const auto library = Library::open("libcapstan_has_none.so.1");
  ASSERT_FALSE(library);
  EXPECT_EQ(library.error().code, "LIB-OPEN");
  EXPECT_THAT(library.error().message, HasSubstr("libcapstan_has_none.so.1"));
}

TEST(PlacesBeside, AreThoseOfTheProgramAndNoneOfTheWorkingFolder) {
  const auto own = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path("/");
  const auto places = places_beside("helper");
  std::filesystem::current_path(before);
  ASSERT_GE(places.size(), 2U);
  EXPECT_EQ(places[0], own / "helper");
  // Where libexec lies is the build's to say; the test of installing holds that.
  EXPECT_THAT(places[1], EndsWith("/capstan/helper"));
  EXPECT_NE(places[1], places[0]);
  for (const auto& place : places) {
    EXPECT_TRUE(std::filesystem::path(place).is_absolute()) << place;
    EXPECT_THAT(place, Not(HasSubstr("..")));
  }
}

TEST(PlacesBeside, AreFirstThoseOfTheLibraryThatAsks) {
  const auto own = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const auto library = Library::open(own / "apart" / "asks_beside.so");
  ASSERT_TRUE(library) << to_text(library.error());
  std::size_t (*ask)(const char* file, const char*(*places)[8]) = nullptr;
  ASSERT_TRUE(library->take("capstan_asks_beside", ask));
  const char* places[8] = {};
  const std::size_t count = ask("helper", &places);
  ASSERT_GE(count, 3U);
  EXPECT_EQ(places[0], own / "apart" / "helper");
  EXPECT_THAT(places[1], EndsWith("/capstan/helper"));
  EXPECT_EQ(places[2], own / "helper");
}

}  // namespace
}  // namespace capstan
