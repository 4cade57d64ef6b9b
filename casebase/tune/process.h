#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "casebase/tune/regression.h"

namespace capstan::casebase::tune {

/// Standard deviations and lengths of a Gaussian process,
///
///     cov(y, y') = sum_k p_k^2 x_k x'_k + field^2 Matern(x, x') + group^2 [same group] + noise^2 / weight
///     [same row]
///
/// with x_0 = 1 and p_k the std devs of the linear prior.
struct ProcessSpreads {
  double field = 0.0;                ///< of what is not linear; 0: none of it (Bayesian linear regression)
  std::vector<double> lengths = {};  ///< one per dimension, in its unit
  double group = 0.0;
  double noise = 0.1;
};

/// A value, and how sure it is.
struct Belief {
  double mean = 0.0;
  double std_dev = 0.0;       ///< of the mean over all groups
  double next_std_dev = 0.0;  ///< of what the next row of a new group shows: group and noise included
};

/// A Gaussian process with a linear part: what is believed of one quantity after some observations.
///
/// Source  Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006: algorithm 2.1, linear part
///         2.7, leave-one-out 5.4.2.
/// Cost    cubic in the rows once, square for each question.
class Process {
 public:
  /// `prior`: of the constant and of each dimension's slope; its std devs finite. Rows' `x` are without the
  /// constant.
  Process(std::vector<Row> rows, std::vector<PriorTerm> prior, ProcessSpreads spreads);
  Process(Process&&) noexcept;
  Process& operator=(Process&&) noexcept;
  ~Process();

  [[nodiscard]] Belief at(std::span<const double> x) const;
  /// Log of the marginal likelihood.
  [[nodiscard]] double log_likelihood() const;
  [[nodiscard]] const ProcessSpreads& spreads() const;
  /// Rows' residual when left out, in standard deviations.
  [[nodiscard]] std::vector<double> left_out() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a process may learn of its own spreads: each is searched within these factors of its start, with a
/// penalty for leaving it (log-normal, std dev of ln 2).
struct ProcessLearning {
  double least = 0.25, most = 4.0;
  std::size_t needed_rows = 6;  ///< below, the start holds
  /// A value far below what all others say weighs less: a load that low is more likely an error of
  /// measurement than luck. One far above is heard in full.
  bool doubt_low = true;
};

/// A process whose spreads are those of the largest posterior probability, by a search of fixed steps.
[[nodiscard]] Process learnt(std::vector<Row> rows, const std::vector<PriorTerm>& prior,
                             const ProcessSpreads& start, const ProcessLearning& learning);

/// The probability that something goes wrong (chatter, breakage, a bad verdict) by place, from what did and
/// what did not: a Gaussian process behind a normal distribution's integral, by Laplace's approximation.
///
/// Source  Rasmussen and Williams 2006, algorithms 3.1 and 3.2, equation 3.82.
class FailureProcess {
 public:
  /// `y` of the rows: above 0 failed, else not. `prior`: of the latent value, in standard deviations, and of
  /// its slopes. Groups share a latent value.
  FailureProcess(std::vector<Row> rows, std::vector<PriorTerm> prior, ProcessSpreads spreads);
  FailureProcess(FailureProcess&&) noexcept;
  FailureProcess& operator=(FailureProcess&&) noexcept;
  ~FailureProcess();
  /// Probability at x for a new group; the uncertainty of the latent value is in it.
  [[nodiscard]] double at(std::span<const double> x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// P(Z <= z) of the normal distribution.
[[nodiscard]] double normal_probability(double z);

}  // namespace capstan::casebase::tune
