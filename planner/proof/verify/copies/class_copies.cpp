#include <cmath>
#include <cstdint>

#include "planner/proof/verify/copies/copies.h"

// What the check says of each class of cutter by itself, whatever the vocabulary says: one row of copy_of a
// class, with its traits and the outline that its edges sweep. A class without a row does not compile
// (-Wswitch); copies.h has the meaning of each trait.

namespace capstan::verify {

using model::CutterClass;

namespace {

enum Trait : std::uint16_t {
  kNone = 0,
  kAxis = 1U << 0U,
  kMill = 1U << 1U,
  kUnder = 1U << 2U,
  kHang = 1U << 3U,
  kSize = 1U << 4U,
  kEdge = 1U << 5U,
  kPoint = 1U << 6U,
  kThread = 1U << 7U,
  kCentre = 1U << 8U,
  kRake = 1U << 9U,
};

/// What a class's edges sweep: a flat end with rounded corners, a cone to a point, a cone over a flat tip by
/// the flank's own angle or by the lead angle, a ball, a hollow quarter round over a flat tip.
enum class Outline : std::uint8_t { kFlat, kPointed, kTapered, kLead, kBall, kHollow };

struct Copy {
  unsigned traits;
  Outline outline;
};

Copy copy_of(CutterClass c) {
  switch (c) {
    case CutterClass::kEndmill:
      return {kMill | kRake, Outline::kFlat};
    case CutterClass::kBullnoseEndmill:
      return {kMill | kRake, Outline::kFlat};
    case CutterClass::kBallEndmill:
      return {kMill | kRake, Outline::kBall};
    case CutterClass::kFacemill:
      return {kMill, Outline::kLead};
    case CutterClass::kTwistDrill:
      return {kAxis | kSize | kCentre, Outline::kPointed};
    case CutterClass::kCenterDrill:
      return {kAxis | kPoint | kCentre, Outline::kPointed};
    case CutterClass::kSpotDrill:
      return {kAxis | kPoint | kCentre, Outline::kPointed};
    case CutterClass::kReamer:
      return {kAxis | kSize, Outline::kFlat};
    case CutterClass::kTap:
      return {kAxis | kSize, Outline::kFlat};
    case CutterClass::kThreadMill:
      return {kMill | kThread, Outline::kFlat};
    case CutterClass::kBoringTool:
      return {kAxis, Outline::kFlat};
    case CutterClass::kCountersink:
      return {kAxis | kPoint | kEdge, Outline::kPointed};
    case CutterClass::kCounterbore:
      return {kAxis | kMill, Outline::kFlat};
    case CutterClass::kChamferMill:
      return {kMill | kPoint | kEdge, Outline::kPointed};
    case CutterClass::kTSlotMill:
      return {kMill | kUnder | kHang, Outline::kFlat};
    case CutterClass::kDovetailMill:
      return {kMill | kUnder | kHang, Outline::kFlat};
    case CutterClass::kGunDrill:
      return {kAxis | kSize, Outline::kPointed};
    case CutterClass::kBackCounterbore:
      return {kAxis | kMill | kUnder, Outline::kFlat};
    case CutterClass::kBackCountersink:
      return {kAxis | kMill | kUnder | kHang | kPoint, Outline::kFlat};
    case CutterClass::kCornerRoundingMill:
      return {kMill, Outline::kHollow};
    case CutterClass::kTaperedEndmill:
      return {kMill, Outline::kTapered};
    case CutterClass::kSideMill:
      return {kMill | kUnder, Outline::kFlat};
    case CutterClass::kTouchProbe:
      return {kNone, Outline::kFlat};
  }
  return {kNone, Outline::kFlat};
}

bool is(CutterClass c, Trait t) { return (copy_of(c).traits & t) != 0; }

}  // namespace

bool works_along_axis(CutterClass c) { return is(c, kAxis); }
bool undercuts(CutterClass c) { return is(c, kUnder); }
bool under_overhangs(CutterClass c) { return is(c, kHang); }
bool sizes_hole(CutterClass c) { return is(c, kSize); }
bool breaks_edges(CutterClass c) { return is(c, kEdge); }
bool cuts_by_point(CutterClass c) { return is(c, kPoint); }
bool mills(CutterClass c) { return is(c, kMill); }
bool mills_threads(CutterClass c) { return is(c, kThread); }
bool cuts_to_centre(CutterClass c) { return is(c, kCentre); }
bool is_raked(CutterClass c) { return is(c, kRake); }
bool is_ball(CutterClass c) { return copy_of(c).outline == Outline::kBall; }

double end_radius_of(const model::Cutter& c) {
  return is_ball(c.cutter_class) ? 0.5 * c.cutting_diameter_mm : c.corner_radius_mm;
}

geometry::CutterProfile outline_of(const model::Cutter& c) {
  const double d = c.cutting_diameter_mm, high = c.maximum_depth_of_cut_mm;
  const auto widening = [&](double lean) {
    return geometry::cone_profile(d + 2.0 * high * std::tan(lean), 2.0 * lean, high, d);
  };
  switch (copy_of(c.cutter_class).outline) {
    case Outline::kPointed:
      if (c.point_angle_rad > 0.0)
        return geometry::cone_profile(d, c.point_angle_rad, high, c.tip_diameter_mm);
      break;
    case Outline::kTapered:  // its diameter is that of the tip
      if (c.taper_angle_rad > 0.0) return widening(c.taper_angle_rad);
      break;
    case Outline::kLead:  // ISO 13399: DC is measured at the tip, DCX = DC + 2 APMX tan PSIR
      if (c.lead_angle_rad > 0.0 && high > 0.0) return widening(c.lead_angle_rad);
      break;
    case Outline::kBall:
      return geometry::ball_profile(d, high);
    case Outline::kHollow:
      if (c.corner_radius_mm > 0.0) return geometry::rounding_profile(d, c.corner_radius_mm, high);
      break;
    case Outline::kFlat:
      break;
  }
  return geometry::bull_profile(d, c.corner_radius_mm, high);
}

}  // namespace capstan::verify
