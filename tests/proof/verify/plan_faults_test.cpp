#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"

namespace capstan::verify {
namespace {

using testing::check;
using testing::PlanMaker;
using testing::told;

bool has(const std::vector<model::Finding>& findings, int property, const std::string& step = "?") {
  return std::any_of(findings.begin(), findings.end(), [&](const auto& f) {
    return f.property == property && f.severity == Severity::kError && (step == "?" || f.step == step);
  });
}

TEST(CheckPlan, APlanThatIsRightHasNoFinding) {
  const auto findings = check(testing::good_plan().plan);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(CheckPlan, AReamerWithdrawnTurningHasNoFinding) {
  PlanMaker k = testing::good_plan();
  testing::with_reamer(k, 300);
  const auto findings = check(k.plan);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

struct Fault {
  const char* name;
  int property;
  const char* step;  ///< where it must be found
  std::function<void(PlanMaker&)> plant;
};
void PrintTo(const Fault& f, std::ostream* out) { *out << f.name; }

class PlantedFault : public ::testing::TestWithParam<Fault> {};

TEST_P(PlantedFault, IsFoundWhereItWasPlanted) {
  PlanMaker k = testing::good_plan();
  GetParam().plant(k);
  const auto findings = check(k.plan);
  EXPECT_TRUE(has(findings, GetParam().property, GetParam().step)) << told(findings);
}

/// The cutter's first path, with one more move at its end.
void cut_at(PlanMaker& k, geometry::Vec3 p) {
  testing::edit_path(k.plan, 0, [&](model::CutterPath& path) {
    path.rapid({p.x, p.y, 10});
    path.line({p.x, p.y, p.z}, model::MoveRole::kPlunge);
    path.rapid({p.x, p.y, 10}, model::MoveRole::kRetract);
  });
  testing::edit_schedule(k.plan, 0, [](model::FeedSchedule& s) {
    for (int i = 0; i < 3; ++i) {
      s.feed_mm_min.push_back(600);
      s.spindle_rpm.push_back(3000);
      s.dwell_s.push_back(0);
    }
  });
}

const Fault kFaults[] = {
    {"NotANumber", 1, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) { p.x[4] = std::numeric_limits<double>::quiet_NaN(); });
     }},
    {"InfiniteFeed", 1, "drill",
     [](PlanMaker& k) {
       testing::edit_schedule(k.plan, 1,
                              [](auto& s) { s.feed_mm_min[2] = std::numeric_limits<double>::infinity(); });
     }},
    {"ColumnsOfDifferentLength", 1, "drill",
     [](PlanMaker& k) { testing::edit_schedule(k.plan, 1, [](auto& s) { s.feed_mm_min.pop_back(); }); }},
    {"UnknownWorkOffset", 3, "", [](PlanMaker& k) { k.plan.setups[0].work_offset = "G60"; }},
    {"ToolNotThere", 4, "drill", [](PlanMaker& k) { k.plan.steps[1].cutter_id = "d9"; }},
    {"PocketBeyondTheMagazine", 4, "", [](PlanMaker& k) { k.plan.cutters[1].pocket = 99; }},
    {"TwoToolsInOnePocketOfTheMagazine", 4, "",
     [](PlanMaker& k) {
       model::ToolTableLine line;
       line.words = {{"P", static_cast<double>(k.plan.cutters[0].pocket)}, {"Z", 100.0}};
       k.plan.cutters[1].table_line = line;
     }},
    {"TwoToolsWithOneNumber", 5, "", [](PlanMaker& k) { k.plan.cutters[1].pocket = 1; }},
    {"LengthInAnotherUnit", 6, "", [](PlanMaker& k) { k.plan.cutters[0].functional_length_mm *= 25.4; }},
    {"ToolChangeBelowTheSecurityPlane", 7, "pocket",
     [](PlanMaker& k) { testing::edit_path(k.plan, 0, [](auto& p) { p.z.back() = 3; }); }},
    {"LengthNotMeasured", 6, "drill",
     [](PlanMaker& k) {
       model::ToolTableLine line;
       line.words = {{"Z", 0.0}};
       k.plan.cutters[1].table_line = line;
     }},
    {"PathStartsLow", 8, "drill",
     [](PlanMaker& k) { testing::edit_path(k.plan, 1, [](auto& p) { p.z[0] = 4; }); }},
    {"RapidThroughMaterial", 9, "pocket",
     [](PlanMaker& k) {
       // Out of the pocket sideways, one millimetre below the top.
       testing::edit_path(k.plan, 0, [](auto& p) {
         p.z.back() = -1;
         p.rapid({35, 10, -1});
         p.rapid({35, 10, 10});
       });
       testing::edit_schedule(k.plan, 0, [](auto& s) {
         for (int i = 0; i < 2; ++i) {
           s.feed_mm_min.push_back(600);
           s.spindle_rpm.push_back(3000);
           s.dwell_s.push_back(0);
         }
       });
     }},
    {"RapidDiagonalThatIsClearOnlyWhenAxesArriveTogether", 9, "pocket",
     [](PlanMaker& k) {
       // Into the finished pocket from far above its side: the straight line is clear, the box of it is not.
       testing::edit_path(k.plan, 0, [](auto& p) {
         p.rapid({10, 50, 60});
         p.rapid({50, 50, -5});
         p.rapid({50, 50, 10});
       });
       testing::edit_schedule(k.plan, 0, [](auto& s) {
         for (int i = 0; i < 3; ++i) {
           s.feed_mm_min.push_back(600);
           s.spindle_rpm.push_back(3000);
           s.dwell_s.push_back(0);
         }
       });
     }},
    {"RapidDownIntoMaterial", 10, "drill",
     [](PlanMaker& k) { testing::edit_path(k.plan, 1, [](auto& p) { p.z[1] = -3; }); }},
    {"RapidDownOntoMaterial", 10, "drill",
     [](PlanMaker& k) { testing::edit_path(k.plan, 1, [](auto& p) { p.z[1] = 0; }); }},
    {"TooDeep", 11, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) {
         for (double& z : p.z) z = z == -10.0 ? -10.05 : z;
       });
     }},
    {"WallCutBySevenHundredths", 11, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) {
         for (double& x : p.x) x = x == 65.0 ? 65.07 : x;
       });
     }},
    {"HoleBesideItsPlace", 11, "drill",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 1, [](auto& p) {
         for (double& x : p.x) x += 0.1;
       });
     }},
    {"CutInThePlainTop", 11, "pocket",
     [](PlanMaker& k) {
       cut_at(k, {85, 85, -0.2});
     }},
    {"FlutesTooShort", 13, "pocket", [](PlanMaker& k) { k.plan.cutters[0].maximum_depth_of_cut_mm = 4; }},
    {"DrillTooShort", 13, "drill", [](PlanMaker& k) { k.plan.cutters[1].stick_out_mm = 15; }},
    {"PlungeWithoutCentre", 14, "pocket", [](PlanMaker& k) { k.plan.cutters[0].centre_cutting = false; }},
    {"RampTooSteep", 14, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) {
         // 5 mm down over 10 mm: 26.6 degrees; the tool allows 5.7.
         p.x[2] = 60;
         p.z[1] = 0.5;
         p.role[2] = model::MoveRole::kRamp;
       });
     }},
    {"SpindleOff", 15, "pocket",
     [](PlanMaker& k) {
       testing::edit_schedule(k.plan, 0,
                              [](auto& s) { std::fill(s.spindle_rpm.begin(), s.spindle_rpm.end(), 0.0); });
     }},
    {"SpindleBackwards", 15, "drill",
     [](PlanMaker& k) {
       testing::edit_schedule(
           k.plan, 1, [](auto& s) { std::fill(s.spindle_rpm.begin(), s.spindle_rpm.end(), -1500.0); });
     }},
    {"ReamerWithdrawnStanding", 15, "ream", [](PlanMaker& k) { testing::with_reamer(k, 0); }},
    {"FasterThanTheTool", 16, "pocket", [](PlanMaker& k) { k.plan.cutters[0].maximum_speed_rpm = 2500; }},
    {"FasterThanTheSpindle", 16, "drill",
     [](PlanMaker& k) {
       testing::edit_schedule(
           k.plan, 1, [](auto& s) { std::fill(s.spindle_rpm.begin(), s.spindle_rpm.end(), 13000.0); });
     }},
    {"MorePowerThanTheSpindleHas", 17, "pocket",
     [](PlanMaker& k) {
       for (auto& p : k.plan.machine.spindle.curve) {
         p.power_w = 300;
         p.torque_nm = 100;
       }
     }},
    {"MoreTorqueThanTheSpindleHas", 17, "drill",
     [](PlanMaker& k) {
       for (auto& p : k.plan.machine.spindle.curve) p.torque_nm = 1;
     }},
    {"FeedZero", 18, "drill",
     [](PlanMaker& k) { testing::edit_schedule(k.plan, 1, [](auto& s) { s.feed_mm_min[2] = 0; }); }},
    {"FeedBeyondTheAxis", 18, "pocket",
     [](PlanMaker& k) { testing::edit_schedule(k.plan, 0, [](auto& s) { s.feed_mm_min[7] = 60000; }); }},
    {"FeedBeyondTheTooth", 18, "pocket",
     [](PlanMaker& k) {
       testing::edit_schedule(k.plan, 0,
                              [](auto& s) { std::fill(s.feed_mm_min.begin(), s.feed_mm_min.end(), 9960.0); });
     }},
    {"DrillFeedPerRevolution", 18, "drill",
     [](PlanMaker& k) {
       // 1.9 mm per revolution.
       testing::edit_schedule(k.plan, 1,
                              [](auto& s) { std::fill(s.feed_mm_min.begin(), s.feed_mm_min.end(), 2850.0); });
     }},
    {"DepthOfCut", 20, "pocket", [](PlanMaker& k) { k.plan.cutters[0].maximum_depth_of_cut_mm = 4.5; }},
    {"WidthOfCut", 20, "pocket", [](PlanMaker& k) { k.plan.steps[0].radial_depth_mm = 10.5; }},
    {"TravelTooShort", 22, "drill", [](PlanMaker& k) { k.plan.machine.axes[0].travel_max_mm = 30; }},
    {"ArcLeavesTheTravel", 22, "pocket",
     [](PlanMaker& k) {
       // A half turn whose ends keep to the travel (15 to 65), but not its summit at 35 - 22.4 = 12.6.
       k.plan.machine.axes[0].travel_max_mm = 65 - 12.6 - 1e-3;
       testing::edit_path(k.plan, 0, [](auto& p) {
         p.arc({35, 35 + 2 * 22.4, 10}, {35, 35 + 22.4}, true, model::MoveRole::kLink);
       });
       testing::edit_schedule(k.plan, 0, [](auto& s) {
         s.feed_mm_min.push_back(600);
         s.spindle_rpm.push_back(3000);
         s.dwell_s.push_back(0);
       });
     }},
    {"ArcRadiiDisagree", 23, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) {
         p.kind[4] = model::MoveKind::kArcCcw;
         p.cx[4] = 50.01;
         p.cy[4] = 50;
       });
     }},
    {"ArcThatBecomesAFullTurn", 24, "pocket",
     [](PlanMaker& k) {
       testing::edit_path(k.plan, 0, [](auto& p) {
         p.kind[4] = model::MoveKind::kArcCw;
         p.x[4] = p.x[3] + 2e-5;
         p.y[4] = p.y[3];
         p.cx[4] = 50;
         p.cy[4] = 50;
       });
     }},
    {"ReamBeforeDrill", 28, "drill",
     [](PlanMaker& k) {
       testing::with_reamer(k, 300);
       std::swap(k.plan.steps[1], k.plan.steps[2]);
     }},
    {"FaceAfterThePocket", 28, "face",
     [](PlanMaker& k) {
       model::CutterPath p;
       p.start({-10, 5, 10});
       p.rapid({-10, 5, 0.5});
       p.line({-10, 5, -1}, model::MoveRole::kApproach);
       p.line({110, 5, -1}, model::MoveRole::kCut);
       p.rapid({110, 5, 10}, model::MoveRole::kRetract);
       k.step<model::PlaneFinishMilling>("face", k.face("F", 1), "em10", p, 600, 3000);
     }},
    {"EndsInTheWork", 32, "drill",
     [](PlanMaker& k) { testing::edit_path(k.plan, 1, [](auto& p) { p.z.back() = 1; }); }},
    {"FeatureForgotten", 34, "", [](PlanMaker& k) { k.hole("H2", 85, 85, 8, 20); }},
    {"FeatureUnplannedWithoutAReason", 34, "",
     [](PlanMaker& k) {
       k.plan.unplanned.push_back({k.hole("H2", 85, 85, 8, 20), ""});
     }},
};

