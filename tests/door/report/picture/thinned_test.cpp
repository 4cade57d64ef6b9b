#include "planner/door/report/picture/thinned.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::report::picture {
namespace {

using geometry::Vec2;

constexpr std::size_t kAny = 1'000'000;

double distance_to(const std::vector<Polyline>& lines, Vec2 p) {
  double out = 1e300;
  for (const Polyline& l : lines) {
    for (std::size_t i = 1; i < l.size(); ++i) {
      const Vec2 along = l[i] - l[i - 1];
      const double length = geometry::dot(along, along);
      const double t = length > 0.0 ? geometry::dot(p - l[i - 1], along) / length : 0.0;
      out = std::min(out, geometry::norm(p - (l[i - 1] + std::min(1.0, std::max(0.0, t)) * along)));
    }
  }
  return out;
}

std::size_t points_of(const std::vector<Polyline>& lines) {
  std::size_t n = 0;
  for (const Polyline& l : lines) n += l.size();
  return n;
}

TEST(Thinned, KeepsTheEndsOfAStraightLineAndTheCornersOfABentOne) {
  EXPECT_EQ(thinned({{{0, 0}, {1, 0}, {2, 0}, {3, 0}}}, kAny), (std::vector<Polyline>{{{0, 0}, {3, 0}}}));
  EXPECT_EQ(thinned({{{0, 0}, {5, 0}, {5, 1}, {5, 5}}}, kAny),
            (std::vector<Polyline>{{{0, 0}, {5, 0}, {5, 5}}}));
}

TEST(Thinned, KeepsWhereALineTurnsBack) {
  EXPECT_EQ(thinned({{{0, 0}, {5, 0}, {9, 0}, {4, 0}}}, kAny),
            (std::vector<Polyline>{{{0, 0}, {9, 0}, {4, 0}}}));
}

TEST(Thinned, LeavesOutWhatHasNoLength) {
  EXPECT_TRUE(thinned({{}, {{1, 1}}, {{2, 2}, {2, 2}, {2.01, 2}}}, kAny).empty());
}

TEST(Thinned, StaysWithinItsErrorOfEveryPointOfRandomLines) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    // Steps from far below the error to far above it.
    std::uniform_real_distribution<double> turn(-1.0, 1.0), size(-3.0, 1.0);
    Polyline line = {{0.0, 0.0}};
    double towards = 0.0;
    for (int i = 0; i < 300; ++i) {
      towards += turn(random);
      const double step = std::pow(10.0, size(random));
      line.push_back(line.back() + step * Vec2{std::cos(towards), std::sin(towards)});
    }
    const auto less = thinned({line}, kAny);
    ASSERT_LT(points_of(less), line.size()) << "seed " << seed;
    for (const Vec2 p : line) ASSERT_LE(distance_to(less, p), kThinning + 1e-9) << "seed " << seed;
  }
}

TEST(Thinned, OfAMillionPointsKeepsAsManyAsItIsAllowedAndDrawsTheSamePlaces) {
  // A raster of which each row is wavier than the error lets it be straight.
  std::vector<Polyline> raster;
  for (int row = 0; row < 500; ++row) {
    raster.emplace_back();
    for (int i = 0; i < 2000; ++i) raster.back().push_back({0.25 * i, row + 0.4 * std::sin(1.7 * i)});
  }
  const auto less = thinned(raster, 20'000);
  EXPECT_LE(points_of(less), 20'000U);
  EXPECT_GT(points_of(less), 2'000U);
  for (const Vec2 p : {Vec2{10.0, 3.0}, Vec2{250.0, 250.0}, Vec2{490.0, 480.0}})
    EXPECT_LT(distance_to(less, p), 20.0);
}

}  // namespace
}  // namespace capstan::report::picture
