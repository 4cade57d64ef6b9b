#include "tooling/library/cutters/edge_kind.h"

#include <algorithm>
#include <cmath>

namespace capstan::tooling {
namespace {

/// Face mills are made to a cutting edge angle of 42 degrees, high-feed mills to 10 to 20: between the two.
/// Default, unsourced.
constexpr double kHighFeedLeanRad = 60.0 * kRadPerDegree;
/// Cutting edge angles are made as 90, 75, 65, 45, 42 degrees and less. Default, unsourced.
constexpr double kSameLeanRad = 10.0 * kRadPerDegree;

}  // namespace

bool drills_with_inserts(const model::Cutter& c) {
  return c.cutter_class == model::CutterClass::kTwistDrill && c.substrate == model::Substrate::kCarbide &&
         c.point_angle_rad >= kFlatPointRad;
}

bool feeds_high(const model::Cutter& c) {
  return c.cutter_class == model::CutterClass::kFacemill && c.lead_angle_rad >= kHighFeedLeanRad;
}

double widest_circle_mm(const model::Cutter& c, double depth_mm) {
  if (c.cutter_class != model::CutterClass::kFacemill) return c.cutting_diameter_mm;
  const double in_mm = std::min(depth_mm, c.maximum_depth_of_cut_mm);
  return c.cutting_diameter_mm + 2.0 * in_mm * std::tan(c.lead_angle_rad);
}

bool edges_lean_alike(const model::Cutter& a, const model::Cutter& b) {
  return drills_with_inserts(a) == drills_with_inserts(b) &&
         std::abs(a.lead_angle_rad - b.lead_angle_rad) < kSameLeanRad;
}

}  // namespace capstan::tooling