INSTANTIATE_TEST_SUITE_P(Plan, PlantedFault, ::testing::ValuesIn(kFaults),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(CheckPlan, AStoppedCheckIsAnError) {
  const PlanMaker k = testing::good_plan();
  Job job;
  job.request_stop();
  const auto findings = check_plan(k.plan, job);
  const auto stopped =
      std::find_if(findings.begin(), findings.end(), [](const auto& f) { return f.code == "CHK-STOPPED"; });
  ASSERT_NE(stopped, findings.end());
  EXPECT_EQ(stopped->severity, Severity::kError);
  EXPECT_NE(stopped->message.find("nothing is proven of"), std::string::npos) << stopped->message;
  const std::string text = testing::program_of(k.plan);
  const auto of_text = check_program({"p.ngc", text, {}}, &k.plan, k.plan.machine, k.plan.cutters, job);
  EXPECT_TRUE(
      std::any_of(of_text.begin(), of_text.end(), [](const auto& f) { return f.code == "CHK-STOPPED"; }));
}

TEST(CheckPlan, AnUnplannedFeatureWithItsReasonIsNoFinding) {
  PlanMaker k = testing::good_plan();
  k.plan.unplanned.push_back({k.hole("H2", 85, 85, 8, 20), "no drill of 8 mm"});
  EXPECT_TRUE(check(k.plan).empty());
}

TEST(CheckPlan, TheSamePlanGivesTheSameFindings) {
  PlanMaker k = testing::good_plan();
  cut_at(k, {85, 85, -0.2});
  const auto findings = check(k.plan);
  EXPECT_FALSE(findings.empty());
  EXPECT_EQ(findings, check(k.plan));
}

TEST(CheckPlan, CuttingInAnotherFeaturesVolumeIsLegal) {
  PlanMaker k = testing::good_plan();
  // A step of the pocket begins the hole beside it, within the hole's own volume.
  model::Cutter small = testing::endmill();
  small.id = "em6";
  small.cutting_diameter_mm = 6;
  small.pocket = 3;
  k.plan.cutters.push_back(small);
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 2});
  p.line({15, 15, -4}, model::MoveRole::kPlunge);
  p.rapid({15, 15, 10}, model::MoveRole::kRetract);
  const auto* pocket = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.step<model::BottomAndSideRoughMilling>("other", pocket->its_feature, "em6", p, 300, 3000);
  std::swap(k.plan.steps[1], k.plan.steps[2]);
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
}

