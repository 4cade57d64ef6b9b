#include "planner/door/app/diff/diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/model/plan/field_differences.h"
#include "tests/door/app/plans.h"

namespace capstan::app {
namespace {

using ::testing::HasSubstr;

TEST(Diff, APlanIsTheSameAsItself) {
  const auto d = diff(testing::planned_plate(), testing::planned_plate());
  EXPECT_TRUE(d.same) << d.text;
}

TEST(Diff, TellsAChangedValueWithWhoChoseItAndWhy) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  const auto technology = after.model.all(model::TypeId::kMillingTechnology).front();
  after.model.get<model::MillingTechnology>(technology)->feedrate = 240.0;
  after.ledger.bind(technology, "feedrate", model::Binder::kCase, {"case.12", "as in case 12", "case base"});
  after.steps[0].feed_mm_min = 240.0;
  after.steps[0].cutting_s = 7.5;  // 30 mm at 240 mm/min
  const auto d = diff(before, after);
  EXPECT_FALSE(d.same);
  EXPECT_THAT(d.text,
              HasSubstr("its_operation/its_technology/feedrate: 300 mm/min -> 240 mm/min (bound by case: as "
                        "in case 12; was bound by optimiser)"));
  EXPECT_THAT(d.text, HasSubstr("feed: 300 mm/min -> 240 mm/min"));
  EXPECT_THAT(d.text, HasSubstr("time: +1.5 s"));
}

TEST(Diff, TellsAddedAndRemovedSteps) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  model::MachiningWorkingstep ws;
  ws.its_id = "REAM IT";
  after.steps.push_back(after.steps[0]);
  after.steps[1].step = after.model.add(ws);
  const auto more = diff(before, after);
  EXPECT_THAT(more.text, HasSubstr("+ 'REAM IT'"));
  const auto fewer = diff(after, before);
  EXPECT_THAT(fewer.text, HasSubstr("- 'REAM IT'"));
  EXPECT_THAT(fewer.text, HasSubstr("-6 s"));
}

TEST(Diff, TellsAnotherOrder) {
  auto before = testing::planned_plate();
  model::MachiningWorkingstep ws;
  ws.its_id = "REAM IT";
  before.steps.push_back(before.steps[0]);
  before.steps[1].step = before.model.add(ws);
  auto after = before;
  std::swap(after.steps[0], after.steps[1]);
  const auto d = diff(before, after);
  EXPECT_FALSE(d.same);
  EXPECT_THAT(d.text, HasSubstr("order: 'DRILL IT' 1 -> 2, 'REAM IT' 2 -> 1"));
}

TEST(Diff, TellsOtherToolsMachinesAndFeatures) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  after.machine.id = "other_vmc";
  after.cutters[0].id = "own/10";
  after.steps[0].cutter_id = "own/10";
  auto* hole = after.model.get<model::TolerancedLengthMeasure>(
      after.model.get<model::RoundHole>(after.model.all(model::TypeId::kRoundHole).front())->diameter);
  hole->theoretical_size = 10.5;
  const auto d = diff(before, after);
  EXPECT_THAT(d.text, HasSubstr("machine: generic_vmc -> other_vmc"));
  EXPECT_THAT(d.text, HasSubstr("- T3 generic/drill/10"));
  EXPECT_THAT(d.text, HasSubstr("+ T3 own/10"));
  EXPECT_THAT(d.text, HasSubstr("ROUND_HOLE 'HOLE': diameter/theoretical_size: 10 mm -> 10.5 mm"));
}

TEST(Diff, TellsAnotherHoldingSecurityPlaneAndWorkOffset) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  after.setups[0].work_offset = "G55";
  after.setups[0].security_z_mm = 42.5;
  after.setups[0].holding.id = "vise";
  after.setups[0].holding.pickup = {0.0, 6.0, 0.0};
  const auto d = diff(before, after);
  EXPECT_FALSE(d.same);
  EXPECT_THAT(d.text, HasSubstr("Set-up 1\n"
                                "  work offset: G54 -> G55\n"
                                "  security plane: Z 30 mm -> Z 42.5 mm\n"
                                "  workholding: not stated -> vise\n"
                                "  workholding: its data differ (pickup)\n"));
}

// 3.937 inch and the like are lengths whose last digits differ; what is computed of them differs, too.
TEST(Diff, TellsNoDifferenceBelowTheResolutionOfNumbersAndTellsOneAboveIt) {
  auto before = testing::planned_plate();
  before.stock.box = {{0, 0, -20}, {100, 50, 0}};
  for (const double off : {4e-10, 4e-6}) {
    auto after = before;
    after.stock.box.hi.x += off;
    after.setups[0].security_z_mm += off;
    after.steps[0].loads.peak_force_n += off;
    after.steps[0].feed_mm_min += off;
    const auto d = diff(before, after);
    EXPECT_EQ(d.same, off < model::kSameNumber) << d.text;
    if (d.same) continue;
    for (const char* told :
         {"stock: its data differ (box)", "security plane: ", "its data differ (loads)", "feed: "})
      EXPECT_THAT(d.text, HasSubstr(told));
  }
}

TEST(Diff, TellsASetupThatLiesElsewhere) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  auto* setup = after.model.get<model::Setup>(after.setups[0].setup);
  auto* origin = after.model.get<model::Axis2Placement3d>(setup->its_origin);
  model::CartesianPoint aside;
  aside.coordinates.items = {5.0, 0.0, 0.0};
  origin->location = after.model.add(aside);
  const auto d = diff(before, after);
  EXPECT_FALSE(d.same);
  EXPECT_THAT(d.text, HasSubstr("its_origin/location"));
}

TEST(Diff, DoesNotTellNamesOfPlacementsWhichAp238DoesNotKeep) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  auto* setup = after.model.get<model::Setup>(after.setups[0].setup);
  after.model.get<model::Axis2Placement3d>(setup->its_origin)->name = "orientation";
  EXPECT_TRUE(diff(before, after).same);
}

TEST(Diff, TellsCoolantThroughTheToolAndExceededLimits) {
  const auto before = testing::planned_plate();
  auto after = testing::planned_plate();
  after.steps[0].through = true;
  after.steps[0].exceeded = {{"spindle_torque", 1.11, 0.48, "Nm", geometry::Vec3{12.4, 30.1, -2.0}}};
  after.steps[0].loads.torque_nm = 1.11;
  const auto d = diff(before, after);
  EXPECT_THAT(d.text, HasSubstr("coolant: none -> through the tool"));
  EXPECT_THAT(d.text, HasSubstr("exceeded limits: none -> spindle torque 1.11 of 0.48 Nm at X12.4 Y30.1"));
  EXPECT_THAT(d.text, HasSubstr("its data differ (loads)"));
}

TEST(Diff, TellsAnotherRadiusOfABarInTheSameBox) {
  auto before = testing::planned_plate();
  before.stock.box.add({0.0, 0.0, 0.0});
  before.stock.box.add({40.0, 40.0, 30.0});
  auto after = before;
  after.stock.cylinder_radius_mm = 20.0;
  EXPECT_THAT(diff(before, after).text, HasSubstr("radius of the stock: none -> 20 mm"));
}

TEST(Diff, SurvivesTheFile) {
  Job job;
  const auto plan = testing::planned_plate();
  const auto written = exchange::write_iso14649(plan, job);
  ASSERT_TRUE(written);
  auto again = testing::read_text(written->bytes);
  const auto d = diff(again, testing::read_text(written->bytes));
  EXPECT_TRUE(d.same) << d.text;
}

}  // namespace
}  // namespace capstan::app
