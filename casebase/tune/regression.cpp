#include "casebase/tune/regression.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

/// Robust regression with groups.
///
/// y = X b + u_g + e, u_g ~ N(0, t^2) for each group, e ~ N(0, s^2 / w). With b ~ N(m, P) the posterior is
///
///     (sum_g X_g' V_g^-1 X_g + P^-1) (b - m) = sum_g X_g' V_g^-1 (y_g - X_g m),   V_g = s^2 / w + t^2 1 1'
///
/// V_g^-1 by Sherman and Morrison, so that the cost is linear in the rows. s and t follow from the residuals
/// within and between the groups by moments (Searle, Casella, McCulloch, Variance Components, 1992), each
/// with an expected value that counts as some rows. The weights are Huber's (Ann. Math. Statist. 35, 1964)
/// until they stay, then Tukey's biweight, whose tuning constants give 95 % efficiency on normal noise
/// (Holland and Welsch, Comm. Statist. A6, 1977).
///
/// Kinds of rows that scatter differently are whitened: rows are divided by the scatter of their kind, which
/// follows from their residuals by moments, less what the terms took of them (feasible generalised least
/// squares; Judge et al., The Theory and Practice of Econometrics, 1985, 11.2).
namespace capstan::casebase::tune {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kHuber = 1.345, kTukey = 4.685;  // Holland and Welsch 1977
constexpr double kMadToDeviation = 1.4826;        // of the normal distribution
constexpr int kHuberTurns = 15, kTukeyTurns = 10;
constexpr int kKindTurns = 12;  // until the scatters stay within a hundredth
constexpr double kVague = 1e3;  // std dev of a coefficient that nothing is known of

struct Spread {
  double noise = 0.0, between = 0.0;
};

struct Group {
  MatrixXd xx;
  VectorXd x, xr;
  double w = 0.0, r = 0.0, given = 0.0;  ///< given: what w was before rows were doubted
};

struct Solution {
  VectorXd b;
  MatrixXd covariance;
};

/// Dense numbers of the groups, 0, 1, ... in the order of their names.
std::vector<std::size_t> numbered(std::span<const Row> rows, std::size_t& count) {
  std::map<std::size_t, std::size_t> numbers;
  for (const Row& row : rows) numbers.emplace(row.group, 0);
  count = 0;
  for (auto& [name, number] : numbers) number = count++;
  std::vector<std::size_t> out;
  out.reserve(rows.size());
  for (const Row& row : rows) out.push_back(numbers.at(row.group));
  return out;
}

Solution solve(std::span<const Row> rows, const std::vector<std::size_t>& group, std::size_t groups,
               const std::vector<double>& weight, const VectorXd& mean, const VectorXd& precision,
               const Spread& s) {
  const auto n = mean.size();
  std::vector<Group> sums(groups, {MatrixXd::Zero(n, n), VectorXd::Zero(n), VectorXd::Zero(n)});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Group& g = sums[group[i]];
    g.given += std::max(0.0, rows[i].weight);
    if (weight[i] <= 0.0) continue;
    const Eigen::Map<const VectorXd> x(rows[i].x.data(), n);
    const double r = rows[i].y - x.dot(mean);
    g.xx += weight[i] * x * x.transpose();
    g.x += weight[i] * x;
    g.xr += weight[i] * r * x;
    g.w += weight[i];
    g.r += weight[i] * r;
  }
  MatrixXd a = precision.asDiagonal();
  VectorXd c = VectorXd::Zero(n);
  const double noise2 = s.noise * s.noise, between2 = s.between * s.between;
  for (const Group& g : sums) {
    if (g.w <= 0.0) continue;
    // A group that is doubted tells less: what it has in common is then less like the other groups'.
    const double of_group = between2 * g.given / g.w;
    const double shared = of_group / (noise2 + of_group * g.w);
    a += (g.xx - shared * g.x * g.x.transpose()) / noise2;
    c += (g.xr - shared * g.r * g.x) / noise2;
  }
  const Eigen::LDLT<MatrixXd> factors(a);
  return {mean + factors.solve(c), factors.solve(MatrixXd::Identity(n, n))};
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Residuals of the rows, and their weighted means by group.
struct Residuals {
  std::vector<double> of_row, of_group, weight_of_group, given_of_group;
  std::vector<std::size_t> heard;  ///< rows of each group that weigh anything
};

Residuals residuals(std::span<const Row> rows, const std::vector<std::size_t>& group, std::size_t groups,
                    const std::vector<double>& weight, const VectorXd& b) {
  const std::vector<double> none(groups, 0.0);
  Residuals out{std::vector<double>(rows.size()), none, none, none, std::vector<std::size_t>(groups, 0)};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.of_row[i] = rows[i].y - Eigen::Map<const VectorXd>(rows[i].x.data(), b.size()).dot(b);
    out.given_of_group[group[i]] += std::max(0.0, rows[i].weight);
    if (weight[i] <= 0.0) continue;
    out.of_group[group[i]] += weight[i] * out.of_row[i];
    out.weight_of_group[group[i]] += weight[i];
    ++out.heard[group[i]];
  }
  for (std::size_t g = 0; g < groups; ++g) {
    if (out.weight_of_group[g] > 0.0) out.of_group[g] /= out.weight_of_group[g];
  }
  return out;
}

