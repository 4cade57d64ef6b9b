#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"

// A plunge in steady material is swept as one: what it says is what it says step by step.

namespace capstan::engagement {
namespace {

using model::CutterClass;

model::Cutter cutter(CutterClass kind, double diameter, double corner = 0.0) {
  model::Cutter c;
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 40.0;
  if (kind == CutterClass::kTwistDrill) c.point_angle_rad = 118.0 * std::numbers::pi / 180.0;
  return c;
}

constexpr double kTop = 10.0, kStep = 0.25;

model::CutterPath down(geometry::Vec2 at, double to, bool in_one) {
  model::CutterPath p;
  p.start({at.x, at.y, 12.0});
  const int n = static_cast<int>(std::lround((12.0 - to) / kStep));
  for (int k = in_one ? n : 1; k <= n; ++k) p.line({at.x, at.y, 12.0 - kStep * k}, model::MoveRole::kDrill);
  return p;
}

/// A block 30 x 30 x 10 mm that stands on z = 0, with steps of whole cells that plunges meet or not.
stock::HeightMap block(std::mt19937& random) {
  auto map = stock::from_box({{0, 0, 0}, {30, 30, kTop}}, 0.12);
  std::uniform_int_distribution<int> place(0, map.nx - 1);
  std::uniform_real_distribution<float> height(1.0F, 9.5F);
  for (int n = 0; n < 3; ++n) {
    const int x0 = place(random), y0 = place(random);
    const float z = height(random);
    for (int iy = y0; iy < std::min(map.ny, y0 + 60); ++iy)
      for (int ix = x0; ix < std::min(map.nx, x0 + 60); ++ix) map.set(ix, iy, {z, z, 0.0F});
  }
  return map;
}

TEST(PlungeProperty, OneMoveHasTheSectionsAndTheStockOfItsSteps) {
  std::mt19937 random(20261130);
  std::uniform_real_distribution<double> place(-2.0, 32.0), end(-4.0, 9.0);
  const model::Cutter cutters[] = {cutter(CutterClass::kTwistDrill, 6.6), cutter(CutterClass::kEndmill, 6.0),
                                   cutter(CutterClass::kBallEndmill, 8.0, 4.0),
                                   cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0)};
  std::size_t steady = 0;
  for (int round = 0; round < 60; ++round) {
    const model::Cutter& c = cutters[round % 4];
    const geometry::Vec2 at{place(random), place(random)};
    const double to = 12.0 - kStep * std::round((12.0 - end(random)) / kStep);
    auto one = block(random);
    auto many = one;
    const auto whole = measure(down(at, to, true), c, one, {.step_mm = kStep});
    const auto steps = measure(down(at, to, false), c, many, {.step_mm = kStep});
    ASSERT_TRUE(whole && steps);
    ASSERT_EQ(whole->sections.size(), steps->sections.size()) << round;
    EXPECT_NEAR(whole->removed_mm3, steps->removed_mm3, 1e-5 * steps->removed_mm3);
    for (std::size_t k = 0; k < whole->sections.size(); ++k) {
      const auto& a = whole->sections;
      const auto& b = steps->sections;
      EXPECT_NEAR(a.csa_mm2[k], b.csa_mm2[k], 2e-5 * std::abs(b.csa_mm2[k]) + 1e-9);
      EXPECT_NEAR(a.rd_max_mm[k], b.rd_max_mm[k], 1e-5);
      EXPECT_NEAR(a.x_cg_ofs_mm[k], b.x_cg_ofs_mm[k], 1e-4);
      EXPECT_NEAR(a.y_cg_ofs_mm[k], b.y_cg_ofs_mm[k], 1e-4);
      steady += k > 0 && std::abs(b.csa_mm2[k] - b.csa_mm2[k - 1]) < 1e-4 ? 1 : 0;
    }
    // At a rim that covers next to nothing of a cell steps gather until they count, and look taller then.
    const auto tallest = [](const model::SectionSeries& s) {
      return s.ad_max_mm.empty() ? 0.0 : *std::max_element(s.ad_max_mm.begin(), s.ad_max_mm.end());
    };
    EXPECT_LE(tallest(whole->sections), tallest(steps->sections) + 1e-5);
    for (std::size_t i = 0; i < one.cells(); ++i) {
      const auto a = one.at(i), b = many.at(i);
      ASSERT_NEAR(a.mean(), b.mean(), 1e-4) << round << " cell " << i;
    }
  }
  EXPECT_GT(steady, 200U);  // the property has looked at what it is about
}

// In an even block the sections of a plunge are known: the whole disc, from the tip of a flat cutter up by a
// step.
TEST(Plunge, InAnEvenBlockEachStepOfAFlatCutterIsItsDiscAStepHigh) {
  auto map = stock::from_box({{0, 0, 0}, {30, 30, kTop}}, 0.05);
  const auto m =
      measure(down({15.01, 14.98}, 2.0, true), cutter(CutterClass::kEndmill, 6.0), map, {.step_mm = kStep});
  ASSERT_TRUE(m);
  ASSERT_EQ(m->sections.size(), 32U);
  for (std::size_t k = 0; k < m->sections.size(); ++k) {
    const auto& s = m->sections;
    EXPECT_NEAR(s.at_mm[k], 2.0 + kStep * static_cast<double>(k + 1), 1e-9);
    EXPECT_NEAR(s.csa_mm2[k], 9.0 * std::numbers::pi, 0.01);
    EXPECT_NEAR(s.rd_max_mm[k], 6.0, 0.06);
    EXPECT_NEAR(s.y_cg_ofs_mm[k], 0.5 * kStep, 1e-3);
    EXPECT_NEAR(m->engagement[k].step_mm, kStep, 1e-9);
    // Where the rim covers next to nothing of a cell two steps count as one.
    EXPECT_GE(s.ad_max_mm[k], kStep - 1e-5);
    EXPECT_LE(s.ad_max_mm[k], 2.0 * kStep + 1e-5);
    EXPECT_NEAR(s.y_max_ofs_mm[k], 0.5 * kStep, 0.5 * kStep + 1e-5);
  }
}

}  // namespace
}  // namespace capstan::engagement
