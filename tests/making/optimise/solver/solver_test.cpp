#include "planner/making/optimise/solver/solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "planner/making/optimise/solver/multipliers.h"
#include "planner/making/optimise/solver/solvers.h"
#include "planner/making/optimise/solver/spent_budget.h"
#include "tests/making/optimise/examples.h"

namespace capstan::optimise {
namespace {

bool has_nlopt() {
  Job job;
  const auto s = solve(examples::projected_point(), {}, job);
  return s || s.error().code != "OPT-BACKEND-ABSENT";
}

TEST(Solve, SaysWhichBackendIsAbsent) {
  Options o;
  o.solver = Solver::kIpopt;  // and none brought
  Job job;
  const auto s = solve(examples::projected_point(), o, job);
  ASSERT_FALSE(s);
  EXPECT_EQ(s.error().code, "OPT-BACKEND-ABSENT");
  EXPECT_NE(s.error().message.find("ipopt"), std::string::npos);
}

/// A backend that never leaves its start: the fallback must notice, for it claims nothing.
Result<std::vector<double>> lazy(Evaluator& evaluator, const Attempt& attempt) {
  static_cast<void>(evaluator.at(attempt.start, false));
  return attempt.start;
}

TEST(Solve, FallsBackWhenAMethodEndsShortOfTheOptimum) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  Options o;
  o.solver = Solver::kIpopt;
  o.backends[Solver::kIpopt] = &lazy;
  Job job;
  const auto s = solve(examples::projected_point(), o, job);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->outcome, Outcome::kOptimal);
  EXPECT_EQ(s->method, "slsqp");
  o.fall_back = false;
  const auto without = solve(examples::projected_point(), o, job);
  ASSERT_TRUE(without);
  EXPECT_NE(without->outcome, Outcome::kOptimal);
}

TEST(Solve, TakesTheJobsBudgetWhenGivenNone) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  Job job;
  job.evaluation_budget = 10;
  const auto s = solve(examples::tolouei_rad_milling().problem, {}, job);
  ASSERT_TRUE(s);
  EXPECT_LE(s->evaluations, 10u + 2 * Options{}.starts);
  EXPECT_NE(s->outcome, Outcome::kOptimal);
}

TEST(Solve, TheDefaultBudgetIsEnoughForTheLargestExample) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  Job job;
  const auto s = solve(examples::tolouei_rad_milling().problem, {}, job);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->outcome, Outcome::kOptimal);
  EXPECT_NEAR(s->objective, -2.6702, 1e-4 * 2.6702);
}

TEST(Solve, WhereNoBudgetIsToldSpentALargerOneComesToTheSame) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  const Problem problem = examples::tolouei_rad_milling().problem;
  const auto with = [&](std::uint32_t budget, bool& spent) {
    Job job;
    job.evaluation_budget = budget;
    const SpentBudgetScope scope;
    const auto s = solve(problem, {}, job);
    spent = scope.spent();
    return s ? std::pair(s->x, s->evaluations) : std::pair(std::vector<double>{}, 0U);
  };
  bool spent = false;
  constexpr std::uint32_t kEnough = 100'000;
  const auto whole = with(kEnough, spent);
  EXPECT_FALSE(spent);
  int told = 0, same = 0;
  for (std::uint32_t budget = 1; budget <= 4 * whole.second; budget += 1 + budget / 8) {
    const auto some = with(budget, spent);
    told += spent ? 1 : 0;
    if (spent) continue;
    ++same;
    EXPECT_EQ(some, whole) << "budget " << budget;
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(same, 0);
}

TEST(Solve, ASpentBudgetIsToldToTheScopesAroundAndToNoLaterOne) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  const SpentBudgetScope outer;
  {
    const SpentBudgetScope inner;
    Job job;
    job.evaluation_budget = 2;
    EXPECT_TRUE(solve(examples::tolouei_rad_milling().problem, {}, job));
    EXPECT_TRUE(inner.spent());
  }
  EXPECT_TRUE(outer.spent());
  EXPECT_FALSE(SpentBudgetScope().spent());
}

