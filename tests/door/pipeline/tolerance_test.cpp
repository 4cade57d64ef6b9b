#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/door/pipeline/block.h"
#include "tests/support/corpus.h"

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::Not;

/// Nearest and farthest that a cutter's flank comes to the axis through (50, 50) while it cuts.
struct Flank {
  double nearest = 1e300, farthest = 0.0;
};
Flank flank_of(const model::Plan& plan) {
  Flank out;
  for (const auto& s : plan.steps) {
    const double r = 0.5 * model::find_cutter(plan, s.cutter_id)->cutting_diameter_mm;
    for (std::size_t i = 0; s.path && i < s.path->size(); ++i) {
      if (s.path->z[i] > -1.0) continue;
      const double d = std::hypot(s.path->x[i] - 50.0, s.path->y[i] - 50.0);
      out.nearest = std::min(out.nearest, d - r);
      out.farthest = std::max(out.farthest, d + r);
    }
  }
  return out;
}

TEST(Aim, CutsAPocketOf20H7At20Point0105) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.021,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  EXPECT_NEAR(2.0 * flank_of(p.plan).farthest, 20.0105, 0.002);
}

TEST(Aim, CutsAnOutsideOf60H9At59Point963AndTheCheckHoldsItGood) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.,0.074,3);\n#61=TOLERANCED_LENGTH_MEASURE(60.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=GENERAL_OUTSIDE_PROFILE('O',#4,(),#50,#53,$,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  EXPECT_NEAR(2.0 * flank_of(p.plan).nearest, 60.0 - 0.037, 0.002);
  Job job;
  for (const auto& f : findings_of(p.plan, job)) EXPECT_NE(f.code, "CHK-GOUGE") << f.message;
}

TEST(Aim, MovesOnlyTheSidesWhoseSizeIsToleranced) {
  // 60 along x without, 40 along y with a tolerance of +0.1 to +0.3: 40.2 wide, 60 long.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.3,-0.1,3);\n#61=TOLERANCED_LENGTH_MEASURE(40.,#60);\n"
                 "#64=TOLERANCED_LENGTH_MEASURE(60.,$);\n#66=TOLERANCED_LENGTH_MEASURE(6.,$);\n"
                 "#62=RECTANGULAR_CLOSED_PROFILE($,#61,#64);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,#66,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  double x = 0.0, y = 0.0;
  for (const auto& s : p.plan.steps) {
    const double r = 0.5 * model::find_cutter(p.plan, s.cutter_id)->cutting_diameter_mm;
    for (std::size_t i = 0; i < s.path->size(); ++i) {
      if (s.path->z[i] > -1.0) continue;
      x = std::max(x, std::abs(s.path->x[i] - 50.0) + r);
      y = std::max(y, std::abs(s.path->y[i] - 50.0) + r);
    }
  }
  EXPECT_NEAR(2.0 * x, 60.0, 0.003);
  EXPECT_NEAR(2.0 * y, 40.2, 0.003);
}

const char* const kHole =
    "#60=PLUS_MINUS_VALUE(0.021,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
    "#63=ROUND_HOLE('H',#4,(),#50,#56,#61,$,#58);\n";

TEST(GeneralTolerance, ThatIsNotUnderstoodIsOneError) {
  Inputs in = shop();
  in.general_tolerance = "ISO 2768-x";
  Job job;
  const auto out = bind(read(kHole), in, {}, job);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, "MDL-GENERAL");
}

TEST(GeneralTolerance, WiderThanTheCheckJudgesByIsSaid) {
  std::string text = part_text("");
  const std::string stated = "('PART',#6,0.1,";
  text.replace(text.find(stated), stated.size(), "('PART',#6,5.,");
  Job job;
  ASSERT_TRUE(read_plan(text, "part.p21", job));
  std::string said;
  for (const auto& d : job.diagnostics()) said += to_text(d) + "\n";
  EXPECT_THAT(said, HasSubstr("WORKPIECE.global_tolerance is 5 mm; kept, but the check judges by 0.5 mm"));
}

