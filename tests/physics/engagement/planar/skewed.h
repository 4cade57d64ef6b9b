#pragma once

#include <cmath>
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

}  // namespace capstan::engagement
