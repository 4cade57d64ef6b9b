// What went wrong when solvers were measured on machining problems; each trap stays sprung.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/making/optimise/solver/solvers.h"
#include "planner/making/optimise/solver/solver.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "tests/making/optimise/examples.h"

namespace capstan::optimise {
namespace {

using examples::Example;

bool has_nlopt() {
  Job job;
  return solve(examples::projected_point(), {}, job).has_value();
}

bool has_ipopt() {
  Options o;
  o.solver = Solver::kIpopt;
  o.fall_back = false;
  o.backends = all_backends();
  Job job;
  return solve(examples::projected_point(), o, job).has_value();
}

/// Most area per tooth of a 10 mm cutter, chip at most 0.05 mm, cutting force (~ width) bounded.
Problem widest_cut(double (*chip)(double fz, double ae)) {
  Problem p{.variables = {{"width", "mm", 0.5, 9.99, 3.0, Walk::kLogarithmic},
                          {"feed", "mm", 0.01, 0.3, 0.03, Walk::kLogarithmic}},
            .constraints = {"chip"},
            .model = {}};
  p.model = central_differences(
      [chip](std::span<const double> x, double& f, std::span<double> c) {
        f = -std::log(x[0] * x[1]);
        c[0] = chip(x[1], x[0]) / 0.05 - 1.0;
      },
      p.variables);
  return p;
}

TEST(Trap, TheSquareRootBeyondHalfImmersionIsALoopholeAndTheCappedFormIsNot) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  Job job;
  const auto bare = [](double fz, double ae) {
    const double r = ae / 10.0;
    return 2.0 * fz * std::sqrt(r * (1.0 - r));
  };
  const auto escaped = solve(widest_cut(bare), {}, job);
  ASSERT_TRUE(escaped && escaped->feasible);
  EXPECT_GT(escaped->x[0], 9.5);  // nearly a slot
  EXPECT_NEAR(escaped->x[1], 0.3, 1e-6);
  const auto capped = [](double fz, double ae) { return mechanics::max_chip_thickness_mm(fz, ae, 10.0); };
  const auto kept = solve(widest_cut(capped), {}, job);
  ASSERT_TRUE(kept && kept->feasible);
  EXPECT_LE(kept->x[1], 0.05 * (1.0 + 1e-5));  // a slot, but at the chip it bears
  EXPECT_LE(kept->x[0] * kept->x[1], 9.99 * 0.05 * (1.0 + 1e-5));
}

/// Cutting time over an angle that has an infinite slope at the full width.
Problem until_the_diameter() {
  return {.variables = {{"width", "mm", 0.1, 10.0, 10.0}},
          .constraints = {"angle"},
          .model = differentiate<1>([](const auto& x, auto& f, auto& c) {
            using std::acos;
            f = 1.0 / x[0];
            c[0] = acos(1.0 - 2.0 * x[0] / 10.0) / 3.0 - 1.0;
          })};
}

TEST(Trap, AnInfiniteSlopeAtTheFullDiameterEndsNoSearch) {
  // acos(1 - 2 w / D) <= 3: w = D (1 - cos 3) / 2 = 9.94996, where the start, at w = D, has no finite slope.
  const double best = 10.0 * (1.0 - std::cos(3.0)) / 2.0;
  for (const bool ipopt : {false, true}) {
    if (!(ipopt ? has_ipopt() : has_nlopt())) continue;
    Options o;
    o.solver = ipopt ? Solver::kIpopt : Solver::kNlopt;
    o.backends = all_backends();  // SLSQP alone stops short of it
    Job job;
    const auto s = solve(until_the_diameter(), o, job);
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->feasible);
    EXPECT_NEAR(s->x[0], best, 1e-4) << ipopt;
  }
}

TEST(Trap, AToleranceBeyondRoundingStillGivesThePoint) {
  // NLopt then ends by "roundoff limited", which its C++ face throws.
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  for (const Algorithm a : {Algorithm::kSlsqp, Algorithm::kAuglagLbfgs}) {
    Options o;
    o.algorithm = a;
    o.fall_back = false;
    o.relative_tolerance = 0.0;
    o.evaluation_budget = 20000;
    Job job;
    const auto e = examples::tolouei_rad_milling();
    const auto s = solve(e.problem, o, job);
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->feasible);
    EXPECT_NEAR(s->objective, e.best_objective, 1e-4 * 2.6702);
  }
}

/// The turning of 6 mm in one rough pass with its depths left to the solver: d_s <= 3, d_r <= 3 and d_r >=
/// d_s leave one point, so that no depth is strictly inside.
Example with_both_depths() {
  auto e = examples::chen_tsai_turning(6.0, 1, 2.03508);
  e.problem.variables[4] = {"finish depth", "mm", 1.0, 3.0, 2.0};
  e.problem.constraints.insert(e.problem.constraints.end(), {"rough depth", "depth order"});
  e.problem.model = differentiate<5>([](const auto& x, auto& f, auto& c) {
    examples::chen_tsai(x, 6.0, 1, f, c);
    c[15] = (6.0 - x[4]) / 3.0 - 1.0;
    c[16] = x[4] / (6.0 - x[4]) - 1.0;
  });
  return e;
}

