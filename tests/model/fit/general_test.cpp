#include "planner/model/features/fit/general.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace capstan::model {
namespace {

GeneralTolerance read(const std::string& text) {
  const auto g = parse_general(text);
  EXPECT_TRUE(g) << text << ": " << (g ? "" : to_text(g.error()));
  return g.value_or(GeneralTolerance{});
}

struct Published {
  const char* text;
  double nominal, value;
};

// ISO 2768-1:1989, table 1: one size within each range, and the ranges' ends for class m.
TEST(General, GivesThePublishedDeviationsOfLinearSizes) {
  const std::vector<Published> kTable{
      {"ISO 2768-f", 0.5, 0.05},  {"ISO 2768-f", 5, 0.05},   {"ISO 2768-f", 20, 0.1},
      {"ISO 2768-f", 100, 0.15},  {"ISO 2768-f", 250, 0.2},  {"ISO 2768-f", 700, 0.3},
      {"ISO 2768-f", 1500, 0.5},  {"ISO 2768-m", 0.5, 0.1},  {"ISO 2768-m", 3, 0.1},
      {"ISO 2768-m", 6, 0.1},     {"ISO 2768-m", 6.01, 0.2}, {"ISO 2768-m", 30, 0.2},
      {"ISO 2768-m", 30.01, 0.3}, {"ISO 2768-m", 120, 0.3},  {"ISO 2768-m", 120.01, 0.5},
      {"ISO 2768-m", 400, 0.5},   {"ISO 2768-m", 1000, 0.8}, {"ISO 2768-m", 2000, 1.2},
      {"ISO 2768-m", 4000, 2},    {"ISO 2768-c", 2, 0.2},    {"ISO 2768-c", 5, 0.3},
      {"ISO 2768-c", 20, 0.5},    {"ISO 2768-c", 100, 0.8},  {"ISO 2768-c", 250, 1.2},
      {"ISO 2768-c", 700, 2},     {"ISO 2768-c", 1500, 3},   {"ISO 2768-c", 3000, 4},
      {"ISO 2768-v", 5, 0.5},     {"ISO 2768-v", 20, 1},     {"ISO 2768-v", 100, 1.5},
      {"ISO 2768-v", 250, 2.5},   {"ISO 2768-v", 700, 4},    {"ISO 2768-v", 1500, 6},
      {"ISO 2768-v", 3000, 8}};
  for (const Published& p : kTable)
    EXPECT_EQ(general_size(read(p.text), p.nominal), p.value) << p.text << p.nominal;
  EXPECT_FALSE(general_size(read("ISO 2768-f"), 3000));
  EXPECT_FALSE(general_size(read("ISO 2768-v"), 3));
  EXPECT_FALSE(general_size(read("ISO 2768-m"), 0.49)) << "stands beside the size";
  EXPECT_FALSE(general_size(read("ISO 2768-m"), 4001));
}

// ISO 2768-2:1989, tables 1 and 2.
TEST(General, GivesThePublishedGeometricTolerances) {
  const std::vector<Published> kFlat{
      {"ISO 2768-mH", 10, 0.02}, {"ISO 2768-mH", 30, 0.05},  {"ISO 2768-mH", 100, 0.1},
      {"ISO 2768-mH", 300, 0.2}, {"ISO 2768-mH", 1000, 0.3}, {"ISO 2768-mH", 3000, 0.4},
      {"ISO 2768-mK", 10, 0.05}, {"ISO 2768-mK", 30, 0.1},   {"ISO 2768-mK", 100, 0.2},
      {"ISO 2768-mK", 300, 0.4}, {"ISO 2768-mK", 1000, 0.6}, {"ISO 2768-mK", 3000, 0.8},
      {"ISO 2768-mL", 10, 0.1},  {"ISO 2768-mL", 30, 0.2},   {"ISO 2768-mL", 100, 0.4},
      {"ISO 2768-mL", 300, 0.8}, {"ISO 2768-mL", 1000, 1.2}, {"ISO 2768-mL", 3000, 1.6}};
  for (const Published& p : kFlat)
    EXPECT_EQ(general_flatness(read(p.text), p.nominal), p.value) << p.text << p.nominal;
  const std::vector<Published> kSquare{
      {"ISO 2768-mH", 100, 0.2},  {"ISO 2768-mH", 300, 0.3},  {"ISO 2768-mH", 1000, 0.4},
      {"ISO 2768-mH", 3000, 0.5}, {"ISO 2768-mK", 100, 0.4},  {"ISO 2768-mK", 300, 0.6},
      {"ISO 2768-mK", 1000, 0.8}, {"ISO 2768-mK", 3000, 1},   {"ISO 2768-mL", 100, 0.6},
      {"ISO 2768-mL", 300, 1},    {"ISO 2768-mL", 1000, 1.5}, {"ISO 2768-mL", 3000, 2}};
  for (const Published& p : kSquare)
    EXPECT_EQ(general_perpendicularity(read(p.text), p.nominal), p.value) << p.text << p.nominal;
}

TEST(General, ReadsWhatDrawingsSay) {
  EXPECT_EQ(read("ISO 2768-mK").text, "ISO 2768-mK");
  EXPECT_EQ(read("DIN ISO 2768 - m").text, "ISO 2768-m");
  EXPECT_EQ(read("ISO 2768-1:1989-f").text, "ISO 2768-f");
  EXPECT_EQ(read("iso 2768-K").geometry_class, 'K');
  EXPECT_EQ(read("ISO 22081:2021 0,2").profile_mm, 0.2);
  EXPECT_EQ(general_size(read("ISO 22081 0.2"), 50), 0.1) << "half the zone";
  EXPECT_EQ(general_flatness(read("ISO 22081 0.2"), 50), 0.2);
  EXPECT_EQ(general_size(read("ISO 22081 +-0.15"), 50), 0.15);
  EXPECT_EQ(general_size(read("\xc2\xb1"
                              "0.1 mm"),
                         7),
            0.1);
  EXPECT_EQ(general_size(read("+/- 0,05"), 7), 0.05);
}

TEST(General, RefusesOtherTextWithWhatItUnderstands) {
  for (const char* text : {"",
                           "m",
                           "ISO",
                           "ISO 2768",
                           "ISO 2768-",
                           "ISO 2768-x",
                           "ISO 2768-mKK",
                           "ISO 2768-M",
                           "ISO 22081",
                           "ISO 22081 -0.2",
                           "ISO 22081 0",
                           "+-",
                           "+-0",
                           "+-1e3",
                           "+-nan",
                           "+-11",
                           "0.1",
                           "ISO +-0.1",
                           "+-0.1.2",
                           "ISO 8015",
                           "+-0.1 inch"}) {
    const auto g = parse_general(text);
    ASSERT_FALSE(g) << text;
    EXPECT_EQ(g.error().code, "MDL-GENERAL");
    EXPECT_NE(g.error().expected.find("ISO 2768-m"), std::string::npos);
  }
}

}  // namespace
}  // namespace capstan::model
