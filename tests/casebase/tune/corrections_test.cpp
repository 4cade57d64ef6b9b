#include "casebase/tune/corrections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::casebase::tune {
namespace {

constexpr ForceHandbook kSteel{.kc11_n_mm2 = 1800.0, .mc = 0.2, .spread = 1.5};

/// Forces of a material 25 % softer than the handbook's, mc 0.25, edges that differ by 5 %.
std::vector<ForceSample> soft(std::size_t edges, std::size_t each) {
  std::mt19937 random(3);
  std::normal_distribution<double> z;
  std::vector<ForceSample> out;
  for (std::size_t e = 0; e < edges; ++e) {
    const double edge = std::exp(0.05 * z(random));
    for (std::size_t i = 0; i < each; ++i) {
      const double h = 0.02 * std::pow(1.4, static_cast<double>(i));
      out.push_back({h, 1350.0 * std::pow(h, -0.25) * edge * std::exp(0.03 * z(random)), e});
    }
  }
  return out;
}

TEST(WearAfter, IsTheCurveOfLifeOf) {
  std::vector<WearReading> readings;
  for (const double t : {4.0, 8.0, 12.0, 20.0}) readings.push_back({t, 0.05 * std::pow(t / 2.0, 0.8)});
  const auto life = life_of(readings, 0.3);
  ASSERT_TRUE(life);
  EXPECT_NEAR(wear_after(readings, *life).value(), 0.3, 1e-9);
  EXPECT_FALSE(wear_after(std::vector<WearReading>{{1.0, 0.01}}, 5.0))
      << "less than the scatter of a reading";
  EXPECT_FALSE(wear_after({}, 5.0));
}

TEST(CorrectForce, FindsTheCoefficientsOfTheCuts) {
  const auto c = correct_force(soft(12, 6), kSteel);
  ASSERT_TRUE(c);
  const double h = 0.05;
  EXPECT_NEAR(c->kc11_n_mm2 * std::pow(h, -c->mc) / (1350.0 * std::pow(h, -0.25)), 1.0, 0.05);
  EXPECT_NEAR(c->mc, 0.25, 0.03);
}

TEST(CorrectForce, WithoutCasesThereIsNone) { EXPECT_FALSE(correct_force({}, kSteel)); }

TEST(CorrectForce, TheSpreadNarrowsWithEdgesNotWithCopies) {
  const double one = correct_force(soft(1, 6), kSteel)->spread;
  const double many = correct_force(soft(12, 6), kSteel)->spread;
  EXPECT_LT(many, one);
  EXPECT_LT(one, kSteel.spread);
  std::vector<ForceSample> copies(1000, soft(1, 1).front());
  EXPECT_GT(correct_force(copies, kSteel)->spread, many);
}

TEST(CorrectForce, NarrowsTheMarginInTheRootSumOfSquares) {
  mechanics::ForceMargin margin{.spread = kSteel.spread, .override_up = 1.2};
  const double handbook = margin.factor();
  const auto c = correct_force(soft(12, 6), kSteel);
  margin.spread = c->spread;
  EXPECT_LT(margin.factor(), handbook);
  // Wear and override stay: the margin never falls below theirs.
  EXPECT_GT(margin.factor(), std::exp(std::hypot(std::log(margin.wear), std::log(margin.override_up))));
}

TEST(CorrectForce, APoisonedForceIsDoubted) {
  std::vector<ForceSample> samples = soft(12, 6);
  samples.push_back({0.05, 135.0, 99});  // ten times too low
  const auto c = correct_force(samples, kSteel);
  EXPECT_EQ(c->how.doubted, 1U);
  EXPECT_NEAR(c->kc11_n_mm2 / correct_force(soft(12, 6), kSteel)->kc11_n_mm2, 1.0, 0.02);
}

TEST(CorrectLife, FindsTaylorsExponentAndKeepsWhatDoesNotVary) {
  const model::ToolLifeLaw handbook{
      .substrate = "carbide", .v0_m_min = 150.0, .life_min = 15.0, .n = 0.25, .q = 2.0, .source = {}};
  std::vector<LifeSample> samples;
  for (std::size_t i = 0; i < 16; ++i) {
    const double v = 100.0 + 10.0 * static_cast<double>(i);
    samples.push_back({v, 0.1, 2.0, 25.0 * std::pow(v / 150.0, -3.0), i});
  }
  const auto c = correct_life(samples, handbook);
  ASSERT_TRUE(c);
  EXPECT_NEAR(1.0 / c->law.n, 3.0, 0.2);
  EXPECT_NEAR(c->law.life_min, 25.0, 1.5);
  EXPECT_NEAR(c->law.q, 2.0, 1e-6);
  EXPECT_LT(c->law.scatter, 0.3);
}

/// Lives of a law with 1/p 0.5 and 1/q 1, at two feeds and two depths.
std::vector<LifeSample> lives(double life_min, std::size_t material) {
  std::vector<LifeSample> out;
  for (const double feed : {0.1, 0.2})
    for (const double depth : {1.0, 2.0})
      out.push_back({150.0, feed, depth, life_min * std::pow(feed / 0.1, -0.5) / depth,
                     out.size() + 10 * material, material});
  return out;
}

TEST(CorrectLife, OtherMaterialsTellExponentsAndNoLife) {
  const model::ToolLifeLaw handbook{.substrate = "carbide",
                                    .v0_m_min = 150.0,
                                    .life_min = 15.0,
                                    .h0_mm = 0.1,
                                    .a0_mm = 1.0,
                                    .n = 0.25,
                                    .source = {}};
  // Of the own material at one feed and depth alone; the others live a tenth and ten times as long.
  const std::vector<LifeSample> own = {
      {150.0, 0.1, 1.0, 15.0, 0}, {150.0, 0.1, 1.0, 15.0, 1}, {150.0, 0.1, 1.0, 15.0, 2}};
  const auto alone = correct_life(own, handbook);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->law.p, 0.0);  // nothing tells it
  std::vector<LifeSample> all = lives(1.5, 1);
  all.insert(all.end(), own.begin(), own.end());
  for (const LifeSample& s : lives(150.0, 2)) all.push_back(s);
  const auto c = correct_life(all, handbook);
  ASSERT_TRUE(c);
  EXPECT_NEAR(1.0 / c->law.p, 0.5, 0.1);
  EXPECT_NEAR(1.0 / c->law.q, 1.0, 0.15);
  EXPECT_NEAR(c->law.life_min, 15.0, 0.2);
  EXPECT_EQ(c->how.cases, 3U);
  EXPECT_EQ(c->how.groups, 3U);
  EXPECT_TRUE(c->beyond.empty());
  ASSERT_TRUE(c->how.left_out);
  ASSERT_EQ(c->how.left_out->each.size(), 3U);
  EXPECT_NEAR(c->how.left_out->each[0].predicted, std::log(15.0), 0.05);
  EXPECT_FALSE(correct_life(lives(150.0, 2), handbook)) << "none of the handbook's material";
}

