#pragma once

#include <vector>

#include "rules/rules.h"

// What the tests of rules share: the rules that are shipped, and usual materials and holes.

namespace capstan::rules {

inline const RuleBase& shipped() {
  static const RuleBase kBase = [] {
    Job job;
    return load_rules("", job).value();
  }();
  return kBase;
}

inline Context steel() {
  Context c;
  c.material.iso_group = "P";
  return c;
}
inline Context iron(double core_mm = 0.0) {
  Context c;
  c.material.iso_group = "K";
  c.core_diameter_mm = core_mm;
  return c;
}

inline std::vector<model::TypeId> kinds(const std::vector<model::ProposedStep>& chain) {
  std::vector<model::TypeId> out;
  for (const auto& step : chain) out.push_back(step.operation);
  return out;
}

namespace drawn {

inline model::FeatureShape hole(double d, double depth,
                                model::HoleBottom bottom = model::HoleBottom::kThrough) {
  model::FeatureShape s;
  s.kind = model::ShapeKind::kHole;
  s.name = "H";
  s.diameter.nominal_mm = s.bottom_diameter_mm = d;
  s.depth_mm = depth;
  s.bottom = bottom;
  s.through = bottom == model::HoleBottom::kThrough;
  s.area = s.reach = geometry::disc({0, 0}, 0.5 * d);
  return s;
}
inline model::FeatureShape toleranced(model::FeatureShape s, double lower, double upper) {
  s.diameter.lower_mm = lower;
  s.diameter.upper_mm = upper;
  s.diameter.given = true;
  return s;
}

}  // namespace drawn

}  // namespace capstan::rules
