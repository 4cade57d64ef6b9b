#include "planner/physics/engagement/front.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "planner/physics/engagement/engagement.h"

namespace capstan::engagement {
namespace {

using geometry::Vec3;

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kBall = 5.0, kCell = 0.1, kLayer = 0.25;
/// Chips of a layer on a level floor, over the feed: sin(acos(1 - t / R)).
const double kOfLayer = std::sqrt(1.0 - (1.0 - kLayer / kBall) * (1.0 - kLayer / kBall));

/// A piece of 60 x 60, so high at x.
stock::HeightMap piece(const std::function<double(double x)>& height) {
  auto map = stock::from_box({{0, 0, -40}, {60, 60, 0}}, kCell);
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const auto h = static_cast<float>(height(map.x_of(ix)) - map.origin.z);
      map.set(ix, iy, {h, h, 0.0F});
    }
  }
  return map;
}

model::Cutter ball() {
  model::Cutter c;
  c.id = "ball";
  c.cutter_class = model::CutterClass::kBallEndmill;
  c.cutting_diameter_mm = 2.0 * kBall;
  c.maximum_depth_of_cut_mm = 30.0;
  return c;
}

/// The thickest chip, over the feed, on a way along a slope that takes a layer square to it; `way` 1: towards
/// +x, where the surface rises by `slope`.
double on_slope(double slope_rad, double way) {
  const double rise = std::tan(slope_rad);
  auto map = piece([&](double x) { return -20.0 + rise * (x - 30.0); });
  // The tip of a ball that touches a slope, less the layer, both square to it.
  const auto tip = [&](double x) {
    const double z = -20.0 + rise * (x - 30.0) + (kBall - kLayer) / std::cos(slope_rad) - kBall;
    return Vec3{x, 30.0, z};
  };
  model::CutterPath path;
  path.start(tip(30.0 - 8.0 * way));
  path.line(tip(30.0 + 8.0 * way), model::MoveRole::kCut);
  const auto m = measure(path, ball(), map);
  EXPECT_TRUE(m.has_value());
  // The middle of the way, where the cut is even.
  return m->engagement.at(m->engagement.size() / 2).chip_over_feed;
}

TEST(ChipOverFeed, OfALayerOnASlopeIsThatOnALevelFloorUpAndDownHill) {
  for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
    for (const double way : {1.0, -1.0}) {
      const double chip = on_slope(degrees * kRad, way);
      // Never thinner than the truth; the doubt of a cell is on it, which a slope stretches.
      EXPECT_GT(chip, kOfLayer) << degrees << " degrees, " << way;
      EXPECT_LT(chip, kOfLayer + 2.0 * kCell / kBall) << degrees << " degrees, " << way;
    }
  }
}

TEST(ChipOverFeed, OfARibAsHighAsTheBallIsTheWholeFeed) {
  const auto map = piece([](double x) { return x > 34.0 && x < 36.0 ? -10.0 : -20.0; });
  const auto nose = round_nose(geometry::ball_profile(2.0 * kBall, 30.0));
  ASSERT_TRUE(nose.has_value());
  const double chip = chip_over_feed(map, *nose, {30.5, 30.0, -20.0}, {1.0, 0.0, 0.0});
  EXPECT_GT(chip, 0.95);
  EXPECT_LE(chip, 1.0);
  EXPECT_EQ(chip_over_feed(map, *nose, {20.0, 30.0, -20.0}, {1.0, 0.0, 0.0}), 0.0);  // in air
}

