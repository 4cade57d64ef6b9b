#include "planner/physics/mechanics/life/arc_speed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace capstan::mechanics {
namespace {

using model::Substrate;

constexpr double kDiameter = 10.0;

double carbide(double share, const char* group = "P") {
  return speed_by_arc(share * kDiameter, kDiameter, Substrate::kCarbide, group);
}

// Dormer Pramet, milling catalogue 2021-22, p. 114, shoulder milling, x.v.
constexpr std::array<std::pair<double, double>, 8> kCatalogue = {{{0.05, 1.48},
                                                                  {0.10, 1.35},
                                                                  {0.15, 1.27},
                                                                  {0.20, 1.22},
                                                                  {0.25, 1.19},
                                                                  {0.30, 1.16},
                                                                  {0.40, 1.11},
                                                                  {0.50, 1.00}}};

TEST(SpeedByArc, IsTheCataloguesInSteelStainlessAndCastIron) {
  for (const char* group : {"P", "M", "K"}) {
    for (const auto& [width, speed] : kCatalogue) EXPECT_NEAR(carbide(width, group), speed, 1e-9) << width;
  }
}

TEST(SpeedByArc, IsLinearBetweenTheCataloguesWidths) {
  for (std::size_t i = 1; i < kCatalogue.size(); ++i) {
    const auto& [w0, v0] = kCatalogue[i - 1];
    const auto& [w1, v1] = kCatalogue[i];
    EXPECT_NEAR(carbide(0.5 * (w0 + w1)), 0.5 * (v0 + v1), 1e-9);
  }
}

TEST(SpeedByArc, NeverExceedsThatOfTheNarrowestTabled) { EXPECT_NEAR(carbide(0.001), 1.48, 1e-9); }

TEST(SpeedByArc, IsTheTablesFromHalfTheDiameterToASlot) {
  for (const double width : {kWholeSpeedWidth, 0.65, 1.0}) EXPECT_EQ(carbide(width), 1.0) << width;
}

// Tungaloy, general catalogue 2020-2021, p. 1084, middle of the speeds for widths from 40 %, of 10 to 40 %, and
// of 5 to 10 % of the diameter: hardened steel 25, 50, 60 m/min; titanium alloys 35, 50, 60 m/min.
TEST(SpeedByArc, RisesLessThanACataloguesInHardSteelAndTitanium) {
  struct {
    const char* group;
    double wide, middle, narrow;
  } rows[] = {{"H", 25.0, 50.0, 60.0}, {"S", 35.0, 50.0, 60.0}};
  for (const auto& [group, wide, middle, narrow] : rows) {
    EXPECT_GT(carbide(0.2, group), 1.0);
    for (const double width : {0.10, 0.15, 0.2, 0.3, 0.4}) EXPECT_LE(carbide(width, group), middle / wide);
    for (const double width : {0.05, 0.07, 0.09}) EXPECT_LE(carbide(width, group), narrow / wide);
  }
}

// Heliyon 6 (2020) e04217: life of an edge in Ti6Al4V as vc^-4 ae^-1, at 10 to 70 % of the diameter.
TEST(SpeedByArc, LeavesAnEdgeInTitaniumTheLifeThatWasMeasured) {
  for (int i = 10; i <= 70; ++i) {
    const double width = 0.01 * i, vc = carbide(width, "S");
    EXPECT_GE(std::pow(vc, -4.0) / width, (width < kWholeSpeedWidth ? 0.98 : 0.7) / kWholeSpeedWidth) << width;
  }
}

TEST(SpeedByArc, IsTheTablesInAluminiumWithoutAGroupAndWithHss) {
  EXPECT_EQ(carbide(0.05, "N"), 1.0);
  EXPECT_EQ(carbide(0.05, ""), 1.0);
  EXPECT_EQ(speed_by_arc(0.5, kDiameter, Substrate::kHss, "P"), 1.0);
}

TEST(SpeedByArc, IsTheTablesWhereNoWidthIsKnown) {
  EXPECT_EQ(carbide(0.0), 1.0);
  EXPECT_EQ(speed_by_arc(1.0, 0.0, Substrate::kCarbide, "P"), 1.0);
}

}  // namespace
}  // namespace capstan::mechanics