TEST(GeneralTolerance, DecidesTheChainOfWhatStatesNone) {
  const std::string plain =
      "#61=TOLERANCED_LENGTH_MEASURE(20.,$);\n#63=ROUND_HOLE('H',#4,(),#50,#56,#61,$,#58);\n";
  const auto reason = [&](const char* general) {
    Inputs in = shop();
    in.general_tolerance = general;
    const Planned p = bound(read(plain), in);
    EXPECT_FALSE(p.plan.steps.empty()) << p.said;
    const auto* d = p.plan.ledger.find(p.plan.steps.front().step, "its_operation");
    return d == nullptr ? std::string() : p.plan.ledger.reason(d->reason).text;
  };
  EXPECT_THAT(reason("ISO 2768-m"), HasSubstr("+-0.2 mm (ISO 2768-m)"));
  EXPECT_THAT(reason("ISO 2768-f"), HasSubstr("+-0.1 mm (ISO 2768-f)"));
}

TEST(Deviation, FollowsFromWhatAStepLeavesAndFromTheTolerance) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.03,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(40.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n"));
  ASSERT_GE(p.plan.steps.size(), 2U) << p.said;
  const auto& rough = p.plan.steps.front();
  const auto& finish = p.plan.steps.back();
  EXPECT_NEAR(finish.contour_tolerance_mm, 0.003, 1e-9) << "a tenth of 0.03";
  EXPECT_GT(rough.contour_tolerance_mm, finish.contour_tolerance_mm);
  Job job;
  const auto text = write_plan(p.plan, Format::kLinuxCnc, job);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("G64 P0.003\n"));
}

TEST(Datums, AreCutFirstAndTheReasonSaysSo) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.2);
  const Planned p = bound(std::move(plan));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  const auto* project = p.plan.model.get<model::Project>(p.plan.project);
  const auto* d = p.plan.ledger.find(project->main_workplan, "its_elements");
  ASSERT_NE(d, nullptr);
  EXPECT_THAT(p.plan.ledger.reason(d->reason).text,
              HasSubstr("datum A ('H2') first, before 'H1': position 0.2 | A"));
  std::vector<std::string> order;
  for (const auto& s : p.plan.steps) order.push_back(model::step_id(p.plan, s));
  const auto last_of = [&](const std::string& name) {
    const auto it =
        std::find_if(order.rbegin(), order.rend(), [&](const auto& n) { return n.starts_with(name); });
    return order.rend() - it;
  };
  const auto first_of = [&](const std::string& name) {
    const auto it =
        std::find_if(order.begin(), order.end(), [&](const auto& n) { return n.starts_with(name); });
    return it - order.begin() + 1;
  };
  EXPECT_LT(last_of("H2"), first_of("H1"));
}

TEST(Datums, GoThroughAp238AndDecideTheSame) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.04);
  Job job;
  const auto text = write_plan(plan, Format::kAp238, job);
  ASSERT_TRUE(text) << to_text(text.error());
  auto again = read_plan(*text, "part.stp", job);
  ASSERT_TRUE(again) << to_text(again.error());
  const auto q =
      model::quality_of(again->model, model::Ref<model::ManufacturingFeature>(feature(*again, "H1")));
  EXPECT_EQ(q.location_mm, 0.04);
  EXPECT_THAT(q.texts, ::testing::ElementsAre("position 0.04 | A"));
  const auto chain = [](const model::Plan& p) {
    std::vector<std::string> out;
    for (const auto& s : p.steps) out.push_back(model::step_id(p, s));
    return out;
  };
  const Planned first = bound(std::move(plan));
  const Planned second = bound(*std::move(again));
  EXPECT_EQ(chain(first.plan), chain(second.plan)) << second.said;
}

TEST(Ties, BetweenSidesThatOneSetUpDoesNotReachAreSaid) {
  // A blind pocket from below, and one from above that refers to it.
  model::Plan plan = read(
      "#61=TOLERANCED_LENGTH_MEASURE(30.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
      "#63=CLOSED_POCKET('ABOVE',#4,(),#50,#53,(),$,#57,$,$,#62);\n"
      "#70=DIRECTION('',(0.,0.,-1.));\n#71=CARTESIAN_POINT('',(50.,50.,-20.));\n"
      "#72=AXIS2_PLACEMENT_3D('',#71,#70,#22);\n"
      "#73=CLOSED_POCKET('BELOW',#4,(),#72,#53,(),$,#57,$,$,#62);\n");
  tie(plan.model, feature(plan, "BELOW"), feature(plan, "ABOVE"), 0.1);
  const Planned p = bound(std::move(plan));
  EXPECT_THAT(p.said, HasSubstr("PIP-TIED"));
  EXPECT_THAT(p.said, HasSubstr("'ABOVE' and 'BELOW' (datum A)"));
  EXPECT_THAT(p.said, HasSubstr("position 0.1 | A"));
}

