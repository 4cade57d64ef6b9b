#include "planner/physics/mechanics/life/arc_speed.h"

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

/// Whether the source tells of this group of ISO 513.
bool tabled(std::string_view group) { return group == "P" || group == "M" || group == "K"; }

}  // namespace

double speed_by_arc(double width_mm, double diameter_mm, model::Substrate substrate,
                    std::string_view iso_group) {
  if (!(width_mm > 0.0) || !(diameter_mm > 0.0) || substrate != model::Substrate::kCarbide) return 1.0;
  if (!tabled(iso_group)) return 1.0;
  const double width = width_mm / diameter_mm;
  if (width <= kRows.front().width) return kRows.front().speed;
  for (std::size_t i = 1; i < kRows.size(); ++i) {
    if (width >= kRows[i].width) continue;
    const Row &a = kRows[i - 1], &b = kRows[i];
    const double share = (width - a.width) / (b.width - a.width);
    return a.speed + share * (b.speed - a.speed);
  }
  return 1.0;
}

}  // namespace capstan::mechanics