/// The same by a look at every cell of the map, without any bound.
double over_all_cells(const stock::HeightMap& map, const RoundNose& nose, Vec3 tip, Vec3 feed) {
  double most = 0.0;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const double x = map.x_of(ix) - tip.x, y = map.y_of(iy) - tip.y;
      const double away = std::hypot(x, y);
      const double sine = std::max(0.0, away - nose.centre_mm) / nose.round_mm;
      if (sine > 1.0) continue;
      const double cosine = std::sqrt(1.0 - sine * sine);
      const double stands = static_cast<double>(map.at(ix, iy).top_mm) + map.origin.z - tip.z - 1e-3;
      if (stands <= nose.round_mm * (1.0 - cosine)) continue;
      const double towards = away > 0.0 ? (x * feed.x + y * feed.y) / away : 0.0;
      most = std::max(most, sine * towards - cosine * feed.z);
    }
  }
  return most;
}

TEST(ChipOverFeed, IsTheLargestOfAllCellsWhateverStandsAndWhereverTheFeedGoes) {
  std::mt19937 random(7);
  const auto number = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  const double radius = 3.0, cell = 0.1;
  int some = 0;
  for (int nth = 0; nth < 4000; ++nth) {
    auto map = stock::from_box({{0, 0, -10}, {8, 8, 0}}, cell);
    // A level piece with holes, steps or bumps, so that the thickest place lies anywhere.
    const double a = number(0.0, 7.0), b = number(0.0, 7.0), step = number(0.0, 2.0);
    const int kind = nth % 4;
    for (int iy = 0; iy < map.ny; ++iy) {
      for (int ix = 0; ix < map.nx; ++ix) {
        double h = number(5.0, 5.2);
        if (kind == 1)
          h = std::cos(a) * (map.x_of(ix) - 4.0) + std::sin(a) * (map.y_of(iy) - b) > 0.0 ? 7.0 : 5.0;
        if (kind == 2) h = std::hypot(map.x_of(ix) - a, map.y_of(iy) - b) < 1.0 + step ? 4.0 : 6.0;
        if (kind == 3) h = number(0.0, 1.0) < 0.01 ? number(5.0, 8.0) : 3.0;
        map.set(ix, iy, {static_cast<float>(h), static_cast<float>(h), 0.0F});
      }
    }
    const RoundNose nose =
        nth % 8 < 4 ? RoundNose{radius, radius, 0.0} : RoundNose{radius, 0.8, radius - 0.8};
    const Vec3 tip{number(0.0, 8.0), number(0.0, 8.0), -10.0 + number(4.5, 5.5)};
    const double way = nth % 5 == 0 ? 0.5 * std::numbers::pi * (nth % 4) : number(0.0, 7.0);
    const double rise = nth % 3 == 0 ? 0.0 : number(-1.5, 1.5);
    const Vec3 feed{std::cos(way) * std::cos(rise), std::sin(way) * std::cos(rise), std::sin(rise)};
    const double all = over_all_cells(map, nose, tip, feed);
    double ceiling = 0.0;
    for (const float top : map.top) ceiling = std::max(ceiling, static_cast<double>(top));
    ceiling += map.origin.z;
    EXPECT_NEAR(chip_over_feed(map, nose, tip, feed), all, 1e-9) << nth;
    EXPECT_NEAR(chip_over_feed(map, nose, tip, feed, ceiling), all, 1e-9) << nth;
    const double known = number(0.0, 1.0);
    EXPECT_NEAR(chip_over_feed(map, nose, tip, feed, ceiling, known), std::max(known, all), 1e-9) << nth;
    some += all > 0.0 ? 1 : 0;
  }
  EXPECT_GT(some, 2000);
}

TEST(ChipOverFeed, IsMeasuredOfRoundNosesOnly) {
  EXPECT_FALSE(round_nose(geometry::flat_profile(10.0, 20.0)).has_value());
  EXPECT_FALSE(round_nose(geometry::cone_profile(10.0, 1.5, 20.0)).has_value());
  const auto bull = round_nose(geometry::bull_profile(10.0, 1.0, 20.0));
  ASSERT_TRUE(bull.has_value());
  EXPECT_EQ(bull->centre_mm, 4.0);
  EXPECT_EQ(bull->round_mm, 1.0);
}

}  // namespace
}  // namespace capstan::engagement
