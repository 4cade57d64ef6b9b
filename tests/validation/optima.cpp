#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/solver/solvers.h"
#include "planner/making/optimise/solver/solver.h"
#include "tests/making/optimise/examples.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using optimise::examples::Example;
namespace examples = optimise::examples;

struct Stated {
  std::string name;
  Example example;
};

std::vector<Stated> stated() {
  return {
      {"five milling operations for profit, after Tolouei-Rad & Bidhendi 1997 ($/min, negative)",
       examples::tolouei_rad_milling()},
      {"turning 6 mm in one roughing pass, after Chen & Tsai 1996 ($)",
       examples::chen_tsai_turning(6.0, 1, 2.03508)},
      {"turning 8 mm in two roughing passes ($)", examples::chen_tsai_turning(8.0, 2, 2.55799)},
      {"turning 10 mm in three roughing passes ($)", examples::chen_tsai_turning(10.0, 3, 3.09427)},
      {"turning, least time, after Quiza Sardinas 2006 (min)",
       examples::quiza_turning(examples::QuizaGoal::kTime)},
      {"turning, least wear (%)", examples::quiza_turning(examples::QuizaGoal::kWear)},
      {"turning, least wear within 1 min (%)", examples::quiza_turning(examples::QuizaGoal::kWearWithinTime)},
      {"speed of least cost, Ghosh & Mallik 4.26", examples::textbook_speed(true)},
      {"speed of most production, Ghosh & Mallik 4.28", examples::textbook_speed(false)},
      {"a drilled hole, stated here", examples::drilled_hole()}};
}

double best(const optimise::Problem& problem, optimise::Solver solver) {
  optimise::Options o;
  o.solver = solver;
  o.starts = 10;
  o.evaluation_budget = 40000;
  o.backends = optimise::all_backends();
  Job job;
  const auto s = optimise::solve(problem, o, job);
  return s && s->feasible ? s->objective : std::nan("");
}

}  // namespace

Comparison optima() {
  Comparison out{.name = "optima"};
  Table rows{{"problem", "tabulated", "by NLopt", "difference", "by Ipopt", "difference"}, {}};
  Table data{{"index", "nlopt", "ipopt"}, {}};
  int n = 0;
  double worst = 0.0;
  const auto difference = [](double v, double tabled) { return std::abs(v / tabled - 1.0); };
  // Differences below what is printed of the tabulated optimum say nothing; six decimals of the objective do.
  const auto text = [](double v) { return v < 5e-7 ? std::string("< 1e-6") : fixed(1e6 * v, 0) + "e-6"; };
  for (const Stated& s : stated()) {
    const double tabled = s.example.best_objective;
    const double a = best(s.example.problem, optimise::Solver::kNlopt);
    const double b = best(s.example.problem, optimise::Solver::kIpopt);
    if (std::isnan(a) || std::isnan(b)) {
      out.skipped = "a solver is absent or found nothing feasible: " + s.name;
      return out;
    }
    rows.rows.push_back({s.name, shortest(rounded(tabled, 6)), fixed(a, 6), text(difference(a, tabled)),
                         fixed(b, 6), text(difference(b, tabled))});
    worst = std::max({worst, difference(a, tabled), difference(b, tabled)});
    data.rows.push_back({std::to_string(n++), fixed(1e6 * std::max(difference(a, tabled), 1e-8), 4),
                         fixed(1e6 * std::max(difference(b, tabled), 1e-8), 4)});
  }
  out.headline = std::to_string(n) + " problems by NLopt and Ipopt, largest relative difference " +
                 fixed(1e6 * worst, 0) + "e-6";
  out.text = markdown(rows);
  out.data.emplace_back("optima.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
