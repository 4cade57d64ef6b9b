#include "planner/files/exchange/ap238/tables/measure.h"

#include <cmath>

#include "planner/files/p21/read/parse.h"
#include "tests/files/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {
namespace {

/// The unit of instance `id`, and how many instances were looked at for it.
std::pair<std::optional<FileUnit>, std::size_t> unit_in(const std::string& instances, std::uint64_t id) {
  Job job;
  const auto file = p21::parse(file_of(instances), "test.stpnc", {}, job);
  EXPECT_TRUE(file) << to_text(file.error());
  if (!file) return {};
  const Graph graph(*file, express::Dictionary::ap238());
  Units units(graph);
  auto out = units.unit(graph.find(id));
  return {out, units.used().size()};
}

TEST(Units, EachPartIsWorkedOutOnce) {
  // Twelve levels of derived units with eight elements each, all of them the level below: 8^12 ways down.
  constexpr int kLevels = 12, kWide = 8;
  std::string text = "#1=(NAMED_UNIT(*)RATIO_UNIT());\n";
  for (int level = 1; level <= kLevels; ++level) {
    std::string elements;
    for (int k = 0; k < kWide; ++k) {
      const std::string e = "#" + std::to_string(100 * level + k);
      text += e + "=DERIVED_UNIT_ELEMENT(#" + std::to_string(level) + ",1.);\n";
      elements += (k == 0 ? "" : ",") + e;
    }
    text += "#" + std::to_string(level + 1) + "=DERIVED_UNIT((" + elements + "));\n";
  }
  const auto [unit, used] = unit_in(text, kLevels + 1);
  ASSERT_TRUE(unit);
  EXPECT_EQ(*unit, FileUnit{});
  EXPECT_EQ(used, 1U + kLevels * (1U + kWide));
}

TEST(Units, OfWhichOneIsAPartOfItselfAreNone) {
  const auto [unit, used] = unit_in(
      "#1=(CONVERSION_BASED_UNIT('a',#2)LENGTH_UNIT()NAMED_UNIT(*));\n"
      "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#3);\n"
      "#3=(CONVERSION_BASED_UNIT('b',#4)LENGTH_UNIT()NAMED_UNIT(*));\n"
      "#4=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#1);\n",
      1);
  EXPECT_FALSE(unit);
  EXPECT_LE(used, 4U);
}

}  // namespace
}  // namespace capstan::exchange::ap238
