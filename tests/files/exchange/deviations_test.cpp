#include "planner/files/exchange/iso14649/deviations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "tests/files/exchange/support.h"

namespace capstan::exchange {
namespace {

using testing::codes;
using ::testing::Contains;
using testing::drilled_plate;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::lines;
using testing::part21;
using testing::read_text;

constexpr double kDegree = std::numbers::pi / 180.0;

struct ReadPlan {
  Job job;
  model::Plan plan;
};

std::unique_ptr<ReadPlan> plate(const std::map<int, std::string>& changed) {
  auto out = std::make_unique<ReadPlan>();
  auto plan = read_text(part21(drilled_plate(changed)), out->job);
  if (!plan) {
    ADD_FAILURE() << to_text(plan.error());
    return out;
  }
  out->plan = std::move(*plan);
  return out;
}

const model::MillingTechnology& technology(const model::Plan& p) {
  return p.model.at<model::MillingTechnology>(p.model.all(model::TypeId::kMillingTechnology)[0]);
}
const model::MillingToolDimension& dimension(const model::Plan& p) {
  return p.model.at<model::MillingToolDimension>(p.model.all(model::TypeId::kMillingToolDimension)[0]);
}

TEST(Deviations, FileThatKeepsTheUnitsIsReadInSilence) {
  const auto r = plate({});
  EXPECT_THAT(lines(r->job), IsEmpty());
  EXPECT_THAT(suspicions(r->plan), IsEmpty());
  EXPECT_EQ(technology(r->plan).feedrate, 300.0);  // 0.005 m/s
  EXPECT_EQ(technology(r->plan).spindle, -960.0);  // 16 rev/s, clockwise
  EXPECT_NEAR(*dimension(r->plan).tool_top_angle, 59.0 * kDegree, 1e-15);
}

TEST(Deviations, SpindleInRevolutionsPerMinuteIsRepairedAndItsLexemeKept) {
  // 1114 1/s with 10 mm would cut at 2100 m/min; 1114 1/min at 35.
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,$,-1114.0,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(codes(r->job), Contains("warning EXC-UNIT-SPINDLE #45"));
  EXPECT_EQ(technology(r->plan).spindle, -1114.0);
  const auto found = suspicions(r->plan);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].attribute, "spindle");
  EXPECT_TRUE(found[0].repaired);
  EXPECT_EQ(found[0].lexeme, "-1114.0");
  EXPECT_THAT(found[0].why, HasSubstr("revolutions per minute"));
}

TEST(Deviations, SlowSpindleIsNotTakenForRevolutionsPerMinute) {
  // 12 rev/s is 22.6 m/min of 10 mm; 12 1/min would be 0.4 m/min.
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,$,-12.,$,.F.,.F.,.F.,$)"}});
  EXPECT_EQ(technology(r->plan).spindle, -720.0);
  EXPECT_THAT(suspicions(r->plan), IsEmpty());
}

TEST(Deviations, CutspeedInMetresPerMinuteIsRepaired) {
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,30.0,$,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(codes(r->job), Contains("warning EXC-UNIT-CUTSPEED #45"));
  EXPECT_EQ(technology(r->plan).cutspeed, 30000.0);  // mm/min
}

TEST(Deviations, CutspeedAndSpindleTogetherAreSaidAndComparedWithTheDiameter) {
  // pi 10 mm 16 /s = 30.16 m/min.
  const auto agree = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,0.5027,-16.,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(lines(agree->job), Contains(HasSubstr("and agrees [EXC-SPEED-CONFLICT]")));
  const auto differ = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,1.0,-16.,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(lines(differ->job),
              Contains(HasSubstr("960 1/min make 30.2 m/min of a diameter of 10 mm, not 60")));
  EXPECT_EQ(technology(differ->plan).spindle, -960.0);  // the spindle is preferred, and untouched
}

TEST(Deviations, SpindleAgainstTheCuttersHandIsSaidAndKept) {
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,$,16.,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(codes(r->job), Contains("warning EXC-SPINDLE-DIRECTION #45"));
  EXPECT_EQ(technology(r->plan).spindle, 960.0);
  const auto left = plate({{31, "TWIST_DRILL(#32,2,.LEFT.,.F.,$)"}});
  EXPECT_THAT(codes(left->job), Contains("warning EXC-SPINDLE-DIRECTION #45"));
}

TEST(Deviations, RadiansAreRecognisedByWhatTheyWouldBeInDegrees) {
  const auto r = plate({{26, "CONICAL_HOLE_BOTTOM(0.3490658503988659,$)"}});
  EXPECT_THAT(codes(r->job), Contains("warning EXC-UNIT-ANGLE #26"));
  const auto& bottom =
      r->plan.model.at<model::ConicalHoleBottom>(r->plan.model.all(model::TypeId::kConicalHoleBottom)[0]);
  EXPECT_NEAR(*bottom.tip_angle, 20.0 * kDegree, 1e-15);
  // 59 cannot be radians, and stays.
  EXPECT_THAT(lines(r->job), Contains(HasSubstr("59. is too large for radians")));
  EXPECT_NEAR(*dimension(r->plan).tool_top_angle, 59.0 * kDegree, 1e-15);
}

TEST(Deviations, SmallRoundAngleStaysInDegrees) {
  const auto r = plate({{26, "CONICAL_HOLE_BOTTOM(0.5,$)"}});
  EXPECT_THAT(lines(r->job), IsEmpty());
}

