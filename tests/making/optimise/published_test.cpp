// The published problems as this project states them, by NLopt and by Ipopt, each with its fallbacks: the
// best feasible of ten starts. Where each number comes from is said in examples.h: [S] read, [M] recalled,
// [C] computed here. The optima are those of our statement; the papers' own tables were not seen.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "planner/making/optimise/solver/solvers.h"
#include "planner/making/optimise/solver/solver.h"
#include "tests/making/optimise/examples.h"

namespace capstan::optimise {
namespace {

using examples::Example;
using examples::MillingStatement;
using examples::QuizaGoal;

constexpr double kRelative = 1e-4;

struct Chain {
  const char* name;
  Solver solver;
};

std::ostream& operator<<(std::ostream& out, const Chain& c) { return out << c.name; }

class Published : public ::testing::TestWithParam<Chain> {
 protected:
  static Options options() {
    Options o;
    o.solver = GetParam().solver;
    o.starts = 10;
    o.evaluation_budget = 40000;
    o.backends = all_backends();
    return o;
  }

  void SetUp() override {
    Job job;
    const auto probe = solve(examples::projected_point(), options(), job);
    if (!probe && probe.error().code == "OPT-BACKEND-ABSENT") {
      GTEST_SKIP() << "backend is absent: " << probe.error().message;
    }
  }

  static Solution solved(const Problem& problem) {
    Job job;
    auto s = solve(problem, options(), job);
    EXPECT_TRUE(s) << to_text(s.error());
    if (!s) return {};
    EXPECT_TRUE(s->feasible);
    // Asked once more, outside of the fence.
    Evaluation e{.constraints = std::vector<double>(problem.constraints.size()),
                 .gradient = std::vector<double>(problem.variables.size()),
                 .jacobian = std::vector<double>(problem.constraints.size() * problem.variables.size())};
    problem.model(s->x, false, e);
    EXPECT_EQ(e.objective, s->objective);
    for (std::size_t i = 0; i < e.constraints.size(); ++i) {
      EXPECT_LE(e.constraints[i], 1e-6) << problem.constraints[i];
    }
    return *s;
  }

  static std::vector<std::string> held_by(const Solution& s) {
    std::vector<std::string> out;
    for (const ActiveLimit& a : s.active) {
      if (a.kind == ActiveLimit::Kind::kConstraint && a.multiplier > 1e-6) out.push_back(a.name);
    }
    return out;
  }

  static void expect_reproduced(const Example& e, double x_relative) {
    const Solution s = solved(e.problem);
    EXPECT_NEAR(s.objective, e.best_objective, kRelative * std::abs(e.best_objective)) << e.name;
    for (std::size_t j = 0; j < e.best_x.size(); ++j) {
      EXPECT_NEAR(s.x[j], e.best_x[j], x_relative * e.best_x[j]) << e.problem.variables[j].name;
    }
    if (!e.active.empty()) {
      EXPECT_EQ(held_by(s), e.active) << e.name;
    }
  }