TEST(Ties, TurnAThroughHoleToTheSideOfItsDatum) {
  model::Plan plan = read(
      "#61=TOLERANCED_LENGTH_MEASURE(30.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
      "#54000=CARTESIAN_POINT('',(0.,0.,-20.));\n#55000=AXIS2_PLACEMENT_3D('',#54000,#21,#22);\n"
      "#56000=PLANE('',#55000);\n#69=TOLERANCED_LENGTH_MEASURE(8.,$);\n"
      "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
      "#66=ROUND_HOLE('H',#4,(),#65,#56000,#69,$,#58);\n"
      "#70=DIRECTION('',(0.,0.,-1.));\n#71=CARTESIAN_POINT('',(50.,50.,-20.));\n"
      "#72=AXIS2_PLACEMENT_3D('',#71,#70,#22);\n"
      "#73=CLOSED_POCKET('BELOW',#4,(),#72,#53,(),$,#57,$,$,#62);\n");
  tie(plan.model, feature(plan, "BELOW"), feature(plan, "H"), 0.1);
  const Planned p = bound(std::move(plan));
  EXPECT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_THAT(p.said, Not(HasSubstr("PIP-TIED")));
  for (const auto& s : p.plan.steps) EXPECT_EQ(s.setup, p.plan.steps.front().setup);
}

TEST(ToolTable, HoldsNoToolOfAStepThatIsLeftOut) {
  // A flat hole in the middle of a pocket of the same depth: what its steps would cut is gone.
  const Planned p =
      bound(read("#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#57000);\n"
                 "#57000=FLAT_HOLE_BOTTOM();\n#64=TOLERANCED_LENGTH_MEASURE(40.,$);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#64);\n"
                 "#66=CLOSED_POCKET('P',#4,(),#50,#56,(),$,#57,$,$,#62);\n"));
  ASSERT_THAT(p.said, HasSubstr("PIP-GONE"));
  for (const auto& c : p.plan.cutters) {
    EXPECT_TRUE(std::any_of(p.plan.steps.begin(), p.plan.steps.end(), [&](const auto& s) {
      return s.cutter_id == c.id;
    })) << c.id;
  }
}

TEST(Requirements, OfAZoneOfZeroAreSaid) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.0);
  const Planned p = bound(std::move(plan));
  EXPECT_THAT(p.said, HasSubstr("POSITION_TOLERANCE of 'H1' has a zone of 0"));
}

TEST(Requirements, ThatNameNothingAreKeptAndSaid) {
  model::Plan plan = read(kTwoHoles);
  model::FlatnessTolerance t;
  t.tolerance_value = 0.001;  // what no cutter holds
  plan.model.add(t);
  const Planned p = bound(std::move(plan));
  EXPECT_TRUE(p.plan.unplanned.empty());
  EXPECT_THAT(p.said, HasSubstr("PIP-REQUIREMENT"));
  EXPECT_THAT(p.said, HasSubstr("flatness 0.001"));
}

TEST(Quality, OfTheAnnexJPartIsItsGeneralTolerance) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto plan = read_plan(testing::slurp(path), "cc3.stp", job);
  ASSERT_TRUE(plan);
  for (const auto f : plan->model.all_below(model::TypeId::kManufacturingFeature))
    EXPECT_TRUE(model::quality_of(plan->model, model::Ref<model::ManufacturingFeature>(f)).texts.empty());
  EXPECT_TRUE(model::Attribution(plan->model).lost().empty());
  const auto pieces = plan->model.all(model::TypeId::kWorkpiece);
  std::vector<double> stated;
  for (const auto piece : pieces) {
    const auto g = model::general_tolerance_of(plan->model, model::Ref<model::Workpiece>(piece));
    ASSERT_TRUE(g);
    if (*g) stated.push_back(*model::general_size(**g, 50.0));
  }
  EXPECT_THAT(stated, ::testing::ElementsAre(0.01));
}

TEST(Quality, OfTheToolMakersFileIsNotAsked) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  Job job;
  const auto plan = read_plan(testing::slurp(path), "exp2.stpnc", job);
  ASSERT_TRUE(plan);
  for (const auto f : plan->model.all_below(model::TypeId::kManufacturingFeature))
    EXPECT_TRUE(model::quality_of(plan->model, model::Ref<model::ManufacturingFeature>(f)).texts.empty());
}

}  // namespace
}  // namespace capstan::pipeline
