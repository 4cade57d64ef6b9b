#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include "planner/model/nouns/arena/walk.h"
#include "planner/physics/motion/time.h"
#include "tests/door/pipeline/block.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"

// Another chain than the rules' first is taken where that is surely quicker.

namespace capstan::pipeline {
namespace {

using ::testing::HasSubstr;

/// In C45. #70 is free for what follows.
std::string pocket(const std::string& profile, const std::string& bosses, double corner_mm) {
  return profile + "#80=TOLERANCED_LENGTH_MEASURE(" + std::to_string(corner_mm) +
         ",$);\n#81=CLOSED_POCKET('P',#4,(),#50,#56,(" + bosses + "),$,#57,$,#80,#70);\n";
}
std::string rectangle(double length, double width) {
  return "#71=TOLERANCED_LENGTH_MEASURE(" + std::to_string(length) + ",$);\n#72=TOLERANCED_LENGTH_MEASURE(" +
         std::to_string(width) + ",$);\n#70=RECTANGULAR_CLOSED_PROFILE($,#72,#71);\n";
}

block::Planned planned(const std::string& features) {
  Inputs in = block::shop();
  in.material_name = "C45";
  return block::bound(block::read(features), in);
}

double cutter_of(const model::Plan& plan, const std::string& id) {
  for (const auto& s : plan.steps) {
    if (model::step_id(plan, s) != id) continue;
    const auto* op = plan.model.get<model::MachiningOperation>(
        plan.model.at<model::MachiningWorkingstep>(s.step).its_operation);
    const auto* tool = plan.model.get<model::MachiningTool>(op->its_tool);
    const model::Cutter* c = model::find_cutter(plan, tool->its_id.value_or(""));
    return c == nullptr ? 0.0 : c->cutting_diameter_mm;
  }
  return 0.0;
}

/// What the plan says of the chains that it did not take.
std::string lost_chains(const model::Plan& plan) {
  std::string out;
  for (const auto& s : plan.steps) {
    const auto* d = plan.ledger.find(s.step, "its_operation");
    if (d == nullptr) continue;
    for (const auto& r : d->rejected) out += r.what + ": " + r.why + "\n";
  }
  return out;
}

TEST(ChainByTime, FinishesTightCornersByTwoMillsOneAfterTheOther) {
  const auto p = planned(pocket(rectangle(60, 40), "", 1.0));
  EXPECT_THAT(p.plan.unplanned, ::testing::IsEmpty()) << p.said;
  ASSERT_EQ(p.plan.steps.size(), 4U) << p.said;
  const double wide = cutter_of(p.plan, "P area_finish"), first = cutter_of(p.plan, "P rest_finish"),
               last = cutter_of(p.plan, "P rest_finish~2");
  EXPECT_GT(wide, first);
  EXPECT_GT(first, last);
  EXPECT_LE(first, 3.0 * 2.0) << "three times as wide as the corners at most";
  EXPECT_EQ(last, 2.0);
  EXPECT_EQ(p.said.find("[TPA-REST]"), std::string::npos) << p.said;
}

TEST(ChainByTime, RoughsAPocketWideThatHasOneNarrowPlaceAndThatPlaceApart) {
  // 4 mm between the boss and one wall, 10 mm and more all round else.
  const auto p = planned(
      "#73=TOLERANCED_LENGTH_MEASURE(30.,$);\n#74=CIRCULAR_CLOSED_PROFILE($,#73);\n"
      "#75=CARTESIAN_POINT('',(34.,50.,0.));\n#76=AXIS2_PLACEMENT_3D('',#75,#21,#22);\n"
      "#77=BOSS('B',#4,(),#76,#56,#74,$);\n" +
      pocket(rectangle(70, 50), "#77", 5.0));
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_GE(cutter_of(p.plan, "P area_rough"), 6.0);
  EXPECT_GT(cutter_of(p.plan, "P rest_rough"), 0.0);
  EXPECT_LE(cutter_of(p.plan, "P rest_rough"), 4.0);
  EXPECT_THAT(lost_chains(p.plan), HasSubstr("the rules prefer it, but that is decisively longer"));
}

TEST(ChainByTime, RoughsATinyPocketByAMillWiderThanItsCorners) {
  const auto p = planned(pocket(rectangle(6, 4), "", 1.0));
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_GT(cutter_of(p.plan, "P area_rough"), 2.0);
  EXPECT_LE(cutter_of(p.plan, "P area_finish"), 2.0);
  EXPECT_THAT(p.said, ::testing::Not(HasSubstr("TPA-REST"))) << "the finish cuts its corners";
}

TEST(ChainByTime, RoughsATriangleByMoreThanItsSharpestCornerLetsIn) {
  const auto p =
      planned(pocket("#71=CARTESIAN_POINT('',(-25.,-15.,0.));\n#72=CARTESIAN_POINT('',(25.,-15.,0.));\n"
                     "#73=CARTESIAN_POINT('',(0.,20.,0.));\n#74=POLYLINE('',(#71,#72,#73,#71));\n"
                     "#70=GENERAL_CLOSED_PROFILE($,#74);\n",
                     "", 2.0));
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_GE(cutter_of(p.plan, "P area_rough"), 5.0);
}

TEST(ChainByTime, KeepsTheRulesOrderWhereAnotherChainSavesLittle) {
  const auto p = planned(pocket(rectangle(40, 25), "", 5.0));
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_EQ(cutter_of(p.plan, "P rest_rough"), 0.0);
  EXPECT_THAT(lost_chains(p.plan), HasSubstr("the rules prefer the chain taken"));
}

/// Time of a floor around a boss of 20 mm, in an outline that is drawn wider than the piece by `beyond_mm`.
double seconds_of_floor(double beyond_mm, double corner_mm) {
  const std::string boss =
      "#90=TOLERANCED_LENGTH_MEASURE(20.,$);\n#91=CIRCULAR_CLOSED_PROFILE($,#90);\n"
      "#92=BOSS('B',#4,(),#50,#56,#91,$);\n";
  const double size = 100.0 + 2.0 * beyond_mm;
  const auto p = planned(boss + pocket(rectangle(size, size), "#92", corner_mm));
  EXPECT_THAT(p.plan.unplanned, ::testing::IsEmpty()) << p.said;
  double out = 0.0;
  for (const auto& s : p.plan.steps) out += s.cutting_s;
  return out;
}

TEST(ChainByTime, IsNotAskedForCornersThatLieInTheAir) {
  const double wide = seconds_of_floor(20.0, 20.0);
  EXPECT_GT(wide, 0.0);
  EXPECT_LE(seconds_of_floor(20.0, 6.0), wide);
  // Corners of 6 mm just within the piece's edge keep their mill.
  EXPECT_GT(seconds_of_floor(-1.0, 6.0), 1.1 * wide);
}

/// The rules, of whose chains for a shoulder around a hole only the first is there.
rules::RuleBase roughed_and_finished() {
  const std::filesystem::path dir = testing::scratch_file("first_chain");
  std::filesystem::create_directories(dir);
  std::ofstream(dir / "hole.yaml") << R"(table: hole
rows:
  - id: hole.shoulder
    priority: 30
    when: {core: [hole], diameter_mm: {from: 2, below: 10000}, it_grade: {from: 10, to: 18}}
    chains:
      - [{do: mill_rough, allowance_side_mm: 0.2, allowance_bottom_mm: 0.2}, mill_finish]
    source: "test"
)";
  Job job;
  auto out = rules::load_rules(dir.string(), job);
  EXPECT_TRUE(out) << to_text(out.error());
  return out ? *std::move(out) : rules::RuleBase{};
}

block::Planned example(const std::string& name, const char* material, Inputs in) {
  in.material_name = material;
  Job job;
  auto plan = read_plan(testing::slurp(testing::source_dir() + "/examples/" + name), name, job);
  EXPECT_TRUE(plan);
  return block::bound(*std::move(plan), in);
}

class OfShoulders : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(OfShoulders, ThePlanWithTheChainTakenIsNoLongerThanWithTheRulesFirst) {
  const auto& [part, material] = GetParam();
  Inputs first_only = block::shop();
  first_only.rules = roughed_and_finished();
  const auto taken = example(part, material, block::shop()), first = example(part, material, first_only);
  ASSERT_TRUE(taken.plan.unplanned.empty() && first.plan.unplanned.empty()) << taken.said << first.said;
  EXPECT_LE(motion::time_of(taken.plan)->total_s(), motion::time_of(first.plan)->total_s());
}

INSTANTIATE_TEST_SUITE_P(Examples, OfShoulders,
                         ::testing::Combine(::testing::Values("bracket.p21", "two_setups.p21"),
                                            ::testing::Values("EN AW-6061", "C45", "X5CrNi18-10")));

TEST(ChainByTime, OfShouldersSparesAToolThatIsChangedForOneShortCut) {
  const auto p = example("bracket.p21", "EN AW-6061", block::shop());
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_EQ(cutter_of(p.plan, "CAP SCREW HOLE[1] mill_rough"), 0.0);
  EXPECT_EQ(cutter_of(p.plan, "CAP SCREW HOLE[1] mill_finish"), cutter_of(p.plan, "SLOT area_finish"))
      << "a tool that the plan uses already";
  // Both counterbores are made with one change.
  EXPECT_THAT(lost_chains(p.plan),
              ::testing::ContainsRegex("mill_rough \\+ mill_finish \\[hole.shoulder\\]: about "
                                       "[0-9.]+ s of cutting and tool changes for the 2 alike, "
                                       "the chain taken about [0-9.]+ s; the rules prefer it, "
                                       "but that is decisively longer"));
}

TEST(ChainByTime, OfShouldersInSteelIsOneCutWhereThatIsSurelyShorter) {
  const auto p = example("two_setups.p21", "C45", block::shop());
  ASSERT_TRUE(p.plan.unplanned.empty()) << p.said;
  for (const std::string shoulder : {"COUNTERBORE 1", "COUNTERBORE 2"}) {
    const auto n = std::count_if(p.plan.steps.begin(), p.plan.steps.end(), [&](const auto& s) {
      return model::step_id(p.plan, s).starts_with(shoulder + " ");
    });
    EXPECT_EQ(n, 1) << shoulder;
  }
}

}  // namespace
}  // namespace capstan::pipeline
