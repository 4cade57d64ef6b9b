#include "tests/examples/linuxcnc/cut_block.h"

#include <algorithm>
#include <cmath>

namespace capstan::linuxcnc {
namespace {

constexpr double kTurning = 1.0;  // 1/min: less is standing
// Of examples/reference_pocket.p21, mm.
constexpr double kPocketX = 50.0, kPocketY = 40.0, kHalfWidth = 30.0, kHalfDepth = 20.0, kCorner = 6.0,
                 kFloor = -10.0;

/// Distance to the outline of the pocket, negative inside of it.
double outside(double x, double y) {
  const double dx = std::abs(x - kPocketX) - (kHalfWidth - kCorner),
               dy = std::abs(y - kPocketY) - (kHalfDepth - kCorner);
  return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - kCorner;
}

}  // namespace

CutBlock::CutBlock(double width_mm, double depth_mm, double top_mm)
    : nx_(static_cast<int>(width_mm / kCell)),
      ny_(static_cast<int>(depth_mm / kCell)),
      top_mm_(top_mm),
      top_(static_cast<std::size_t>(nx_ * ny_), 0.0),
      reached_{kPocketX, kPocketX, kPocketY, kPocketY} {}

void CutBlock::cut(const Record& record, int mark, const std::map<int, Mill>& tools) {
  for (std::size_t s = 0; s < record.size(); ++s) {
    const auto mill = tools.find(record.tool[s]);
    if (record.mark[s] != mark || mill == tools.end()) continue;
    const double tip = record.z_mm[s] - mill->second.length_mm - top_mm_, r = 0.5 * mill->second.diameter_mm;
    if (!(tip < 0.0)) continue;
    const double x = record.x_mm[s], y = record.y_mm[s];
    reached_ = {std::min(reached_[0], x - r), std::max(reached_[1], x + r), std::min(reached_[2], y - r),
                std::max(reached_[3], y + r)};
    const int j0 = std::max(0, static_cast<int>((y - r) / kCell)),
              j1 = std::min(ny_ - 1, static_cast<int>((y + r) / kCell));
    const int i0 = std::max(0, static_cast<int>((x - r) / kCell)),
              i1 = std::min(nx_ - 1, static_cast<int>((x + r) / kCell));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        double& top = top_[static_cast<std::size_t>(j * nx_ + i)];
        if (!(tip < top) || std::hypot(i * kCell + kPoint - x, j * kCell + kPoint - y) > r) continue;
        if (record.kind[s] == kRapid) rapid_mm_ = std::max(rapid_mm_, top - tip);
        top = tip;
        const double rpm = std::abs(record.rpm[s]);
        struck_ |= rpm < kTurning;
        fastest_rpm_ = std::max(fastest_rpm_, rpm);
      }
    }
  }
}

bool CutBlock::whole() const {
  return std::all_of(top_.begin(), top_.end(), [](double t) { return t == 0.0; });
}

double differs_from_pocket(const CutBlock& block) {
  const std::array walls = {kPocketX - kHalfWidth, kPocketX + kHalfWidth, kPocketY - kHalfDepth,
                            kPocketY + kHalfDepth};
  double worst = 0.0;
  for (std::size_t w = 0; w < walls.size(); ++w)
    worst = std::max(worst, std::abs(block.reached()[w] - walls[w]));
  for (int j = 0; j < block.ny(); ++j) {
    for (int i = 0; i < block.nx(); ++i) {
      const double out = outside(i * CutBlock::kCell + CutBlock::kPoint,
                                 j * CutBlock::kCell + CutBlock::kPoint),
                   top = block.at(i, j);
      if (out > 0.0 && top < 0.0) worst = std::max(worst, std::min(out, -top));
      if (out < 0.0) worst = std::max(worst, std::min(-out, std::abs(top - kFloor)));
    }
  }
  return worst;
}

}  // namespace capstan::linuxcnc
