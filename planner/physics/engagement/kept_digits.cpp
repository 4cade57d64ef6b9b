#include "planner/physics/engagement/kept_digits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// A number is rounded as a whole count of a power of ten, and divided by it: of two exact doubles the
// quotient is the double nearest to the decimal, so that its shortest print has no more digits.

namespace capstan::engagement {
namespace {

constexpr std::array<double, 10> kTen = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr int kFinestLength = 6, kFinestArea = 9;  // decimals

double at_decimals(double v, int decimals) {
  const double ten = kTen[static_cast<std::size_t>(decimals)];
  return std::round(v * ten) / ten + 0.0;
}

/// With so many digits, and so many decimals at most.
double with_digits(double v, int digits, int most_decimals) {
  const double size = std::abs(v);
  int decimals = digits;
  for (double p = 1.0; decimals > 0 && size >= p; p *= 10.0) --decimals;
  if (size < 1.0) {
    for (double p = 0.1; decimals < most_decimals && size < p; p *= 0.1) ++decimals;
  }
  return at_decimals(v, std::min(decimals, most_decimals));
}

}  // namespace

void keep_digits(model::SectionSeries& s, double known_to_mm) {
  const bool exact = !(known_to_mm > 0.0);
  const int digits = exact ? 7 : 5;
  int decimals = kFinestLength;
  if (!exact) {
    // A hundredth of a cell: 1e-3 of one of 0.1 mm or more.
    decimals = 2;
    for (double cell = known_to_mm; decimals < kFinestLength && cell < 1.0; cell *= 10.0) ++decimals;
  }
  for (double& v : s.at_mm) v = at_decimals(v, kFinestLength);
  for (auto* column :
       {&s.ad_max_mm, &s.rd_max_mm, &s.x_max_ofs_mm, &s.y_max_ofs_mm, &s.x_cg_ofs_mm, &s.y_cg_ofs_mm}) {
    for (double& v : *column) v = with_digits(v, 7, decimals);
  }
  for (auto* column : {&s.csa_mm2, &s.removed_mm3}) {
    for (double& v : *column) v = with_digits(v, digits, kFinestArea);
  }
}

}  // namespace capstan::engagement
