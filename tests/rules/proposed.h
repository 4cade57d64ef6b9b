#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/shop.h"

namespace capstan::rules {

/// What the shipped rules propose: chains or a reason, every step with all that it must say.
inline model::Proposal proposed(const model::FeatureShape& s, const Context& c = steel()) {
  model::Proposal p = propose(shipped(), s, c);
  EXPECT_NE(p.chains.empty(), p.cannot.empty()) << "chains or a reason, never neither or both: " << p.cannot;
  for (const auto& chain : p.chains) {
    for (const auto& step : chain) {
      EXPECT_FALSE(step.why.id.empty());
      EXPECT_FALSE(step.why.source.empty());
      EXPECT_FALSE(step.tool.classes.empty());
      EXPECT_GT(step.tool.reach_mm, 0.0);
      EXPECT_FALSE(step.tool.words.empty());
    }
  }
  return p;
}
/// The operations of the first chain.
inline std::vector<model::TypeId> first(const model::Proposal& p) {
  return p.chains.empty() ? std::vector<model::TypeId>{} : kinds(p.chains[0]);
}
/// The row that gave the first step, or why there is none.
inline std::string row(const model::Proposal& p) {
  return p.chains.empty() ? p.cannot : p.chains[0][0].why.id;
}

/// The hole with the tolerance H of a grade.
inline model::FeatureShape h(model::FeatureShape s, int grade) {
  return drawn::toleranced(s, 0.0, standard_tolerance_mm(grade, s.diameter.nominal_mm));
}

}  // namespace capstan::rules