Spread spread_of(const Residuals& r, const std::vector<std::size_t>& group, const std::vector<double>& weight,
                 double known_terms, const RegressionOptions& o) {
  double within = o.noise_rows * o.noise * o.noise, within_n = o.noise_rows;
  double rows = 0.0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double d = r.of_row[i] - r.of_group[group[i]];
    within += weight[i] * d * d;
    rows += weight[i];
  }
  double groups = 0.0, between = 0.0;
  for (std::size_t g = 0; g < r.of_group.size(); ++g) {
    if (r.heard[g] == 0) continue;
    const double believed = r.weight_of_group[g] / r.given_of_group[g];
    groups += believed;
    between += believed * r.of_group[g] * r.of_group[g];
  }
  const bool grouped = o.between > 0.0 || groups < rows - 0.5;
  if (!grouped) {  // each row is a group of its own: noise and groups are one
    double all = o.noise_rows * o.noise * o.noise;
    for (std::size_t i = 0; i < weight.size(); ++i) all += weight[i] * r.of_row[i] * r.of_row[i];
    return {std::sqrt(all / std::max(1.0, o.noise_rows + rows - known_terms)), 0.0};
  }
  within_n += std::max(0.0, rows - groups);
  Spread s;
  s.noise = std::sqrt(within / std::max(1e-9, within_n));
  if (within_n <= 0.0) s.noise = o.noise;
  // A group's mean scatters by between^2 + noise^2 / rows of the group, and the terms took some of it.
  double noise_share = 0.0;
  for (std::size_t g = 0; g < r.of_group.size(); ++g) {
    if (r.weight_of_group[g] > 0.0) noise_share += s.noise * s.noise / r.given_of_group[g];
  }
  const double freedom = std::max(1.0, groups - known_terms);
  const double seen = std::max(0.0, between / freedom - (groups > 0.0 ? noise_share / groups : 0.0));
  s.between =
      std::sqrt((o.between_groups * o.between * o.between + freedom * seen) / (o.between_groups + freedom));
  return s;
}

/// How many terms the rows decide rather than the prior.
double terms_decided(const MatrixXd& covariance, const VectorXd& precision) {
  double out = 0.0;
  for (Eigen::Index i = 0; i < precision.size(); ++i) {
    out += std::clamp(1.0 - precision[i] * covariance(i, i), 0.0, 1.0);
  }
  return out;
}

double robust_weight(double z, bool tukey) {
  if (!tukey) return z <= kHuber ? 1.0 : kHuber / z;
  const double u = z / kTukey;
  return u >= 1.0 ? 0.0 : (1.0 - u * u) * (1.0 - u * u);
}

}  // namespace

double Regression::at(std::span<const double> x) const {
  double out = 0.0;
  for (std::size_t i = 0; i < coefficient.size(); ++i) out += coefficient[i] * x[i];
  return out;
}

