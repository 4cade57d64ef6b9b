#pragma once

#include <cstddef>
#include <vector>

#include "planner/making/optimise/solver/evaluator.h"

namespace capstan::optimise {

/// A limit of the unit box that is reached at u.
struct ReachedLimit {
  enum class Kind { kConstraint, kLowerBound, kUpperBound } kind = Kind::kConstraint;
  std::size_t index = 0;    ///< of the constraint, or of the free variable
  double multiplier = 0.0;  ///< >= 0, for the unit box
};

struct FirstOrder {
  std::vector<ReachedLimit> reached;  ///< constraints, then bounds, each in order
  double residual = 0.0;              ///< largest part of grad f + J^T lambda, over max(1, |grad f|)
};

/// Multipliers that come closest to stationarity: min |grad f + sum lambda_i grad c_i|, lambda >= 0, over
/// the constraints with c_i >= -active_tolerance and the bounds within it.
///
/// Needs     slopes in `e`, finite.
/// Source    Lawson & Hanson, Solving Least Squares Problems, chapter 23 (NNLS).
[[nodiscard]] FirstOrder first_order(const Evaluation& e, const std::vector<double>& u,
                                     double active_tolerance);

}  // namespace capstan::optimise
