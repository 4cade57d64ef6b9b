// What every backend owes, and the published problems by each of them.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "planner/making/optimise/solver/solvers.h"
#include "planner/making/optimise/solver/solver.h"
#include "tests/making/optimise/examples.h"

namespace capstan::optimise {
namespace {

using examples::Example;
using examples::QuizaGoal;

struct Way {
  const char* name;
  Solver solver;
  Algorithm algorithm;
};

std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.name; }

class Contract : public ::testing::TestWithParam<Way> {
 protected:
  /// One method alone: no fallback may cover for it.
  Options alone() const {
    Options o;
    o.solver = GetParam().solver;
    o.algorithm = GetParam().algorithm;
    o.fall_back = false;
    o.evaluation_budget = 20000;
    o.backends = all_backends();
    if (referee()) o.starts = 1;  // it starts everywhere by itself
    return o;
  }

  /// The evolution strategy: comes near an optimum and stays there until its budget ends.
  static bool referee() { return GetParam().algorithm == Algorithm::kIsres; }

  void SetUp() override {
    Job job;
    const auto probe = solve(examples::projected_point(), alone(), job);
    if (!probe && probe.error().code == "OPT-BACKEND-ABSENT") {
      GTEST_SKIP() << "backend is absent: " << probe.error().message;
    }
  }

  Solution solved(const Problem& problem) { return solved(problem, alone()); }
  static Solution solved(const Problem& problem, const Options& options) {
    Job job;
    auto s = solve(problem, options, job);
    EXPECT_TRUE(s) << to_text(s.error());
    return s ? *s : Solution{};
  }
  /// First-order methods find an optimum to many digits; COBYLA, without slopes, to fewer.
  static double accuracy() {
    if (referee()) return 1e-2;
    return GetParam().algorithm == Algorithm::kCobyla ? 1e-3 : 1e-5;
  }
  static void expect_at_optimum(const Solution& s) {
    EXPECT_TRUE(s.feasible);
    if (!referee()) {
      EXPECT_EQ(s.outcome, Outcome::kOptimal);
    }
  }
};

TEST_P(Contract, FindsAKnownMinimumAndItsShadowPrice) {
  const Solution s = solved(examples::projected_point());
  expect_at_optimum(s);
  EXPECT_NEAR(s.x[0], 2.0, accuracy());
  EXPECT_NEAR(s.x[1], 1.0, accuracy());
  EXPECT_NEAR(s.objective, 2.0, accuracy());
  if (referee()) return;  // near the limit, not at it
  ASSERT_EQ(s.active.size(), 1u);
  EXPECT_EQ(s.active[0].name, "sum");
  EXPECT_NEAR(s.active[0].multiplier, 2.0, 1e-3);
}

TEST_P(Contract, ShadowPriceIsWhatMoreOfTheLimitIsWorth) {
  if (referee()) return;
  const Solution s = solved(examples::projected_point(3.0));
  const Solution more = solved(examples::projected_point(3.001));
  EXPECT_NEAR((s.objective - more.objective) / 0.001, s.active.at(0).multiplier, 5e-3 + accuracy() / 0.001);
}

TEST_P(Contract, NamesTheBoundThatHoldsTheSolution) {
  const Problem p{.variables = {{"feed", "mm", 0.05, 0.5, 0.1, Walk::kLogarithmic}},
                  .constraints = {},
                  .model = differentiate<1>([](const auto& x, auto& f, auto&) { f = 1.0 / x[0]; })};
  const Solution s = solved(p);
  expect_at_optimum(s);
  EXPECT_NEAR(s.x[0], 0.5, accuracy());
  if (referee()) return;
  ASSERT_EQ(s.active.size(), 1u);
  EXPECT_EQ(s.active[0].kind, ActiveLimit::Kind::kUpperBound);
  EXPECT_NEAR(s.active[0].multiplier, 4.0, 1e-3);  // -d(1/x)/dx at 0.5
}

TEST_P(Contract, NeverAsksTheModelOutsideTheBounds) {
  Problem p{.variables = {{"x", "", 0.5, 2.0, 0.5}, {"y", "", 1.0, 9.0, 1.0, Walk::kLogarithmic}},
            .constraints = {"c"},
            .model = {}};
  bool outside = false;
  p.model = [&outside](std::span<const double> x, bool slopes, Evaluation& e) {
    outside = outside || x[0] < 0.5 || x[0] > 2.0 || x[1] < 1.0 || x[1] > 9.0;
    e.objective = -x[0] * x[1];
    e.constraints[0] = x[0] * x[0] + x[1] - 11.0;
    if (!slopes) return;
    e.gradient = {-x[1], -x[0]};
    e.jacobian = {2.0 * x[0], 1.0};
  };
  const Solution s = solved(p);
  EXPECT_FALSE(outside);
  EXPECT_NEAR(s.objective, -1.9148542 * (11.0 - 1.9148542 * 1.9148542), 10 * accuracy());  // x = sqrt(11/3)
}

TEST_P(Contract, SaysSoWhenNothingIsFeasible) {
  Problem p = examples::projected_point();
  p.constraints = {"sum", "other way"};
  p.model = differentiate<2>([](const auto& x, auto& f, auto& c) {
    f = x[0] + x[1];
    c[0] = x[0] + x[1] - 3.0;
    c[1] = 3.5 - x[0] - x[1];
  });
  const Solution s = solved(p);
  EXPECT_FALSE(s.feasible);
  EXPECT_TRUE(s.outcome == Outcome::kInfeasible || s.outcome == Outcome::kLimitReached);
  EXPECT_GE(s.max_violation, 0.25 - 1e-9);  // no point does better than half the gap
}

struct ModelBroke : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST_P(Contract, RethrowsWhatTheModelThrows) {
  Problem p = examples::projected_point();
  const Model good = p.model;
  int calls = 0;
  p.model = [&calls, good](std::span<const double> x, bool slopes, Evaluation& e) {
    if (++calls > 5) throw ModelBroke("table ends here");
    good(x, slopes, e);
  };
  Job job;
  try {
    static_cast<void>(solve(p, alone(), job));
    FAIL() << "nothing was thrown";
  } catch (const ModelBroke& e) {
    EXPECT_STREQ(e.what(), "table ends here");
  }
}

TEST_P(Contract, StepsBackFromWhereTheModelIsNotANumber) {
  Problem p = examples::projected_point();
  p.model = differentiate<2>([](const auto& x, auto& f, auto& c) {
    using std::log;
    // Not a number for x + y < 1; the minimum of the objective lies at x = y = 1.
    f = x[0] + x[1] - log(x[0] + x[1] - 1.0) + (x[0] - x[1]) * (x[0] - x[1]);
    c[0] = x[0] - 4.0;
  });
  p.variables[0].start = 3.0;
  const Solution s = solved(p);
  EXPECT_TRUE(s.feasible);
  EXPECT_NEAR(s.objective, 2.0, std::max(1e-3, accuracy()));
}

TEST_P(Contract, StaysWithinItsBudget) {
  for (const std::uint32_t budget : {3u, 25u, 200u}) {
    Options o = alone();
    o.evaluation_budget = budget;
    const Solution s = solved(examples::tolouei_rad_milling().problem, o);
    // Each start may be measured twice when the budget cuts it off.
    EXPECT_LE(s.evaluations, budget + 2 * o.starts) << budget;
    EXPECT_EQ(s.x.size(), 10u);
  }
}

TEST_P(Contract, EndsWhenAskedToStop) {
  Job job;
  job.request_stop();
  const auto s = solve(examples::projected_point(), alone(), job);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->outcome, Outcome::kLimitReached);
  EXPECT_EQ(s->x, (std::vector<double>{0.1, 4.0}));  // the start, measured
  EXPECT_NEAR(s->max_violation, 1.1, 1e-12);
}

