#include "planner/physics/mechanics/life/arc_speed.h"

#include <array>
#include <cstddef>

namespace capstan::mechanics {
namespace {

struct Row {
  double width = 0.0, speed = 1.0;  ///< over the diameter; over the table's
};
using Rows = std::array<Row, 8>;
constexpr Rows kRows = {{{0.05, 1.48},
                         {0.10, 1.35},
                         {0.15, 1.27},
                         {0.20, 1.22},
                         {0.25, 1.19},
                         {0.30, 1.16},
                         {0.40, 1.11},
                         {kWholeSpeedWidth, 1.0}}};
constexpr Rows kRowsS = {{{0.05, 1.48},
                          {0.10, 1.35},
                          {0.15, 1.27},
                          {0.20, 1.22},
                          {0.25, 1.189},
                          {0.30, 1.136},
                          {0.40, 1.057},
                          {kWholeSpeedWidth, 1.0}}};

/// Those of a group of ISO 513; null where the sources tell of none.
const Rows* rows_of(std::string_view group) {
  if (group == "S") return &kRowsS;
  return group == "P" || group == "M" || group == "K" || group == "H" ? &kRows : nullptr;
}

}  // namespace

double speed_by_arc(double width_mm, double diameter_mm, model::Substrate substrate,
                    std::string_view iso_group) {
  if (!(width_mm > 0.0) || !(diameter_mm > 0.0) || substrate != model::Substrate::kCarbide) return 1.0;
  const Rows* rows = rows_of(iso_group);
  if (rows == nullptr) return 1.0;
  const double width = width_mm / diameter_mm;
  if (width <= rows->front().width) return rows->front().speed;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    if (width >= (*rows)[i].width) continue;
    const Row &a = (*rows)[i - 1], &b = (*rows)[i];
    const double share = (width - a.width) / (b.width - a.width);
    return a.speed + share * (b.speed - a.speed);
  }
  return 1.0;
}

}  // namespace capstan::mechanics
