#include "planner/making/optimise/solver/evaluator.h"

#include "planner/ground/base/stopping.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::optimise {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

double max_violation(const Evaluation& e) {
  double worst = 0.0;
  for (const double c : e.constraints) {
    if (!std::isfinite(c)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, c);
  }
  return worst;
}

Evaluator::Evaluator(const Problem& problem, const Job& job, double feasibility_tolerance)
    : problem_(problem), job_(job), tolerance_(feasibility_tolerance) {
  for (std::size_t j = 0; j < problem.variables.size(); ++j) {
    if (problem.variables[j].lower < problem.variables[j].upper) free_.push_back(j);
  }
  const std::size_t m = problem.constraints.size();
  raw_ = {.constraints = std::vector<double>(m),
          .gradient = std::vector<double>(problem.variables.size()),
          .jacobian = std::vector<double>(m * problem.variables.size())};
  unit_ = {.constraints = std::vector<double>(m),
           .gradient = std::vector<double>(free_.size()),
           .jacobian = std::vector<double>(m * free_.size())};
}

std::vector<double> Evaluator::to_x(std::span<const double> u) const {
  std::vector<double> x;
  x.reserve(problem_.variables.size());
  for (const Variable& v : problem_.variables) x.push_back(v.lower);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Variable& v = problem_.variables[free_[k]];
    const double t = std::clamp(u[k], 0.0, 1.0);
    const double value = v.walk == Walk::kLogarithmic ? v.lower * std::pow(v.upper / v.lower, t)
                                                      : v.lower + t * (v.upper - v.lower);
    // The ends exactly, whatever pow rounds to.
    x[free_[k]] = t == 1.0 ? v.upper : std::clamp(value, v.lower, v.upper);
  }
  return x;
}

std::vector<double> Evaluator::to_u(std::span<const double> x) const {
  std::vector<double> u;
  u.reserve(free_.size());
  for (const std::size_t j : free_) {
    const Variable& v = problem_.variables[j];
    const double value = std::clamp(x[j], v.lower, v.upper);
    const double t = v.walk == Walk::kLogarithmic ? std::log(value / v.lower) / std::log(v.upper / v.lower)
                                                  : (value - v.lower) / (v.upper - v.lower);
    u.push_back(std::clamp(t, 0.0, 1.0));
  }
  return u;
}

double Evaluator::stretch(std::size_t k, double u) const {
  const Variable& v = problem_.variables[free_[k]];
  if (v.walk == Walk::kLinear) return v.upper - v.lower;
  const double ratio = v.upper / v.lower;
  return v.lower * std::pow(ratio, std::clamp(u, 0.0, 1.0)) * std::log(ratio);
}

const Evaluation& Evaluator::at(std::span<const double> u, bool want_slopes) {
  const bool same = valid_ && std::equal(u.begin(), u.end(), u_.begin(), u_.end());
  if (same && (slopes_ || !want_slopes)) return unit_;
  if (!same) ++evaluations_;
  u_.assign(u.begin(), u.end());
  valid_ = false;
  compute(want_slopes);
  valid_ = true;
  slopes_ = want_slopes;
  if (!same) remember();
  return unit_;
}

void Evaluator::compute(bool want_slopes) {
  poll();
  problem_.model(to_x(u_), want_slopes, raw_);
  unit_.objective = raw_.objective;
  unit_.constraints = raw_.constraints;
  finite_ = std::isfinite(raw_.objective) && all_finite(raw_.constraints);
  if (!want_slopes) return;
  const std::size_t n = problem_.variables.size();
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const double s = stretch(k, u_[k]);
    unit_.gradient[k] = raw_.gradient[free_[k]] * s;
    for (std::size_t i = 0; i < constraints(); ++i) {
      unit_.jacobian[i * free_.size() + k] = raw_.jacobian[i * n + free_[k]] * s;
    }
  }
  finite_ = finite_ && all_finite(unit_.gradient) && all_finite(unit_.jacobian);
}

void Evaluator::remember() {
  if (!std::isfinite(unit_.objective)) return;
  const double violation = max_violation(unit_);
  if (!std::isfinite(violation)) return;
  const bool feasible = violation <= tolerance_;
  const bool had_feasible = best_.known && best_.violation <= tolerance_;
  const bool better = !best_.known || (feasible ? !had_feasible || unit_.objective < best_.objective
                                                : !had_feasible && violation < best_.violation);
  if (better) best_ = {u_, unit_.objective, violation, true};
}

}  // namespace capstan::optimise
