#include "tests/making/toolpath/front_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace capstan::toolpath {

using geometry::Vec2;

namespace {
constexpr double kPi = std::numbers::pi;
constexpr int kRays = 180;     // of the front half
constexpr double kLag = 1.0;   // mm
constexpr double kHeld = 0.5;  // mm
}  // namespace

FrontRaster::FrontRaster(Vec2 lo, Vec2 hi, double cell_mm)
    : lo_(lo),
      cell_(cell_mm),
      nx_(static_cast<std::size_t>(std::ceil((hi.x - lo.x) / cell_mm))),
      ny_(static_cast<std::size_t>(std::ceil((hi.y - lo.y) / cell_mm))),
      solid_(nx_ * ny_, 1) {}

void FrontRaster::only(const geometry::Region& region) {
  for (std::size_t y = 0; y < ny_; ++y) {
    // Crossings of the row with the region's edges.
    const double at = lo_.y + (static_cast<double>(y) + 0.5) * cell_;
    std::vector<std::pair<double, int>> hits;
    for (const auto& loop : region.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i];
        const Vec2 b = loop[(i + 1) % loop.size()];
        if ((a.y <= at) == (b.y <= at)) continue;
        hits.push_back({a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x), a.y > b.y ? 1 : -1});
      }
    }
    std::sort(hits.begin(), hits.end());
    std::size_t k = 0;
    int winding = 0;
    for (std::size_t x = 0; x < nx_; ++x) {
      const double p = lo_.x + (static_cast<double>(x) + 0.5) * cell_;
      while (k < hits.size() && hits[k].first <= p) winding += hits[k++].second;
      if (winding == 0) solid_[y * nx_ + x] = 0;
    }
  }
}

bool FrontRaster::solid(Vec2 p) const {
  const double x = (p.x - lo_.x) / cell_;
  const double y = (p.y - lo_.y) / cell_;
  if (x < 0.0 || y < 0.0) return false;
  const auto i = static_cast<std::size_t>(x);
  const auto j = static_cast<std::size_t>(y);
  return i < nx_ && j < ny_ && solid_[j * nx_ + i] != 0;
}

void FrontRaster::clear(Vec2 p, double radius) {
  const auto n = static_cast<double>(ny_);
  const double from = std::clamp(std::floor((p.y - radius - lo_.y) / cell_), 0.0, n);
  const double till = std::clamp(std::ceil((p.y + radius - lo_.y) / cell_), 0.0, n);
  for (auto y = static_cast<std::size_t>(from); y < static_cast<std::size_t>(till); ++y) {
    const double dy = lo_.y + (static_cast<double>(y) + 0.5) * cell_ - p.y;
    if (std::abs(dy) >= radius) continue;
    const double dx = std::sqrt((radius - dy) * (radius + dy));
    const auto m = static_cast<double>(nx_);
    const auto a = static_cast<std::size_t>(std::clamp(std::ceil((p.x - dx - lo_.x) / cell_ - 0.5), 0.0, m));
    const auto b = static_cast<std::size_t>(std::clamp(std::floor((p.x + dx - lo_.x) / cell_ + 0.5), 0.0, m));
    if (b > a) std::memset(&solid_[y * nx_ + a], 0, b - a);
  }
}

double FrontRaster::arc(Vec2 p, Vec2 direction, double radius) const {
  int hits = 0;
  for (int i = 0; i < kRays; ++i) {
    const double t = kPi * ((i + 0.5) / kRays - 0.5);
    const double c = std::cos(t);
    const double s = std::sin(t);
    const Vec2 q = p + radius * Vec2{c * direction.x - s * direction.y, s * direction.x + c * direction.y};
    if (!solid(q)) continue;
    if (std::none_of(late_.begin(), late_.end(), [&](Vec2 at) { return norm(q - at) < radius - 1e-6; }))
      ++hits;
  }
  return hits * kPi / kRays;
}

