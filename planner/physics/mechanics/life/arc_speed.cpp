#include "planner/physics/mechanics/life/arc_speed.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace capstan::mechanics {
namespace {

struct Row {
  double width = 0.0, speed = 1.0;  ///< over the diameter; over the table's
};
constexpr std::array<Row, 8> kRows = {{{0.05, 1.48},
                                       {0.10, 1.35},
                                       {0.15, 1.27},
                                       {0.20, 1.22},
                                       {0.25, 1.19},
                                       {0.30, 1.16},
                                       {0.40, 1.11},
                                       {kWholeSpeedWidth, 1.0}}};

/// The most in a group of ISO 513.
double most_of(std::string_view group) {
  if (group == "P" || group == "M" || group == "K") return kRows.front().speed;
  constexpr double kHardOrHot = 1.3;
  return group == "S" || group == "H" ? kHardOrHot : 1.0;
}

}  // namespace

double speed_by_arc(double width_mm, double diameter_mm, model::Substrate substrate,
                    std::string_view iso_group) {
  if (!(width_mm > 0.0) || !(diameter_mm > 0.0) || substrate != model::Substrate::kCarbide) return 1.0;
  const double most = most_of(iso_group);
  const double width = width_mm / diameter_mm;
  if (width <= kRows.front().width) return std::min(most, kRows.front().speed);
  for (std::size_t i = 1; i < kRows.size(); ++i) {
    if (width >= kRows[i].width) continue;
    const Row &a = kRows[i - 1], &b = kRows[i];
    const double share = (width - a.width) / (b.width - a.width);
    return std::min(most, a.speed + share * (b.speed - a.speed));
  }
  return 1.0;
}

}  // namespace capstan::mechanics