TEST(CheckPlan, FoldsWhatRepeatsInAStepIntoItsWorst) {
  PlanMaker k = testing::good_plan();
  testing::edit_schedule(k.plan, 0, [](auto& s) {
    std::fill(s.feed_mm_min.begin(), s.feed_mm_min.end(), 11000.0);
    s.feed_mm_min[9] = 20000.0;
  });
  const auto findings = check(k.plan);
  std::size_t axis = 0;
  for (const auto& f : findings) {
    if (f.code != "CHK-FEED-AXIS") continue;
    ++axis;
    EXPECT_EQ(f.move, 9);
    EXPECT_NE(f.message.find("the worst of"), std::string::npos) << f.message;
  }
  EXPECT_EQ(axis, 1U);
}

TEST(CheckPlan, AFormCutterWhoseHeadOrNeckRunsIntoTheSolidIsFound) {
  PlanMaker k = testing::good_plan();
  for (model::Cutter& c : k.plan.cutters) {
    if (c.cutter_class != model::CutterClass::kEndmill) continue;
    c.cutter_class = model::CutterClass::kTSlotMill;
    c.cutting_width_mm = 2.0;
    c.neck_diameter_mm = 6.0;
  }
  bool head = false;
  for (const auto& f : check(k.plan)) {
    if (f.code != "CHK-HEAD" && f.code != "CHK-NECK") continue;
    head = true;
    EXPECT_EQ(f.property, 11);
  }
  EXPECT_TRUE(head);
}

TEST(CheckPlan, ASunkHelixThatLeavesACoreIsFound) {
  PlanMaker k = testing::good_plan();
  model::CutterPath p;
  p.start({56, 50, 10});
  p.rapid({56, 50, 0.5});
  for (int i = 1; i <= 4; ++i) p.arc({56, 50, 0.5 - 0.5 * i}, {50, 50}, false, model::MoveRole::kRamp);
  p.rapid({56, 50, 10}, model::MoveRole::kRetract);
  k.plan.steps[0].path = std::make_shared<model::CutterPath>(p);
  k.plan.steps[0].schedule.reset();
  const auto findings = check(k.plan);
  EXPECT_TRUE(has(findings, 14, "pocket")) << told(findings);
}

TEST(PropertyText, SaysEachPropertyThatIsChecked) {
  for (int n = 1; n <= 38; ++n) EXPECT_EQ(property_text(n).empty(), n == 19) << n;
}

}  // namespace
}  // namespace capstan::verify
