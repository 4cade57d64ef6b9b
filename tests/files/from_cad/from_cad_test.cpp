// From the faces of CAD parts to the nouns of a plan: what a tool reaches becomes features with the sizes of
// the part, what it does not reach stays unplanned with the reason.

#include "planner/files/from_cad/from_cad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/not_recognised.h"
#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/exchange/brep/support.h"

namespace capstan::testing {
namespace {

using exchange::testing::StepPart;
using geometry::Vec2;
using geometry::Vec3;
using model::TypeId;

class FromCad : public ::testing::Test {
 protected:
  void SetUp() override {
    if (exchange::testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
  }
  exchange::Brep shape(const std::string& step) {
    exchange::BrepLimits limits;
    limits.helper = exchange::testing::helper();
    auto brep = exchange::read_brep_bytes(step, "part.step", limits, job_);
    EXPECT_TRUE(brep) << (brep ? "" : brep.error().message);
    return brep ? *std::move(brep) : exchange::Brep{};
  }
  Result<model::Plan> planned(const std::string& step, const from_cad::RawPiece& raw = {}) {
    return from_cad::plan_of_part(shape(step), "part.step", raw, job_);
  }
  Job job_;
};

/// A prism along y over a section in (x, z), counter-clockwise; its faces in the order of the section, then
/// the two ends.
std::string prism(const std::vector<Vec2>& section, double length, const std::string& unit = "mm") {
  StepPart step;
  std::vector<Vec3> corners;
  for (const double y : {0.0, length}) {
    for (const Vec2 p : section) corners.push_back({p.x, y, p.y});
  }
  const int n = static_cast<int>(section.size());
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < n; ++i) faces.push_back({i, i + n, (i + 1) % n + n, (i + 1) % n});
  std::vector<int> front, back;
  for (int i = 0; i < n; ++i) {
    front.push_back(i);
    back.push_back(2 * n - 1 - i);
  }
  faces.push_back(front);
  faces.push_back(back);
  const int solid = step.solid(step.flat_faces(corners, faces), "prism");
  step.product({solid}, step.context(unit));
  return step.text();
}

/// A block of 40 x 20 mm with a slot of 10 mm, 8 mm deep, in its top; 60 mm long.
std::vector<Vec2> slotted() {
  return {{0, 0}, {40, 0}, {40, 20}, {25, 20}, {25, 12}, {15, 12}, {15, 20}, {0, 20}};
}

/// The same with a T below: 20 mm wide from z = 6 to 12, a neck of 10 mm above it.
std::vector<Vec2> tee() {
  return {{0, 0},  {40, 0}, {40, 20}, {25, 20}, {25, 12}, {30, 12},
          {30, 6}, {10, 6}, {10, 12}, {15, 12}, {15, 20}, {0, 20}};
}

std::multimap<TypeId, model::FeatureShape> shapes_of(const model::Plan& plan) {
  std::multimap<TypeId, model::FeatureShape> out;
  const auto parts = model::parts_of_others(plan.model);
  for (const auto f : plan.model.all_below(TypeId::kTwo5dManufacturingFeature)) {
    if (parts.count(f) != 0) continue;
    const auto shapes = model::shapes_of(plan.model, model::Ref<model::ManufacturingFeature>(f));
    EXPECT_TRUE(shapes) << (shapes ? "" : shapes.error().message);
    if (!shapes) continue;
    for (const auto& s : *shapes) out.emplace(f.type, s);
  }
  return out;
}

TEST_F(FromCad, ASlotBecomesASlotWithTheSizesOfThePart) {
  const auto plan = planned(prism(slotted(), 60));
  ASSERT_TRUE(plan) << plan.error().message;
  const auto shapes = shapes_of(*plan);
  ASSERT_EQ(shapes.size(), 1U);
  const auto& [type, slot] = *shapes.begin();
  EXPECT_EQ(type, TypeId::kSlot);
  EXPECT_NEAR(slot.width.nominal_mm, 10.0, 1e-6);
  EXPECT_NEAR(slot.depth_mm, 8.0, 1e-6);
  EXPECT_NEAR(slot.frame.z.z, 1.0, 1e-9);
  EXPECT_NEAR(slot.frame.to_parent({0, 0, 0}).z, 20.0, 1e-6);
  EXPECT_TRUE(model::not_recognised(*plan).empty());
}

TEST_F(FromCad, EveryFeatureSaysFromWhichFacesOfTheFileItIs) {
  const exchange::Brep brep = shape(prism(slotted(), 60));
  const auto plan = from_cad::plan_of_part(brep, "part.step", {}, job_);
  ASSERT_TRUE(plan);
  std::string said;
  for (const auto& [key, decision] : plan->ledger.entries())
    said += plan->ledger.reason(decision.reason).text;
  // The section's sides 3, 4 and 5 are the walls and the floor of the slot.
  for (const std::size_t f : {3U, 4U, 5U})
    EXPECT_NE(said.find("#" + std::to_string(brep.faces.at(f).id)), std::string::npos) << said;
}

TEST_F(FromCad, SizesOfAPartInInchesAreMillimetres) {
  std::vector<Vec2> section = slotted();
  for (Vec2& p : section) p = (1.0 / 25.4) * p;
  const auto plan = planned(prism(section, 60 / 25.4, "inch"));
  ASSERT_TRUE(plan) << plan.error().message;
  const auto shapes = shapes_of(*plan);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_NEAR(shapes.begin()->second.width.nominal_mm, 10.0, 1e-6);
  EXPECT_NEAR(shapes.begin()->second.depth_mm, 8.0, 1e-6);
}

TEST_F(FromCad, WhatNoToolReachesFromAboveIsNotPlannedAsIfItDid) {
  const auto plan = planned(prism(tee(), 60));
  ASSERT_TRUE(plan) << plan.error().message;
  const auto left = model::not_recognised(*plan);
  // From above the neck hides the bar; from its ends the whole section is one area.
  for (const auto& [type, s] : shapes_of(*plan)) EXPECT_LT(std::abs(s.frame.z.z), 1e-9) << s.name;
  EXPECT_TRUE(!shapes_of(*plan).empty() || !left.empty());
}

TEST_F(FromCad, TheRawPieceThatIsNamedIsFacedDownToThePart) {
  const auto plan = planned(prism(slotted(), 60), {.box = geometry::Box3{{0, 0, 0}, {40, 60, 22}}});
  ASSERT_TRUE(plan) << plan.error().message;
  const auto shapes = shapes_of(*plan);
  const auto face = shapes.find(TypeId::kPlanarFace);
  ASSERT_NE(face, shapes.end());
  EXPECT_NEAR(face->second.depth_mm, 2.0, 1e-6);
  const auto slot = shapes.find(TypeId::kSlot);
  ASSERT_NE(slot, shapes.end());
  EXPECT_NEAR(slot->second.depth_mm, 8.0, 1e-6) << "the slot begins at the finished face";
}

TEST_F(FromCad, ARawPieceThatDoesNotHoldThePartIsRefused) {
  const auto plan = planned(prism(slotted(), 60), {.box = geometry::Box3{{0, 0, 0}, {40, 60, 19}}});
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "CAD-STOCK");
}

TEST_F(FromCad, SeveralSolidsAreRefused) {
  StepPart step;
  const std::vector<int> boxes = {step.box({0, 0, 0}, {10, 10, 10}), step.box({20, 0, 0}, {30, 10, 10})};
  step.product(boxes, step.context());
  const auto plan = planned(step.text());
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "CAD-BODIES");
}

TEST_F(FromCad, TheExampleHasTheFeaturesThatItsProgramMadeIt) {
  const auto plan = planned(slurp(source_dir() + "/examples/cover.step"));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_TRUE(model::not_recognised(*plan).empty());
  const auto shapes = shapes_of(*plan);
  EXPECT_EQ(shapes.count(TypeId::kStep), 1U);
  EXPECT_EQ(shapes.count(TypeId::kSlot), 1U);
  EXPECT_EQ(shapes.count(TypeId::kRoundHole), 5U);
  EXPECT_EQ(shapes.count(TypeId::kCounterboreHole), 2U) << "its two elements";
  const auto pocket = shapes.find(TypeId::kClosedPocket);
  ASSERT_NE(pocket, shapes.end());
  EXPECT_NEAR(pocket->second.corner_radius_mm, 6.0, 1e-6);
  EXPECT_NEAR(pocket->second.depth_mm, 9.0, 1e-6);
  EXPECT_NEAR(pocket->second.width.nominal_mm, 30.0, 1e-6);
  EXPECT_NEAR(pocket->second.length.nominal_mm, 40.0, 1e-6);
}

}  // namespace
}  // namespace capstan::testing