TEST(Trap, WhereverSlsqpEndsItIsMeasured) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  for (int k = 0; k < 40; ++k) {
    auto e = with_both_depths();
    double j = 0.0;
    for (Variable& v : e.problem.variables) {
      j += 1.0;
      v.walk = Walk::kLinear;
      const double t = 0.618034 * (k + 1) * j + 0.37 * j;
      v.start = v.lower + (t - std::floor(t)) * (v.upper - v.lower);
    }
    Options o;
    o.starts = 1;
    o.evaluation_budget = 20000;
    o.fall_back = false;
    Job job;
    const auto s = solve(e.problem, o, job);
    ASSERT_TRUE(s);
    Evaluation seen{.objective = 0.0,
                    .constraints = std::vector<double>(e.problem.constraints.size()),
                    .gradient = {},
                    .jacobian = {}};
    e.problem.model(s->x, false, seen);
    EXPECT_EQ(s->feasible, max_violation(seen) <= o.feasibility_tolerance) << k;
    EXPECT_EQ(s->max_violation, max_violation(seen)) << k;
  }
}

/// SLSQP as it can be: ends outside of the limits, where the objective is low.
Result<std::vector<double>> ends_outside(Evaluator& evaluator, const Attempt& attempt) {
  if (attempt.algorithm != Algorithm::kSlsqp) return solve_with_nlopt(evaluator, attempt);
  return std::vector<double>(evaluator.variables(), 0.7);
}

TEST(Trap, AnEndThatIsInfeasibleIsSeenAndMended) {
  if (!has_nlopt()) GTEST_SKIP() << "NLopt is absent";
  const auto e = with_both_depths();
  Options o;
  o.evaluation_budget = 20000;
  o.backends[Solver::kNlopt] = &ends_outside;
  Job job;
  const auto s = solve(e.problem, o, job);
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->feasible);
  EXPECT_EQ(s->method, "auglag+lbfgs");
  EXPECT_NEAR(s->objective, e.best_objective, 1e-4 * e.best_objective);
  o.fall_back = false;
  const auto alone = solve(e.problem, o, job);
  ASSERT_TRUE(alone);
  EXPECT_FALSE(alone->feasible);  // said, not hidden
}

/// Nothing here is smooth where it matters: a corner at the optimum, a staircase, or no value at all.
std::vector<Problem> rough_problems() {
  const std::vector<Variable> box = {{"x", "", 0.1, 10.0, 5.0, Walk::kLogarithmic},
                                     {"y", "", 0.1, 10.0, 5.0}};
  const auto of = [&](PlainModel m) {
    return Problem{.variables = box, .constraints = {"c"}, .model = central_differences(std::move(m), box)};
  };
  return {of([](auto x, double& f, auto c) {  // a corner that the limit meets
            f = std::max(2.0 / x[0], x[0]) + std::abs(x[1] - 3.0);
            c[0] = std::max(x[0] - 1.5, 1.0 - 2.0 * x[0]);
          }),
          of([](auto x, double& f, auto c) {  // a staircase
            f = -std::floor(5.0 * x[0]) - x[1];
            c[0] = std::floor(x[0] + x[1]) / 7.0 - 1.0;
          }),
          of([](auto x, double& f, auto c) {  // nothing is feasible
            f = x[0];
            c[0] = std::abs(x[0] - x[1]) + 1.0;
          }),
          of([](auto x, double& f, auto c) {  // no number over half of the box
            f = x[0] > 3.0 ? std::nan("") : -x[0];
            c[0] = x[1] > 6.0 ? std::numeric_limits<double>::infinity() : x[1] - 2.0;
          })};
}

TEST(Trap, NoMethodAsksBeyondItsBudgetWhateverTheModelIsLike) {
  for (const Solver solver : {Solver::kNlopt, Solver::kIpopt}) {
    if (!(solver == Solver::kIpopt ? has_ipopt() : has_nlopt())) continue;
    std::size_t number = 0;
    for (Problem& p : rough_problems()) {
      std::uint32_t asked = 0;
      p.model = [&asked, inner = p.model](std::span<const double> x, bool slopes, Evaluation& e) {
        ++asked;
        inner(x, slopes, e);
      };
      Options o;
      o.solver = solver;
      o.backends = all_backends();
      o.starts = 4;
      o.evaluation_budget = 300;
      Job job;
      const auto s = solve(p, o, job);
      ASSERT_TRUE(s) << number;
      EXPECT_LE(s->evaluations, 300u + 3u * 2u * o.starts) << number;  // ends are measured beside
      // A point may be asked twice: for its value, then for its slopes.
      EXPECT_LE(asked, 2u * s->evaluations + 3u) << number;
      EXPECT_EQ(s->feasible, number != 2) << number;
      ++number;
    }
  }
}

}  // namespace
}  // namespace capstan::optimise
