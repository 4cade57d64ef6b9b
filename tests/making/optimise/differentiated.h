#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "planner/making/optimise/problem/problem.h"

/// Exact slopes of the published problems, against which planning's differences and solvers are held.
namespace capstan::optimise {

/// A number that carries its slopes: value + sum of d[i] eps_i, eps_i eps_j = 0 (forward differentiation).
///
/// Write a formula once as a template over its number type, with `using std::sqrt; sqrt(x)`; called with
/// Dual it gives exact derivatives, called with double the value alone.
///
/// Needs     N, the number of variables, at compile time; up to about a dozen.
/// Fails     where a derivative is infinite or undefined (sqrt or pow at 0, acos at 1) the slope is not
///           finite, which the solver's fence reports. Comparisons look at the value only.
/// Source    Griewank & Walther, Evaluating Derivatives, chapter 3.
template <std::size_t N>
struct Dual {
  double v = 0.0;
  std::array<double, N> d{};

  constexpr Dual() = default;
  constexpr Dual(double value) : v(value) {}  // NOLINT: a constant is a number without slopes

  /// Variable number `index`.
  [[nodiscard]] static constexpr Dual variable(double value, std::size_t index) {
    Dual x(value);
    x.d[index] = 1.0;
    return x;
  }

  /// f(x) with slope f'(x), by the chain rule.
  [[nodiscard]] constexpr Dual chain(double value, double slope) const {
    Dual r(value);
    // 0 times an infinite slope is 0 here: a variable that does not enter has no influence.
    for (std::size_t i = 0; i < N; ++i) r.d[i] = d[i] == 0.0 ? 0.0 : slope * d[i];
    return r;
  }

  constexpr Dual& operator+=(const Dual& o) { return *this = *this + o; }
  constexpr Dual& operator-=(const Dual& o) { return *this = *this - o; }
  constexpr Dual& operator*=(const Dual& o) { return *this = *this * o; }
  constexpr Dual& operator/=(const Dual& o) { return *this = *this / o; }

  friend constexpr Dual operator-(const Dual& a) { return a.chain(-a.v, -1.0); }
  friend constexpr Dual operator+(const Dual& a, const Dual& b) { return combine(a, b, a.v + b.v, 1.0, 1.0); }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) {
    return combine(a, b, a.v - b.v, 1.0, -1.0);
  }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) { return combine(a, b, a.v * b.v, b.v, a.v); }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    return combine(a, b, a.v / b.v, 1.0 / b.v, -a.v / (b.v * b.v));
  }
  friend constexpr Dual operator+(const Dual& a, double b) { return a.chain(a.v + b, 1.0); }
  friend constexpr Dual operator+(double a, const Dual& b) { return b.chain(a + b.v, 1.0); }
  friend constexpr Dual operator-(const Dual& a, double b) { return a.chain(a.v - b, 1.0); }
  friend constexpr Dual operator-(double a, const Dual& b) { return b.chain(a - b.v, -1.0); }
  friend constexpr Dual operator*(const Dual& a, double b) { return a.chain(a.v * b, b); }
  friend constexpr Dual operator*(double a, const Dual& b) { return b.chain(a * b.v, a); }
  friend constexpr Dual operator/(const Dual& a, double b) { return a.chain(a.v / b, 1.0 / b); }
  friend constexpr Dual operator/(double a, const Dual& b) { return b.chain(a / b.v, -a / (b.v * b.v)); }

  friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend constexpr bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend constexpr bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }

  friend Dual sqrt(const Dual& a) {
    const double r = std::sqrt(a.v);
    return a.chain(r, 0.5 / r);
  }
  friend Dual exp(const Dual& a) {
    const double r = std::exp(a.v);
    return a.chain(r, r);
  }
  friend Dual log(const Dual& a) { return a.chain(std::log(a.v), 1.0 / a.v); }
  friend Dual pow(const Dual& a, double p) {
    return a.chain(std::pow(a.v, p), p == 0.0 ? 0.0 : p * std::pow(a.v, p - 1.0));
  }
  friend Dual pow(const Dual& a, const Dual& p) {
    const double r = std::pow(a.v, p.v);
    return combine(a, p, r, p.v * std::pow(a.v, p.v - 1.0), r * std::log(a.v));
  }
  friend Dual sin(const Dual& a) { return a.chain(std::sin(a.v), std::cos(a.v)); }
  friend Dual cos(const Dual& a) { return a.chain(std::cos(a.v), -std::sin(a.v)); }
  friend Dual tan(const Dual& a) {
    const double t = std::tan(a.v);
    return a.chain(t, 1.0 + t * t);
  }
  friend Dual asin(const Dual& a) { return a.chain(std::asin(a.v), 1.0 / std::sqrt(1.0 - a.v * a.v)); }
  friend Dual acos(const Dual& a) { return a.chain(std::acos(a.v), -1.0 / std::sqrt(1.0 - a.v * a.v)); }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double r2 = x.v * x.v + y.v * y.v;
    return combine(y, x, std::atan2(y.v, x.v), x.v / r2, -y.v / r2);
  }
  friend Dual abs(const Dual& a) { return a.chain(std::abs(a.v), a.v < 0.0 ? -1.0 : 1.0); }
  friend Dual min(const Dual& a, const Dual& b) { return b.v < a.v ? b : a; }
  friend Dual max(const Dual& a, const Dual& b) { return a.v < b.v ? b : a; }

 private:
  static constexpr Dual combine(const Dual& a, const Dual& b, double value, double da, double db) {
    Dual r(value);
    for (std::size_t i = 0; i < N; ++i) {
      r.d[i] = (a.d[i] == 0.0 ? 0.0 : da * a.d[i]) + (b.d[i] == 0.0 ? 0.0 : db * b.d[i]);
    }
    return r;
  }
};

/// A model from one formula, written once for any number type:
///
///     differentiate<2>([](const auto& x, auto& objective, auto& c) {
///       objective = 1.0 / (x[0] * x[1]);
///       c[0] = x[0] * x[0] * x[1] / 900.0 - 1.0;
///     });
///
/// x is a std::array<T, N>, c a std::vector<T> of the problem's number of constraints; T is double when
/// no slopes are wanted, else Dual<N>.
template <std::size_t N, class Formula>
[[nodiscard]] Model differentiate(Formula formula) {
  return [formula = std::move(formula)](std::span<const double> x, bool want_slopes, Evaluation& out) {
    if (!want_slopes) {
      std::array<double, N> point;
      for (std::size_t j = 0; j < N; ++j) point[j] = x[j];
      formula(point, out.objective, out.constraints);
      return;
    }
    using T = Dual<N>;
    std::array<T, N> point;
    for (std::size_t j = 0; j < N; ++j) point[j] = T::variable(x[j], j);
    T objective;
    std::vector<T> constraints(out.constraints.size());
    formula(point, objective, constraints);
    out.objective = objective.v;
    for (std::size_t j = 0; j < N; ++j) out.gradient[j] = objective.d[j];
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      out.constraints[i] = constraints[i].v;
      for (std::size_t j = 0; j < N; ++j) out.jacobian[i * N + j] = constraints[i].d[j];
    }
  };
}

}  // namespace capstan::optimise