double Regression::std_dev_at(std::span<const double> x) const {
  const std::size_t n = coefficient.size();
  double out = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) out += x[i] * covariance[i * n + j] * x[j];
  }
  return std::sqrt(std::max(0.0, out));
}

const Regression::Kind* Regression::kind_of(std::size_t kind) const {
  const auto at = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.kind == kind; });
  if (at != kinds.end()) return &*at;
  const auto most = std::max_element(kinds.begin(), kinds.end(),
                                     [](const Kind& a, const Kind& b) { return a.scatter < b.scatter; });
  return most == kinds.end() ? nullptr : &*most;
}

double Regression::predictive_std_dev_at(std::span<const double> x, std::size_t kind) const {
  const Kind* k = kind_of(kind);
  return std::hypot(std_dev_at(x), (k != nullptr ? k->scatter : 1.0) * std::hypot(noise, between));
}

double Regression::std_dev(std::size_t term) const {
  return std::sqrt(std::max(0.0, covariance[term * coefficient.size() + term]));
}

namespace {

/// All rows as one kind.
Regression regress_alike(std::span<const Row> rows, std::size_t terms, const RegressionOptions& options) {
  const auto n = static_cast<Eigen::Index>(terms);
  VectorXd mean = VectorXd::Zero(n), precision = VectorXd::Constant(n, 1.0 / (kVague * kVague));
  for (std::size_t i = 0; i < std::min(terms, options.prior.size()); ++i) {
    const PriorTerm& p = options.prior[i];
    const auto k = static_cast<Eigen::Index>(i);
    mean[k] = p.mean;
    if (p.std_dev < kVague) precision[k] = 1.0 / std::max(p.std_dev * p.std_dev, 1e-18);
  }
  std::size_t groups = 0;
  const std::vector<std::size_t> group = numbered(rows, groups);
  std::vector<double> base, weight;
  for (const Row& row : rows) base.push_back(std::max(0.0, row.weight));
  weight = base;
  Spread spread{std::max(options.noise, 1e-9), options.between};
  Solution now = solve(rows, group, groups, weight, mean, precision, spread);
  const int turns = rows.empty() ? 0 : (options.robust ? kHuberTurns + kTukeyTurns : 3);
  for (int turn = 0; turn < turns; ++turn) {
    if (options.robust) {
      const Residuals r = residuals(rows, group, groups, base, now.b);
      std::vector<double> sizes;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (base[i] > 0.0) sizes.push_back(std::abs(r.of_row[i]) * std::sqrt(std::min(1.0, base[i])));
      }
      // Few rows say little of their own scatter: what is expected beforehand is its floor.
      const double scale =
          std::max(kMadToDeviation * median(sizes), std::hypot(options.noise, options.between));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool in_full = r.of_row[i] > 0.0 ? options.hear_above : options.hear_below;
        weight[i] =
            base[i] * (in_full ? 1.0 : robust_weight(std::abs(r.of_row[i]) / scale, turn >= kHuberTurns));
      }
    }
    const Residuals r = residuals(rows, group, groups, weight, now.b);
    spread = spread_of(r, group, weight, terms_decided(now.covariance, precision), options);
    spread.noise = std::max(spread.noise, 1e-9);
    now = solve(rows, group, groups, weight, mean, precision, spread);
  }
  Regression out;
  out.coefficient.assign(now.b.data(), now.b.data() + n);
  out.covariance.resize(terms * terms);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      out.covariance[static_cast<std::size_t>(i * n + j)] = now.covariance(i, j);
    }
  }
  out.noise = spread.noise;
  out.between = spread.between;
  out.groups = groups;
  const double most = base.empty() ? 1.0 : std::max(1e-300, *std::max_element(base.begin(), base.end()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.effective_rows += weight[i] / most;
    out.weight.push_back(base[i] > 0.0 ? weight[i] / base[i] : 0.0);
  }
  return out;
}

