#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "casebase/retain/join/join.h"
#include "casebase/tune/advise.h"
#include "casebase/tune/from_case.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase::retain {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A pocket of 20 mm width and 10 mm depth whose floor is to be Ra 1.6, and a hole of 8 mm.
std::vector<Case> two_cases() {
  std::vector<Case> out;
  for (const char* step : {"POCKET", "HOLE"}) {
    Case c = sample();
    c.observed = {};
    c.from.workingstep = step;
    c.asked.diameter_mm = c.from.workingstep == "HOLE" ? 8.0 : 0.0;
    c.asked.width_mm = c.from.workingstep == "HOLE" ? 0.0 : 20.0;
    c.asked.depth_mm = 10.0;
    c.asked.asked_ra_um = c.from.workingstep == "HOLE" ? 0.0 : 1.6;
    out.push_back(c);
  }
  return out;
}

struct Joined {
  Case pocket, hole;
  std::string said;
};
Joined join(const std::string& rows, std::vector<Case> cases = two_cases()) {
  Job job;
  const auto read = read_inspection("part,characteristic,type,nominal,tol_plus,tol_minus,value,unit\n" + rows,
                                    "cmm.csv", 1.0, job);
  EXPECT_TRUE(read) << (read ? std::string() : to_text(read.error()));
  if (read) add_inspection(*read, {}, {.part = "7", .file = "log", .inspection = "cmm.csv"}, cases, job);
  Joined out{cases[0], cases[1], {}};
  for (const Diagnostic& d : job.diagnostics()) out.said += to_text(d) + '\n';
  return out;
}

TEST(InspectedStep, KeepsSizeDepthPlaceAndRoughnessEachInItsPlace) {
  const Joined j = join(
      "7,POCKET/w,Width,20,0.1,-0.1,20.04,mm\n7,POCKET/d,Depth,10,0.1,-0.1,9.95,mm\n"
      "7,POCKET/p,Position,,,,0.03,mm\n7,POCKET/r,Ra,,,,1.2,um\n");
  EXPECT_NEAR(j.pocket.observed.size_deviation_mm.value().value, 0.04, 1e-12);
  EXPECT_NEAR(j.pocket.observed.depth_deviation_mm.value().value, -0.05, 1e-12);
  EXPECT_NEAR(j.pocket.observed.position_deviation_mm.value().value, 0.03, 1e-12);
  EXPECT_NEAR(j.pocket.observed.surface_ra_um.value().value, 1.2, 1e-12);
  EXPECT_EQ(j.pocket.observed.surface_ra_um->origin, Origin::kMeasured);
  EXPECT_EQ(j.pocket.observed.verdict, Verdict::kGood);
  EXPECT_EQ(j.pocket.id, id_of(j.pocket));
  EXPECT_FALSE(fault_of(j.pocket));
  EXPECT_FALSE(j.hole.observed.size_deviation_mm);
  EXPECT_EQ(j.said, "");
}

TEST(InspectedStep, IsJudgedByTheRoughestPlaceAgainstWhatIsAsked) {
  const Joined fine = join("7,POCKET/1,Ra,,,,1.2,um\n7,POCKET/2,Ra,,,,1.6,um\n");
  EXPECT_NEAR(fine.pocket.observed.surface_ra_um.value().value, 1.6, 1e-12);
  EXPECT_GT(fine.pocket.observed.surface_ra_um->std_dev, 0.0);
  EXPECT_EQ(fine.pocket.observed.verdict, Verdict::kGood);
  EXPECT_EQ(join("7,POCKET/1,Ra,,,,1.2,um\n7,POCKET/2,Ra,,,,1.7,um\n").pocket.observed.verdict,
            Verdict::kBad);
  // Of the hole no roughness is asked for: what the row states holds, if it states any.
  EXPECT_EQ(join("7,HOLE/r,Ra,,,,6,um\n").hole.observed.verdict, Verdict::kUnknown);
  EXPECT_EQ(join("7,HOLE/r,Ra,3.2,,,6,um\n").hole.observed.verdict, Verdict::kBad);
}

TEST(InspectedStep, WithAnAskedRoughnessIsEvidenceOfIt) {
  tune::PlannedStep planned;
  planned.step = two_cases()[0];
  const auto finish = static_cast<std::size_t>(tune::Watched::kFinish);
  EXPECT_FALSE(tune::evidence_of(planned.step, planned).ln_load[finish]);
  const Joined j = join("7,POCKET/r,Ra,,,,0.8,um\n");
  ASSERT_TRUE(tune::evidence_of(j.pocket, planned).ln_load[finish]);
  EXPECT_NEAR(*tune::evidence_of(j.pocket, planned).ln_load[finish], std::log(0.5), 1e-12);  // 0.8 of 1.6 um
}

