#include "casebase/normalisation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::casebase {
namespace {

// Version 1. A distance of one: a size twice as large, a tolerance four times as wide. Default, unsourced.
constexpr double kSizeScale = std::numbers::ln2;
constexpr double kToleranceScale = 2.0 * std::numbers::ln2;
constexpr double kNoToleranceMm = 1.0;      // what no tolerance counts as. Default, unsourced
constexpr double kLeastToleranceMm = 1e-4;  // below, no machine tells them apart. Default, unsourced
constexpr double kLeastSizeMm = 1e-3;       // likewise

double scaled_size(double mm) { return mm > 0.0 ? std::log(std::max(mm, kLeastSizeMm)) / kSizeScale : 0.0; }

double scaled_tolerance(double mm) {
  return std::log(mm > 0.0 ? std::max(mm, kLeastToleranceMm) : kNoToleranceMm) / kToleranceScale;
}

}  // namespace

Point point_of(const Question& q) {
  return {scaled_size(q.diameter_mm), scaled_size(q.depth_mm), scaled_size(q.width_mm),
          scaled_tolerance(q.tolerance_mm)};
}

std::string bucket_of(const Question& q) {
  std::string key =
      q.operation + '\n' + q.material_group + '\n' + q.tool_class + '\n' + q.machine_class + '\n';
  for (const double mm : {q.diameter_mm, q.depth_mm, q.width_mm}) key += mm > 0.0 ? '1' : '0';
  return key;
}

double distance2(const Point& a, const Point& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace capstan::casebase
