#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::optimise {

/// How a solver walks along a variable. Speeds, feeds and depths are better on a logarithmic walk.
enum class Walk { kLinear, kLogarithmic };

struct Variable {
  std::string name;
  std::string unit;
  double lower = 0.0;
  double upper = 0.0;
  double start = 0.0;  ///< first start; taken into the bounds
  Walk walk = Walk::kLinear;
};

/// Values and derivatives of a model at one point.
struct Evaluation {
  double objective = 0.0;
  std::vector<double> constraints;  ///< c_i, satisfied when <= 0
  std::vector<double> gradient;     ///< d objective / d x_j
  /// Shape: jacobian[i * variables + j] = d c_i / d x_j
  std::vector<double> jacobian;
};

/// x -> objective and constraints, and their slopes when asked for. All vectors of `out` have their size
/// already. Must be a pure function of x; what it throws comes out of `solve`.
using Model = std::function<void(std::span<const double> x, bool want_slopes, Evaluation& out)>;

/// Minimise objective(x) subject to c_i(x) <= 0 and lower <= x <= upper.
///
/// Needs     constraints written as ratios (power / limit - 1), so that one tolerance fits all and a
///           multiplier reads as "what one part in a hundred more of this limit is worth".
struct Problem {
  std::vector<Variable> variables;
  std::vector<std::string> constraints;  ///< their names, as `explain` prints them
  Model model;
};

/// Fails with OPT-PROBLEM: no variable or model, an empty or repeated name, a bound that is not finite,
/// lower > upper, a start that is not finite, a logarithmic walk with lower <= 0.
[[nodiscard]] Status validate(const Problem& problem);

/// A function without slopes.
using PlainModel =
    std::function<void(std::span<const double> x, double& objective, std::span<double> constraints)>;

/// Slopes by central differences, step 1e-6 of a variable's range, one-sided at a bound. A slope costs 2 N
/// calls of `plain`, which count as one evaluation. Accuracy  about 1e-9 of the range's change of the
/// function; keep `plain` smooth to 1e-12.
[[nodiscard]] Model central_differences(PlainModel plain, std::vector<Variable> variables);

}  // namespace capstan::optimise
