#include "planner/making/optimise/solver/multipliers.h"

#include <algorithm>
#include <cmath>

namespace capstan::optimise {
namespace {

using Values = std::vector<double>;

double dot(const Values& a, const Values& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Least squares A_passive z = b by modified Gram-Schmidt; columns that depend on earlier ones get 0.
std::vector<double> least_squares(const std::vector<Values>& columns, const std::vector<std::size_t>& passive,
                                  const Values& b) {
  constexpr double kDependent = 1e-10;
  const std::size_t k = passive.size();
  std::vector<Values> q;
  std::vector<Values> r(k, Values(k, 0.0));
  Values rest = b;
  Values right(k, 0.0);
  for (std::size_t j = 0; j < k; ++j) {
    q.push_back(columns[passive[j]]);
    const double before = std::sqrt(dot(q[j], q[j]));
    for (std::size_t i = 0; i < j; ++i) {
      r[i][j] = dot(q[i], q[j]);
      for (std::size_t s = 0; s < b.size(); ++s) q[j][s] -= r[i][j] * q[i][s];
    }
    const double after = std::sqrt(dot(q[j], q[j]));
    if (after <= kDependent * before) {
      std::fill(q[j].begin(), q[j].end(), 0.0);
      continue;
    }
    r[j][j] = after;
    for (double& v : q[j]) v /= after;
    right[j] = dot(q[j], rest);
    for (std::size_t s = 0; s < b.size(); ++s) rest[s] -= right[j] * q[j][s];
  }
  std::vector<double> z(k, 0.0);
  for (std::size_t j = k; j-- > 0;) {
    if (r[j][j] == 0.0) continue;
    double value = right[j];
    for (std::size_t i = j + 1; i < k; ++i) value -= r[j][i] * z[i];
    z[j] = value / r[j][j];
  }
  return z;
}

/// min |A x - b|, x >= 0, columns of unit length.
std::vector<double> nnls(const std::vector<Values>& columns, const Values& b) {
  const std::size_t n = columns.size();
  std::vector<double> x(n, 0.0);
  std::vector<bool> in(n, false);
  Values rest = b;
  const double enough = 1e-12 * std::max(1.0, std::sqrt(dot(b, b)));
  for (std::size_t outer = 0; outer < 3 * n + 3; ++outer) {
    std::size_t enter = n;
    double steepest = enough;
    for (std::size_t j = 0; j < n; ++j) {
      const double w = dot(columns[j], rest);
      if (!in[j] && w > steepest) {
        steepest = w;
        enter = j;
      }
    }
    if (enter == n) break;
    in[enter] = true;
    for (std::size_t inner = 0; inner <= n; ++inner) {
      std::vector<std::size_t> passive;
      for (std::size_t j = 0; j < n; ++j) {
        if (in[j]) passive.push_back(j);
      }
      const std::vector<double> z = least_squares(columns, passive, b);
      double step = 1.0;
      for (std::size_t i = 0; i < passive.size(); ++i) {
        if (z[i] <= 0.0) step = std::min(step, x[passive[i]] / (x[passive[i]] - z[i] + 1e-300));
      }
      bool left = false;
      for (std::size_t i = 0; i < passive.size(); ++i) {
        double& value = x[passive[i]];
        value += step * (z[i] - value);
        if (z[i] <= 0.0 && value <= 1e-14) {
          value = 0.0;
          in[passive[i]] = false;
          left = true;
        }
      }
      if (!left) break;
    }
    rest = b;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t s = 0; s < b.size(); ++s) rest[s] -= x[j] * columns[j][s];
    }
  }
  return x;
}

}  // namespace

FirstOrder first_order(const Evaluation& e, const std::vector<double>& u, double active_tolerance) {
  const std::size_t n = u.size();
  FirstOrder result;
  std::vector<Values> columns;
  const auto add = [&](ReachedLimit limit, Values slope) {
    result.reached.push_back(limit);
    columns.push_back(std::move(slope));
  };
  for (std::size_t i = 0; i < e.constraints.size(); ++i) {
    if (e.constraints[i] < -active_tolerance) continue;
    const auto row = e.jacobian.begin() + static_cast<std::ptrdiff_t>(i * n);
    add({ReachedLimit::Kind::kConstraint, i, 0.0}, Values(row, row + static_cast<std::ptrdiff_t>(n)));
  }
  for (std::size_t k = 0; k < n; ++k) {
    Values slope(n, 0.0);
    if (u[k] <= active_tolerance) {
      slope[k] = -1.0;
      add({ReachedLimit::Kind::kLowerBound, k, 0.0}, std::move(slope));
    } else if (u[k] >= 1.0 - active_tolerance) {
      slope[k] = 1.0;
      add({ReachedLimit::Kind::kUpperBound, k, 0.0}, std::move(slope));
    }
  }
  std::vector<double> length;
  for (Values& c : columns) {
    length.push_back(std::sqrt(dot(c, c)));
    for (double& v : c) v = length.back() > 0.0 ? v / length.back() : 0.0;
  }
  Values downhill = e.gradient;
  for (double& v : downhill) v = -v;
  const std::vector<double> lambda = nnls(columns, downhill);
  Values rest = e.gradient;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::size_t s = 0; s < n; ++s) rest[s] += lambda[j] * columns[j][s];
    result.reached[j].multiplier = length[j] > 0.0 ? lambda[j] / length[j] : 0.0;
  }
  const double scale = std::max(1.0, std::sqrt(dot(e.gradient, e.gradient)));
  for (const double v : rest) result.residual = std::max(result.residual, std::abs(v) / scale);
  return result;
}

}  // namespace capstan::optimise
