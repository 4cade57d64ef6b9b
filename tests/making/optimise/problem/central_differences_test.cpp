#include <gtest/gtest.h>

#include <cmath>

#include "planner/making/optimise/problem/problem.h"
#include "tests/making/optimise/differentiated.h"

namespace capstan::optimise {
namespace {

using D = Dual<2>;

template <class T>
T everything(const T& x, const T& y) {
  using std::abs;
  using std::acos;
  using std::asin;
  using std::atan2;
  using std::cos;
  using std::exp;
  using std::log;
  using std::max;
  using std::min;
  using std::pow;
  using std::sin;
  using std::sqrt;
  using std::tan;
  T r = sqrt(x) * exp(-y) / log(x + 2.0) + pow(x, 1.7) - pow(y, 2.0) * 3.0;
  r += sin(x * y) * cos(y) - tan(0.3 * x) / (1.0 + y);
  r -= asin(0.2 * x) * acos(0.3 * y) + atan2(y, x) + pow(x, y);
  r *= abs(x - 5.0) + max(x, y) * min(x, y);
  r /= 2.0 - y / 7.0;
  return 1.0 / r;
}

TEST(Dual, SlopesAgreeWithDifferences) {
  const double x = 1.3;
  const double y = 0.8;
  const D r = everything(D::variable(x, 0), D::variable(y, 1));
  EXPECT_DOUBLE_EQ(r.v, everything(x, y));
  const double h = 1e-6;
  EXPECT_NEAR(r.d[0], (everything(x + h, y) - everything(x - h, y)) / (2.0 * h),
              1e-7 * std::abs(r.d[0]) + 1e-9);
  EXPECT_NEAR(r.d[1], (everything(x, y + h) - everything(x, y - h)) / (2.0 * h),
              1e-7 * std::abs(r.d[1]) + 1e-9);
}

TEST(CentralDifferences, AgreeWithExactSlopes) {
  const std::vector<Variable> variables = {{"x", "", 0.5, 2.0, 1.0}, {"y", "", 0.5, 1.0, 0.7}};
  const auto dual = differentiate<2>([](const auto& x, auto& f, auto& c) {
    f = everything(x[0], x[1]);
    c[0] = x[0] * x[1] - 1.0;
  });
  const auto plain = central_differences(
      [](std::span<const double> x, double& f, std::span<double> c) {
        f = everything(x[0], x[1]);
        c[0] = x[0] * x[1] - 1.0;
      },
      variables);
  for (const double y : {0.5, 0.8, 1.0}) {  // the ends, too
    const std::array<double, 2> x = {1.3, y};
    Evaluation a{.constraints = {0.0}, .gradient = {0.0, 0.0}, .jacobian = {0.0, 0.0}};
    Evaluation b = a;
    dual(x, true, a);
    plain(x, true, b);
    EXPECT_EQ(a.objective, b.objective);
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(a.gradient[j], b.gradient[j], 1e-5 * std::abs(a.gradient[j]) + 1e-7);
      EXPECT_NEAR(a.jacobian[j], b.jacobian[j], 1e-6);
    }
  }
}

}  // namespace
}  // namespace capstan::optimise
