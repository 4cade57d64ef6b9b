#include "planner/proof/verify/copies.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "planner/model/nouns/arena/attribute.h"

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
/// the flank's own angle or by the lead angle, a ball.
enum class Outline : std::uint8_t { kFlat, kPointed, kTapered, kLead, kBall };

struct Copy {
  unsigned traits;
  Outline outline;
};

Copy copy_of(CutterClass c) {
  switch (c) {
#define CAPSTAN_CLASS_COPY(value, traits, outline) \
  case CutterClass::value:                         \
    return {traits, Outline::outline};
#include "planner/proof/verify/class_copies.inc"
#undef CAPSTAN_CLASS_COPY
  }
  return {kNone, Outline::kFlat};
}

bool is(CutterClass c, Trait t) { return (copy_of(c).traits & t) != 0; }

constexpr int kMarkingRank = 1, kDrillingRank = 2, kRoughingRank = 3, kFinishingRank = 4, kSizingRank = 5;

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

int order_rank(model::TypeId op) {
  using model::TypeId;
  if (op == TypeId::kNone) return 0;
  const model::NounType& noun = model::noun_type(op);
  if (noun.abstract) return 0;
  if (model::is_a(op, TypeId::kMillingTypeOperation)) {
    if (noun.keyword.ends_with("ROUGH_MILLING")) return kRoughingRank;
    return noun.keyword.ends_with("FINISH_MILLING") ? kFinishingRank : 0;
  }
  if (!model::is_a(op, TypeId::kDrillingTypeOperation) || op == TypeId::kCounterSinking) return 0;
  if (op == TypeId::kCenterDrilling) return kMarkingRank;
  return model::is_a(op, TypeId::kDrillingOperation) ? kDrillingRank : kSizingRank;
}

bool finishes(model::TypeId op) { return order_rank(op) == kFinishingRank; }

double speed_by_arc(double width_ratio, const std::string& group) {
  constexpr double kWidth[] = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5};
  constexpr double kSpeed[] = {1.48, 1.35, 1.27, 1.22, 1.19, 1.16, 1.11, 1.0};
  if (group != "P" && group != "M" && group != "K") return 1.0;
  double speed = 1.0;
  for (int i = 0; i + 1 < 8; ++i) {
    if (width_ratio < kWidth[i] || width_ratio >= kWidth[i + 1]) continue;
    speed = kSpeed[i] + (width_ratio - kWidth[i]) / (kWidth[i + 1] - kWidth[i]) * (kSpeed[i + 1] - kSpeed[i]);
  }
  if (width_ratio > 0.0 && width_ratio < kWidth[0]) speed = kSpeed[0];
  return speed;
}

double usual_ramp(const model::Cutter& c, const std::string& group) {
  double degrees = 3.0;
  if (group == "N") degrees = 10.0;
  if (c.substrate == model::Substrate::kCarbide && (group == "P" || group == "K")) degrees = 5.0;
  return std::min(c.maximum_ramp_angle_rad, degrees / 180.0 * std::numbers::pi);
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
    case Outline::kFlat:
      break;
  }
  return geometry::bull_profile(d, c.corner_radius_mm, high);
}

}  // namespace capstan::verify
