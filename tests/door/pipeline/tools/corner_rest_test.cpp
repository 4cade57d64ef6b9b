// Inside corners that no mill of the list makes: the feature is planned, and what stays is told, recorded and
// found.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/pipeline/block.h"

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A pocket of 40 x 30 mm about the block's middle whose corners state this radius.
std::string pocket(const std::string& radius, double depth_mm) {
  return "#60=CARTESIAN_POINT('',(0.,0.,-" + fixed(depth_mm, 1) +
         "));\n#61=AXIS2_PLACEMENT_3D('',#60,#21,#22);\n#62=PLANE('',#61);\n"
         "#80=TOLERANCED_LENGTH_MEASURE(40.,$);\n#81=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
         "#82=TOLERANCED_LENGTH_MEASURE(" +
         radius +
         ",$);\n#83=RECTANGULAR_CLOSED_PROFILE($,#81,#80);\n"
         "#84=CLOSED_POCKET('POCKET',#4,(),#50,#62,(),$,#57,$,#82,#83);\n";
}

const model::Plan& with_rest() {
  static const Planned kPlanned = bound(read(pocket("0.5", 17.0)));
  return kPlanned.plan;
}

std::vector<model::Finding> found(const model::Plan& plan, const std::string& code) {
  Job job;
  std::vector<model::Finding> out = verify::check_plan(plan, job);
  std::erase_if(out, [&](const model::Finding& f) { return f.code != code; });
  return out;
}

std::string texts(const std::vector<model::Finding>& findings) {
  std::string out;
  for (const auto& f : findings) out += f.message + "\n";
  return out;
}

model::Plan recording(const model::Plan& plan, const model::CornerRest& rest) {
  model::Plan out = plan;
  std::erase_if(out.provenance, [](const auto& p) { return model::corner_rest(p).has_value(); });
  out.provenance.push_back(model::provenance_of(rest));
  return out;
}

double narrowest_radius(const model::Plan& plan) {
  double out = 1e300;
  for (const auto& c : plan.cutters) out = std::min(out, 0.5 * c.cutting_diameter_mm);
  return out;
}

TEST(CornerRests, APocketIsPlannedWhoseCornersNoMillMakes) {
  for (const double depth : {10.0, 17.0}) {
    for (const char* radius : {"0.2", "0.5"}) {
      SCOPED_TRACE(std::string(radius) + ", " + fixed(depth, 1) + " mm deep");
      const Planned p = bound(read(pocket(radius, depth)));
      EXPECT_THAT(p.plan.unplanned, IsEmpty()) << p.said;
      const auto rests = model::corner_rests(p.plan);
      ASSERT_EQ(rests.size(), 1U) << p.said;
      EXPECT_EQ(rests[0].feature, "POCKET");
      EXPECT_EQ(rests[0].stated_mm, parse_double(radius));
      EXPECT_EQ(rests[0].radius_mm, narrowest_radius(p.plan));
      EXPECT_THAT(p.said, HasSubstr("a radius of " + trimmed(rests[0].radius_mm, 4) +
                                    " mm stays in place of " + radius + " mm"));
      // A mill that narrow bends at this depth: planned with it, the radius would stay, so none is named.
      EXPECT_THAT(p.said, Not(HasSubstr("you need")));
    }
  }
}

TEST(CornerRests, APocketIsPlannedThatStatesCornersOfRadiusZero) {
  const Planned p = bound(read(pocket("0.", 10.0)));
  EXPECT_THAT(p.plan.unplanned, IsEmpty()) << p.said;
  ASSERT_EQ(model::corner_rests(p.plan).size(), 1U) << p.said;
  EXPECT_EQ(model::corner_rests(p.plan)[0].stated_mm, 0.0);
  EXPECT_THAT(p.said, HasSubstr("it states inside corners of radius 0, and a mill leaves them round"));
  EXPECT_THAT(p.said, Not(HasSubstr("you need"))) << "no tool makes them";
}

TEST(CornerRests, AToleranceOfTheRadiusThatIsNotKeptIsNamed) {
  std::string toleranced = pocket("0.5", 10.0);
  toleranced.replace(toleranced.find("MEASURE(0.5,$)"), 14, "MEASURE(0.5,#86)");
  const Planned p = bound(read(toleranced + "#86=PLUS_MINUS_VALUE(0.2,0.1,3);\n"));
  EXPECT_THAT(p.plan.unplanned, IsEmpty()) << p.said;
  EXPECT_THAT(p.said, HasSubstr("in place of 0.5 mm (its tolerance of -0.1 to +0.2 mm is not kept)"));
}

TEST(CornerRests, WhatStaysIsTheCornersAreaTimesTheDepth) {
  const model::CornerRest r = model::corner_rests(with_rest()).at(0);
  // A right corner keeps (1 - pi / 4) r^2 of a mill of radius r; the stated radius keeps as much by its own.
  const double area = (4.0 - std::numbers::pi) * (r.radius_mm * r.radius_mm - 0.25);
  const auto findings = found(with_rest(), "CHK-REST");
  ASSERT_EQ(findings.size(), 1U);
  const std::string text = findings[0].message;
  const std::size_t at = text.find("records it: ");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + 12)), 17.0 * area, 0.02 * 17.0 * area) << text;
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
}

TEST(CornerRests, WithTheRecordNothingIsLeftAndWithoutItIsFound) {
  EXPECT_THAT(found(with_rest(), "CHK-LEFT"), IsEmpty());
  model::Plan silent = with_rest();
  std::erase_if(silent.provenance, [](const auto& p) { return model::corner_rest(p).has_value(); });
  EXPECT_EQ(found(silent, "CHK-LEFT").size(), 1U);
  EXPECT_THAT(found(silent, "CHK-REST"), IsEmpty());
}

