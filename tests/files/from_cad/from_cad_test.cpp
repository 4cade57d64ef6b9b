// From the faces of CAD parts to the nouns of a plan: what a tool reaches becomes features with the sizes of
// the part, what it does not reach stays unplanned with the reason.

#include "planner/files/from_cad/from_cad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numbers>

#include "planner/files/from_cad/areas.h"
#include "planner/files/from_cad/cover.h"
#include "planner/files/from_cad/holes.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/not_recognised.h"
#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/exchange/brep/support.h"
#include "tests/files/from_cad/turned_part.h"

namespace capstan::testing {
namespace {

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
    return from_cad::plan_of_part(shape(step), "part.step", {raw, {}}, job_);
  }
  /// The notes with a code, one behind the other.
  [[nodiscard]] std::string said(const std::string& code) const {
    std::string out;
    for (const auto& d : job_.diagnostics()) out += d.code == code ? d.message + "\n" : "";
    return out;
  }
  Job job_;
};

/// Faces of holes, and the bounds that they cut into the sides of a prism, by the side's number.
struct Holes {
  std::vector<int> faces;
  std::map<int, int> bounds;
};

/// A prism along y over a section in (x, z), counter-clockwise; its faces in the order of the section, then
/// the two ends.
std::string prism(const std::vector<Vec2>& section, double length, const std::string& unit = "mm",
                  const std::function<Holes(StepPart&)>& holes = {}, double turned_rad = 0.0) {
  StepPart step;
  const Holes drilled = holes ? holes(step) : Holes{};
  std::vector<Vec3> corners;
  for (const double y : {0.0, length}) {
    for (const Vec2 p : section)
      corners.push_back({p.x * std::cos(turned_rad) - y * std::sin(turned_rad),
                         p.x * std::sin(turned_rad) + y * std::cos(turned_rad), p.y});
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
  auto made = step.flat_faces(corners, faces, drilled.bounds);
  made.insert(made.end(), drilled.faces.begin(), drilled.faces.end());
  const int solid = step.solid(made, "prism");
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

std::string reasons(const model::Plan& plan) {
  std::string out;
  for (const auto& [feature, why] : model::not_recognised(plan)) out += why + "\n";
  return out;
}

/// The only shape of a plan in which everything is planned.
model::FeatureShape only(const Result<model::Plan>& plan) {
  EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
  if (!plan) return {};
  EXPECT_EQ(reasons(*plan), "");
  const auto shapes = shapes_of(*plan);
  EXPECT_EQ(shapes.size(), 1U);
  return shapes.empty() ? model::FeatureShape{} : shapes.begin()->second;
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
  // From above the neck hides the bar; from its ends the whole section is one area, 60 mm deep. The walls of
  // the neck are faces of their own to recognition, and opposite to each stands the other.
  const auto left = model::not_recognised(*plan);
  EXPECT_EQ(left.size(), 2U);
  for (const auto& [faces, why] : left)
    EXPECT_NE(why.find("does not reach 480 of its 480 mm2"), std::string::npos) << why;
  const auto shapes = shapes_of(*plan);
  ASSERT_EQ(shapes.size(), 1U);
  const auto& [type, s] = *shapes.begin();
  EXPECT_EQ(type, TypeId::kOpenPocket);
  EXPECT_NEAR(std::abs(s.frame.z.y), 1.0, 1e-9);
  EXPECT_NEAR(s.depth_mm, 60.0, 1e-6);
  EXPECT_TRUE(s.through);
}

TEST_F(FromCad, AWallThatLeansOverTheMouthIsMadeToItsEndByAMillThatRunsOut) {
  // A floor and a wall that leans back by ten on twelve, through all of the part, open above and beside.
  const Vec2 foot{15, 8}, end{5, 20};
  const auto s = only(planned(prism({{0, 0}, {40, 0}, {40, foot.y}, foot, end, {0, 20}}, 60)));
  EXPECT_TRUE(s.open && s.through);
  constexpr double kRadius = 6.0;
  const Vec2 along = (1.0 / norm(end - foot)) * (end - foot), off = {along.y, -along.x};
  const geometry::Region centres = geometry::offset(s.reach, -(kRadius - 0.01));
  for (const double past : {0.0, 2.0 * kRadius}) {
    const Vec2 p = end + past * along + kRadius * off;
    EXPECT_TRUE(geometry::contains(centres, xy(s.frame.to_local({p.x, 30.0, p.y})))) << past;
  }
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
  EXPECT_TRUE(plan.error().message.ends_with("1 (solid, 6 faces); 2 (solid, 6 faces)"));
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

TEST_F(FromCad, AFilletAtTheBottomOfABoreIsItsBottom) {
  const auto hole = only(planned(bored({{5, 20}, {5, 11}, {4, 10, 1}, {0, 10}})));
  EXPECT_EQ(hole.bottom, model::HoleBottom::kFlatWithRadius);
  EXPECT_NEAR(hole.depth_mm, 10.0, 1e-6);
  EXPECT_NEAR(hole.bottom_hole_radius_mm, 1.0, 1e-6);
}

TEST_F(FromCad, AFilletBetweenTwoBoresIsNotTheBottomOfTheLower) {
  // A counterbore of diameter 11, 6.5 deep, with a fillet of 0.5 at its shelf, over a bore of 6.6 through.
  const auto plan = planned(bored({{5.5, 20}, {5.5, 14}, {5, 13.5, 0.5}, {3.3, 13.5}, {3.3, 0}}));
  ASSERT_TRUE(plan) << plan.error().message;
  for (const auto& [type, s] : shapes_of(*plan)) {
    EXPECT_EQ(type, TypeId::kClosedPocket) << "no hole noun says it; a mill makes it";
    const bool upper = s.diameter.nominal_mm > 7.0 || geometry::bounds(s.area).hi.x > 3.5;
    EXPECT_NEAR(s.depth_mm, upper ? 6.5 : 13.5, 1e-6);
    EXPECT_NEAR(s.bottom_radius_mm, upper ? 0.5 : 0.0, 1e-6);
  }
  EXPECT_NE(reasons(*plan), "");
}

TEST_F(FromCad, AFilletOverAConeHasNoDepthOfAPlane) {
  const auto plan = planned(bored({{5, 20}, {5, 11}, {4, 10, 1}, {0, 7}}));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_TRUE(shapes_of(*plan).empty());
  EXPECT_NE(reasons(*plan).find("no flat bottom"), std::string::npos) << reasons(*plan);
}

TEST_F(FromCad, APointThatWouldBeReadAsAnotherIsRefusedWithItsAngle) {
  const auto wide =
      only(planned(bored({{3, 20}, {3, 10}, {0, 10 - 3 / std::tan(59 * 0.017453292519943295)}})));
  EXPECT_EQ(wide.bottom, model::HoleBottom::kConical);
  EXPECT_NEAR(wide.depth_mm, 10.0, 1e-6);
  EXPECT_NEAR(wide.bottom_angle_rad, 31 * 0.017453292519943295, 1e-6);
  const auto sharp = planned(bored({{3, 20}, {3, 10}, {0, 10 - 3 / std::tan(30 * 0.017453292519943295)}}));
  ASSERT_TRUE(sharp) << sharp.error().message;
  EXPECT_TRUE(shapes_of(*sharp).empty());
  EXPECT_NE(reasons(*sharp).find("a point of 60 degrees"), std::string::npos) << reasons(*sharp);
}

/// A bore of 4 mm along x or y, from a side of the prism to another.
void bore(StepPart& step, Vec3 from, Vec3 axis, double length, int low_side, int high_side, Holes& out) {
  const Vec3 across{axis.y, axis.x, 0};
  const auto rim = [&](Vec3 at) {
    const int v = step.vertex(at + 2.0 * across);
    const int circle = step.add("CIRCLE(''," + StepPart::ref(step.placement(at, axis, across)) + ",2.)");
    return step.add("EDGE_CURVE(''," + StepPart::ref(v) + "," + StepPart::ref(v) + "," +
                    StepPart::ref(circle) + ",.T.)");
  };
  const int low = rim(from), high = rim(from + length * axis);
  out.bounds[low_side] = step.bound({step.oriented(low, true)}, false);
  out.bounds[high_side] = step.bound({step.oriented(high, false)}, false);
  out.faces.push_back(step.face(
      "bore", {step.bound({step.oriented(high, true)}, true), step.bound({step.oriented(low, false)}, false)},
      step.add("CYLINDRICAL_SURFACE(''," + StepPart::ref(step.placement(from, axis, across)) + ",2.)"),
      false));
}

TEST_F(FromCad, AHoleThroughTwoEarsIsOneRoundHole) {
  const auto plan = planned(prism(slotted(), 60, "mm", [](StepPart& step) {
    Holes out;
    bore(step, {0, 30, 16}, {1, 0, 0}, 15, 7, 5, out);
    bore(step, {25, 30, 16}, {1, 0, 0}, 15, 3, 1, out);
    return out;
  }));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(reasons(*plan), "");
  const auto shapes = shapes_of(*plan);
  EXPECT_EQ(shapes.count(TypeId::kCounterboreHole), 0U);
  ASSERT_EQ(shapes.count(TypeId::kRoundHole), 1U);
  const auto& hole = shapes.find(TypeId::kRoundHole)->second;
  EXPECT_NEAR(hole.depth_mm, 40.0, 1e-6);
  EXPECT_NEAR(hole.diameter.nominal_mm, 4.0, 1e-6);
  EXPECT_TRUE(hole.through);
}

TEST_F(FromCad, BevelledCornersOfAPlateAreMilledWithItsHole) {
  // 40 x 30 mm, 4 mm thick, two corners cut off by 8 mm; the hole asks for the direction square to the plate.
  const std::vector<Vec2> outline = {{0, 8}, {8, 0}, {40, 0}, {40, 22}, {32, 30}, {0, 30}};
  const auto plan = planned(prism(outline, 4, "mm", [](StepPart& step) {
    Holes out;
    bore(step, {20, 0, 15}, {0, 1, 0}, 4, 6, 7, out);
    return out;
  }));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(reasons(*plan), "");
  const auto shapes = shapes_of(*plan);
  EXPECT_EQ(shapes.size(), 3U);
  for (const auto& [type, s] : shapes)
    EXPECT_NEAR(std::abs(s.frame.z.y), 1.0, 1e-9) << "one set-up makes all of it: " << s.name;
}

TEST_F(FromCad, AHoleIntoACavityThatIsNotPlannedEndsInIt) {
  const std::vector<Vec2> section = {{0, 0},   {40, 0},  {40, 6},  {10, 8},
                                     {10, 12}, {40, 14}, {40, 20}, {0, 20}};
  const exchange::Brep brep = shape(prism(section, 60, "mm", [](StepPart& step) {
    constexpr double r = 2.0, slope = 2.0 / 30.0;
    const auto rim = [&](const std::string& curve, Vec3 at) {
      const int v = step.vertex(at);
      return step.add("EDGE_CURVE(''," + StepPart::ref(v) + "," + StepPart::ref(v) + "," +
                      StepPart::ref(step.add(curve)) + ",.T.)");
    };
    const Vec3 up = geometry::normalised({-slope, 0, 1}), along = geometry::normalised({1, 0, slope});
    const int level = step.placement({25, 30, 20}, {0, 0, 1}, {1, 0, 0});
    const int top = rim("CIRCLE(''," + StepPart::ref(level) + ",2.)", {25 + r, 30, 20});
    const int leaning = step.placement({25, 30, 13}, up, along);
    const int low = rim("ELLIPSE(''," + StepPart::ref(leaning) + "," +
                            StepPart::real(r * std::sqrt(1 + slope * slope)) + ",2.)",
                        {25 + r, 30, 13 + r * slope});
    Holes out;
    out.bounds[6] = step.bound({step.oriented(top, false)}, false);
    out.bounds[4] = step.bound({step.oriented(low, true)}, false);
    out.faces.push_back(step.face(
        "hole",
        {step.bound({step.oriented(top, true)}, true), step.bound({step.oriented(low, false)}, false)},
        step.add("CYLINDRICAL_SURFACE(''," + StepPart::ref(level) + ",2.)"), false));
    return out;
  }));
  const from_cad::Part part(brep, 0, {{0, 0, 0}, {40, 60, 20}});
  std::vector<from_cad::Hole> holes;
  std::string why;
  for (const auto& f : recognise::recognise(brep, 0).features) {
    if (f.type != TypeId::kRoundHole) continue;
    auto hole = from_cad::hole_of(part, f, why);
    ASSERT_TRUE(hole) << why;
    holes.push_back(*hole);
  }
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(holes.front().end, from_cad::HoleEnd::kThrough);
  std::vector<from_cad::Hole> into_room = holes;
  from_cad::end(part, {}, holes);
  EXPECT_EQ(holes.front().end, from_cad::HoleEnd::kFlat) << "the part is below";
  EXPECT_NEAR(holes.front().bores.back().bottom_mm, -7.0 - 2.0 * 2.0 / 30.0, 0.02);
  from_cad::Room cavity;
  cavity.frame = from_cad::Part::frame_along({1, 0, 0});
  cavity.level_mm = 10.0;
  const Vec2 at = xy(cavity.frame.to_local({0, 30, 11}));
  cavity.area = geometry::rectangle({at.x - 40, at.y - 40}, {at.x + 40, at.y + 40});
  from_cad::end(part, {cavity}, into_room);
  EXPECT_EQ(into_room.front().end, from_cad::HoleEnd::kThrough) << "it ends in what a room clears";
}

/// A plate of 60 x 40 x 10 mm with four corners of 6 mm.
std::vector<Corner> rounded_plate() {
  return {{{6, 0}, {}},   {{54, 0}, Vec2{54, 6}}, {{60, 6}, {}}, {{60, 34}, Vec2{54, 34}},
          {{54, 40}, {}}, {{6, 40}, Vec2{6, 34}}, {{0, 34}, {}}, {{0, 6}, Vec2{6, 6}}};
}

TEST_F(FromCad, TheRoundCornersOfAPlateAreOneContour) {
  const auto plan = planned(extruded(rounded_plate(), 10));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(reasons(*plan), "");
  const auto shapes = shapes_of(*plan);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_EQ(shapes.begin()->first, TypeId::kGeneralOutsideProfile);
  EXPECT_NEAR(shapes.begin()->second.depth_mm, 10.0, 1e-6);
}

TEST_F(FromCad, AStepKeepsTheFilletAtTheFootOfItsWall) {
  // A shoulder with a fillet of 2 mm between its floor and its wall. On the large part, 600 mm long, the
  // points of the lattice lie 9 mm apart, and none in the fillet.
  for (const double s : {20.0, 200.0}) {
    const auto plan = planned(extruded({{{0, 0}, {}},
                                        {{2 * s, 0}, {}},
                                        {{2 * s, s / 2}, {}},
                                        {{s + 2, s / 2}, Vec2{s + 2, s / 2 + 2}},
                                        {{s, s / 2 + 2}, {}},
                                        {{s, s}, {}},
                                        {{0, s}, {}}},
                                       3 * s));
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_EQ(reasons(*plan), "");
    const auto shapes = shapes_of(*plan);
    ASSERT_EQ(shapes.size(), 1U);
    EXPECT_EQ(shapes.begin()->first, TypeId::kStep);
    EXPECT_NEAR(shapes.begin()->second.bottom_radius_mm, 2.0, 1e-6);
  }
}

TEST_F(FromCad, AnAreaThatIsThinnerThanPointsAreToldApartIsNotDrawn) {
  const exchange::Brep brep = shape(bored({{5, 20}, {5, 10}, {0, 10}}));
  const from_cad::Part part(brep, 0, {{0, 0, 0}, {40, 40, 20}});
  from_cad::Room room;
  room.frame = from_cad::Part::frame_along({0, 0, 1});
  room.level_mm = 10.0;
  room.top_mm = 20.0;
  room.raw = geometry::rectangle({0, 0}, {40, 40});
  room.area = geometry::rectangle({2, 2}, {38, 2.00005});
  model::Model m;
  EXPECT_FALSE(from_cad::noun_of(part, room, m, {}, "1").set());
  room.area = geometry::rectangle({2, 2}, {38, 12});
  EXPECT_TRUE(from_cad::noun_of(part, room, m, {}, "1").set());
}

TEST_F(FromCad, AGapIsSeenInAThinSheetAndBesideFacesThatAreLeftOut) {
  StepPart step;
  step.product({step.box({0, 0, 0}, {300, 600, 1})}, step.context());
  const exchange::Brep brep = shape(step.text());
  const model::Model nothing;
  const from_cad::Part half(brep, 0, {{0, 0, 0}, {600, 600, 1}});
  const from_cad::Part whole(brep, 0, {{0, 0, 0}, {300, 600, 1}});
  for (const bool all : {true, false}) {
    const auto gap = from_cad::not_covered(half, nothing, all);
    EXPECT_NEAR(gap.volume_mm3, 180'000.0, 0.02 * 180'000.0);
    EXPECT_NEAR(gap.at.x, 450.0, 5.0);
    EXPECT_NEAR(gap.at.z, 0.5, 0.2);
    EXPECT_EQ(from_cad::not_covered(whole, nothing, all).volume_mm3, 0.0);
  }
}

TEST_F(FromCad, APartThatLiesAskewKeepsTheAxesThatAreNearestAndTheNoteTellsThem) {
  const auto slot = only(planned(prism(slotted(), 60, "mm", {}, 20 * 0.017453292519943295)));
  EXPECT_NEAR(slot.frame.z.z, 1.0, 1e-9);
  EXPECT_NEAR(slot.depth_mm, 8.0, 1e-6);
  EXPECT_NE(said("CAD-TURNED").find("x (0.9397, 0.342, 0), y (-0.342, 0.9397, 0), z (0, 0, 1)"),
            std::string::npos)
      << said("CAD-TURNED");
}

TEST_F(FromCad, TheNoteOfAWholePartSpeaksOfFeaturesAndNotOfThePlan) {
  ASSERT_TRUE(planned(prism(slotted(), 60)));
  const std::string note = said("CAD-RECOGNISED");
  EXPECT_NE(note.find("no face and no volume is left over"), std::string::npos) << note;
  EXPECT_EQ(note.find("planned"), std::string::npos) << note;
}

TEST_F(FromCad, TheNoteCountsWhatIsInFeatures) {
  const auto plan = planned(bored({{3, 20}, {3, 10}, {0, 10 - 3 / std::tan(30 * 0.017453292519943295)}}));
  ASSERT_TRUE(plan) << plan.error().message;
  const std::size_t stays = model::not_recognised(*plan).size();
  EXPECT_EQ(stays, 2U) << "its faces, and the volume";
  EXPECT_NE(said("CAD-RECOGNISED").find("no feature of no face;"), std::string::npos)
      << said("CAD-RECOGNISED");
  EXPECT_NE(said("CAD-RECOGNISED").find("2 groups of faces or volumes are no features and stay"),
            std::string::npos)
      << said("CAD-RECOGNISED");
}

TEST_F(FromCad, AShortFlatOnARoundIsNoArc) {
  // A disc of 10 mm whose right side is flat over 0.8 mm: 0.008 mm short of the circle.
  const double half = std::asin(0.04);
  geometry::Loop loop;
  for (int i = 0; i <= 100; ++i) {
    const double a = half + (2.0 * std::numbers::pi - 2.0 * half) * i / 100;
    loop.push_back(10.0 * Vec2{std::cos(a), std::sin(a)});
  }
  const std::vector<from_cad::RoundWall> round = {{{0, 0}, 10.0}};
  EXPECT_EQ(from_cad::pieces_of(loop, {}, round, 0.04).size(), 1U) << "by its points alone: a circle";
  const std::vector<from_cad::FlatWall> flat = {{loop.back(), loop.front()}};
  const auto pieces = from_cad::pieces_of(loop, {}, round, 0.04, flat);
  ASSERT_EQ(pieces.size(), 2U);
  const auto line = std::find_if(pieces.begin(), pieces.end(), [](const auto& p) { return !p.arc(); });
  ASSERT_NE(line, pieces.end());
  EXPECT_NEAR(norm(line->to - line->from), 0.8, 1e-9);
  const exchange::Brep brep = shape(extruded(rounded_plate(), 10));
  const from_cad::Part part(brep, 0, {{0, 0, 0}, {60, 40, 10}});
  const auto walls = part.flat_walls(from_cad::Part::frame_along({0, 0, 1}));
  ASSERT_EQ(walls.size(), 4U);
  for (const auto& w : walls) {
    const double length = norm(w.to - w.from);
    EXPECT_LT(std::min(std::abs(length - 48.0), std::abs(length - 28.0)), 1e-6) << length;
  }
}

}  // namespace
}  // namespace capstan::testing