  static double profit(const MillingStatement& statement) {
    return -solved(examples::tolouei_rad_milling(Walk::kLogarithmic, statement).problem).objective;
  }
};

TEST_P(Published, MillingForProfitIsReproduced) {
  const Example e = examples::tolouei_rad_milling();
  const Solution s = solved(e.problem);
  EXPECT_NEAR(s.objective, -2.6702, kRelative * 2.6702);
  for (std::size_t j = 0; j < e.best_x.size(); ++j) {
    EXPECT_NEAR(s.x[j], e.best_x[j], 1e-3 * e.best_x[j]) << e.problem.variables[j].name;
  }
  EXPECT_EQ(held_by(s), e.active);
  std::array<double, 10> x;
  std::copy(s.x.begin(), s.x.end(), x.begin());
  double objective = 0.0, cost = 0.0, time = 0.0;
  std::vector<double> c(9);
  examples::tolouei_rad(x, MillingStatement{}, objective, c, cost, time);
  EXPECT_NEAR(cost, 10.8673, kRelative * 10.8673);
  EXPECT_NEAR(time, 5.2927, kRelative * 5.2927);
}

TEST_P(Published, MillingForProfitWithOtherContactsIsReproduced) {
  EXPECT_NEAR(profit({.contact = 0.25}), 2.7013, kRelative * 2.7013);
  EXPECT_NEAR(profit({.contact = 1.0}), 2.6144, kRelative * 2.6144);
  EXPECT_NEAR(profit({.contact = 1e-6}), 2.7423, kRelative * 2.7423);  // tools for nothing: an upper bound
}

TEST_P(Published, MillingForProfitWithoutLimitsIsReproduced) {
  // Tabulated to three decimals: half a unit of the last is 1.8e-4 of the value.
  EXPECT_NEAR(profit({.roughness = false}), 2.854, 5e-4 + kRelative);
  EXPECT_NEAR(profit({.power = false}), 2.892, 5e-4 + kRelative);
  EXPECT_NEAR(profit({.power = false, .roughness = false}), 4.070, 5e-4 + kRelative);
}

TEST_P(Published, ClaimsBeyondTheBoundsCannotBe) {
  // What others claim of this problem, all [M] but the last, [S]: cost, time, profit rate.
  struct Claim {
    const char* who;
    double cost, time, rate;
  };
  const double least_time =
      solved(
          examples::tolouei_rad_milling(Walk::kLogarithmic, {.goal = MillingStatement::Goal::kTime}).problem)
          .objective;
  EXPECT_NEAR(least_time, 5.2775, kRelative * 5.2775);
  const double most_rate = profit({.contact = 1e-6});
  const auto possible = [&](const Claim& c) {
    constexpr double kPrinted = 0.01;                  // of two decimals, both numbers
    const double tools = c.cost - 0.5 - 1.9 * c.time;  // what is left for tools
    return tools >= -2.0 * kPrinted && c.time >= least_time - kPrinted && c.rate <= most_rate + kPrinted;
  };
  const Claim handbook{"handbook", 18.36, 9.40, 0.71};
  const Claim feasible_direction{"feasible direction", 11.35, 5.48, 2.49};
  EXPECT_TRUE(possible(handbook));
  EXPECT_TRUE(possible(feasible_direction));
  for (const Claim& c : {Claim{"genetic", 11.11, 5.22, 2.65}, Claim{"ant colony", 10.20, 5.43, 2.72},
                         Claim{"immune", 11.08, 5.07, 2.75}, Claim{"hybrid swarm", 10.90, 5.05, 2.79}}) {
    EXPECT_FALSE(possible(c)) << c.who;
    // The rows agree with rate = (25 - cost) / time, so it is the statement's money that they count.
    EXPECT_NEAR((25.0 - c.cost) / c.time, c.rate, 0.011) << c.who;
  }
  // 3.45 [S] (Lee 2020): above what either limit alone is worth, below what both are.
  EXPECT_GT(3.45, profit({.roughness = false}));
  EXPECT_GT(3.45, profit({.power = false}));
  EXPECT_LT(3.45, profit({.power = false, .roughness = false}));
}

TEST_P(Published, MostProfitPerTimeIsLeastCostWithTheRightEarning) {
  // Dinkelbach: start from nothing earned, put in what comes out.
  double earning = 0.0;
  for (int round = 0; round < 5; ++round) {
    const auto e = examples::tolouei_rad_milling(
        Walk::kLogarithmic, {.goal = MillingStatement::Goal::kParametric, .earning = earning});
    const Solution s = solved(e.problem);
    std::array<double, 10> x;
    std::copy(s.x.begin(), s.x.end(), x.begin());
    double rate = 0.0, cost = 0.0, time = 0.0;
    std::vector<double> c(9);
    examples::tolouei_rad(x, MillingStatement{}, rate, c, cost, time);
    earning = -rate;
  }
  EXPECT_NEAR(earning, 2.6702, kRelative * 2.6702);
}

TEST_P(Published, MultiPassTurningIsReproduced) {
  expect_reproduced(examples::chen_tsai_turning(6.0, 1, 2.03508), 1e-3);
  expect_reproduced(examples::chen_tsai_turning(8.0, 2, 2.55799), 1e-3);
  expect_reproduced(examples::chen_tsai_turning(10.0, 3, 3.09427), 1e-3);
}

TEST_P(Published, MultiPassTurningHasNoBetterNumberOfPasses) {
  // d_r <= 3 and d_s <= 3 ask for at least ceil((d_t - 3) / 3) passes; d_r >= 1 allows at most d_t - 1.
  const auto best = [](double depth, int passes) {
    return solved(examples::chen_tsai_turning(depth, passes, 0.0).problem).objective;
  };
  for (const auto& [depth, passes, value] :
       {std::tuple{6.0, 1, 2.03508}, {8.0, 2, 2.55799}, {10.0, 3, 3.09427}}) {
    for (int other = passes + 1; other <= passes + 2 && other + 1.0 <= depth; ++other) {
      EXPECT_GT(best(depth, other), value) << depth << " " << other;
    }
  }
}

TEST_P(Published, TurningWithTwoGoalsIsReproduced) {
  for (const auto goal : {QuizaGoal::kTime, QuizaGoal::kWear, QuizaGoal::kWearWithinTime}) {
    Example e = examples::quiza_turning(goal);
    e.active.clear();
    expect_reproduced(e, 2e-3);
    const Solution s = solved(e.problem);
    const auto held = held_by(s);
    EXPECT_NE(std::find(held.begin(), held.end(), "power"), held.end());  // active everywhere
    std::array<double, 3> x{s.x[0], s.x[1], s.x[2]};
    double other = 0.0;
    std::vector<double> c(4);
    if (goal == QuizaGoal::kTime) {
      examples::quiza(x, QuizaGoal::kWear, other, c);
      EXPECT_NEAR(other, 9.2056, 2e-3 * 9.2056);
    } else if (goal == QuizaGoal::kWear) {
      examples::quiza(x, QuizaGoal::kTime, other, c);
      EXPECT_NEAR(other, 1.06521, 1e-4 * 1.06521);
    }
  }
}

TEST_P(Published, ADrilledHoleOfLeastCostIsReproduced) {
  expect_reproduced(examples::drilled_hole(), 1e-3);
  const double feed = std::pow(3000.0 / 6170.0, 1.0 / 0.7);
  const double speed = 25.9 * std::pow(feed, -0.4) * std::pow(0.25 / 9.0, 0.2);
  EXPECT_NEAR(feed, 0.356963, 1e-6);
  EXPECT_NEAR(speed, 19.0981, 1e-4);
  EXPECT_NEAR(std::pow(25.9 / (speed * std::pow(feed, 0.4)), 5.0), 36.0, 1e-9);  // life, min
}

TEST_P(Published, SpeedsOfLeastCostAndMostProductionAreReproduced) {
  // The least is flat: a speed off by 1e-3 changes the cost by 1e-6.
  expect_reproduced(examples::textbook_speed(true), 1e-3);
  expect_reproduced(examples::textbook_speed(false), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Chains, Published,
                         ::testing::Values(Chain{"nlopt", Solver::kNlopt}, Chain{"ipopt", Solver::kIpopt}),
                         [](const auto& test) { return std::string(test.param.name); });

/// An evolution strategy that knows no slopes, 100,000 points: nothing it finds may be better.
TEST(Referee, FindsNothingBetterThanThePublishedOptima) {
  Options o;
  o.algorithm = Algorithm::kIsres;
  o.fall_back = false;
  o.starts = 1;
  o.evaluation_budget = 100000;
  for (const Example& e :
       {examples::tolouei_rad_milling(), examples::chen_tsai_turning(6.0, 1, 2.03508),
        examples::chen_tsai_turning(8.0, 2, 2.55799), examples::chen_tsai_turning(10.0, 3, 3.09427),
        examples::quiza_turning(QuizaGoal::kTime), examples::quiza_turning(QuizaGoal::kWear),
        examples::quiza_turning(QuizaGoal::kWearWithinTime), examples::drilled_hole(),
        examples::textbook_speed(true), examples::textbook_speed(false)}) {
    Job job;
    const auto s = solve(e.problem, o, job);
    if (!s && s.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << "NLopt is absent";
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->feasible) << e.name;
    const double scale = std::abs(e.best_objective);
    EXPECT_GT(s->objective, e.best_objective - 1e-4 * scale) << e.name;
    EXPECT_LT(s->objective, e.best_objective + 2e-3 * scale) << e.name;
  }
}

TEST(Referee, TheWalkDoesNotChangeTheOptimum) {
  const auto best = [](Walk walk) {
    Job job;
    job.evaluation_budget = 20000;
    const auto s = solve(examples::tolouei_rad_milling(walk).problem, {}, job);
    return s ? s->objective : std::nan("");
  };
  const double linear = best(Walk::kLinear);
  if (std::isnan(linear)) GTEST_SKIP() << "NLopt is absent";
  EXPECT_NEAR(linear, best(Walk::kLogarithmic), 1e-6);
}

}  // namespace
}  // namespace capstan::optimise