FrontRaster::Report FrontRaster::run(const GeneratedPath& g, double radius_mm, double below_mm,
                                     std::size_t from_move, double blind_mm) {
  Report out;
  const auto& p = g.path;
  // Places not yet cleared on the cells: the whole disc a short way behind would cover what the smaller
  // circle touches abeam. Up to then their smaller discs count.
  late_.clear();
  std::vector<double> held;
  const auto clear_late = [&](double keep_mm) {
    std::size_t n = 0;
    while (n < late_.size() && static_cast<double>(late_.size() - n) * 2.0 * cell_ > keep_mm)
      clear(late_[n++], radius_mm);
    late_.erase(late_.begin(), late_.begin() + static_cast<std::ptrdiff_t>(n));
  };
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.role[i] == model::MoveRole::kRetract && i > from_move) ++out.retracts;
    const bool low = p.z[i] <= below_mm && p.z[i - 1] <= below_mm;
    const double length = model::move_length(p, i);
    const bool link = p.role[i] == model::MoveRole::kLink || p.role[i] == model::MoveRole::kApproach;
    if (!low || length <= 0.0) continue;
    if (i >= from_move) (link ? out.link_mm : out.cut_mm) += length;
    const int n = std::max(1, static_cast<int>(std::ceil(length / (2.0 * cell_))));
    Vec2 last = xy(p.point(i - 1));
    for (int k = 1; k <= n; ++k) {
      const Vec2 at = xy(model::point_on_move(p, i, static_cast<double>(k) / n));
      const Vec2 d = at - last;
      const double l = norm(d);
      if (l > 1e-9) {
        const Vec2 heading = (1.0 / l) * d;
        clear_late(link ? 0.0 : kLag);
        const double a = arc(at, heading, radius_mm - blind_mm);
        if (link) {
          out.most_on_link_rad = std::max(out.most_on_link_rad, a);
        } else if (i >= from_move) {
          if (a == 0.0) out.idle_mm += l;
          out.peak_arc_rad = std::max(out.peak_arc_rad, a);
          held.push_back(a);
          if (static_cast<double>(held.size()) * 2.0 * cell_ > kHeld) {
            const double least = *std::min_element(held.begin(), held.end());
            held.erase(held.begin());
            if (least > out.held_arc_rad) {
              out.held_arc_rad = least;
              out.held_at = at;
            }
          }
        }
        if (!link) late_.push_back(at);
      }
      last = at;
    }
  }
  clear_late(0.0);
  return out;
}

double FrontRaster::left_mm2(const geometry::Region& region) const {
  FrontRaster inside(
      lo_, {lo_.x + static_cast<double>(nx_) * cell_, lo_.y + static_cast<double>(ny_) * cell_}, cell_);
  inside.nx_ = nx_;
  inside.ny_ = ny_;
  inside.solid_.assign(nx_ * ny_, 1);
  inside.only(region);
  double cells = 0.0;
  for (std::size_t i = 0; i < solid_.size(); ++i)
    cells += (solid_[i] != 0 && inside.solid_[i] != 0) ? 1.0 : 0.0;
  return cells * cell_ * cell_;
}

namespace {

/// Along x at a height y, out of the air.
GeneratedPath at_y(double y, double z) {
  GeneratedPath g;
  g.path.start({-10, y, z});
  g.path.line({70, y, z}, model::MoveRole::kCut);
  return g;
}

TEST(FrontRaster, CountsTheArcOfAStraightCutAndOfASlot) {
  FrontRaster r({0, 0}, {60, 30}, 0.02);
  const auto slot = r.run(at_y(5.0, 0.0), 5.0, 0.0, 0, 0.02);
  EXPECT_NEAR(slot.held_arc_rad, kPi, 0.04);
  r.run(at_y(7.0, 0.0), 5.0, 0.0, 0, 0.02);
  const auto side = r.run(at_y(8.5, 0.0), 5.0, 0.0, 0, 0.02);
  EXPECT_NEAR(side.held_arc_rad, std::acos(3.5 / 4.98), 0.04);
}

}  // namespace
}  // namespace capstan::toolpath
