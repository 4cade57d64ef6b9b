#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "tests/simulated_shop/campaign.h"
#include "tests/support/soak.h"

namespace capstan::testing {
namespace {

using casebase::tune::Setting;
using casebase::tune::TuneOptions;

constexpr int kParts = 40;

/// A short sample; the thirty shops of docs/validation.md, from other seeds, where the tests soak.
const Summary& shops() {
  static std::map<std::uint64_t, Summary> by_seed;
  const auto seed = static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  const auto [it, fresh] = by_seed.try_emplace(soaking() ? seed : 0);
  if (fresh) it->second = soaking() ? run_shops(1000 * seed, 30, kParts) : run_shops(1, 6, kParts);
  return it->second;
}

const ArmSummary& arm_of(Arm arm) { return shops().arms[static_cast<std::size_t>(arm)]; }
constexpr std::array kTuned = {Arm::kRegression, Arm::kProcess};

TEST(SimulatedShopProperty, TunedPartsTakeLessTimeThanTheHandbooks) {
  for (const Arm arm : kTuned) EXPECT_LT(geometric_mean(arm_of(arm).time_ratios(false)), 1.0);
}

TEST(SimulatedShopProperty, WhereTheTunerNeverDoubtsTheValuesTunedPartsTakeMuchLess) {
  // Three times thirty shops came to 0.85 to 0.91; six of them scatter more.
  const double most = soaking() ? 0.93 : 0.97;
  for (const Arm arm : kTuned) {
    const std::vector<double> ratios = arm_of(arm).time_ratios(true);
    ASSERT_GT(ratios.size(), 0U);
    EXPECT_LT(geometric_mean(ratios), most);
  }
}

TEST(SimulatedShopProperty, NoTunedSettingExceedsThePlannersOwnLimits) {
  for (const ArmSummary& arm : shops().arms) EXPECT_LE(arm.worst_planner_excess, 0.0);
}

TEST(SimulatedShopProperty, SettingsOfTheTunersOwnExceedHiddenLimitsNoMoreOftenThanStated) {
  for (const Arm arm : kTuned) {
    const Tally own = arm_of(arm).of(Said::kOwn);
    EXPECT_LE(clopper_pearson_upper(own.over, own.parts), TuneOptions{}.probability)
        << own.over << " of " << own.parts;
    EXPECT_LE(upper_by_shops(arm_of(arm).by_shop(Said::kOwn)), TuneOptions{}.probability)
        << own.over << " of " << own.parts;
  }
}

TEST(SimulatedShopProperty, PartsOfEachKindExceedThemNoMoreOftenThanTheTunerSaidOfThem) {
  for (const Arm arm : kTuned) {
    const Tally kept = arm_of(arm).of(Said::kHandbook), own = arm_of(arm).of(Said::kOwn);
    EXPECT_LE(clopper_pearson_upper(kept.over, kept.parts), kept.stated / kept.parts)
        << kept.over << " of " << kept.parts;
    EXPECT_LE(own.stated, TuneOptions{}.probability * own.parts);
    const Tally against = arm_of(arm).of(Said::kAgainst);
    if (against.parts > 0) {
      EXPECT_GT(against.stated, TuneOptions{}.probability * against.parts);
    }
  }
}

TEST(SimulatedShopProperty, OverAllShopsTheTunerIsNoWorseThanTheHandbook) {
  for (const ArmSummary& arm : shops().arms) {
    EXPECT_LE(arm.all().over,
              arm_of(Arm::kHandbook).all().over + TuneOptions{}.probability * arm.of(Said::kOwn).parts)
        << "of " << arm.all().parts;
  }
}

TEST(SimulatedShopProperty, NoPartIsLeftOut) {
  for (const ArmSummary& arm : shops().arms)
    EXPECT_EQ(arm.all().parts, static_cast<int>(shops().seeds.size()) * kParts);
  EXPECT_EQ(arm_of(Arm::kHandbook).all().parts, arm_of(Arm::kHandbook).of(Said::kHandbook).parts);
}

TEST(SimulatedShopProperty, ForcesExceedTheLoadsOfTheCorrectedCardNoMoreOftenThanTheMarginStates) {
  const auto seed = static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  const ForceForecasts all = soaking() ? forecast_forces(1000 * seed, 40) : forecast_forces(1, 15);
  EXPECT_GE(all.taken, all.shops / 2);
  // The usual margin: 84 of 100 cuts stay below (mechanics/loads/margin.h).
  EXPECT_LE(clopper_pearson_upper(all.over_cases, all.cuts), 0.16) << all.over_cases << " of " << all.cuts;
  EXPECT_GE(all.within_90, 0.8 * all.sharp) << all.within_90 << " of " << all.sharp;
  // How far it lies above the true force differs less from shop to shop.
  const auto range = [](const std::vector<double>& ln) {
    const auto [low, high] = std::minmax_element(ln.begin(), ln.end());
    return *high - *low;
  };
  EXPECT_LT(range(all.ln_held_cases), 0.5 * range(all.ln_held_card));
}

TEST(SimulatedShop, IsTheSameForTheSameSeed) {
  const Campaign a = run_campaign(3, Arm::kProcess, 8), b = run_campaign(3, Arm::kProcess, 8);
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].at, b.parts[i].at);
    EXPECT_EQ(a.parts[i].time_s, b.parts[i].time_s);
  }
}

