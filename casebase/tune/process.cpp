#include "casebase/tune/process.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace capstan::casebase::tune {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDoubtBelow = -2.0;  // standard deviations. Default, unsourced
constexpr int kDoubtTurns = 3;
constexpr int kNewtonTurns = 40;

double square(double v) { return v * v; }

double matern52(double r) {
  const double a = std::sqrt(5.0) * r;
  return (1.0 + a + a * a / 3.0) * std::exp(-a);
}

double scaled_distance(std::span<const double> a, std::span<const double> b,
                       const std::vector<double>& lengths) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += square((a[k] - b[k]) / lengths[k]);
  return std::sqrt(sum);
}

/// Covariance of the linear part and the field, without group and noise.
double covariance(std::span<const double> a, std::span<const double> b, const std::vector<PriorTerm>& prior,
                  const ProcessSpreads& s) {
  double out = square(prior[0].std_dev);
  for (std::size_t k = 0; k < a.size(); ++k) out += square(prior[k + 1].std_dev) * a[k] * b[k];
  if (s.field > 0.0) out += square(s.field) * matern52(scaled_distance(a, b, s.lengths));
  return out;
}

double prior_mean(std::span<const double> x, const std::vector<PriorTerm>& prior) {
  double out = prior[0].mean;
  for (std::size_t k = 0; k < x.size(); ++k) out += prior[k + 1].mean * x[k];
  return out;
}

MatrixXd matrix_of(const std::vector<Row>& rows, const std::vector<PriorTerm>& prior,
                   const ProcessSpreads& s) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  MatrixXd k(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& a = rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Row& b = rows[static_cast<std::size_t>(j)];
      k(i, j) = covariance(a.x, b.x, prior, s) + (a.group == b.group ? square(s.group) : 0.0);
      k(j, i) = k(i, j);
    }
  }
  return k;
}

VectorXd covariances_with(const std::vector<Row>& rows, std::span<const double> x,
                          const std::vector<PriorTerm>& prior, const ProcessSpreads& s) {
  VectorXd out(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out[static_cast<Eigen::Index>(i)] = covariance(rows[i].x, x, prior, s);
  }
  return out;
}

}  // namespace

double normal_probability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

struct Process::Impl {
  std::vector<Row> rows;
  std::vector<PriorTerm> prior;
  ProcessSpreads spreads;
  Eigen::LLT<MatrixXd> factors;
  VectorXd residual, alpha;
};

Process::Process(std::vector<Row> rows, std::vector<PriorTerm> prior, ProcessSpreads spreads)
    : impl_(std::make_unique<Impl>()) {
  impl_->rows = std::move(rows);
  impl_->prior = std::move(prior);
  impl_->spreads = std::move(spreads);
  const auto n = static_cast<Eigen::Index>(impl_->rows.size());
  MatrixXd k = matrix_of(impl_->rows, impl_->prior, impl_->spreads);
  impl_->residual.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = impl_->rows[static_cast<std::size_t>(i)];
    k(i, i) += square(impl_->spreads.noise) / std::max(row.weight, 1e-9);
    impl_->residual[i] = row.y - prior_mean(row.x, impl_->prior);
  }
  impl_->factors.compute(k);
  impl_->alpha = impl_->factors.solve(impl_->residual);
}

Process::Process(Process&&) noexcept = default;
Process& Process::operator=(Process&&) noexcept = default;
Process::~Process() = default;

Belief Process::at(std::span<const double> x) const {
  const Impl& m = *impl_;
  double variance = covariance(x, x, m.prior, m.spreads);
  Belief out{.mean = prior_mean(x, m.prior)};
  if (!m.rows.empty()) {
    const VectorXd k = covariances_with(m.rows, x, m.prior, m.spreads);
    out.mean += k.dot(m.alpha);
    variance -= m.factors.matrixL().solve(k).squaredNorm();
  }
  out.std_dev = std::sqrt(std::max(0.0, variance));
  out.next_std_dev = std::hypot(out.std_dev, m.spreads.group, m.spreads.noise);
  return out;
}

double Process::log_likelihood() const {
  const Impl& m = *impl_;
  double half_log_determinant = 0.0;
  const auto n = m.residual.size();
  for (Eigen::Index i = 0; i < n; ++i) half_log_determinant += std::log(m.factors.matrixLLT()(i, i));
  return -0.5 * m.residual.dot(m.alpha) - half_log_determinant -
         0.5 * static_cast<double>(n) * std::log(2.0 * std::numbers::pi);
}

const ProcessSpreads& Process::spreads() const { return impl_->spreads; }

std::vector<double> Process::left_out() const {
  const Impl& m = *impl_;
  const auto n = m.residual.size();
  const MatrixXd inverse = m.factors.solve(MatrixXd::Identity(n, n));
  std::vector<double> out;
  for (Eigen::Index i = 0; i < n; ++i) out.push_back(m.alpha[i] / std::sqrt(inverse(i, i)));
  return out;
}

