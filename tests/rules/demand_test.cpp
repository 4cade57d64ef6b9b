#include "rules/facts/demand.h"

#include <random>

#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/shop.h"

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::ShapeKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// A through hole of 12 mm, 20 mm deep, with an H tolerance of that grade; 0: none stated.
FeatureShape hole(int grade, double d = 12.0) {
  FeatureShape s;
  s.kind = ShapeKind::kHole;
  s.name = "H";
  s.depth_mm = 20.0;
  s.through = true;
  s.diameter.nominal_mm = s.bottom_diameter_mm = d;
  if (grade > 0) {
    s.diameter.upper_mm = standard_tolerance_mm(grade, d);
    s.diameter.given = true;
  }
  return s;
}
FeatureShape area(ShapeKind kind) {
  FeatureShape s;
  s.kind = kind;
  s.name = "A";
  s.depth_mm = 10.0;
  s.area = s.reach = geometry::rounded_rectangle({0, 0}, {80, 40}, 8.0);
  s.corner_radius_mm = 8.0;
  return s;
}
std::vector<std::string> actions(const Proposal& p) {
  std::vector<std::string> out;
  if (p.chains.empty()) return {p.cannot};
  for (const auto& step : p.chains[0]) out.push_back(step.name.substr(step.name.rfind(' ') + 1));
  return out;
}

// ISO 286: the same hole, H11, H9, H7.
TEST(Hole, WithATighterToleranceGetsAnotherChainAndSaysByWhichRow) {
  const auto chain = [](int grade) { return propose(shipped(), hole(grade), steel()); };
  EXPECT_THAT(actions(chain(11)), ElementsAre("centre", "drill"));
  EXPECT_THAT(actions(chain(9)), ElementsAre("centre", "drill", "ream"));
  EXPECT_THAT(actions(chain(7)), ElementsAre("centre", "drill", "ream"));
  EXPECT_EQ(chain(11).chains[0][1].why.id, "hole.drill");
  EXPECT_EQ(chain(9).chains[0][2].why.id, "hole.ream.it9");
  EXPECT_EQ(chain(7).chains[0][2].why.id, "hole.ream.it7");
  EXPECT_THAT(actions(chain(6)), ElementsAre("centre", "drill", "bore", "measure", "bore"));
  EXPECT_THAT(chain(5).cannot, HasSubstr("[hole.grind]"));
  for (const int grade : {11, 9, 7}) {
    const Proposal p = chain(grade);
    for (const auto& step : p.chains[0]) {
      EXPECT_FALSE(step.why.source.empty());
      EXPECT_FALSE(step.why.text.empty());
    }
  }
}

TEST(Hole, WithAFinerTextureGetsAnotherChainAndSaysByWhichRow) {
  const auto chain = [](double ra) {
    Context c = steel();
    c.quality.ra_um = ra;
    return propose(shipped(), hole(11), c);
  };
  EXPECT_THAT(actions(chain(6.3)), ElementsAre("centre", "drill"));
  EXPECT_THAT(actions(chain(3.2)), ElementsAre("centre", "drill"));
  const Proposal milled = chain(1.6);
  EXPECT_THAT(actions(milled), ElementsAre("centre", "drill", "ream"));
  EXPECT_EQ(milled.chains[0][2].why.id, "hole.ream.it9");
  EXPECT_THAT(milled.chains[0][2].why.text, HasSubstr("ra_um = 1.6"));
  EXPECT_THAT(milled.chains[0][2].why.text, HasSubstr("[texture.hole.milled; Machinery's Handbook"));
  EXPECT_EQ(chain(0.8).chains[0][2].why.id, "hole.ream.it7");
  EXPECT_THAT(chain(0.4).cannot, HasSubstr("[texture.hole.honed]"));
}