TEST(Solve, ASpentBudgetOfAThreadWithoutAScopeIsToldToThoseThatLive) {
  const SpentBudgetScope outer, inner;
  std::thread([] {
    const SpentBudgetScope own;
    tell_budget_spent();
    EXPECT_TRUE(own.spent());
  }).join();
  EXPECT_FALSE(inner.spent());
  std::thread([] { tell_budget_spent(); }).join();
  EXPECT_TRUE(inner.spent());
  EXPECT_TRUE(outer.spent());
  EXPECT_FALSE(SpentBudgetScope().spent());
}

TEST(Solve, AgreesWithAnEvolutionStrategyThatKnowsNoSlopes) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  Options o;
  o.algorithm = Algorithm::kIsres;
  o.fall_back = false;
  o.starts = 1;
  o.evaluation_budget = 100000;
  Job job;
  const auto s = solve(examples::tolouei_rad_milling().problem, o, job);
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->feasible);
  EXPECT_NEAR(s->objective, -2.6702, 2e-3 * 2.6702);
  EXPECT_GT(s->objective, -2.6702 * 1.0001);  // nothing beats the optimum
}

TEST(Solve, RefusesAProblemThatIsNotOne) {
  Job job;
  const auto refused = [&job](Problem p) {
    const auto s = solve(p, {}, job);
    return s ? std::string() : s.error().code;
  };
  Problem p = examples::projected_point();
  p.variables[0].lower = 9.0;
  EXPECT_EQ(refused(p), "OPT-PROBLEM");
  p = examples::projected_point();
  p.variables[0].upper = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(p), "OPT-PROBLEM");
  p = examples::projected_point();
  p.variables[1].name = "x";
  EXPECT_EQ(refused(p), "OPT-PROBLEM");
  p = examples::projected_point();
  p.variables[0].walk = Walk::kLogarithmic;  // from 0
  EXPECT_EQ(refused(p), "OPT-PROBLEM");
  p = examples::projected_point();
  p.model = nullptr;
  EXPECT_EQ(refused(p), "OPT-PROBLEM");
}

TEST(Solve, JudgesAProblemWithoutAFreeVariable) {
  Problem p = examples::projected_point();
  p.variables = {{"x", "mm", 1.0, 1.0, 1.0}, {"y", "mm", 3.0, 3.0, 3.0}};
  Job job;
  const auto s = solve(p, {}, job);
  ASSERT_TRUE(s);
  EXPECT_FALSE(s->feasible);
  EXPECT_EQ(s->max_violation, 1.0);
  EXPECT_EQ(s->outcome, Outcome::kInfeasible);
}

TEST(FirstOrder, FindsTheMultipliersThatBalanceTheGradient) {
  // min -x - 2y: constraints with gradients (1,0), (0,1), and (1,1) which must get nothing twice.
  const Evaluation e{.objective = 0.0,
                     .constraints = {0.0, 0.0, -1.0},
                     .gradient = {-1.0, -2.0},
                     .jacobian = {1.0, 0.0, 0.0, 1.0, 1.0, 1.0}};
  const FirstOrder f = first_order(e, {0.5, 0.5}, 1e-6);
  ASSERT_EQ(f.reached.size(), 2u);
  EXPECT_NEAR(f.reached[0].multiplier, 1.0, 1e-12);
  EXPECT_NEAR(f.reached[1].multiplier, 2.0, 1e-12);
  EXPECT_LT(f.residual, 1e-12);
}

TEST(FirstOrder, GivesNoNegativePrice) {
  // The only active constraint pushes the wrong way.
  const Evaluation e{.objective = 0.0, .constraints = {0.0}, .gradient = {1.0}, .jacobian = {1.0}};
  const FirstOrder f = first_order(e, {0.5}, 1e-6);
  EXPECT_EQ(f.reached.at(0).multiplier, 0.0);
  EXPECT_NEAR(f.residual, 1.0, 1e-12);
}

}  // namespace
}  // namespace capstan::optimise
