#include "planner/making/optimise/cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "planner/making/optimise/cut/cost.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/solver/solvers.h"
#include "planner/physics/mechanics/constants.h"
#include "tests/making/optimise/cut/questions.h"
#include "tests/making/optimise/cut/solved.h"

namespace capstan::optimise {
namespace {

class Cut : public questions::Solved {
 protected:
  static CutPoint point(const CutAnswer& a) { return {a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min}; }

  static const model::ActiveConstraint* find(const CutAnswer& a, std::string_view name) {
    for (const auto& c : a.active) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }
};

TEST_F(Cut, IsNoSlowerThanAnyPointOfAGrid) {
  for (const auto& q : {questions::roughing(), questions::weak_spindle()}) {
    const CutAnswer a = answered(q);
    ASSERT_TRUE(a.feasible);
    const double found = objective_of(q, point(a));
    double best = 1e300;
    for (double ae = 1.0; ae <= 6.5; ae += 0.25) {
      for (double vc = 30.0; vc <= 120.0; vc += 5.0) {
        for (double fz = 0.006; fz <= 0.1; fz *= 1.06) {
          const double n = 1000.0 * vc / (std::numbers::pi * 10.0);
          const double feed = fz * 4.0 * n;
          const auto l = loads_of(q, a.ap_mm, ae, n, feed);
          if (!l) continue;
          bool kept = true;
          for (const Measure& m : measures(q, *l, a.ap_mm, n, feed)) kept = kept && m.excess() <= 0.0;
          if (kept) best = std::min(best, objective_of(q, {a.ap_mm, ae, n, feed}));
        }
      }
    }
    // Rounding of speed and feed to whole numbers costs at most about 1 / 300.
    EXPECT_LE(found, best * 1.004);
  }
}

// An edge of HSS is rounded to 0.012 mm: five times that; in titanium, which hardens, as much more as the
// chip is thicker: 0.06 / 0.3.
TEST_F(Cut, InLevelsThatAnEdgeSmearsIsNone) {
  auto q = questions::roughing();
  q.cutter.substrate = model::Substrate::kHss;
  q.ap_most_mm = 0.009;
  const CutAnswer a = answered(q);
  EXPECT_FALSE(a.feasible);
  ASSERT_FALSE(a.violated.empty());
  EXPECT_NE(a.violated.back().find("level depth 0.009 mm, at least 0.06 mm"), std::string::npos)
      << a.violated.back();
  q.ap_most_mm = 0.061;
  EXPECT_TRUE(answered(q).feasible);
  q.material.iso_group = "S";
  const CutAnswer in_titanium = answered(q);
  EXPECT_FALSE(in_titanium.feasible);
  ASSERT_FALSE(in_titanium.violated.empty());
  EXPECT_NE(in_titanium.violated.back().find("at least 0.2 mm"), std::string::npos)
      << in_titanium.violated.back();
  q.material.iso_group = "P";
  // What is left in all may be thinner: one level.
  q.depth_mm = 0.009;
  EXPECT_TRUE(answered(q).feasible);
}

TEST_F(Cut, NoOtherNumberOfLevelsIsBetter) {
  CutQuestion deep = questions::roughing();
  deep.depth_mm = 30.0;
  CutQuestion stiff = deep;
  stiff.deflection_limit_mm = 0.02;
  CutQuestion slot = questions::roughing();
  slot.slot = true;
  slot.width_mm = 10.0;
  for (const auto& q : {deep, stiff, slot}) {
    const CutAnswer a = answered(q);
    ASSERT_TRUE(a.feasible);
    const double found = objective_of(q, point(a));
    for (int levels = 1; levels <= 3 * a.levels; ++levels) {
      CutQuestion given = q;
      given.ap_mm = q.depth_mm / levels;
      if (*given.ap_mm > deepest_level(q)) continue;
      const CutAnswer b = answered(given);
      if (b.feasible) {
        EXPECT_LE(found, objective_of(q, point(b)) * 1.005) << levels << " not " << a.levels;
      }
    }
  }
}

/// The same cut by NLopt and by Ipopt: time goes with one over the feed, and speed and feed are rounded down
/// to whole numbers, so two answers differ by no more than 1 / n + 1 / feed, and by 1e-4 for each solver
/// (published_test.cpp).
void expect_the_same_by_either_solver(const CutQuestion& q, const std::string& what) {
  Options ipopt;
  ipopt.solver = Solver::kIpopt;
  ipopt.backends = all_backends();
  ipopt.fall_back = false;
  ipopt.starts = 2;
  Job job;
  const auto a = cut(q, {}, job);
  const auto b = cut(q, ipopt, job);
  if (!b && b.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << b.error().message;
  ASSERT_TRUE(a && b) << what;
  ASSERT_TRUE(a->feasible && b->feasible) << what;
  const double time = objective_of(q, {a->ap_mm, a->ae_mm, a->n_rpm, a->feed_mm_min});
  const double other = objective_of(q, {b->ap_mm, b->ae_mm, b->n_rpm, b->feed_mm_min});
  const double rounding = 1.0 / std::min(a->n_rpm, b->n_rpm) + 1.0 / std::min(a->feed_mm_min, b->feed_mm_min);
  EXPECT_NEAR(other, time, (rounding + 2e-4) * time) << what;
}

TEST_F(Cut, IsTheSameByEitherSolverWhateverTheStep) {
  // One level each: Ipopt takes some milliseconds for a start.
  CutQuestion rough = questions::roughing();
  rough.ap_mm = 6.0;
  expect_the_same_by_either_solver(rough, "roughing");
  CutQuestion slot = rough;
  slot.slot = true;
  slot.width_mm = 10.0;
  expect_the_same_by_either_solver(slot, "slot");
  CutQuestion weak = questions::weak_spindle();
  weak.ap_mm = 4.0;
  expect_the_same_by_either_solver(weak, "weak spindle");
  CutQuestion finish = questions::finishing();
  finish.ap_mm = 12.0;
  expect_the_same_by_either_solver(finish, "finishing");
  expect_the_same_by_either_solver(questions::drilling(), "drilling");
  for (const Aim aim : {Aim::kCost, Aim::kProfit}) {
    CutQuestion paid = rough;
    paid.aim = aim;
    paid.cutter.price = 40.0;
    expect_the_same_by_either_solver(paid, "aim " + std::to_string(static_cast<int>(aim)));
  }
}

TEST_F(Cut, AWeakSpindleIsSearchedToTheEndByEitherSolver) {
  for (const double watts : {20.0, 400.0}) {
    CutQuestion q = questions::roughing();
    q.ap_mm = 0.25;
    q.machine.spindle.curve = {{100.0, 0.1 * watts, 0.0}, {2000.0, watts, 0.0}, {8000.0, watts, 0.0}};
    const CutAnswer a = answered(q);
    EXPECT_TRUE(a.feasible) << watts;
    EXPECT_LE(a.loads.power_w, watts * 0.85 * (1.0 + 1e-6));
    expect_the_same_by_either_solver(q, std::to_string(watts) + " W");
  }
}

/// One active limit, eased by 1 % and by 10 %, against what its price says.
void expect_price(const CutQuestion& q, const char* limit) {
  Job job;
  const auto a = cut(q, {}, job);
  ASSERT_TRUE(a && a->feasible) << limit;
  // Prices are those of the exact cut; what is answered has whole numbers for feed and speed.
  const double rounding = 0.001 + 2.0 / a->feed_mm_min;
  std::size_t i = 0;
  while (i < a->active.size() && a->active[i].name != limit) ++i;
  ASSERT_LT(i, a->active.size()) << limit;
  const double price = a->active[i].shadow_price;
  EXPECT_GT(price, 0.0) << limit;
  const auto objective = [&](double factor) {
    CutQuestion more = q;
    if (is_milling(q.kind)) more.ap_mm = a->ap_mm;
    more.eased = {limit, factor};
    const auto b = cut(more, {}, job);
    EXPECT_TRUE(b && b->feasible);
    return b ? objective_of(q, {b->ap_mm, b->ae_mm, b->n_rpm, b->feed_mm_min}) : 0.0;
  };
  const double now = objective(1.0);
  const double one = 1.0 - objective(1.01) / now;
  const double ten = 1.0 - objective(1.1) / now;
  EXPECT_NEAR(one, price, rounding) << limit;
  // The law of diminishing returns: ten percent bring at most ten times what one percent is priced at.
  EXPECT_LE(ten, 10.0 * price + rounding) << limit;
  EXPECT_GE(ten, price - rounding) << limit;
  if (q.aim == Aim::kTime) {
    EXPECT_NEAR(a->saved_by_tenth.at(i), ten, rounding) << limit;
  }
}

TEST_F(Cut, ShadowPricesAreWhatMoreOfALimitSaves) {
  CutQuestion torque = questions::weak_spindle();
  torque.n_rpm = 1000.0;
  torque.ap_mm = 3.0;
  expect_price(torque, "spindle_torque");
  CutQuestion power = torque;
  power.n_rpm = 3500.0;
  expect_price(power, "spindle_power");
  CutQuestion corner = torque;
  corner.n_rpm.reset();
  expect_price(corner, "spindle_power");  // where torque ends and power begins
  CutQuestion wide = questions::roughing();
  wide.deflection_limit_mm = 0.01;
  wide.ap_mm = 0.45;
  expect_price(wide, "tool_deflection");
  CutQuestion light = questions::roughing();
  light.ap_mm = 0.5;
  expect_price(light, "cutting_speed");
  expect_price(light, "chip_thickness");
  CutQuestion soft = questions::roughing();
  soft.peak_force_limit_n = 200.0;
  soft.ap_mm = 0.6;
  expect_price(soft, "peak_force");
  CutQuestion smooth = questions::finishing();
  smooth.surface_ra_um = 0.01;
  expect_price(smooth, "surface_roughness");
  CutQuestion slow = questions::roughing();
  slow.ap_mm = 0.5;
  slow.machine.axes[0].feed_max_mm_min = 500.0;
  expect_price(slow, "axis_feed");
  expect_price(questions::drilling(), "feed_per_tooth");
  CutQuestion stiff = questions::finishing();
  stiff.wall_error_limit_mm = 0.004;
  stiff.deflection_limit_mm = 1.0;
  expect_price(stiff, "wall_error");
}

TEST_F(Cut, PricesOfCostAreFractionsOfTheCost) {
  CutQuestion q = questions::weak_spindle();
  q.aim = Aim::kCost;
  q.cutter.price = 20.0;
  q.n_rpm = 1000.0;
  q.ap_mm = 3.0;
  expect_price(q, "spindle_torque");
}

TEST_F(Cut, LimitsOfTheSpindleSayAtWhichSpeed) {
  CutQuestion q = questions::weak_spindle();
  q.n_rpm = 1000.0;
  q.ap_mm = 3.0;
  const CutAnswer torque = answered(q);
  const auto* c = find(torque, "spindle_torque");
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->at_rpm, 1000.0);
  EXPECT_EQ(c->unit, "Nm");
  EXPECT_NEAR(c->limit, 2.4 * 0.85, 0.02);
  EXPECT_EQ(find(torque, "spindle_power"), nullptr);  // the same limit is named once
  q.n_rpm = 3500.0;
  const CutAnswer power = answered(q);
  ASSERT_NE(find(power, "spindle_power"), nullptr);
  EXPECT_EQ(find(power, "spindle_power")->at_rpm, 3500.0);
  for (const auto& a : answered(questions::roughing()).active) {
    if (a.name == "chip_thickness" || a.name == "tool_deflection") {
      EXPECT_EQ(a.at_rpm, 0.0) << a.name;
    }
  }
}

TEST_F(Cut, CostWantsSlowerSpeedsThanTimeAndProfitLiesBetween) {
  CutQuestion q = questions::roughing();
  q.cutter.price = 60.0;
  const double fastest = answered(q).vc_m_min;
  q.aim = Aim::kCost;
  const double cheapest = answered(q).vc_m_min;
  q.aim = Aim::kProfit;
  const double profit_of_nothing = answered(q).vc_m_min;
  q.earning_per_min = 5.0;
  const double profit = answered(q).vc_m_min;
  q.earning_per_min = 500.0;
  const double rush = answered(q).vc_m_min;
  EXPECT_LT(cheapest, fastest);
  EXPECT_NEAR(profit_of_nothing, cheapest, 1e-9);
  EXPECT_GT(profit, cheapest);
  EXPECT_GT(rush, profit);
  EXPECT_LE(rush, fastest + 1e-9);
}

TEST_F(Cut, TheSpeedOfLeastCostIsTheTextbooks) {
  // Feed and width given: cost per volume ~ 1 / V + K / (V T), T ~ V^(-1/n): V* as Ghosh & Mallik, and far
  // from the table's speed, which here is no limit.
  CutQuestion q = questions::roughing();
  q.aim = Aim::kCost;
  q.cutter.price = 60.0;
  q.cutter.life_min = 15.0;
  q.machine.cost_per_hour = 72.0;
  q.machine.tool_change_s = 30.0;
  q.ap_mm = 0.5;
  q.depth_mm = 0.5;
  q.ae_mm = 2.0;
  q.fz_mm = 0.05;
  const double rate = 72.0 / 60.0;
  const double edge = 60.0 + rate * 0.5;
  const double n = mechanics::kTaylorExponentCarbide;
  const double c = 120.0 * std::pow(15.0, n);
  const double best = c * std::pow(n / (1.0 - n) * rate / edge, n);
  const CutAnswer a = answered(q);
  EXPECT_TRUE(a.feasible);
  EXPECT_NEAR(a.vc_m_min, best, 2e-3 * best);
}

TEST_F(Cut, TheMaterialsLifeLawRulesTheCost) {
  CutQuestion q = questions::roughing();
  q.material.life = {{.substrate = "carbide",
                      .v0_m_min = 100.0,
                      .life_min = 20.0,
                      .h0_mm = 0.05,
                      .a0_mm = 2.0,
                      .n = 0.3,
                      .p = 0.6,
                      .q = 0.0,
                      .scatter = 0.2,
                      .source = "this test"}};
  const double n = 1000.0 * 100.0 / (std::numbers::pi * 10.0);
  const CutPoint at{2.0, 3.0, n, 0.05 * 4.0 * n};
  EXPECT_NEAR(edge_life_min(q, at), 20.0 * std::exp(-0.2), 1e-9);
  const CutPoint faster{2.0, 3.0, 1.1 * n, 0.05 * 4.0 * 1.1 * n};
  EXPECT_NEAR(edge_life_min(q, faster) / edge_life_min(q, at), std::pow(1.1, -1.0 / 0.3), 1e-9);
  const CutPoint thicker{2.0, 3.0, n, 0.06 * 4.0 * n};
  EXPECT_NEAR(edge_life_min(q, thicker) / edge_life_min(q, at), std::pow(1.2, -1.0 / 0.6), 1e-9);
  const CutPoint deeper{4.0, 3.0, n, 0.05 * 4.0 * n};
  EXPECT_EQ(edge_life_min(q, deeper), edge_life_min(q, at));  // q = 0: no influence
  q.cutter.substrate = model::Substrate::kHss;                // no law for it
  EXPECT_NEAR(edge_life_min(q, at),
              mechanics::kLifeAtTableMin * std::pow(120.0 / 100.0, 1.0 / mechanics::kTaylorExponentHss),
              1e-9);
}

TEST_F(Cut, KeepsTheSurfaceThatIsDemanded) {
  CutQuestion q = questions::finishing();
  const double free_fz = answered(q).fz_mm;
  q.surface_ra_um = 0.01;
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  EXPECT_LT(a.fz_mm, free_fz);
  // Ra = 318 f^2 / (4 D) um
  EXPECT_LE(318.0 * a.fz_mm * a.fz_mm / 40.0, 0.01 * (1.0 + 1e-3));
  EXPECT_NE(find(a, "surface_roughness"), nullptr);
}

TEST_F(Cut, AFeedThatIsNoneIsAnOutcome) {
  for (const double feed :
       {1e-320, 0.0, -5.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    CutQuestion q = questions::roughing();
    q.feed_mm_min = feed;
    const CutAnswer a = answered(q);
    EXPECT_FALSE(a.feasible) << feed;
    ASSERT_EQ(a.violated.size(), 1u);
    EXPECT_NE(a.violated[0].find("feed"), std::string::npos);
    q.n_rpm = 2000.0;
    EXPECT_FALSE(answered(q).feasible);
  }
}

TEST_F(Cut, SaysWhatIsViolatedWhenNothingCanBeCut) {
  CutQuestion q = questions::weak_spindle();
  q.slot = true;
  q.ap_mm = 5.0;
  q.machine.spindle.curve = {{60.0, 1.0, 0.0}, {8000.0, 5.0, 0.0}};
  const CutAnswer a = answered(q);
  EXPECT_FALSE(a.feasible);
  ASSERT_FALSE(a.violated.empty());
  EXPECT_EQ(a.violated[0].rfind("spindle ", 0), 0u) << a.violated[0];
}

TEST_F(Cut, GivesTheSameAnswerTwice) {
  const CutAnswer a = answered(questions::weak_spindle());
  const CutAnswer b = answered(questions::weak_spindle());
  EXPECT_EQ(a.n_rpm, b.n_rpm);
  EXPECT_EQ(a.feed_mm_min, b.feed_mm_min);
  EXPECT_EQ(a.ae_mm, b.ae_mm);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.saved_by_tenth, b.saved_by_tenth);
}

TEST(CutWithoutSolver, IsRefusedAsAbsent) {
  Options o;
  o.backends[Solver::kNlopt] = nullptr;
  Job job;
  const auto a = cut(questions::roughing(), o, job);
  ASSERT_FALSE(a);
  EXPECT_EQ(a.error().code, "OPT-BACKEND-ABSENT");
}

}  // namespace
}  // namespace capstan::optimise