TEST(Hole, WithACloserPositionIsNotReamedAfterADrillThatRan) {
  const auto chain = [](double zone) {
    Context c = steel();
    c.quality.location_mm = zone;
    return propose(shipped(), hole(9), c);
  };
  EXPECT_THAT(actions(chain(0.2)), ElementsAre("centre", "drill", "ream"));
  EXPECT_THAT(actions(chain(0.1)), ElementsAre("centre", "drill", "mill_finish"));
  EXPECT_THAT(chain(0.1).chains[0][2].why.text, HasSubstr("[position.hole.milled; "));
  EXPECT_THAT(actions(chain(0.04)), ElementsAre("centre", "drill", "bore"));
  EXPECT_THAT(actions(chain(0.02)), ElementsAre("centre", "drill", "probe_feature", "bore"));
  EXPECT_THAT(chain(0.02).chains[0][2].why.text, HasSubstr("measured in the machine by other means"));
  EXPECT_THAT(chain(0.018).cannot, HasSubstr("[position.ground]"));
  EXPECT_THAT(chain(0.01).cannot, HasSubstr("[position.ground]"));
}

TEST(Probing, IsProposedBeforeTheLastStepWhereTheChainAloneDoesNotHoldThePosition) {
  Context c = steel();
  c.abilities.probe = true;
  c.quality.location_mm = 0.02;
  const Proposal p = propose(shipped(), hole(9), c);
  EXPECT_THAT(actions(p), ElementsAre("centre", "drill", "probe_feature", "bore"));
  const auto& probe = p.chains.at(0).at(2);
  EXPECT_EQ(probe.operation, model::TypeId::kWorkpieceProbing);
  EXPECT_THAT(probe.tool.classes, ElementsAre(model::CutterClass::kTouchProbe));
  EXPECT_EQ(probe.why.id, "position.tight.hole");
  EXPECT_THAT(probe.why.text, HasSubstr("the operator corrects the work offset"));
  EXPECT_FALSE(probe.coolant);
  EXPECT_THAT(p.chains[0][3].after, ElementsAre(2U));
  EXPECT_THAT(actions(propose(shipped(), area(ShapeKind::kPocket), c)),
              ElementsAre("area_rough", "area_finish", "probe_feature", "spring_pass"));
  c.quality.location_mm = 0.04;
  EXPECT_THAT(actions(propose(shipped(), hole(9), c)), ElementsAre("centre", "drill", "bore"));
}

TEST(Probing, HoldsNoMoreWithAProbeThanWithoutForNothingCorrectsByItself) {
  for (const bool probe : {false, true}) {
    Context c = steel();
    c.abilities.probe = probe;
    c.quality.location_mm = 0.0199;
    EXPECT_THAT(propose(shipped(), hole(9), c).cannot, HasSubstr("closer than 0.02 mm")) << probe;
    EXPECT_THAT(propose(shipped(), area(ShapeKind::kPocket), c).cannot, HasSubstr("closer than 0.02 mm"))
        << probe;
    c.quality.location_mm = 0.02;
    EXPECT_TRUE(propose(shipped(), hole(9), c).cannot.empty()) << probe;
  }
}

TEST(Hole, WithACloserFormIsReamedOrBored) {
  Context c = steel();
  c.quality.orientation_mm = 0.03;
  EXPECT_THAT(actions(propose(shipped(), hole(11), c)), ElementsAre("centre", "drill", "ream"));
  c.quality.form_mm = 0.005;
  EXPECT_THAT(propose(shipped(), hole(11), c).cannot, HasSubstr("[form.ground]"));
}

TEST(Walls, GetASpringPassWhereTextureOrFormAsksForIt) {
  for (const ShapeKind kind : {ShapeKind::kPocket, ShapeKind::kStep, ShapeKind::kOutside}) {
    Context c = steel();
    EXPECT_THAT(actions(propose(shipped(), area(kind), c)), ElementsAre("area_rough", "area_finish"));
    c.quality.ra_um = 0.8;
    EXPECT_THAT(actions(propose(shipped(), area(kind), c)),
                ElementsAre("area_rough", "area_finish", "spring_pass"));
    c.quality.ra_um = 0.4;
    EXPECT_THAT(propose(shipped(), area(kind), c).cannot, HasSubstr("[texture.milled.ground]"));
  }
  Context c = steel();
  c.quality.form_mm = 0.015;
  FeatureShape face = area(ShapeKind::kFace);
  EXPECT_THAT(actions(propose(shipped(), face, c)),
              ElementsAre("plane_rough", "plane_rough", "plane_finish"));
  // Beside a wall, too: without it floor and wall are finished once.
  face.open = true;
  face.reach = face.area;
  EXPECT_THAT(actions(propose(shipped(), face, c)), ElementsAre("area_rough", "area_finish", "spring_pass"));
  EXPECT_THAT(actions(propose(shipped(), face, steel())), ElementsAre("area_rough", "area_finish"));
}

