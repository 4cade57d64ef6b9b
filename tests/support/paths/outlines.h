#pragma once

#include <cmath>
#include <vector>

#include "planner/ground/geometry/profile.h"

namespace capstan::test {

/// Outlines that no class of cutter has yet, made of the same straight pieces and arcs. mm.

inline geometry::CutterProfile outline(std::vector<geometry::ProfilePiece> pieces) {
  const double radius = pieces.back().r1_mm;
  return {.pieces = std::move(pieces), .radius_mm = radius, .cutting_length_mm = 20.0};
}

/// A circle's arc about (rc, zc) from r0 to r1.
inline geometry::ProfilePiece arc(double r0, double r1, double rc, double zc, double radius) {
  return {.r0_mm = r0, .r1_mm = r1, .radius_mm = radius, .rc_mm = rc, .zc_mm = zc};
}

/// A lens of radius 10 up to 3 mm from the axis: its rim is a corner.
inline geometry::CutterProfile lens() { return outline({arc(0.0, 3.0, 0.0, 10.0, 10.0)}); }

/// A barrel: a ball nose of 1 mm up to 60 degrees, then, tangent to it, an arc of 12 mm to its widest place.
inline geometry::CutterProfile barrel() {
  const double sine = std::sqrt(0.75), cosine = 0.5, z = 1.0 - cosine;
  const double rc = sine - 12.0 * sine, zc = z + 12.0 * cosine;
  return outline({arc(0.0, sine, 0.0, 1.0, 1.0), arc(sine, rc + 12.0, rc, zc, 12.0)});
}

/// A cone of 2 x 20 degrees behind a ball of 1 mm, 3 mm from axis to rim.
inline geometry::CutterProfile tapered_ball() {
  const double lean = 20.0 * std::acos(-1.0) / 180.0, r = std::cos(lean), z = 1.0 - std::sin(lean);
  return outline(
      {arc(0.0, r, 0.0, 1.0, 1.0), {.r0_mm = r, .r1_mm = 3.0, .z0_mm = z, .slope = 1.0 / std::tan(lean)}});
}

}  // namespace capstan::test