TEST(LifeOf, IsReadOffACurveThroughAllReadings) {
  std::vector<WearReading> readings;
  for (double t = 2.0; t <= 30.0; t += 2.0) readings.push_back({t, 0.3 * std::pow(t / 20.0, 0.6)});
  ASSERT_TRUE(life_of(readings, 0.3));
  EXPECT_NEAR(*life_of(readings, 0.3), 20.0, 0.5);
  readings[9].wear_mm = 3.0;  // a wrong reading just where the limit is
  EXPECT_NEAR(*life_of(readings, 0.3), 20.0, 1.0);
}

TEST(LifeOf, IsNotToldOfAnEdgeThatWasNotWornOut) {
  EXPECT_FALSE(life_of(std::vector<WearReading>{{2.0, 0.1}, {4.0, 0.15}, {6.0, 0.2}}, 0.3));
  EXPECT_FALSE(life_of({}, 0.3));
}

TEST(CorrectTime, ShortBlocksTakeLonger) {
  std::vector<TimeSample> samples;
  for (std::size_t i = 0; i < 20; ++i) {
    const double block = 0.02 * std::pow(1.3, static_cast<double>(i));
    samples.push_back({100.0, 100.0 * (1.0 + 0.02 / block), block, i});
  }
  const auto c = correct_time(samples);
  ASSERT_TRUE(c);
  EXPECT_GT(c->factor(0.03), 1.3);
  EXPECT_LT(c->factor(1.0), 1.1);
  EXPECT_GT(c->ln_std_dev(0.03), 0.0);
}

