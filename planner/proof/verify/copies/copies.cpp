#include "planner/proof/verify/copies/copies.h"

#include <algorithm>
#include <numbers>

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::verify {

namespace {

constexpr int kMarkingRank = 1, kDrillingRank = 2, kRoughingRank = 3, kFinishingRank = 4, kSizingRank = 5;

}  // namespace

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
  constexpr double kOthers[] = {1.48, 1.35, 1.27, 1.22, 1.19, 1.16, 1.11, 1.0};
  constexpr double kAlloys[] = {1.48, 1.35, 1.27, 1.22, 1.189, 1.136, 1.057, 1.0};
  const auto& speeds = group == "S" ? kAlloys : kOthers;
  if (group != "P" && group != "M" && group != "K" && group != "S" && group != "H") return 1.0;
  double speed = 1.0;
  for (int i = 0; i + 1 < 8; ++i) {
    if (width_ratio < kWidth[i] || width_ratio >= kWidth[i + 1]) continue;
    speed = speeds[i] + (width_ratio - kWidth[i]) / (kWidth[i + 1] - kWidth[i]) * (speeds[i + 1] - speeds[i]);
  }
  if (width_ratio > 0.0 && width_ratio < kWidth[0]) speed = speeds[0];
  return speed;
}

double usual_ramp(const model::Cutter& c, const std::string& group) {
  double degrees = 3.0;
  if (group == "N") degrees = 10.0;
  if (c.substrate == model::Substrate::kCarbide && (group == "P" || group == "K")) degrees = 5.0;
  return std::min(c.maximum_ramp_angle_rad, degrees / 180.0 * std::numbers::pi);
}

}  // namespace capstan::verify
