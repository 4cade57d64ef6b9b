#include <gtest/gtest.h>

#include "tests/proof/verify/checked.h"

// Features that reach out of the raw piece, into each other or through a boss, on the small plan that is
// right.

namespace capstan::verify {
namespace {

using model::MoveRole;
using testing::check;
using testing::down_to;
using testing::found;
using testing::PlanMaker;
using testing::told;

TEST(Within, AHoleThatEndsBelowTheRawPieceIsFoundAndOneThatEndsAtItsUndersideIsNot) {
  for (const double depth : {50.0, 55.0}) {  // the raw piece is 50 mm high
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
    auto* hole = k.plan.model.get<model::RoundHole>(ws->its_feature);
    hole->depth = k.depth(depth);
    hole->bottom_condition = k.plan.model.add(model::FlatHoleBottom{});
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-OUTSIDE", "drill") != nullptr, depth > 50.0) << told(findings);
  }
}

TEST(Within, AFeatureBesideTheRawPieceIsFound) {
  PlanMaker k = testing::good_plan();
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
  k.plan.model.get<model::RoundHole>(ws->its_feature)->feature_placement = k.at(150, 15, 0);
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-OUTSIDE", "drill"), nullptr) << told(findings);
}

TEST(Within, AHoleDrilledAtTheEdgeIsFoundAndOneInsideIsNot) {
  for (const double x : {-2.0, 2.0, 4.0}) {  // 8 mm wide
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
    k.plan.model.get<model::RoundHole>(ws->its_feature)->feature_placement = k.at(x, 15, 0);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-EDGE", "drill") != nullptr, x < 4.0) << told(findings);
  }
}

TEST(Within, APocketBelowSolidIsFoundAndOneThatAFaceOpensIsNot) {
  for (const bool faced : {false, true}) {
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
    k.plan.model.get<model::ClosedPocket>(ws->its_feature)->feature_placement = k.at(50, 50, -3);
    if (faced) k.face("F", 3);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-BURIED", "pocket") != nullptr, !faced) << told(findings);
  }
}

TEST(Within, AnOutsideBelowSolidIsFoundAlthoughADeepFaceLiesElsewhere) {
  const auto face = [](PlanMaker& k, const char* id, double at, double size, double depth) {
    const auto f = k.face(id, depth);
    model::RectangularClosedProfile r;
    r.profile_length = k.length(size);
    r.profile_width = k.length(size);
    auto* noun = k.plan.model.get<model::PlanarFace>(f);
    noun->feature_placement = k.at(at, at, 0);
    noun->face_boundary = k.plan.model.add(r);
  };
  for (const bool top : {false, true}) {
    PlanMaker k = testing::empty_plan();
    model::RectangularClosedProfile r;
    r.profile_length = k.length(60);
    r.profile_width = k.length(60);
    model::Boss b;
    b.its_id = "B";
    b.feature_placement = k.at(50, 50, -10);  // 10 mm below the top of the piece
    b.depth = k.depth(10);
    b.its_boundary = k.plan.model.add(r);
    model::CutterPath p;
    p.start({0, 0, 10});
    p.line({5, 0, 10}, MoveRole::kCut);
    k.step<model::BottomAndSideRoughMilling>("outside", k.plan.model.add(b), "em10", p, 600, 3000);
    face(k, "DEEP", 10, 20, 30);          // in a corner of the piece, 30 deep
    if (top) face(k, "TOP", 50, 60, 10);  // what the outside leaves is no higher than its top
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-BURIED", "outside") == nullptr, top) << told(findings);
  }
}

TEST(Within, ADrillsPointThatComesOutBelowIsFound) {
  for (const double depth : {47.0, 48.0}) {  // 4 / tan 59 = 2.403 mm of 50
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
    k.plan.model.get<model::RoundHole>(ws->its_feature)->depth = k.depth(depth);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-OUTSIDE", "drill") != nullptr, depth > 47.5) << told(findings);
  }
}

/// The good plan of a part that is to be that high, of its raw piece of 50 mm.
PlanMaker finished_to(double height) {
  PlanMaker k = testing::good_plan();
  model::Block block;
  block.position = k.at(0, 0, -height);
  block.x = block.y = 100.0;
  block.z = height;
  const auto piece = k.plan.model.all(model::TypeId::kWorkpiece).front();
  k.plan.model.get<model::Workpiece>(piece)->its_bounding_geometry = k.plan.model.add(block);
  return k;
}

TEST(Within, ADrillsPointThatComesOutBelowTheFinishedPartIsFoundAlthoughTheRawPieceIsThicker) {
  for (const double height : {23.0, 22.0}) {  // 20 + 4 / tan 59 = 22.403 mm of 50, later faced from below
    PlanMaker k = finished_to(height);
    const auto findings = check(k.plan);
    const auto* f = found(findings, "CHK-OUTSIDE", "drill");
    ASSERT_EQ(f != nullptr, height < 22.4) << told(findings);
    if (f == nullptr) continue;
    EXPECT_NE(f->message.find("underside of the finished part by 0.403 mm"), std::string::npos) << f->message;
  }
}

TEST(Within, AFloorInWhatIsCutOffBelowTheFinishedPartIsFound) {
  for (const double height : {10.0, 9.0}) {  // the pocket is 10 mm deep, the raw piece 50 mm high
    PlanMaker k = finished_to(height);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-OUTSIDE", "pocket") != nullptr, height < 9.5) << told(findings);
  }
}

TEST(Within, AHoleDrilledIntoAnothersWallIsFoundAndOneBesideItIsNot) {
  for (const double apart : {6.0, 9.0}) {  // both of 8 mm
    PlanMaker k = testing::good_plan();
    model::CutterPath p = down_to(15 + apart, 15, -20 - testing::point_length());
    k.step<model::Drilling>("next", k.hole("H2", 15 + apart, 15, 8, 20), "d8", p, 225, 1500);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-OVERLAP", "next") != nullptr, apart < 8.0) << told(findings);
  }
}

TEST(Stands, ABossThatIsAFeatureOfItsOwnIsAGougeWhenAFaceIsCutThroughIt) {
  for (const bool boss : {true, false}) {
    PlanMaker k = testing::empty_plan();
    model::CutterPath p;
    p.start({-10, 50, 10});
    p.rapid({-10, 50, -2});
    p.line({110, 50, -2}, MoveRole::kCut);
    p.rapid({110, 50, 10}, MoveRole::kRetract);
    k.step<model::PlaneFinishMilling>("face", k.face("F", 2), "em10", p, 600, 3000);
    if (boss) {
      model::RectangularClosedProfile r;
      r.profile_length = k.length(20);
      r.profile_width = k.length(20);
      model::Boss b;
      b.its_id = "B";
      b.feature_placement = k.at(50, 50, 0);
      b.depth = k.depth(2);
      b.its_boundary = k.plan.model.add(r);
      k.plan.unplanned.push_back({k.plan.model.add(b), "not asked here"});
    }
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-GOUGE", "face") != nullptr, boss) << told(findings);
  }
}

}  // namespace
}  // namespace capstan::verify