/// Bores by cutters of stick-outs of 3 and 6 D at three feeds: 0.02 mm too small, and 0.01 mm wider for
/// every 0.05 mm per turn at 4 D, which grow with the feed and the cube of the stick-out.
std::vector<BoreSample> bent() {
  std::vector<BoreSample> out;
  for (std::size_t i = 0; i < 18; ++i) {
    const double feed = 0.02 * static_cast<double>(1 + i % 3), ratio = i % 2 == 0 ? 3.0 : 6.0;
    out.push_back({-0.02 + 0.01 * (feed / 0.05) * std::pow(ratio / 4.0, 3.0), feed, ratio, i});
  }
  return out;
}

TEST(CorrectBores, GrowWithTheFeedAndTheCubeOfTheStickOut) {
  const auto c = correct_bores(bent());
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->deviation_mm(0.02, 3.0), -0.02 + 0.01 * 0.4 * 0.421875, 0.001);
  // Of a stick-out that no part was cut with.
  EXPECT_NEAR(c->deviation_mm(0.06, 9.0), -0.02 + 0.01 * 1.2 * 11.390625, 0.001);
  EXPECT_GT(c->std_dev_mm(0.06, 6.0), 0.0);
}

TEST(CorrectBores, OfSlenderCuttersAreAsUncertainAsTheyScatter) {
  std::vector<BoreSample> samples = bent();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].stick_out_ratio > 4.0) samples[i].deviation_mm += i % 4 == 1 ? 0.1 : -0.1;
  }
  const auto c = correct_bores(samples);
  ASSERT_TRUE(c);
  EXPECT_GT(c->half_90_mm(0.04, 6.0), 0.1);
  EXPECT_LT(c->half_90_mm(0.04, 3.0), 0.05);
}

TEST(CorrectBores, OfFewPartsHaveAnIntervalOfStudentsT) {
  std::vector<BoreSample> samples;
  for (std::size_t i = 0; i < 4; ++i) samples.push_back({0.001 * static_cast<double>(i), 0.05, 4.0, i});
  const auto c = correct_bores(samples);
  ASSERT_TRUE(c);
  // Of 3 degrees of freedom: 2.353 (Abramowitz and Stegun, table 26.10).
  EXPECT_NEAR(c->half_90_mm(0.05, 4.0) / c->std_dev_mm(0.05, 4.0), 2.353, 0.01);
}

TEST(CorrectBores, OfOnePartAreNoPartsOfTheirOwn) {
  std::vector<BoreSample> samples;
  for (std::size_t i = 0; i < 40; ++i) {
    samples.push_back(
        {0.001 * static_cast<double>(i % 5), 0.05, i % 2 == 0 ? 3.0 : 6.0, i % 4 < 2 ? 0U : 1U});
  }
  samples.push_back({0.002, 0.05, 3.0, 2U});
  const auto c = correct_bores(samples);
  ASSERT_TRUE(c);
  // Three parts: 2 degrees of freedom, 2.920 (Abramowitz and Stegun, table 26.10).
  EXPECT_NEAR(c->half_90_mm(0.05, 3.0) / c->std_dev_mm(0.05, 3.0), 2.920, 0.01);
  EXPECT_NEAR(c->half_90_mm(0.05, 6.0) / c->std_dev_mm(0.05, 6.0), 2.920, 0.01);
}

TEST(CorrectBores, OfOneSlendernessSayLittleOfASlenderOne) {
  std::vector<BoreSample> samples;
  for (std::size_t i = 0; i < 8; ++i) samples.push_back({-0.02, 0.05, 3.0, i});
  const auto c = correct_bores(samples);
  ASSERT_TRUE(c);
  EXPECT_LT(c->half_90_mm(0.05, 3.0), 0.05);
  // What bending does is not known: 0.1 mm at 4 D, 1.6 mm at 10 D.
  EXPECT_GT(c->half_90_mm(0.05, 10.0), 1.0);
}

TEST(Corrected, MaterialCarriesTheCoefficientsAndTheirOrigin) {
  model::WorkMaterial material;
  material.kc11_n_mm2 = 1800.0;
  material.mc = 0.2;
  material.sources = {{"kc11_n_mm2", "a table"}};
  Corrections c;
  c.force = correct_force(soft(12, 6), kSteel);
  const model::WorkMaterial now = corrected(material, c);
  EXPECT_DOUBLE_EQ(now.kc11_n_mm2, c.force->kc11_n_mm2);
  EXPECT_EQ(now.sources.front().second, "72 cases on 12 edges");
}

}  // namespace
}  // namespace capstan::casebase::tune
