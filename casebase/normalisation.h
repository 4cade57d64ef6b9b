#pragma once

#include <array>
#include <string>

#include "casebase/casebase.h"

namespace capstan::casebase {

/// A question's sizes where distance is measured: Euclid's, over logarithms divided by fixed scales.
/// The scales never depend on the cases stored, so that a distance means the same tomorrow. (With the
/// categories equal and the scale of each size fixed, HVDM of Wilson and Martinez, "Improved heterogeneous
/// distance functions", JAIR 6, 1997, is this.)
using Point = std::array<double, 4>;

/// Needs a question without fault.
[[nodiscard]] Point point_of(const Question& q);

/// What has to be equal: the categories, and which of diameter, depth and width apply.
[[nodiscard]] std::string bucket_of(const Question& q);

/// Summed in the order of the array: the one formula of all indices.
[[nodiscard]] double distance2(const Point& a, const Point& b);

}  // namespace capstan::casebase
