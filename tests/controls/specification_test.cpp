#include "planner/controls/specification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/contradicted.h"
#include "tests/support/empty_plan.h"

namespace capstan::controls {
namespace {

using namespace ::testing;

/// A plan that tells a control all: one workingstep with path, cutter, feed and work offset, and its
/// technology.
struct Told {
  model::Plan plan = testing::empty_plan();
  model::Ref<model::MillingTechnology> technology;

  Told() {
    auto& m = plan.model;
    technology = m.add<model::MillingTechnology>({});
    m.at<model::MillingTechnology>(technology).spindle = -3000.0;
    m.at<model::MillingTechnology>(technology).feedrate = 600.0;
    const auto operation = m.add<model::BottomAndSideRoughMilling>({});
    m.at<model::BottomAndSideRoughMilling>(operation).its_technology = technology;
    model::CutterPath path;
    path.start({0, 0, 0});
    path.line({10, 0, 0}, model::MoveRole::kCut);
    auto& result = testing::add_step(plan, "STEP", "em18", path);
    m.at<model::MachiningWorkingstep>(result.step).its_operation = operation;
  }
  model::MillingTechnology& speeds() { return plan.model.at<model::MillingTechnology>(technology); }
  std::vector<std::string> said(const Conformance& control = {}) const {
    std::vector<std::string> out;
    for (const auto& f : specification(plan, control)) out.push_back(f.code + " " + f.message);
    return out;
  }
};

TEST(Specification, OfAPlanThatTellsAllOnceHasNoFinding) { EXPECT_THAT(Told().said(), IsEmpty()); }

TEST(Specification, NamesWhatIsLeftOpen) {
  Told t;
  model::Decision open;
  open.state = model::DecisionState::kOpen;
  t.plan.ledger.set({t.technology, "feedrate"}, open);
  EXPECT_THAT(t.said(),
              ElementsAre(AllOf(StartsWith("FIT-OPEN"), HasSubstr("feedrate of MILLING_TECHNOLOGY"))));
  Told none;
  none.plan.steps.clear();
  none.plan.model = {};
  none.plan.project = {};
  EXPECT_THAT(none.said(), ElementsAre(HasSubstr("there is no workingstep")));
}

TEST(Specification, NamesWhatIsMissingOfAStep) {
  Told t;
  t.plan.steps[0].feed_mm_min = 0.0;
  t.plan.steps[0].schedule = nullptr;
  t.plan.steps[0].path = nullptr;
  t.plan.cutters[0].pocket = 0;
  EXPECT_THAT(t.said(), ElementsAre("FIT-MISSING missing: its cutter's tool number, its path, its feed"));
  t.plan.cutters.clear();
  t.plan.setups.clear();
  EXPECT_THAT(t.said(), ElementsAre("FIT-MISSING missing: its cutter, its path, its feed, its work offset"));
}

TEST(Specification, TellsTwoSpeedsThatAgreeFromTwoThatDoNot) {
  Told t;
  // pi 18 mm 3000 1/min is 169.6 m/min.
  t.speeds().cutspeed = 170'000.0;
  EXPECT_THAT(t.said(), ElementsAre(AllOf(StartsWith("FIT-OVER"), HasSubstr("spindle and cutspeed"))));
  t.speeds().cutspeed = 84'800.0;
  EXPECT_THAT(t.said(), ElementsAre(AllOf(StartsWith("FIT-CONTRADICTION"), HasSubstr("a factor of 2"))));
  t.speeds().cutspeed.reset();
  t.speeds().feedrate_per_tooth = 0.1;  // two teeth
  EXPECT_THAT(t.said(), ElementsAre(StartsWith("FIT-OVER")));
  t.speeds().feedrate_per_tooth = 0.08;  // two and a half
  EXPECT_THAT(t.said(), ElementsAre(AllOf(StartsWith("FIT-CONTRADICTION"), HasSubstr("2.5 teeth"))));
}

TEST(Specification, NamesWhatTheFileSaysInTwoWays) {
  Told t;
  model::set_contradicted(t.plan, t.technology, "spindle", "it is 1 here and 2 there");
  EXPECT_THAT(t.said(), Contains("FIT-CONTRADICTION contradictory: it is 1 here and 2 there"));
}

TEST(Specification, NamesWhatTheControlDoesNotUse) {
  Told t;
  t.plan.model.add<model::BroadcastContent>({});
  EXPECT_THAT(t.said(), ElementsAre(AllOf(StartsWith("FIT-OVER"), HasSubstr("1 broadcast content"))));
  EXPECT_THAT(t.said({.broadcasts = true}), IsEmpty());
  Told spline;
  auto& m = spline.plan.model;
  const auto curve = m.add<model::BSplineCurveWithKnots>({});
  const auto path = m.add<model::CutterLocationTrajectory>({});
  m.at<model::CutterLocationTrajectory>(path).basiccurve = curve;
  EXPECT_THAT(spline.said(), ElementsAre(HasSubstr("1 path is a B-spline")));
  EXPECT_THAT(spline.said({.splines = true}), IsEmpty());
  Told contact;
  contact.plan.model.add<model::CutterContactTrajectory>({});
  EXPECT_THAT(contact.said(), IsEmpty());
  EXPECT_THAT(contact.said({.compensation = false}), ElementsAre(StartsWith("FIT-COMPENSATION")));
}

}  // namespace
}  // namespace capstan::controls
