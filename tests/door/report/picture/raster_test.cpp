#include "planner/door/report/picture/raster.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/door/report/picture/glyphs.h"

namespace capstan::report::picture {
namespace {

constexpr Colour kBlack{0, 0, 0};

template <class... Shapes>
Pixels drawn(Shapes... shapes) {
  Drawing d{.width = 20.0, .height = 10.0};
  d.groups.push_back({.shapes = {shapes...}});
  return pixels_of(d);
}
int red_at(const Pixels& p, std::size_t x, std::size_t y) { return p.rgb[3 * (y * p.wide + x)]; }
/// How many pixels are covered, in parts of one.
double covered(const Pixels& p) {
  double out = 0.0;
  for (std::size_t i = 0; i < p.rgb.size(); i += 3) out += (255.0 - p.rgb[i]) / 255.0;
  return out;
}

TEST(Raster, IsOfTheStatedSizeAndWhiteWhereNothingIsDrawn) {
  const Pixels p = drawn();
  EXPECT_EQ(p.wide, 40U);
  EXPECT_EQ(p.high, 20U);
  EXPECT_EQ(p.rgb, std::vector<std::uint8_t>(3 * 40 * 20, 255));
}

TEST(Raster, CoversTheAreaOfWhatIsFilled) {
  const Polyline square = {{1.0, 1.0}, {5.0, 1.0}, {5.0, 4.0}, {1.0, 4.0}};
  const Pixels p = drawn(Lines{.lines = {square}, .closed = true, .fill = kBlack});
  EXPECT_DOUBLE_EQ(covered(p), 8.0 * 6.0);
  EXPECT_EQ(red_at(p, 2, 2), 0);
  EXPECT_EQ(red_at(p, 1, 2), 255);
  EXPECT_EQ(red_at(p, 9, 7), 0);
  EXPECT_EQ(red_at(p, 10, 7), 255);
  // A quarter unit further to the right, half of each pixel at its sides.
  Polyline shifted = square;
  for (auto& q : shifted) q.x += 0.25;
  EXPECT_EQ(red_at(drawn(Lines{.lines = {shifted}, .closed = true, .fill = kBlack}), 2, 3), 128);
}

TEST(Raster, LeavesAHoleInAnAreaEmpty) {
  const Pixels p =
      drawn(Lines{.lines = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{3, 3}, {6, 3}, {6, 6}, {3, 6}}},
                  .closed = true,
                  .fill = kBlack});
  EXPECT_EQ(red_at(p, 8, 8), 255);
  EXPECT_DOUBLE_EQ(covered(p), 4.0 * (100.0 - 9.0));
}

TEST(Raster, DrawsALineAlongItsPixelsInItsColour) {
  const Pixels p =
      drawn(Lines{.lines = {{{2.0, 4.0}, {18.0, 4.0}}}, .stroke = Colour{255, 0, 0}, .width = 1.0});
  const std::size_t at = 3 * (8 * p.wide + 20);
  EXPECT_EQ(p.rgb[at], 255);
  EXPECT_EQ(p.rgb[at + 1], 0);
  EXPECT_EQ(p.rgb[3 * (4 * p.wide + 20) + 1], 255);
}

TEST(Raster, LeavesGapsInADashedLine) {
  const Lines line{.lines = {{{0.0, 4.0}, {20.0, 4.0}}}, .stroke = kBlack, .width = 1.0, .dashed = true};
  const Pixels p = drawn(line);
  EXPECT_EQ(red_at(p, 4, 8), 0);     // within the first dash of 4 units
  EXPECT_EQ(red_at(p, 11, 8), 255);  // within the gap of 3 units that follows
  EXPECT_EQ(red_at(p, 18, 8), 0);
}

TEST(Raster, CoversTheAreaOfADot) {
  const Pixels p = drawn(Dots{.at = {{10.0, 5.0}}, .radius = 4.0, .fill = kBlack});
  EXPECT_NEAR(covered(p) / (std::numbers::pi * 64.0), 1.0, 0.01);
}

TEST(Raster, KeepsWithinTheSheetWhateverIsDrawn) {
  const Pixels p = drawn(Lines{.lines = {{{-1e6, -1e6}, {1e6, 1e6}, {-500.0, 3.0}}},
                               .closed = true,
                               .fill = kBlack,
                               .stroke = kBlack},
                         Dots{.at = {{-3.0, 400.0}}, .radius = 50.0, .fill = kBlack},
                         Words{.at = {-20.0, 3.0}, .text = "beyond the sheet", .colour = kBlack});
  EXPECT_GT(covered(p), 0.0);
}

TEST(Raster, WritesTextOfDotsFromItsBaseLineUp) {
  // An I: three dots, five in the middle, three.
  const Pixels p = drawn(Words{.at = {1.0, 8.0}, .text = "I", .colour = kBlack});
  EXPECT_DOUBLE_EQ(covered(p), 4.0 * (7.0 + 2.0 + 2.0));
  EXPECT_EQ(red_at(p, 2 + 2 * 2, 2 * 1), 0);      // its upper end, 7 dots above the base line
  EXPECT_EQ(red_at(p, 2 + 2 * 2, 2 * 8 - 1), 0);  // the dot on the base line
  EXPECT_EQ(red_at(p, 2 + 2 * 2, 2 * 8), 255);
  const Pixels end = drawn(Words{.at = {7.0, 8.0}, .text = "I", .colour = kBlack, .ends_there = true});
  EXPECT_EQ(end.rgb, p.rgb);
}

TEST(Glyphs, TellEveryPrintableCharacterFromTheOthers) {
  std::string all;
  for (char c = ' '; c < 127; ++c) all += c;
  const auto glyphs = glyphs_of(all);
  ASSERT_EQ(glyphs.size(), 95U);
  for (std::size_t i = 0; i < glyphs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(glyphs[i], glyphs[k]) << all[i] << " and " << all[k];
}

TEST(Glyphs, ShowOneBoxForAnyOtherCharacterOrByte) {
  const auto glyphs = glyphs_of("\xC3\x98\xFF\n");
  ASSERT_EQ(glyphs.size(), 3U);
  for (const Glyph& g : glyphs) EXPECT_EQ(g, (Glyph{0x7F, 0x41, 0x41, 0x41, 0x7F}));
}

}  // namespace
}  // namespace capstan::report::picture
