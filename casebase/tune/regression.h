#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace capstan::casebase::tune {

/// One observation of a linear model: y = x . b + (what its group has in common) + noise.
struct Row {
  std::vector<double> x;  ///< the terms; the constant is one of them, where there is one
  double y = 0.0;         ///< most often a logarithm
  double weight = 1.0;    ///< against the others; 0: not heard
  std::size_t group = 0;  ///< rows of one edge, one plate, one source: they do not count as independent
  /// Rows of one kind scatter alike, those of another need not: slender tools more than short ones.
  std::size_t kind = 0;
};

/// What is held of one coefficient before anything is observed. The default says nothing of it.
struct PriorTerm {
  double mean = 0.0;
  double std_dev = std::numeric_limits<double>::infinity();
};

struct RegressionOptions {
  std::vector<PriorTerm> prior = {};  ///< one per term; missing ones say nothing
  double noise = 0.1;                 ///< std dev of one row that is expected beforehand
  double noise_rows = 2.0;            ///< how many rows that expectation is worth
  double between = 0.0;               ///< std dev between groups that is expected beforehand
  double between_groups = 2.0;        ///< how many groups that expectation is worth
  bool robust = true;  ///< Huber's weights, then Tukey's: rows far from all others are not heard
  /// Rows above, or below, the fit count in full however far they lie: those of the unsafe side.
  bool hear_above = false, hear_below = false;
};

/// A fitted model with its uncertainty.
struct Regression {
  std::vector<double> coefficient;
  std::vector<double> covariance;  ///< of the coefficients, row by row
  double noise = 0.0;              ///< std dev of a row within its group
  double between = 0.0;            ///< std dev between groups
  double effective_rows = 0.0;     ///< sum of the weights that the rows ended with, as shares of the largest
  std::size_t groups = 0;
  std::vector<double> weight;  ///< of each row in the end, 0 to 1: how far it was believed
  /// Of a kind of rows: its scatter over `noise` and `between`, and how many degrees of freedom tell it.
  struct Kind {
    std::size_t kind = 0;
    double scatter = 1.0, freedom = 0.0;
  };
  std::vector<Kind> kinds;  ///< empty: all rows are of one kind

  [[nodiscard]] double at(std::span<const double> x) const;
  /// Of the mean at x, by the coefficients alone.
  [[nodiscard]] double std_dev_at(std::span<const double> x) const;
  /// Of one further row of a further group at x. Of a kind that no row is of: as of the one that scatters
  /// most.
  [[nodiscard]] double predictive_std_dev_at(std::span<const double> x, std::size_t kind = 0) const;
  [[nodiscard]] const Kind* kind_of(std::size_t kind) const;
  [[nodiscard]] double std_dev(std::size_t term) const;
};

/// Ridge regression with a random effect of the groups, fitted by iterated weights. Where rows are of several
/// kinds each kind has a scatter of its own: what is expected beforehand counts in each as `noise_rows`.
///
/// Needs    rows of `terms` finite numbers, weights of at least 0. Terms that neither rows nor prior tell
///          anything of stay at the prior's mean (0 where there is none) with a std dev of 1e3.
/// Cost     linear in the rows.
[[nodiscard]] Regression regress(std::span<const Row> rows, std::size_t terms,
                                 const RegressionOptions& options);

/// What each row is predicted as by a model fitted without it and without the other rows of its group.
struct LeftOut {
  double observed = 0.0, predicted = 0.0;
  double std_dev = 0.0;  ///< that the prediction states
  double freedom = 0.0;  ///< degrees of freedom that `std_dev` is estimated from; 0: as good as known
  /// Whether what was observed lies within the stated interval of 90 %.
  [[nodiscard]] bool within_90() const;
};
/// Half the interval of 90 %, in standard deviations that so many degrees of freedom tell (Student's t); 0:
/// the normal distribution's.
/// Accuracy  0.3 % from two degrees on.
/// Source    Abramowitz and Stegun, Handbook of Mathematical Functions, 1972, 26.7.5.
[[nodiscard]] double deviations_90(double freedom);
[[nodiscard]] std::vector<LeftOut> leave_groups_out(std::span<const Row> rows, std::size_t terms,
                                                    const RegressionOptions& options);
/// Root of the mean square of observed - predicted.
[[nodiscard]] double rms(std::span<const LeftOut> left_out);
/// Share of those that lie within their interval of 90 %.
[[nodiscard]] double coverage_90(std::span<const LeftOut> left_out);

}  // namespace capstan::casebase::tune