TEST_P(Contract, GivesTheSameBytesTwice) {
  const Problem p = examples::tolouei_rad_milling().problem;
  const Solution a = solved(p);
  const Solution b = solved(p);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST_P(Contract, LeavesAFixedVariableAlone) {
  Problem p = examples::projected_point();
  p.variables[1] = {"y", "mm", 0.75, 0.75, 0.75};
  const Solution s = solved(p);
  EXPECT_EQ(s.x[1], 0.75);
  EXPECT_NEAR(s.x[0], 2.25, accuracy());
}

void expect_matches(const Example& e, const Solution& s, double relative) {
  EXPECT_TRUE(s.feasible) << e.name;
  EXPECT_NEAR(s.objective, e.best_objective, relative * std::abs(e.best_objective))
      << e.name << " " << s.method;
}

TEST_P(Contract, SolvesThePublishedProblems) {
  if (referee()) {  // with its full budget: published_test.cpp
    const auto e = examples::drilled_hole();
    return expect_matches(e, solved(e.problem), 1e-2);
  }
  if (GetParam().algorithm == Algorithm::kCobyla) {  // linear models without slopes: near, not at the optimum
    const auto e = examples::quiza_turning(QuizaGoal::kTime);
    return expect_matches(e, solved(e.problem), 1e-2);
  }
  const auto milling = examples::tolouei_rad_milling();
  const Solution s = solved(milling.problem);
  expect_matches(milling, s, 1e-4);
  EXPECT_EQ(s.outcome, Outcome::kOptimal);
  for (std::size_t j = 0; j < milling.best_x.size(); ++j) {
    EXPECT_NEAR(s.x[j], milling.best_x[j], 1e-3 * milling.best_x[j]) << milling.problem.variables[j].name;
  }
  std::vector<std::string> active;
  for (const ActiveLimit& a : s.active) {
    if (a.kind == ActiveLimit::Kind::kConstraint) active.push_back(a.name);
  }
  EXPECT_EQ(active, milling.active);

  expect_matches(examples::chen_tsai_turning(6.0, 1, 2.03508),
                 solved(examples::chen_tsai_turning(6.0, 1, 0).problem), 1e-4);
  expect_matches(examples::chen_tsai_turning(8.0, 2, 2.55799),
                 solved(examples::chen_tsai_turning(8.0, 2, 0).problem), 1e-4);
  expect_matches(examples::chen_tsai_turning(10.0, 3, 3.09427),
                 solved(examples::chen_tsai_turning(10.0, 3, 0).problem), 1e-4);
  for (const auto goal : {QuizaGoal::kTime, QuizaGoal::kWear, QuizaGoal::kWearWithinTime}) {
    const Example e = examples::quiza_turning(goal);
    const Solution q = solved(e.problem);
    expect_matches(e, q, 1e-4);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(q.x[j], e.best_x[j], 2e-3 * e.best_x[j]);
  }
}

/// Every published problem, with what is known of its optimum.
std::vector<Example> published() {
  return {examples::tolouei_rad_milling(),
          examples::chen_tsai_turning(6.0, 1, 2.03508),
          examples::chen_tsai_turning(8.0, 2, 2.55799),
          examples::chen_tsai_turning(10.0, 3, 3.09427),
          examples::quiza_turning(QuizaGoal::kTime),
          examples::quiza_turning(QuizaGoal::kWear),
          examples::quiza_turning(QuizaGoal::kWearWithinTime),
          examples::drilled_hole(),
          examples::textbook_speed(true),
          examples::textbook_speed(false)};
}

// A point that breaks no limit by more than the feasibility tolerance e and whose first-order residual is
// that small is below the optimum by at most the sum of its multipliers times e: these problems' limits are
// ratios, their multipliers below 10 times the objective, and no more than 5 hold. With e = 1e-6: 5e-5 of the
// objective for each of two solvers.
TEST(Backends, FindTheSameOptimumOfEveryPublishedProblem) {
  constexpr double kOfBoth = 2.0 * 5e-5;
  const Way ways[] = {{"slsqp", Solver::kNlopt, Algorithm::kSlsqp},
                      {"auglag", Solver::kNlopt, Algorithm::kAuglagLbfgs},
                      {"ipopt", Solver::kIpopt, Algorithm::kSlsqp}};
  int compared = 0;
  for (const Example& e : published()) {
    std::vector<std::pair<const char*, double>> found;
    for (const Way& way : ways) {
      Options o;
      o.solver = way.solver;
      o.algorithm = way.algorithm;
      o.fall_back = false;
      o.starts = 10;
      o.evaluation_budget = 40000;
      o.backends = all_backends();
      Job job;
      const auto s = solve(e.problem, o, job);
      if (!s && s.error().code == "OPT-BACKEND-ABSENT") continue;
      ASSERT_TRUE(s) << way.name << " " << to_text(s.error());
      EXPECT_TRUE(s->feasible) << e.name << " " << way.name;
      for (const auto& [other, objective] : found) {
        EXPECT_NEAR(s->objective, objective, kOfBoth * std::abs(objective))
            << e.name << ": " << way.name << " and " << other;
        ++compared;
      }
      found.emplace_back(way.name, s->objective);
    }
  }
  if (compared == 0) GTEST_SKIP() << "fewer than two backends are built in";
  RecordProperty("pairs_compared", compared);
}

TEST(AbsentBackend, IsRefusedWithWhatToBuild) {
  // Where the build has both, there is nothing to refuse; the build without them runs this in earnest.
  for (const Solver solver : {Solver::kNlopt, Solver::kIpopt}) {
    Options o;
    o.solver = solver;
    o.backends = all_backends();
    o.fall_back = false;
    Job job;
    const auto s = solve(examples::projected_point(), o, job);
    if (s) {
      EXPECT_EQ(s->outcome, Outcome::kOptimal);
      continue;
    }
    EXPECT_EQ(s.error().code, "OPT-BACKEND-ABSENT");
    const char* name = solver == Solver::kNlopt ? "NLopt" : "Ipopt";
    EXPECT_NE(s.error().message.find(name), std::string::npos) << s.error().message;
    const char* option = solver == Solver::kNlopt ? "-DCAPSTAN_WITH_NLOPT=ON" : "-DCAPSTAN_WITH_IPOPT=ON";
    EXPECT_NE(s.error().hint.find(option), std::string::npos) << s.error().hint;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Contract,
                         ::testing::Values(Way{"slsqp", Solver::kNlopt, Algorithm::kSlsqp},
                                           Way{"auglag", Solver::kNlopt, Algorithm::kAuglagLbfgs},
                                           Way{"cobyla", Solver::kNlopt, Algorithm::kCobyla},
                                           Way{"isres", Solver::kNlopt, Algorithm::kIsres},
                                           Way{"ipopt", Solver::kIpopt, Algorithm::kSlsqp}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace capstan::optimise