TEST(InspectedStep, TakesTheSizesOfTheNominalThatItAsksFor) {
  const Joined j = join(
      "7,HOLE/1,Diameter,12,0.1,-0.1,12.08,mm\n7,HOLE/2,Diameter,8,0.1,-0.1,8.01,mm\n"
      "7,HOLE/3,Diameter,8,0.1,-0.1,8.03,mm\n");
  EXPECT_NEAR(j.hole.observed.size_deviation_mm.value().value, 0.02, 1e-12);
  EXPECT_THAT(j.said, HasSubstr("HOLE/1 (Diameter, line 2)"));
  EXPECT_THAT(j.said, Not(HasSubstr("HOLE/2")));
  // Of neither: no size is better than one of two things.
  const Joined none = join("7,HOLE/1,Diameter,12,0.1,-0.1,12.08,mm\n7,HOLE/2,Diameter,9,0.1,-0.1,9,mm\n");
  EXPECT_FALSE(none.hole.observed.size_deviation_mm);
  EXPECT_THAT(none.said, HasSubstr("HOLE/2 (Diameter, line 3)"));
}

TEST(InspectedStep, KeepsNoSizeThatItDoesNotAskForAndIsNotGoodByIt) {
  const Joined inch = join("7,HOLE/d,Diameter,0.315,0.0006,0,0.3152,\n");
  EXPECT_FALSE(inch.hole.observed.size_deviation_mm);
  EXPECT_EQ(inch.hole.observed.verdict, Verdict::kUnknown);
  EXPECT_THAT(inch.said, HasSubstr("warning"));
  EXPECT_THAT(inch.said, HasSubstr("nominal 0.315 mm, asked 8 mm"));
  EXPECT_THAT(inch.said, HasSubstr("--unit inch"));
  EXPECT_THAT(inch.said, HasSubstr("HOLE/d (Diameter, line 2)"));
  // With its unit it is the same hole, rounded: 0.0002 in too wide.
  const Joined said = join("7,HOLE/d,Diameter,0.315,0.0006,0,0.3152,in\n");
  EXPECT_NEAR(said.hole.observed.size_deviation_mm.value().value, 0.0002 * 25.4, 1e-9);
  EXPECT_EQ(said.hole.observed.verdict, Verdict::kGood);
  EXPECT_EQ(said.said, "");

  const Joined other = join("7,HOLE/d,Diameter,10,0.1,-0.1,10.004,mm\n");
  EXPECT_FALSE(other.hole.observed.size_deviation_mm);
  EXPECT_EQ(other.hole.observed.verdict, Verdict::kUnknown);
  EXPECT_THAT(other.said, HasSubstr("nominal 10 mm, asked 8 mm"));
  EXPECT_THAT(other.said, Not(HasSubstr("inch")));
  // Beyond its limits it is bad whatever it is of.
  EXPECT_EQ(join("7,HOLE/d,Diameter,10,0.1,-0.1,10.4,mm\n").hole.observed.verdict, Verdict::kBad);
  const Joined depth = join("7,HOLE/d,Depth,12,0.1,-0.1,12,mm\n");
  EXPECT_FALSE(depth.hole.observed.depth_deviation_mm);
  EXPECT_THAT(depth.said, HasSubstr("nominal 12 mm, asked 10 mm"));
}

TEST(InspectedStep, KeepsNoSizeWhoseDecimalPointSlipped) {
  const Joined j = join("7,HOLE/d,Diameter,8,0.1,-0.1,80.04,mm\n");
  EXPECT_FALSE(j.hole.observed.size_deviation_mm);
  EXPECT_EQ(j.hole.observed.verdict, Verdict::kBad);
  EXPECT_THAT(j.said, HasSubstr("factor of 3.16"));
  EXPECT_FALSE(join("7,HOLE/d,Diameter,8,,,0.315,mm\n").hole.observed.size_deviation_mm);
}

TEST(InspectedStep, TakesANominalThatIsTheMiddleOfItsZone) {
  // 8 mm +0.015/0, of which the path aims at the middle.
  std::vector<Case> cases = two_cases();
  cases[1].asked.tolerance_mm = 0.015;
  cases[1].bound.aimed_over_mm = Figure{0.0075, 0.0, Origin::kEntered};
  const Joined middle = join("7,HOLE/d,Diameter,8.0075,0.0075,-0.0075,8.0085,mm\n", cases);
  EXPECT_NEAR(middle.hole.observed.size_deviation_mm.value().value, 0.0085, 1e-9);
  EXPECT_EQ(middle.hole.observed.verdict, Verdict::kGood);
  const Joined drawn = join("7,HOLE/d,Diameter,8,0.015,0,8.0085,mm\n", cases);
  EXPECT_NEAR(drawn.hole.observed.size_deviation_mm.value().value, 0.0085, 1e-9);
  // A nominal whose own limits hold the size that is asked for.
  const Joined wide = join("7,HOLE/d,Diameter,8.2,0.2,-0.2,8.3,mm\n");
  EXPECT_NEAR(wide.hole.observed.size_deviation_mm.value().value, 0.3, 1e-9);
  EXPECT_EQ(middle.said + drawn.said + wide.said, "");
}