/// The scatter of each kind over what is expected beforehand, from the residuals of a fit to whitened rows.
void learn_scatter(std::span<const Row> rows, const Regression& fit, const RegressionOptions& o,
                   std::vector<Regression::Kind>& kinds) {
  const double expected = std::max(std::hypot(o.noise, o.between), 1e-9);
  for (Regression::Kind& k : kinds) {
    double square = o.noise_rows, freedom = o.noise_rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& row = rows[i];
      if (row.kind != k.kind || row.weight <= 0.0) continue;
      const double believed = row.weight * fit.weight[i];
      const double residual = (row.y - fit.at(row.x)) / expected;
      const double taken =
          fit.std_dev_at(row.x) / (k.scatter * std::max(std::hypot(fit.noise, fit.between), 1e-9));
      square += believed * residual * residual;
      freedom += believed * (1.0 - std::min(1.0, taken * taken));
    }
    k.freedom = freedom;
    k.scatter = std::max(1e-6, std::sqrt(square / std::max(freedom, 1e-9)));
  }
}

}  // namespace

Regression regress(std::span<const Row> rows, std::size_t terms, const RegressionOptions& options) {
  std::vector<Regression::Kind> kinds;
  for (const Row& row : rows) {
    if (std::none_of(kinds.begin(), kinds.end(), [&](const auto& k) { return k.kind == row.kind; }))
      kinds.push_back({row.kind, 1.0, 0.0});
  }
  if (kinds.size() < 2) return regress_alike(rows, terms, options);
  std::vector<Row> whitened(rows.begin(), rows.end());
  const auto whiten = [&] {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto kind =
          std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.kind == rows[i].kind; });
      whitened[i].y = rows[i].y / kind->scatter;
      for (std::size_t j = 0; j < terms; ++j) whitened[i].x[j] = rows[i].x[j] / kind->scatter;
    }
  };
  // Every row is heard while the scatters are learned: rows of a wild kind are no outliers.
  RegressionOptions all = options;
  all.robust = false;
  for (int turn = 0; turn < kKindTurns; ++turn) {
    whiten();
    learn_scatter(rows, regress_alike(whitened, terms, all), options, kinds);
  }
  whiten();
  Regression fit = regress_alike(whitened, terms, options);
  fit.noise = options.noise;  // what the scatters are multiples of
  fit.between = options.between;
  fit.kinds = kinds;
  return fit;
}

std::vector<LeftOut> leave_groups_out(std::span<const Row> rows, std::size_t terms,
                                      const RegressionOptions& options) {
  std::vector<std::size_t> names;
  for (const Row& row : rows) names.push_back(row.group);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::vector<LeftOut> out(rows.size());
  for (const std::size_t name : names) {
    std::vector<Row> others;
    for (const Row& row : rows) {
      if (row.group != name) others.push_back(row);
    }
    const Regression fit = regress(others, terms, options);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].group == name) {
        const Regression::Kind* kind = fit.kind_of(rows[i].kind);
        out[i] = {rows[i].y, fit.at(rows[i].x), fit.predictive_std_dev_at(rows[i].x, rows[i].kind),
                  kind != nullptr ? kind->freedom : 0.0};
      }
    }
  }
  return out;
}

double rms(std::span<const LeftOut> left_out) {
  double sum = 0.0;
  for (const LeftOut& l : left_out) sum += (l.observed - l.predicted) * (l.observed - l.predicted);
  return left_out.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(left_out.size()));
}

double deviations_90(double freedom) {
  constexpr double z = 1.6449;  // of the normal distribution, both sides
  if (!(freedom > 0.0)) return z;
  const double n = freedom, z2 = z * z;
  const double g1 = (z2 + 1.0) / 4.0;
  const double g2 = ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 = ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z * (1.0 + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n);
}

bool LeftOut::within_90() const { return std::abs(observed - predicted) <= deviations_90(freedom) * std_dev; }

double coverage_90(std::span<const LeftOut> left_out) {
  if (left_out.empty()) return 0.0;
  const auto within =
      std::count_if(left_out.begin(), left_out.end(), [](const LeftOut& l) { return l.within_90(); });
  return static_cast<double>(within) / static_cast<double>(left_out.size());
}

}  // namespace capstan::casebase::tune
