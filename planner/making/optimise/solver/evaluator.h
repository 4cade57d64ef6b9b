#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/optimise/problem/problem.h"

namespace capstan::optimise {

/// A problem as the backends see it: free variables mapped to [0, 1] (linearly or logarithmically), fixed
/// variables removed. Evaluates the model once per point for all callers, and counts these points.
class Evaluator {
 public:
  /// Needs a validated problem, which must outlive this.
  Evaluator(const Problem& problem, const Job& job, double feasibility_tolerance);

  [[nodiscard]] std::size_t variables() const { return free_.size(); }
  [[nodiscard]] std::size_t constraints() const { return problem_.constraints.size(); }

  /// Values at u, and slopes by u if wanted; held until the next call. A point outside the box is taken
  /// to its border. Throws what the model throws.
  const Evaluation& at(std::span<const double> u, bool want_slopes);

  /// Whether objective, constraints and (if computed) slopes of the last point are finite.
  [[nodiscard]] bool finite() const { return finite_; }

  [[nodiscard]] std::uint32_t evaluations() const { return evaluations_; }
  /// Points may be evaluated until the count reaches `total`.
  void allow_until(std::uint32_t total) { allowed_ = total; }
  [[nodiscard]] bool exhausted() const { return evaluations_ >= allowed_ || job_.stop_requested(); }

  [[nodiscard]] std::vector<double> to_x(std::span<const double> u) const;
  /// Into the bounds, then to the unit box.
  [[nodiscard]] std::vector<double> to_u(std::span<const double> x) const;
  /// dx/du of free variable k at u.
  [[nodiscard]] double stretch(std::size_t k, double u) const;
  /// Index in the problem of free variable k.
  [[nodiscard]] std::size_t index(std::size_t k) const { return free_[k]; }

  /// The best point evaluated so far: feasible with the least objective, else of least violation.
  struct Best {
    std::vector<double> u;
    double objective = 0.0;
    double violation = 0.0;
    bool known = false;
  };
  [[nodiscard]] const Best& best() const { return best_; }
  void forget_best() { best_ = {}; }

 private:
  void compute(bool want_slopes);
  void remember();

  const Problem& problem_;
  const Job& job_;
  double tolerance_;
  std::vector<std::size_t> free_;
  std::vector<double> u_;
  Evaluation raw_;
  Evaluation unit_;
  bool valid_ = false;
  bool slopes_ = false;
  bool finite_ = false;
  std::uint32_t evaluations_ = 0;
  std::uint32_t allowed_ = 0;
  Best best_;
};

/// Largest constraint above zero; infinite when one is not a number.
[[nodiscard]] double max_violation(const Evaluation& e);

}  // namespace capstan::optimise
