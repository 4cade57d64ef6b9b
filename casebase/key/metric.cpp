#include "casebase/key/metric.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "casebase/record/bytes.h"

// Ridge regression (Hoerl and Kennard, Technometrics 12, 1970) of the outcome on the coordinates, with a mean
// of its own for each combination of categories and known numbers, solved by Cholesky. The learned weight is
// drawn towards 1, which is the fixed scale, as if so many further cases said so.

namespace capstan::casebase {
namespace {

constexpr std::uint8_t kMetricVersion = 2;  // of the normalisation whose coordinates it weighs
constexpr double kFactor = 1.5;     // in speed or feed: what a distance of one means. Default, unsourced
constexpr double kDrawnBy = 100.0;  // cases. Default, unsourced
constexpr double kRidge = 1.0;      // cases one unit off, without effect. Default, unsourced

using Vector = Eigen::Matrix<double, static_cast<int>(kDimensions), 1>;
using Square = Eigen::Matrix<double, static_cast<int>(kDimensions), static_cast<int>(kDimensions)>;
using Outcome = Eigen::Vector2d;

struct Row {
  Vector x;
  Outcome y;
};

}  // namespace

Metric learned_metric(std::span<const Case> cases) {
  std::map<std::pair<std::string, std::uint16_t>, std::vector<Row>> groups;
  for (const Case& c : cases) {
    if (c.observed.verdict != Verdict::kGood || c.origin == Origin::kSimulated) continue;
    const Key key = key_of(c.asked);
    const Point p = point_of(key);
    groups[{categories_of(c.asked), key.known}].push_back(
        {Vector(Eigen::Map<const Vector>(p.data())), {std::log(c.bound.vc_m_min), std::log(c.bound.fz_mm)}});
  }
  Square a = kRidge * Square::Identity();
  Eigen::Matrix<double, static_cast<int>(kDimensions), 2> b = decltype(b)::Zero();
  Vector spread = Vector::Zero();  // sum of squares of each coordinate about its means
  Metric metric;
  for (const auto& [of, rows] : groups) {
    Vector mean_x = Vector::Zero();
    Outcome mean_y = Outcome::Zero();
    for (const Row& r : rows) {
      mean_x += r.x;
      mean_y += r.y;
    }
    mean_x /= static_cast<double>(rows.size());
    mean_y /= static_cast<double>(rows.size());
    for (const Row& r : rows) {
      const Vector x = r.x - mean_x;
      a += x * x.transpose();
      b += x * (r.y - mean_y).transpose();
      spread += x.cwiseAbs2();
    }
    metric.cases += rows.size();
  }
  const Eigen::Matrix<double, static_cast<int>(kDimensions), 2> effect = a.llt().solve(b);
  for (std::size_t i = 0; i < kDimensions; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double w = effect.row(at).norm() / std::log(kFactor);
    const double n = spread[at];  // so many cases one unit off their mean
    metric.weight[i] =
        std::clamp(std::sqrt((kDrawnBy + n * w * w) / (kDrawnBy + n)), kLeastWeight, kMostWeight);
  }
  return metric;
}

std::string bytes_of(const Metric& metric) {
  std::string out;
  put(out, kMetricVersion);
  put(out, metric.cases);
  for (const double w : metric.weight) put(out, w);
  return out;
}

std::optional<Metric> metric_of(std::string_view bytes) {
  Bytes from(bytes);
  if (from.integer<std::uint8_t>() != kMetricVersion) return std::nullopt;
  Metric m;
  m.cases = from.integer<std::uint64_t>();
  for (double& w : m.weight) {
    w = from.number();
    if (!(w >= kLeastWeight && w <= kMostWeight)) return std::nullopt;
  }
  if (!from.good() || !from.at_end()) return std::nullopt;
  return m;
}

std::string_view dimension_name(std::size_t i) {
  constexpr std::array<std::string_view, kDimensions> kNames = {
      "diameter",        "depth", "width",     "tolerance", "roughness",
      "cutter diameter", "teeth", "stick-out", "hardness",  "coolant"};
  return kNames.at(i);
}

}  // namespace capstan::casebase