TEST(CornerRests, WhatStaysBeyondTheRecordedRadiusIsFound) {
  model::CornerRest less = model::corner_rests(with_rest()).at(0);
  less.radius_mm = 0.6;
  EXPECT_EQ(found(recording(with_rest(), less), "CHK-LEFT").size(), 1U);
}

TEST(CornerRests, ARecordThatPlanningDidNotWriteIsFound) {
  const model::CornerRest right = model::corner_rests(with_rest()).at(0);
  model::CornerRest wide = right, other = right, stated = right;
  wide.radius_mm = 2.0 * right.radius_mm;
  other.feature = "ANOTHER";
  stated.stated_mm = 0.4;
  const auto error_of = [&](const model::CornerRest& r) {
    return texts(found(recording(with_rest(), r), "CHK-REST-RECORD"));
  };
  EXPECT_EQ(error_of(right), "");
  EXPECT_THAT(error_of(wide), HasSubstr("the mills of its steps leave"));
  EXPECT_THAT(error_of(other), HasSubstr("no feature of that name is made"));
  EXPECT_THAT(error_of(stated), HasSubstr("the feature states 0.5 mm"));
}

TEST(CornerRests, EveryFormKeepsTheRecordAndWhatTheCheckFindsByIt) {
  const auto said = texts(found(with_rest(), "CHK-REST"));
  for (const auto& [format, ending] :
       {std::pair(Format::kJson, ".json"), {Format::kIso14649, ".p21"}, {Format::kAp238, ".stpnc"}}) {
    SCOPED_TRACE(ending);
    Job job;
    const auto text = write_plan(with_rest(), format, job);
    ASSERT_TRUE(text) << to_text(text.error());
    const auto back = read_plan(*text, std::string("plan") + ending, job);
    ASSERT_TRUE(back) << to_text(back.error());
    const auto rests = model::corner_rests(*back);
    ASSERT_EQ(rests.size(), 1U);
    EXPECT_EQ(model::provenance_of(rests[0]).value,
              model::provenance_of(model::corner_rests(with_rest()).at(0)).value);
    EXPECT_EQ(texts(found(*back, "CHK-REST")), said);
    // Bound again, it is the same.
    const Planned again = bound(*back);
    ASSERT_EQ(model::corner_rests(again.plan).size(), 1U) << again.said;
    EXPECT_EQ(model::corner_rests(again.plan)[0].radius_mm, rests[0].radius_mm);
    EXPECT_THAT(found(again.plan, "CHK-LEFT"), IsEmpty());
  }
}

TEST(CornerRests, TheToolThatIsNeededMakesTheCornersAsStated) {
  Inputs few = shop();
  std::erase_if(few.library,
                [](const model::Cutter& c) { return c.id.starts_with("generic/endmill_2f_deep/"); });
  const Planned poor = bound(read(pocket("1.", 17.0)), few);
  ASSERT_EQ(model::corner_rests(poor.plan).size(), 1U) << poor.said;
  Inputs richer = few;
  for (model::Cutter c : shop().library) {
    if (c.id != "generic/endmill_2f_neck/2") continue;
    c.id = "long";
    c.usable_length_mm += 15.0, c.stick_out_mm += 15.0, c.neck_length_mm += 15.0;
    c.functional_length_mm += 15.0, c.overall_length_mm += 15.0;
    c.cutting_diameter_mm = 1.5;
    richer.library.push_back(c);
  }
  ASSERT_GT(richer.library.size(), few.library.size());
  const Planned whole = bound(read(pocket("1.", 17.0)), richer);
  EXPECT_THAT(whole.plan.unplanned, IsEmpty()) << whole.said;
  EXPECT_THAT(model::corner_rests(whole.plan), IsEmpty()) << whole.said;
}

TEST(CornerRests, APocketThatStatesNoRadiusKeepsMoreThanUsualWhereOnlyAWideMillIsThere) {
  Inputs poor = shop();
  std::erase_if(poor.library, [](const model::Cutter& c) { return c.id != "generic/endmill_3f_short/16"; });
  std::string unstated = pocket("1.", 10.0);
  unstated.replace(unstated.find("$,#82,#83"), 9, "$,$,#83");
  const Planned p = bound(read(unstated), poor);
  EXPECT_THAT(p.plan.unplanned, IsEmpty()) << p.said;
  ASSERT_EQ(model::corner_rests(p.plan).size(), 1U) << p.said;
  EXPECT_EQ(model::corner_rests(p.plan)[0].stated_mm, 3.0) << "what may stay where none is stated";
  EXPECT_EQ(model::corner_rests(p.plan)[0].radius_mm, 8.0);
  EXPECT_EQ(found(p.plan, "CHK-REST").size(), 1U);
  EXPECT_THAT(found(p.plan, "CHK-LEFT"), IsEmpty());
}

TEST(CornerRests, AFilletAtTheFloorThatNoMillMakesIsNotRestMaterial) {
  std::string fillet = pocket("4.", 10.0);
  fillet.replace(fillet.find("#57,$,#82"), 9, "#57,#85,#82");
  const Planned p = bound(read(fillet + "#85=TOLERANCED_LENGTH_MEASURE(1.37,$);\n"));
  EXPECT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_THAT(model::corner_rests(p.plan), IsEmpty());
}

}  // namespace
}  // namespace capstan::pipeline
