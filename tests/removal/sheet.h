#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/removal/parts.h"

/// Features in a flat block, planned.
namespace capstan::testing::removal {

struct Sheet {
  Box block = removal::block(60, 60, 20);
  Drawing d{"SHEET", block};
  [[nodiscard]] PlanOutput planned() const { return plan_bytes(d.text(), "sheet.p21"); }
};

inline std::string told(const PlanOutput& o) {
  std::string out;
  for (const auto& m : o.diagnostics) out += m.severity + " " + m.code + " " + m.text + "\n";
  for (const auto& m : o.findings) out += "finding " + m.severity + " " + m.code + " " + m.text + "\n";
  return out;
}

inline void expect_unplanned(const PlanOutput& o, std::size_t features, const std::string& why) {
  EXPECT_EQ(o.unplanned, features) << told(o);
  EXPECT_TRUE(std::any_of(o.diagnostics.begin(), o.diagnostics.end(), [&](const PlanMessage& m) {
    return m.code == "PIP-UNPLANNED" && m.text.find(why) != std::string::npos;
  })) << told(o);
}

inline void expect_refused(const Sheet& s, const std::string& why) {
  const PlanOutput o = s.planned();
  expect_unplanned(o, 1, why);
  EXPECT_EQ(o.steps, 0U) << told(o);
}

}  // namespace capstan::testing::removal