TEST(InspectedStep, TakesASizeThatItDoesNotState) {
  EXPECT_NEAR(
      join("7,POCKET/l,Length,60,0.1,-0.1,60.04,mm\n").pocket.observed.size_deviation_mm.value().value, 0.04,
      1e-9);
  std::vector<Case> sheet = two_cases();
  sheet[1].asked.diameter_mm = 0.0;
  const Joined j = join("7,HOLE/d,Diameter,12,0.1,-0.1,12.04,mm\n", sheet);
  EXPECT_NEAR(j.hole.observed.size_deviation_mm.value().value, 0.04, 1e-9);
  EXPECT_EQ(j.said, "");
}

TEST(InspectedStep, TellsByNameAndLineWhatNoCaseKeeps) {
  const Joined j = join(
      "7,POCKET/f,Flatness,,,,0.02,mm\n7,POCKET/a,Angle,90,0.1,-0.1,90.02,deg\n7,POCKET/n,Diameter,,,,8,mm\n"
      "7,SLOT/w,Width,9,0.1,-0.1,9,mm\n8,POCKET/w,Width,9,0.1,-0.1,9,mm\n");
  EXPECT_THAT(
      j.said,
      HasSubstr("POCKET/f (Flatness, line 2), POCKET/a (Angle, line 3), POCKET/n (Diameter, line 4)"));
  EXPECT_THAT(j.said, HasSubstr("no case of this log is about: SLOT/w (Width, line 5)"));
  EXPECT_THAT(j.said, HasSubstr("cmm.csv"));
  EXPECT_THAT(j.said, Not(HasSubstr("line 6")));  // of another part
  EXPECT_EQ(j.pocket.observed, Observed{});
}

TEST(InspectedStep, IsBadWhereWhatNoCaseKeepsIsBeyondItsLimits) {
  const std::string width = "7,POCKET/w,Width,20,0.1,-0.1,20.0,mm\n";
  for (const std::string row :
       {"7,POCKET/r,Radius,5,0.05,-0.05,5.4,mm", "7,POCKET/a,Angle,90,0.1,-0.1,89.8,deg",
        "7,POCKET/d,Distance,1,0.01,-0.01,1.02,in", "7,POCKET/s,Perpendicularity,,0.05,,0.06,mm"}) {
    const Joined j = join(width + row + "\n");
    EXPECT_EQ(j.pocket.observed.verdict, Verdict::kBad) << row;
    EXPECT_NEAR(j.pocket.observed.size_deviation_mm.value().value, 0.0, 1e-12) << row;
    EXPECT_EQ(j.pocket.id, id_of(j.pocket)) << row;
    EXPECT_THAT(j.said, HasSubstr("a case keeps nothing of these"));
  }
  // Within them, and without limits, it says nothing.
  EXPECT_EQ(join(width + "7,POCKET/r,Radius,5,0.05,-0.05,5.04,mm\n").pocket.observed.verdict, Verdict::kGood);
  EXPECT_EQ(join("7,POCKET/r,Radius,5,0.05,-0.05,5.04,mm\n").pocket.observed.verdict, Verdict::kUnknown);
  EXPECT_EQ(join(width + "7,POCKET/f,Flatness,,,,9,mm\n").pocket.observed.verdict, Verdict::kGood);
}

TEST(InspectedStep, IsJudgedByAPlaceOfWhichAnUpperLimitAloneIsStated) {
  EXPECT_EQ(join("7,POCKET/p,Position,,0.05,,0.06,mm\n").pocket.observed.verdict, Verdict::kBad);
  EXPECT_EQ(join("7,POCKET/p,Position,,0.05,,0.04,mm\n").pocket.observed.verdict, Verdict::kGood);
}

TEST(InspectedStep, KeepsThePlaceAsADistanceWhereItComesOutShortOfItsNominal) {
  const Joined j = join("7,POCKET/p,Position,50,0.05,-0.05,49.97,mm\n");
  EXPECT_NEAR(j.pocket.observed.position_deviation_mm.value().value, 0.03, 1e-12);
  EXPECT_EQ(j.pocket.observed.verdict, Verdict::kGood);
  EXPECT_FALSE(fault_of(j.pocket));
  EXPECT_EQ(join("7,POCKET/p,Position,50,0.05,,49.94,mm\n").pocket.observed.verdict, Verdict::kBad);
}

}  // namespace
}  // namespace capstan::casebase::retain
