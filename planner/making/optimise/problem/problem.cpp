#include "planner/making/optimise/problem/problem.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/ground/base/number.h"

namespace capstan::optimise {
namespace {

tl::unexpected<Diagnostic> refuse(std::string path, std::string message, std::string expected) {
  return fail(Diagnostic{.code = "OPT-PROBLEM",
                         .message = std::move(message),
                         .path = std::move(path),
                         .expected = std::move(expected)});
}

Status validate(const Variable& v) {
  for (const double value : {v.lower, v.upper, v.start}) {
    if (!std::isfinite(value)) return refuse(v.name, "a bound or the start is not finite", "finite numbers");
  }
  if (v.lower > v.upper) {
    return refuse(v.name, "the lower bound " + shortest(v.lower) + " is above the upper " + shortest(v.upper),
                  "lower <= upper");
  }
  if (v.walk == Walk::kLogarithmic && !(v.lower > 0.0)) {
    return refuse(v.name, "a logarithmic walk from " + shortest(v.lower), "a lower bound above zero");
  }
  return {};
}

}  // namespace

Status validate(const Problem& problem) {
  if (problem.variables.empty()) return refuse({}, "the problem has no variable", "at least one");
  if (!problem.model) return refuse({}, "the problem has no model", "a callable");
  std::set<std::string> names;
  for (const Variable& v : problem.variables) {
    if (v.name.empty() || !names.insert(v.name).second) {
      return refuse(v.name, "a variable's name is empty or used twice", "names that tell them apart");
    }
    if (auto s = validate(v); !s) return s;
  }
  for (const std::string& name : problem.constraints) {
    if (name.empty() || !names.insert(name).second) {
      return refuse(name, "a constraint's name is empty or used twice", "names that tell them apart");
    }
  }
  return {};
}

Model central_differences(PlainModel plain, std::vector<Variable> variables) {
  return [plain = std::move(plain), variables = std::move(variables)](std::span<const double> x,
                                                                      bool want_slopes, Evaluation& out) {
    plain(x, out.objective, out.constraints);
    if (!want_slopes) return;
    const std::size_t n = variables.size();
    std::vector<double> point(x.begin(), x.end());
    std::vector<double> above(out.constraints.size());
    std::vector<double> below(out.constraints.size());
    for (std::size_t j = 0; j < n; ++j) {
      const Variable& v = variables[j];
      const double step = 1e-6 * (v.upper - v.lower);
      if (!(step > 0.0)) {  // a fixed variable needs no slope
        out.gradient[j] = 0.0;
        for (std::size_t i = 0; i < above.size(); ++i) out.jacobian[i * n + j] = 0.0;
        continue;
      }
      double f_above = 0.0;
      double f_below = 0.0;
      const double high = std::min(x[j] + step, v.upper);
      const double low = std::max(x[j] - step, v.lower);
      point[j] = high;
      plain(point, f_above, above);
      point[j] = low;
      plain(point, f_below, below);
      point[j] = x[j];
      out.gradient[j] = (f_above - f_below) / (high - low);
      for (std::size_t i = 0; i < above.size(); ++i) {
        out.jacobian[i * n + j] = (above[i] - below[i]) / (high - low);
      }
    }
  };
}

}  // namespace capstan::optimise