TEST(Facts, SayWhatIsNotAskedAndNotKnown) {
  const FeatureFacts f = facts_of(area(ShapeKind::kPocket), steel());
  EXPECT_EQ(f.facts.text(*find_fact("ra_um")), "ra_um = 1000 (not asked)");
  EXPECT_EQ(f.facts.text(*find_fact("wall_thickness_mm")), "wall_thickness_mm = 10000 (not known)");
  EXPECT_EQ(f.facts.text(*find_fact("hardness_hb")), "hardness_hb = 0 (not known)");
}

TEST(Facts, ComeFromTheContext) {
  Context c = steel();
  c.quality.ra_um = 1.6;
  c.quality.form_mm = 0.05;
  c.quality.location_mm = 0.1;
  c.quality.runout_mm = 0.02;
  c.wall_thickness_mm = 0.5;
  c.floor_thickness_mm = 2.0;
  c.batch = 50;
  c.material.hardness_hb = 180;
  c.abilities.probe = true;
  c.has_through_coolant = true;
  const Facts f = facts_of(area(ShapeKind::kPocket), c).facts;
  EXPECT_EQ(f.number("ra_um"), 1.6);
  EXPECT_EQ(f.number("position_mm"), 0.1);
  EXPECT_EQ(f.number("form_mm"), 0.02) << "the tightest of form and run-out";
  EXPECT_EQ(f.number("wall_ratio"), 20.0) << "10 mm deep beside 0.5 mm";
  EXPECT_NEAR(*f.number("floor_ratio"), 20.0, 0.6) << "40 mm wide above 2 mm; the width is known to 3 %";
  EXPECT_NEAR(*f.number("corner_ratio"), 0.4, 0.02) << "corners of 16 mm by a passage of 40 mm";
  EXPECT_EQ(f.number("batch"), 50.0);
  EXPECT_EQ(f.number("hardness_hb"), 180.0);
  EXPECT_EQ(f.symbol("probe"), "yes");
  EXPECT_EQ(f.symbol("through_coolant"), "yes");
}

TEST(Threads, AreMilledInHardMaterialAndWithoutSynchronisedSpindle) {
  FeatureShape s = hole(0, 8.5);
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = 10.0;
  s.thread_pitch_mm = 1.5;
  s.thread_depth_mm = 12.0;
  Context c = steel();
  EXPECT_THAT(actions(propose(shipped(), s, c)), ElementsAre("tap"));
  c.material.hardness_hb = 450;
  EXPECT_EQ(propose(shipped(), s, c).chains.at(0).at(0).why.id, "thread.mill.hard");
  c = steel();
  c.abilities.rigid_tapping = false;
  EXPECT_EQ(propose(shipped(), s, c).chains.at(0).at(0).why.id, "thread.mill.unsynchronised");
}

TEST(Threads, OfBlindHolesAreTappedWithAShortLeadOfThroughHolesWithALongOne) {
  FeatureShape s = hole(0, 8.5);
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = 10.0;
  s.thread_pitch_mm = 1.5;
  s.thread_depth_mm = 12.0;
  for (const bool through : {false, true}) {
    s.through = through;
    s.depth_mm = 20.0;
    const Proposal p = propose(shipped(), s, steel());
    ASSERT_THAT(actions(p), ElementsAre("tap"));
    const double lead = through ? 4.0 : 3.0;  // threads
    EXPECT_EQ(p.chains[0][0].tool.lead_threads_max, lead);
    EXPECT_NEAR(p.chains[0][0].depth_mm, 12.0 + lead * 1.5, 1e-9);
  }
}

TEST(Counterbore, OfALargeBatchIsMadeByItsOwnTool) {
  FeatureShape s = hole(11, 20);
  s.bottom = HoleBottom::kFlat;
  s.through = false;
  Context c = steel();
  c.core_diameter_mm = 11.0;
  EXPECT_THAT(actions(propose(shipped(), s, c)), ElementsAre("mill_rough", "mill_finish"));
  c.batch = 500;
  EXPECT_THAT(actions(propose(shipped(), s, c)), ElementsAre("counterbore"));
}

}  // namespace
}  // namespace capstan::rules