TEST(Deviations, ComplementOfADrillsHalfAngleIsTakenAsSuch) {
  const auto r = plate({{32, "MILLING_TOOL_DIMENSION(10.,31.,$,45.,$,$,$)"}});
  EXPECT_THAT(codes(r->job), Contains("warning EXC-TIP-ANGLE #32"));
  EXPECT_NEAR(*dimension(r->plan).tool_top_angle, 59.0 * kDegree, 1e-15);  // a point of 118 degrees
}

TEST(Deviations, PercentIsRecognisedWhereNothingElseCanBeMeant) {
  const std::map<int, std::string> with = {{20, "DRILLING($,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,#47)"},
                                           {47, "DRILLING_TYPE_STRATEGY(75.,0.5,2.,$,$,$)"}};
  const auto r = plate(with);
  const auto& s = r->plan.model.at<model::DrillingTypeStrategy>(
      r->plan.model.all(model::TypeId::kDrillingTypeStrategy)[0]);
  EXPECT_EQ(s.reduced_cut_at_start, 0.75);
  EXPECT_EQ(s.reduced_feed_at_start, 0.5);
  EXPECT_THAT(codes(r->job), Contains("warning EXC-RATIO #47"));
}

TEST(Deviations, OverlapThatMayBeALengthIsKeptAndCalledSuspicious) {
  for (const auto& [text, value, repaired] : std::initializer_list<std::tuple<const char*, double, bool>>{
           {"4.0", 4.0, false}, {"25.", 0.25, true}}) {
    const auto r =
        plate({{20, "BOTTOM_AND_SIDE_ROUGH_MILLING($,$,'M',10.,$,#44,#45,#41,$,$,$,#47,2.,2.,$,$)"},
               {47, std::string("CONTOUR_PARALLEL(") + text + ",.T.,.CCW.,.CONVENTIONAL.)"}});
    const auto& s =
        r->plan.model.at<model::ContourParallel>(r->plan.model.all(model::TypeId::kContourParallel)[0]);
    EXPECT_EQ(s.overlap, value);
    const auto found = suspicions(r->plan);
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_EQ(found[0].repaired, repaired);
    EXPECT_EQ(found[0].lexeme, text);
  }
}

TEST(Deviations, FeedOfZeroIsOpen) {
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.0,.TCP.,$,-16.,$,.F.,.F.,.F.,$)"}});
  const auto at = r->plan.model.all(model::TypeId::kMillingTechnology)[0];
  EXPECT_TRUE(r->plan.ledger.is_open(at, "feedrate"));
  EXPECT_FALSE(technology(r->plan).feedrate);
  EXPECT_EQ(r->plan.ledger.find(at, "feedrate")->lexeme, "0.0");
}

TEST(Deviations, SpindleThatStandsStillIsOpen) {
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.005,.TCP.,$,0.0,$,.F.,.F.,.F.,$)"}});
  const auto at = r->plan.model.all(model::TypeId::kMillingTechnology)[0];
  EXPECT_TRUE(r->plan.ledger.is_open(at, "spindle"));
  EXPECT_EQ(r->plan.ledger.find(at, "spindle")->lexeme, "0.0");
}

TEST(Deviations, FeedThatNoCutterTakesIsKeptAndSaid) {
  const auto r = plate({{45, "MILLING_TECHNOLOGY(0.175,.TCP.,$,-16.,$,.F.,.F.,.F.,$)"}});
  EXPECT_THAT(lines(r->job), Contains(HasSubstr("10.938 mm per revolution")));  // 10500 / 960
  EXPECT_EQ(technology(r->plan).feedrate, 10500.0);
}

TEST(Open, MissingToolTechnologyAndOperationAreOpenDecisions) {
  const auto tool = plate({{20, "DRILLING($,$,'DRILL',10.,$,$,$,#41,$,$,$,$,$,$)"}});
  const auto op = tool->plan.model.all(model::TypeId::kDrilling)[0];
  EXPECT_TRUE(tool->plan.ledger.is_open(op, "its_tool"));
  EXPECT_TRUE(tool->plan.ledger.is_open(op, "its_technology"));
  EXPECT_THAT(codes(tool->job), Contains("note EXC-OPEN #20"));
  const auto none = plate({{10, "MACHINING_WORKINGSTEP('WS',#62,#17,$,$)"}});
  EXPECT_TRUE(none->plan.ledger.is_open(none->plan.model.all(model::TypeId::kMachiningWorkingstep)[0],
                                        "its_operation"));
  const auto feed = plate({{45, "MILLING_TECHNOLOGY($,.TCP.,$,$,$,.F.,.F.,.F.,$)"}});
  const auto t = feed->plan.model.all(model::TypeId::kMillingTechnology)[0];
  EXPECT_TRUE(feed->plan.ledger.is_open(t, "feedrate"));
  EXPECT_TRUE(feed->plan.ledger.is_open(t, "spindle"));
}

TEST(Open, ToolWithoutUsableDimensionsIsARequirement) {
  const auto r = plate({{32, "MILLING_TOOL_DIMENSION(0.0,$,$,45.,$,$,$)"}});
  EXPECT_TRUE(r->plan.ledger.is_open(r->plan.model.all(model::TypeId::kDrilling)[0], "its_tool"));
  EXPECT_THAT(codes(r->job), Contains("warning EXC-ZERO #32"));
}

TEST(Open, MissingListsAreTakenAsEmptyWithAWarning) {
  const auto r = plate({{41, "MILLING_MACHINE_FUNCTIONS(.T.,$,$,.F.,$,$,.T.,$,$,())"}});
  EXPECT_THAT(lines(r->job), Contains(HasSubstr("axis_clamping is missing; taken as empty [P21-MANDATORY]")));
}

}  // namespace
}  // namespace capstan::exchange
