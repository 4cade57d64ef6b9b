#include "planner/files/json/tree/columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "planner/files/json/json.h"
#include "planner/ground/base/number.h"
#include "tests/support/paths/long_paths.h"

namespace capstan::json {
namespace {

std::vector<double> values(const Column& c) {
  std::vector<double> out(c.bytes.size() / sizeof(double));
  std::memcpy(out.data(), c.bytes.data(), c.bytes.size());
  return out;
}

std::string in_a_plan(const std::string& column) { return "{\"paths\":[{\"x\":[" + column + "]}]}"; }

std::string times(const std::string& number, std::size_t n) {
  std::string out = number;
  while (--n != 0) out += "," + number;
  return out;
}

TEST(Columns, AreReadToTheNearestDoubleHoweverTheyAreSpelled) {
  std::mt19937_64 random(7);
  std::string text;
  std::vector<double> expected;
  const auto add = [&](const std::string& number) {
    text += (expected.empty() ? "" : expected.size() % 3 == 0 ? " ,\n\t" : ",") + number;
    expected.push_back(std::strtod(number.c_str(), nullptr));
  };
  for (int i = 0; i < 20000; ++i) {
    const double v = std::ldexp(static_cast<double>(random() >> 11U), static_cast<int>(random() % 200) - 210);
    add(shortest(v));
    add("-" + std::to_string(random() % 1000000) + "." + std::to_string(random()));
    add(fixed(static_cast<double>(random() % 100000) / 1000.0, static_cast<int>(random() % 9)));
  }
  for (const char* n : {"0", "-0.0", "0.000000000000000000000000001", "1e22", "1E+23", "123456789012345.5",
                        "9007199254740993.0", "0.30000000000000004", "1.7976931348623157e308"})
    add(n);
  const Columns taken = take_columns(in_a_plan(text));
  ASSERT_EQ(taken.columns.size(), 1U);
  EXPECT_EQ(values(taken.columns[0]), expected);
  EXPECT_EQ(taken.columns[0].not_whole, 0U);
  EXPECT_EQ(taken.columns[0].array, 1U);
  // The line ends stay, so that faults behind the column are told where they are.
  const std::string lines(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), '\n');
  EXPECT_EQ(taken.rest, in_a_plan(lines));
}

// A text that is no column to its bracket asks for no memory of one, and its end is not looked for again and
// again.
TEST(Columns, OfALongTextThatIsNoneNothingIsTaken) {
  const std::string numbers = times("1", kLeastColumn + 1), commas(1 << 20, ',');
  std::string open = "{\"paths\":[{";  // each lowers the level with what it does not end with
  for (int i = 0; i < 100'000; ++i) open += "[" + numbers + ",x}";
  for (const std::string& text :
       {in_a_plan(numbers + commas), in_a_plan(numbers + ",\"" + commas + "\""), open + "]"}) {
    const Columns taken = take_columns(text);
    EXPECT_TRUE(taken.columns.empty());
    EXPECT_EQ(taken.rest, text);
  }
  EXPECT_EQ(take_columns(in_a_plan(numbers)).columns.at(0).bytes.size(), (kLeastColumn + 1) * sizeof(double));
}

TEST(Columns, KnowTheFirstNumberThatIsNotSpelledAsAWholeOne) {
  EXPECT_EQ(take_columns(in_a_plan(times("7", 20))).columns.at(0).not_whole, std::nullopt);
  EXPECT_EQ(take_columns(in_a_plan(times("7", 20) + ",2.0," + times("7", 20))).columns.at(0).not_whole, 20U);
}

TEST(Columns, AreLeftToTheGeneralParserWhereTheyAreNone) {
  for (const char* number : {"01", "1.", ".5", "+1", "1e", "1e999", "0x1", "nan", "1 2", "\"1\"", "[1]",
                             "null", "", "12345678901234567890"}) {
    const std::string text = in_a_plan(times("1.5", 20) + "," + number);
    const Columns taken = take_columns(text);
    EXPECT_TRUE(taken.columns.empty()) << number;
    EXPECT_EQ(taken.rest, text) << number;
  }
  // Too short, not at the columns' level, cut off, within a text.
  for (const std::string& text :
       {in_a_plan(times("1", kLeastColumn - 1)), "{\"paths\":[[" + times("1", 20) + "]]}",
        "{\"paths\":[{\"x\":[" + times("1", 20), "{\"a\":[[\"[[" + times("1", 20) + "]]\"]]}"}) {
    const Columns taken = take_columns(text);
    EXPECT_TRUE(taken.columns.empty()) << text;
    EXPECT_EQ(taken.rest, text);
  }
}

class LongPlan : public ::testing::Test {
 protected:
  static Result<model::Plan> read(const std::string& bytes) {
    Job job;
    return read_json(bytes, "plan.json", job);
  }
  static std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  }
  const model::Plan plan_ = capstan::testing::long_paths_plan(1200);
  const std::string bytes_ = write_json(plan_);
};

TEST_F(LongPlan, IsReadBackWhole) {
  const auto back = read(bytes_);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(*back->steps[0].path, *plan_.steps[0].path);
  EXPECT_EQ(*back->steps[0].schedule, *plan_.steps[0].schedule);
  EXPECT_EQ(*back->steps[0].sections, *plan_.steps[0].sections);
  EXPECT_EQ(write_json(*back), bytes_);
}

TEST_F(LongPlan, NamesThePlaceOfAFaultInAColumn) {
  const auto fault = [&](const std::string& what, const std::string& by) {
    const auto read_plan = read(replaced(bytes_, what, by));
    return read_plan ? "none" : read_plan.error().code + " " + read_plan.error().path;
  };
  EXPECT_EQ(fault("\"move\":[1,", "\"move\":[1.0,"), "JSON-VALUE /sections/0/move/0");
  EXPECT_EQ(fault("\"move\":[1,", "\"move\":[-1,"), "JSON-VALUE /sections/0/move/0");
  EXPECT_EQ(fault("\"move\":[1,", "\"move\":[4294967296,"), "JSON-VALUE /sections/0/move/0");
  EXPECT_EQ(fault("\"move\":[1,2,", "\"move\":[1,null,"), "JSON-VALUE /sections/0/move/1");
  EXPECT_EQ(fault("\"x\":[0,", "\"x\":["), "JSON-VALUE /paths/0");
  EXPECT_EQ(fault("\"x\":[0,", "\"x\":[1e999,"), "JSON-SYNTAX ");
  EXPECT_EQ(fault("\"x\":[0,", "\"x\":[00,"), "JSON-SYNTAX ");
}

TEST_F(LongPlan, TellsTheLineOfAFaultBehindColumns) {
  const auto good = static_cast<std::uint64_t>(std::count(bytes_.begin(), bytes_.end(), '\n'));
  std::string spread = replaced(bytes_, "\"x\":[0,", "\"x\":[0,\n\n\n");
  spread.replace(spread.rfind('}'), 1, "?");
  const auto read_plan = read(spread);
  ASSERT_FALSE(read_plan);
  EXPECT_EQ(read_plan.error().code, "JSON-SYNTAX");
  EXPECT_EQ(read_plan.error().line, good + 3);
}

}  // namespace
}  // namespace capstan::json
