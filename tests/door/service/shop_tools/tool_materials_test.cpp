#include "planner/door/service/shop_tools/tool_materials.h"

#include <gtest/gtest.h>

#include <utility>

namespace capstan::service {
namespace {

using model::Cutter;
using model::Substrate;

Cutter cutter(Substrate s, const char* source) {
  Cutter c;
  c.id = "em10";
  c.pocket = 3;
  c.substrate = s;
  c.sources.emplace_back("substrate", source);
  return c;
}

std::vector<model::Finding> found(Cutter planned, Cutter loaded) {
  model::Plan plan;
  plan.cutters.push_back(std::move(planned));
  loaded.id = "another name";
  return other_tool_materials(plan, {std::move(loaded)});
}

TEST(OtherToolMaterials, AToolOfHssWhereThePlanCutsWithCarbideIsAnError) {
  const auto f = found(cutter(Substrate::kCarbide, "stated"), cutter(Substrate::kHss, "stated: column"));
  ASSERT_EQ(f.size(), 1U);
  EXPECT_EQ(f[0].code, "CHK-TOOL-MATERIAL");
  EXPECT_EQ(f[0].severity, Severity::kError);
}

TEST(OtherToolMaterials, AToolOfCarbideWhereThePlanStatesHssIsAWarning) {
  const auto f = found(cutter(Substrate::kHss, "stated"), cutter(Substrate::kCarbide, "stated"));
  ASSERT_EQ(f.size(), 1U);
  EXPECT_EQ(f[0].severity, Severity::kWarning);
}

TEST(OtherToolMaterials, WhatIsNotStatedOrIsTheSameIsNoFinding) {
  EXPECT_TRUE(found(cutter(Substrate::kCarbide, "stated"), cutter(Substrate::kHss, "default: the slower one"))
                  .empty());
  EXPECT_TRUE(found(cutter(Substrate::kCarbide, "stated"), cutter(Substrate::kCarbide, "stated")).empty());
  EXPECT_TRUE(
      found(cutter(Substrate::kHss, "default: assumed"), cutter(Substrate::kCarbide, "stated")).empty());
}

TEST(OtherToolMaterials, AToolWithoutAPocketIsNamedByItsName) {
  Cutter planned = cutter(Substrate::kCarbide, "stated");
  planned.pocket = 0;
  model::Plan plan;
  plan.cutters.push_back(planned);
  const auto f = other_tool_materials(plan, {cutter(Substrate::kHss, "stated")});
  ASSERT_EQ(f.size(), 1U);
  EXPECT_TRUE(f[0].message.starts_with("'em10' is of ")) << f[0].message;
}

}  // namespace
}  // namespace capstan::service