TEST(SimulatedShop, LoadsGrowWithFeedAndWear) {
  const PlannedJob j = drawn_job(1);
  HiddenShop shop(1, j.tables);
  ShopEdge sharp = shop.new_edge();
  ShopEdge worn = sharp;
  worn.wear_mm = 0.25;
  worn.parts = 3;
  ShopEdge again = sharp;
  const CutPart base = shop.cut(j.job, j.vc_m_min, j.fz_mm, sharp);
  EXPECT_GT(shop.cut(j.job, j.vc_m_min, 1.3 * j.fz_mm, again).truth.force_n, base.truth.force_n);
  EXPECT_GT(shop.cut(j.job, j.vc_m_min, j.fz_mm, worn).truth.force_n, base.truth.force_n);
}

TEST(SimulatedShop, ADeepEnoughCutChatters) {
  PlannedJob j = drawn_job(1);
  HiddenShop shop(1, j.tables);
  ShopEdge shallow = shop.new_edge(), deep = shallow;
  j.job.ap_mm = 0.2;
  EXPECT_FALSE(shop.cut(j.job, j.vc_m_min, j.fz_mm, shallow).chatter);
  j.job.ap_mm = 60.0;
  EXPECT_TRUE(shop.cut(j.job, j.vc_m_min, j.fz_mm, deep).chatter);
}

TEST(UpperByShops, IsTheRatioWithItsErrorFromShopToShop) {
  // Residuals -1, 0, 1 of 30 parts: an error of sqrt(2 * 3 / 2) / 30, and t(0.95, 2) = 2.920. Parts that are
  // independent would come to 0.239 (Clopper and Pearson).
  EXPECT_NEAR(upper_by_shops({{10, 0, 0.0}, {10, 1, 0.0}, {10, 2, 0.0}}), 0.1 + 2.920 * std::sqrt(3.0) / 30.0,
              0.0006);
  EXPECT_NEAR(upper_by_shops({{40, 4, 0.0}, {20, 2, 0.0}, {10, 1, 0.0}}), 0.1, 1e-12);
  EXPECT_EQ(upper_by_shops({{10, 0, 0.0}}), 1.0);
}

TEST(ClopperPearson, GivesTheTabulatedBounds) {
  EXPECT_NEAR(clopper_pearson_upper(0, 59), 0.0495, 0.0005);         // 1 - 0.05^(1/59)
  EXPECT_NEAR(clopper_pearson_upper(2, 20, 0.975), 0.3170, 0.0005);  // Clopper and Pearson 1934, chart
}

}  // namespace
}  // namespace capstan::testing