namespace {

/// One knob of the search: a factor on some of the spreads.
enum class Knob { kField, kLengths, kGroup, kNoise };
constexpr std::array<Knob, 4> kKnobs = {Knob::kNoise, Knob::kGroup, Knob::kField, Knob::kLengths};

using Factors = std::array<double, kKnobs.size()>;  // logarithms

ProcessSpreads scaled(const ProcessSpreads& start, const Factors& f) {
  ProcessSpreads out = start;
  for (std::size_t i = 0; i < kKnobs.size(); ++i) {
    const double by = std::exp(f[i]);
    switch (kKnobs[i]) {
      case Knob::kField:
        out.field *= by;
        break;
      case Knob::kGroup:
        out.group *= by;
        break;
      case Knob::kNoise:
        out.noise *= by;
        break;
      case Knob::kLengths:
        for (double& l : out.lengths) l *= by;
        break;
    }
  }
  return out;
}

double penalty(const Factors& f) {
  double out = 0.0;
  for (const double v : f) out += 0.5 * square(v / std::numbers::ln2);
  return out;
}

Factors searched(const std::vector<Row>& rows, const std::vector<PriorTerm>& prior,
                 const ProcessSpreads& start, const ProcessLearning& learning) {
  Factors best{};
  const auto worth = [&](const Factors& f) {
    return Process(rows, prior, scaled(start, f)).log_likelihood() - penalty(f);
  };
  double best_worth = worth(best);
  const double low = std::log(learning.least), high = std::log(learning.most);
  for (const double step : {0.7, 0.35}) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      if ((kKnobs[i] == Knob::kField || kKnobs[i] == Knob::kLengths) && start.field <= 0.0) continue;
      if (kKnobs[i] == Knob::kGroup && start.group <= 0.0) continue;
      for (const double way : {-step, step}) {
        for (;;) {
          Factors next = best;
          next[i] = std::clamp(next[i] + way, low, high);
          if (next[i] == best[i]) break;
          const double w = worth(next);
          if (w <= best_worth + 1e-9) break;
          best = next;
          best_worth = w;
        }
      }
    }
  }
  return best;
}

}  // namespace

Process learnt(std::vector<Row> rows, const std::vector<PriorTerm>& prior, const ProcessSpreads& start,
               const ProcessLearning& learning) {
  const std::vector<Row> given = rows;
  if (learning.doubt_low) {
    for (int turn = 0; turn < kDoubtTurns; ++turn) {
      const std::vector<double> z = Process(rows, prior, start).left_out();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        // The residual of a row that weighs less has grown more uncertain: the weight is of the full one.
        const double full = z[i] / std::sqrt(std::max(rows[i].weight / given[i].weight, 1e-9));
        rows[i].weight = given[i].weight * (full < kDoubtBelow ? square(kDoubtBelow / full) : 1.0);
      }
    }
  }
  Factors factors{};
  if (rows.size() >= learning.needed_rows) factors = searched(rows, prior, start, learning);
  return Process(std::move(rows), prior, scaled(start, factors));
}

struct FailureProcess::Impl {
  std::vector<Row> rows;
  std::vector<PriorTerm> prior;
  ProcessSpreads spreads;
  VectorXd slope, root_curvature;
  Eigen::LLT<MatrixXd> factors;
};

FailureProcess::FailureProcess(std::vector<Row> rows, std::vector<PriorTerm> prior, ProcessSpreads spreads)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.rows = std::move(rows);
  m.prior = std::move(prior);
  m.spreads = std::move(spreads);
  const auto n = static_cast<Eigen::Index>(m.rows.size());
  const MatrixXd k = matrix_of(m.rows, m.prior, m.spreads);
  VectorXd mean(n), sign(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = m.rows[static_cast<std::size_t>(i)];
    mean[i] = prior_mean(row.x, m.prior);
    sign[i] = row.y > 0.0 ? 1.0 : -1.0;
  }
  VectorXd latent = VectorXd::Zero(n);  // beside the mean
  m.slope = VectorXd::Zero(n);
  m.root_curvature = VectorXd::Zero(n);
  for (int turn = 0; turn < kNewtonTurns; ++turn) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double z = sign[i] * (latent[i] + mean[i]);
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
      // Far out on the wrong side the ratio tends to -z; the quotient would be 0 / 0.
      const double ratio = z < -30.0 ? -z : density / normal_probability(z);
      const double weight = m.rows[static_cast<std::size_t>(i)].weight;
      m.slope[i] = weight * sign[i] * ratio;
      m.root_curvature[i] = std::sqrt(weight * std::max(0.0, ratio * ratio + z * ratio));
    }
    MatrixXd b = MatrixXd::Identity(n, n);
    b += m.root_curvature.asDiagonal() * k * m.root_curvature.asDiagonal();
    m.factors.compute(b);
    const VectorXd c = m.root_curvature.cwiseAbs2().cwiseProduct(latent) + m.slope;
    const VectorXd a =
        c - m.root_curvature.cwiseProduct(m.factors.solve(m.root_curvature.cwiseProduct(k * c)));
    const VectorXd next = k * a;
    const double moved = n > 0 ? (next - latent).cwiseAbs().maxCoeff() : 0.0;
    latent = next;
    if (moved < 1e-9) break;
  }
}

FailureProcess::FailureProcess(FailureProcess&&) noexcept = default;
FailureProcess& FailureProcess::operator=(FailureProcess&&) noexcept = default;
FailureProcess::~FailureProcess() = default;

double FailureProcess::at(std::span<const double> x) const {
  const Impl& m = *impl_;
  double mean = prior_mean(x, m.prior);
  double variance = covariance(x, x, m.prior, m.spreads) + square(m.spreads.group);
  if (!m.rows.empty()) {
    const VectorXd k = covariances_with(m.rows, x, m.prior, m.spreads);
    mean += k.dot(m.slope);
    variance -= m.factors.matrixL().solve(m.root_curvature.cwiseProduct(k)).squaredNorm();
  }
  return normal_probability(mean / std::sqrt(1.0 + std::max(0.0, variance)));
}

}  // namespace capstan::casebase::tune
