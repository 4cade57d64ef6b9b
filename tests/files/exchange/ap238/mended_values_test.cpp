#include "tests/files/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::Model;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

// A hole that is drilled, with a placement and a security plane.
struct Drilled : Bench {
  model::Ref<model::MachiningWorkingstep> ws;
  model::Ref<model::Drilling> operation;
  Drilled() {
    Model& m = plan.model;
    model::Axis2Placement3d p;
    p.name = "orientation";
    model::CartesianPoint o;
    o.coordinates = {{10.0, 20.0, 0.0}, true};
    p.location = m.add(std::move(o));
    model::RoundHole hole;
    hole.its_id = "hole";
    hole.its_workpiece = workpiece;
    hole.feature_placement = m.add(std::move(p));
    model::DrillingTypeStrategy strategy;
    strategy.reduced_cut_at_start = 0.5;
    model::Drilling op;
    op.its_id = "drill";
    op.retract_plane = 5.0;
    op.its_machining_strategy = m.add(std::move(strategy));
    operation = m.add(std::move(op));
    model::MachiningWorkingstep step_;
    step_.its_id = "ws";
    step_.enabled = true;
    step_.its_feature = m.add(std::move(hole));
    step_.its_operation = operation;
    ws = step(std::move(step_));
  }
};

const model::MachiningWorkingstep& first_step(const model::Plan& plan) {
  return plan.model.at<model::MachiningWorkingstep>(
      plan.model.all(model::TypeId::kMachiningWorkingstep).front());
}

MATCHER_P(Says, code, "") {
  for (const std::string& line : arg) {
    if (line.find(code) != std::string::npos) return true;
  }
  return false;
}

TEST(Doubtful, PercentBecomesARatioWithAWord) {
  std::vector<std::string> said;
  const auto plan =
      read_text(replaced(written(Drilled().plan).bytes, "RATIO_MEASURE(0.5)", "RATIO_MEASURE(50.)"), &said);
  const auto strategies = plan.model.all(model::TypeId::kDrillingTypeStrategy);
  ASSERT_EQ(strategies.size(), 1u);
  EXPECT_DOUBLE_EQ(*plan.model.at<model::DrillingTypeStrategy>(strategies.front()).reduced_cut_at_start, 0.5);
  EXPECT_THAT(said, Says("[EXC-RATIO]"));
}

TEST(Doubtful, AStepThatIsNotSurelyEnabledIsDisabled) {
  const std::string text = written(Drilled().plan).bytes;
  EXPECT_EQ(first_step(read_text(text)).enabled, std::optional(true));
  std::vector<std::string> said;
  const auto plan = read_text(replaced(text, "ITEM('','enabled')", "ITEM('','off')"), &said);
  EXPECT_EQ(first_step(plan).enabled, std::optional(false));
  EXPECT_THAT(said, Says("taken as disabled"));
}

TEST(Doubtful, AnAttributeThatIsGivenTwiceIsTold) {
  const std::string text = written(Drilled().plan).bytes;
  const auto line_of = [&](const std::string& what) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    const auto begin = text.rfind('\n', at) + 1;
    return text.substr(begin, text.find('\n', at) - begin);
  };
  // Another retract plane for the same operation, in the same unit.
  const std::string property = line_of("ACTION_PROPERTY('retract plane'");
  const std::string operation =
      property.substr(property.rfind('#'), property.rfind(')') - property.rfind('#'));
  const std::string value = line_of("LENGTH_MEASURE(5.)");
  const std::string second =
      "#9001=ACTION_PROPERTY('retract plane',''," + operation +
      ");\n#9002=ACTION_PROPERTY_REPRESENTATION('','',#9001,#9003);\n"
      "#9003=REPRESENTATION('',(#9004),#9005);\n#9005=REPRESENTATION_CONTEXT('','');\n#9004" +
      replaced(value.substr(value.find('=')), "(5.)", "(50.)") + "\n";
  std::vector<std::string> said;
  const auto plan = read_text(replaced(text, "ENDSEC;\nEND-ISO", second + "ENDSEC;\nEND-ISO"), &said);
  EXPECT_THAT(said, Says("[EXC-TWICE]"));
  std::vector<std::string> before;
  (void)read_text(text, &before);
  EXPECT_THAT(before, ::testing::Not(Says("[EXC-TWICE]")));
}

TEST(Doubtful, AMachinedFeatureWithoutAPlaceIsRefused) {
  Job job;
  const auto plan = read_bytes(replaced(written(Drilled().plan).bytes, "AXIS2_PLACEMENT_3D('orientation'",
                                        "AXIS2_PLACEMENT_3D('somewhere'"),
                               "t.stpnc", {}, job);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("where the feature lies is not known"), std::string::npos)
      << plan.error().message;
}

TEST(Doubtful, LengthsInAnUnknownUnitAreRefused) {
  Job job;
  const auto plan =
      read_bytes(replaced(written(Drilled().plan).bytes, "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.MILLI.,$)"),
                 "t.stpnc", {}, job);
  ASSERT_FALSE(plan);
  bool told = false;
  for (const auto& d : job.diagnostics())
    told = told || (d.code == "EXC-UNIT" && d.severity == Severity::kError);
  EXPECT_TRUE(told);
}

TEST(Doubtful, ParametersOfCirclesAreAnglesInTheContextsUnit) {
  Drilled bench;
  Model& m = bench.plan.model;
  model::Circle circle;
  model::Axis2Placement3d p;
  model::CartesianPoint o;
  o.coordinates = {{0.0, 0.0, 0.0}, true};
  p.location = m.add(std::move(o));
  circle.position = m.add(std::move(p));
  circle.radius = 4.0;
  model::TrimmedCurve arc;
  arc.basis_curve = m.add(std::move(circle));
  const auto parameter = [](double degrees) {
    model::SelectValue v;
    v.type = "PARAMETER_VALUE";
    v.real = degrees;
    return model::SelectList{{v}, true};
  };
  arc.trim_1 = parameter(0.0);
  arc.trim_2 = parameter(90.0);
  arc.sense_agreement = true;
  arc.master_representation = model::TrimmingPreference::kParameter;
  model::CutterLocationTrajectory path;
  path.its_id = "tp";
  path.basiccurve = m.add(std::move(arc));
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(path)));
  m.at<model::Drilling>(bench.operation).its_toolpath = m.add(std::move(list));
  EXPECT_NE(written(bench.plan).bytes.find("PARAMETER_VALUE(1.5707963267948966)"), std::string::npos);
  const auto back = read_text(written(bench.plan).bytes);
  const auto arcs = back.model.all(model::TypeId::kTrimmedCurve);
  ASSERT_EQ(arcs.size(), 1u);
  EXPECT_NEAR(*back.model.at<model::TrimmedCurve>(arcs.front()).trim_2.items.front().real, 90.0, 1e-12);
}

}  // namespace
}  // namespace capstan::exchange::ap238
