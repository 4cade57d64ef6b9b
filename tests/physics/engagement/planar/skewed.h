#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "planner/physics/engagement/planar/planar.h"

/// Cutters and paths askew in a block, so that no cell or axis is met by chance.
namespace capstan::engagement {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::Cutter;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;
using stock::PlanarStock;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kSkew = 27.0 * kPi / 180.0;
inline const Box3 kBlock{{0.0, 0.0, -20.0}, {80.0, 60.0, 0.0}};

inline Cutter cutter(CutterClass kind, double diameter, double corner = 0.0, double point = 0.0) {
  Cutter c;
  c.id = "t";
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.point_angle_rad = point;
  c.maximum_depth_of_cut_mm = 30.0;
  return c;
}

inline Vec3 skewed(double s, double left, double z) {
  const Vec2 p = Vec2{15.13, 12.07} + s * Vec2{std::cos(kSkew), std::sin(kSkew)} +
                 left * Vec2{-std::sin(kSkew), std::cos(kSkew)};
  return {p.x, p.y, z};
}

inline CutterPath line(double left, double z, double length) {
  CutterPath p;
  p.start(skewed(0.0, left, 10.0));
  p.rapid(skewed(0.0, left, 5.0));
  p.line(skewed(0.0, left, z), MoveRole::kPlunge);
  p.line(skewed(length, left, z), MoveRole::kCut);
  return p;
}

inline CutterPath pocket(double stepover, double depth, int levels) {
  CutterPath p;
  p.start(skewed(0.0, 0.0, 5.0));
  for (int level = 1; level <= levels; ++level) {
    const double z = -depth * level / levels;
    p.line(skewed(0.0, 0.0, z), MoveRole::kPlunge);
    int k = 0;
    for (double left = 0.0; left < 12.0; left += stepover, ++k) {
      p.line(skewed(k % 2 == 0 ? 0.0 : 20.0, left, z), MoveRole::kLink);
      p.line(skewed(k % 2 == 0 ? 20.0 : 0.0, left, z), MoveRole::kCut);
    }
    for (const auto& [s, left] : {std::pair{0.0, 12.0}, {0.0, 0.0}, {20.0, 0.0}, {20.0, 12.0}, {0.0, 12.0}})
      p.line(skewed(s, left, z), MoveRole::kCut);
    p.rapid(skewed(0.0, 12.0, 5.0));
    p.rapid(skewed(0.0, 0.0, 5.0));
  }
  return p;
}

/// Largest relative error of the CSA of the samples of a move between two places.
inline double worst_csa(const Measurement& m, std::uint32_t move, double lo, double hi, double expected) {
  double worst = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < m.sections.size(); ++i) {
    if (m.sections.move[i] != move || m.sections.at_mm[i] < lo || m.sections.at_mm[i] > hi) continue;
    worst = std::max(worst, std::abs(m.sections.csa_mm2[i] / expected - 1.0));
    ++n;
  }
  EXPECT_GT(n, 0);
  return worst;
}

}  // namespace capstan::engagement
