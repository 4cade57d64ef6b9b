#include "planner/files/exchange/records/records.h"

#include <regex>

#include "planner/files/exchange/ap238/tables/addresses.h"
#include "tests/files/exchange/ap238/support.h"
#include "tests/files/exchange/support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::Binder;
using model::Ref;
using model::TypeId;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A main workplan with a nested one, both of which somebody decided about.
struct Bound : Bench {
  Ref<model::Workplan> inner;
  Bound() {
    model::Workplan w;
    w.its_id = "set-up 1: top";  // a colon, as addresses have
    w.its_elements.given = true;
    inner = step(w);
    model::Workplan other = w;  // of the same name
    step(other);
    auto& m = plan.model;
    m.at<model::Workplan>(inner).persistent_id = "7b1c";
    plan.ledger.bind(workplan, "its_elements", Binder::kRule,
                     {"order.faces", "it's faces before what lies in them", "default, unsourced"},
                     {{inner, "its_elements"}, {workplan, "its_setup"}},
                     {{"another order", "one tool change more"}, {"a third", ""}});
    plan.ledger.find(workplan, "its_elements")->pinned = true;
    plan.ledger.find(workplan, "its_elements")->lexeme = "(a,b)";
    plan.ledger.bind(inner, "its_id", Binder::kOptimiser, {"limit.torque", "", "derived"},
                     {{workplan, "its_elements"}});
    plan.ledger.bind(inner, "its_elements", Binder::kGiven, plan.ledger.reason(0));
    plan.ledger.reopen({inner, "its_effect"});
    plan.machine.id = "generic_vmc";
    plan.machine.description = "a machine with \xC3\xA4";
    plan.material.id = "mild_steel";
    plan.material.iso_group = "P";
    plan.material.kc11_n_mm2 = 1780.0;
    plan.material.mc = 0.17;
    plan.material.vc_carbide_m_min = 120.5;
    plan.material.kc_uncertainty = 0.15;
    plan.stock.box = {{0, -0.1, -30}, {100, 120, 0}};
    plan.stock.source = "--stock";
    plan.stock.cylinder_radius_mm = 12.7;
    for (const double d : {10.0, 9.525, 3.3}) {
      model::Cutter c;
      c.id = "D" + std::to_string(static_cast<int>(d));
      c.cutter_class = model::CutterClass::kTwistDrill;
      c.cutting_diameter_mm = d;
      c.point_angle_rad = 2.0594885173533086;
      c.maximum_speed_rpm = 12345.678;
      c.life_min = 17.3;
      c.teeth = 2;
      c.pocket = 3;
      c.centre_cutting = true;
      c.hand = model::Hand::kLeft;
      plan.cutters.push_back(c);
    }
    plan.provenance.push_back({"machine", "generic_vmc", "built-in default"});
    plan.provenance.push_back({"aaa", "", ""});
    model::StepResult s;
    s.step = inner;
    s.cutter_id = "D10";
    s.feed_mm_min = 1234.567;
    s.vc_m_min = 269.98523;
    s.fz_mm = 0.08;
    s.cutting_s = 12.3;
    s.flood = true;
    plan.steps.push_back(s);
  }
};

std::map<std::string, std::string> ledger(const model::Plan& plan) {
  const Addresses names(plan, [&](model::AnyRef at) { return at.index + 1; });
  const auto place = [&](const model::DecisionKey& k) {
    return names.from({}, k.object) + "." + k.attribute;
  };
  std::map<std::string, std::string> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    const auto& why = plan.ledger.reason(d.reason);
    std::string text = std::string(d.state == model::DecisionState::kOpen ? "open " : "bound ") +
                       std::string(model::to_text(d.binder)) + (d.pinned ? " pinned " : " ") + why.id + "|" +
                       why.text + "|" + why.source + "|" + d.lexeme + "|";
    for (const auto& k : d.depends_on) text += place(k) + " ";
    for (const auto& r : d.rejected) text += "; not " + r.what + ": " + r.why;
    out[place(key)] = text;
  }
  return out;
}

TEST(Ap238Records, WhoBoundWhatSurvivesTheFile) {
  const Bound b;
  const std::string bytes = written(b.plan).bytes;
  const auto again = read_text(bytes);
  EXPECT_EQ(ledger(b.plan), ledger(again));
  EXPECT_EQ(ledger(again).size(), 4U);
  EXPECT_EQ(again.machine.id, b.plan.machine.id);
  EXPECT_EQ(again.machine.description, b.plan.machine.description);
  EXPECT_EQ(again.material, b.plan.material);
  EXPECT_EQ(again.cutters, b.plan.cutters);
  EXPECT_EQ(again.provenance, b.plan.provenance);
  EXPECT_EQ(again.stock.box, b.plan.stock.box);
  EXPECT_EQ(again.stock.source, "--stock");
  EXPECT_EQ(again.stock.cylinder_radius_mm, 12.7);
  ASSERT_EQ(again.steps.size(), 1U);
  const auto& s = again.steps[0];
  EXPECT_EQ(s.feed_mm_min, 1234.567);
  EXPECT_EQ(s.vc_m_min, 269.98523);
  EXPECT_EQ(s.cutting_s, 12.3);
  EXPECT_TRUE(s.flood);
  EXPECT_FALSE(s.mist);
  EXPECT_EQ(again.model.at<model::Executable>(s.step).persistent_id, "7b1c");
  const std::string twice = written(again).bytes;
  EXPECT_TRUE(twice.substr(twice.find("DATA;")) == bytes.substr(bytes.find("DATA;")));
}

TEST(Ap238Records, AreProcessPropertiesOfTheExecutableWithAnItemForEachField) {
  const Bound b;
  const auto lines = shapes(written(b.plan).bytes);
  EXPECT_THAT(lines, Contains("MACHINING_PROCESS_PROPERTY('capstan binding','',#);"));
  EXPECT_THAT(lines, Contains("MACHINING_PROCESS_PROPERTY('capstan identity','',#);"));
  EXPECT_THAT(lines, Contains("ACTION_PROPERTY_REPRESENTATION('','',#,#);"));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('attribute','its_elements');"));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('bound by','rule');"));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('rejected[1].why','one tool change more');"));
  // The nested plan from the main one, and the main one from the nested; a colon in the name is escaped.
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('depends on[1]','{WORKPLAN:set-up 1%3A "
                              "top}.its_elements');"));
  EXPECT_THAT(lines,
              Contains("DESCRIPTIVE_REPRESENTATION_ITEM('depends on[1]','{WORKPLAN:main}.its_elements');"));
  EXPECT_THAT(lines, Contains(HasSubstr("('cutting diameter')")));
  EXPECT_THAT(lines, Contains("DESCRIPTIVE_REPRESENTATION_ITEM('life [min]','17.3');"));
}

/// Every instance gets another number, and the file another order.
std::string renumbered(const std::string& bytes) {
  const auto data = bytes.find("DATA;\n") + 6;
  const auto end = bytes.find("ENDSEC;", data);
  std::string instances =
      std::regex_replace(bytes.substr(data, end - data), std::regex("#([0-9]+)"), "#9$017");
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < instances.size();) {
    const auto n = instances.find('\n', i) + 1;
    lines.push_back(instances.substr(i, n - i));
    i = n;
  }
  std::string out = bytes.substr(0, data);
  for (auto it = lines.rbegin(); it != lines.rend(); ++it) out += *it;
  return out + bytes.substr(end);
}

TEST(Ap238Records, DoNotMindNewInstanceNumbersAndAnotherOrder) {
  const Bound b;
  const std::string other = renumbered(written(b.plan).bytes);
  const auto again = read_text(other);
  EXPECT_EQ(ledger(b.plan), ledger(again));
  EXPECT_EQ(again.cutters, b.plan.cutters);
  EXPECT_EQ(again.provenance, b.plan.provenance);
}

TEST(Ap238Records, EditedValueIsGivenAgain) {
  const Bound b;
  std::string bytes = written(b.plan).bytes;
  const std::string before = "MACHINING_WORKPLAN('set-up 1: top'";
  const auto at = bytes.find(before);
  ASSERT_NE(at, std::string::npos) << bytes;
  bytes.replace(at, before.size(), "MACHINING_WORKPLAN('set-up 9: top'");
  std::vector<std::string> said;
  const auto again = read_text(bytes, &said);
  const auto before_edit = ledger(b.plan);
  const auto after = ledger(again);
  EXPECT_EQ(after.at("{WORKPLAN:set-up 9%3A top}.its_id").substr(0, 11), "bound given");
  EXPECT_EQ(after.at("{WORKPLAN:main}.its_elements").substr(0, 10), "bound rule");  // untouched
  EXPECT_EQ(after.size(), before_edit.size());
  EXPECT_THAT(said, Contains(HasSubstr("WORKPLAN.its_id was edited since it was bound by optimiser")));
}

// AP238 has a feature's operations by workingsteps alone; ISO 14649 lists them at the feature, and may not.
TEST(Ap238Records, OperationThatItsFeatureDoesNotListIsNotListedAfterwards) {
  for (const char* listed : {"(#20)", "()"}) {
    SCOPED_TRACE(listed);
    Job job;
    const std::string hole = std::string("ROUND_HOLE('HOLE',#4,") + listed + ",#81,#64,#58,$,#26)";
    const auto plan = exchange::testing::read_text(
        exchange::testing::part21(exchange::testing::drilled_plate({{17, hole}})), job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    const auto again = read_text(written(*plan).bytes);
    const auto holes = again.model.all(TypeId::kRoundHole);
    ASSERT_EQ(holes.size(), 1U);
    const auto& hole_again = again.model.at<model::ManufacturingFeature>(holes[0]);
    EXPECT_EQ(hole_again.its_operations.items.size(), std::string(listed) == "()" ? 0U : 1U);
    EXPECT_EQ(again.model.all(TypeId::kDrilling).size(), 1U);
  }
}

TEST(Ap238Records, OfAnotherKindAreProcessPropertiesLikeAnyOther) {
  const Bench b;
  std::string bytes = written(b.plan).bytes;
  std::vector<std::string> said;
  const auto at = bytes.find("ENDSEC;\nEND-ISO");
  const auto workplan = std::regex_replace(bytes, std::regex("[^]*#([0-9]+)=MACHINING_WORKPLAN[^]*"), "$1");
  bytes.insert(at, "#900=MACHINING_PROCESS_PROPERTY('capstan tea','',#" + workplan +
                       ");\n#901=MACHINING_PROCESS_PROPERTY('capstan binding','',#" + workplan + ");\n");
  const auto again = read_text(bytes, &said);
  EXPECT_THAT(written(again).bytes, HasSubstr("MACHINING_PROCESS_PROPERTY('capstan tea'"));
  EXPECT_THAT(said, Contains(HasSubstr("'capstan binding' is malformed; ignored [EXC-RECORD]")));
}

TEST(Ap238Addresses, LeadBackToWhatTheyName) {
  const Bound b;
  const Addresses names(b.plan, [&](model::AnyRef at) { return at.index + 1; });
  for (const model::AnyRef at : b.plan.model.all_below(TypeId::kExecutable)) {
    EXPECT_EQ(names.find(b.workplan, names.from(b.workplan, at)), at);
    EXPECT_EQ(names.find({}, names.from({}, at)), at);
  }
  EXPECT_EQ(names.from(b.workplan, b.workplan), "");
  for (const char* wrong :
       {"{WORKPLAN:main:2}", "{WORKPLAN:none}", "{}", "{NO_NOUN:x}", "{WORKPLAN", "its_elements[9]",
        "its_elements", "nothing.at.all", "{WORKPLAN:main}.x", "}", "[", ".", "{WORKPLAN:main:0}"}) {
    EXPECT_FALSE(names.find(b.workplan, wrong).set()) << wrong;
  }
}

// What cannot be meant is refused, as in ISO 14649.
struct Hostile {
  const char* what;
  const char* instances;
  const char* code;
};

class Ap238Hostile : public ::testing::TestWithParam<Hostile> {};

TEST_P(Ap238Hostile, IsRefusedAndSaysWhy) {
  Bench b;
  model::Workplan w;
  w.its_id = "inner";
  w.its_elements.given = true;
  b.step(w);
  std::string bytes = written(b.plan).bytes;
  const auto number = [&](const std::string& of) {
    return std::regex_replace(bytes, std::regex("[^]*#([0-9]+)=" + of + "[^]*"), "$1");
  };
  std::string extra = GetParam().instances;
  const auto put = [&](const std::string& name, const std::string& n) {
    for (auto at = extra.find(name); at != std::string::npos; at = extra.find(name))
      extra.replace(at, name.size(), n);
  };
  put("MAIN", number("MACHINING_WORKPLAN\\('main'"));
  put("INNER", number("MACHINING_WORKPLAN\\('inner'"));
  bytes.insert(bytes.find("ENDSEC;\nEND-ISO"), extra);
  Job job;
  const auto plan = read_bytes(bytes, "t.stpnc", {}, job);
  EXPECT_FALSE(plan.has_value());
  std::vector<std::string> said;
  for (const auto& d : job.diagnostics()) said.push_back(to_text(d));
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("error"), HasSubstr(GetParam().code))));
}

INSTANTIATE_TEST_SUITE_P(
    Files, Ap238Hostile,
    ::testing::Values(Hostile{"WorkplanInItself",
                              "#900=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#MAIN,#MAIN,9.);\n",
                              "EXC-CYCLE"},
                      Hostile{"WorkplanInOneBelowIt",
                              "#900=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#INNER,#MAIN,9.);\n",
                              "EXC-CYCLE"}),
    [](const auto& given) { return std::string(given.param.what); });

// As the reader sees them: written from a model that holds them.
std::vector<std::string> said_of(const model::Plan& plan, bool* accepted) {
  Job job;
  const auto back = read_bytes(written(plan).bytes, "t.stpnc", {}, job);
  *accepted = back.has_value();
  std::vector<std::string> said;
  for (const auto& d : job.diagnostics()) said.push_back(to_text(d));
  return said;
}

TEST(Ap238Meaning, DirectionsHaveLength) {
  Bench b;
  auto& m = b.plan.model;
  model::CartesianPoint p;
  p.coordinates.items = {0, 0, 0};
  p.coordinates.given = true;
  model::Direction d;
  d.direction_ratios.items = {0, 0, 0};
  d.direction_ratios.given = true;
  model::Axis2Placement3d frame;
  frame.location = m.add(p);
  frame.axis = m.add(d);
  const auto placed = m.add(frame);
  m.at<model::Workplan>(b.workplan).toolpath_orientation = placed;
  bool accepted = true;
  EXPECT_THAT(said_of(b.plan, &accepted), Contains(AllOf(HasSubstr("error"), HasSubstr("EXC-GEOMETRY"))));
  EXPECT_FALSE(accepted);
}

TEST(Ap238Meaning, SizesAreNotNegative) {
  Bench b;
  auto& m = b.plan.model;
  model::CartesianPoint p;
  p.coordinates.items = {0, 0, 0};
  p.coordinates.given = true;
  model::Axis2Placement3d frame;
  frame.location = m.add(p);
  model::Block block;
  block.position = m.add(frame);
  block.x = -10.0;
  block.y = 10.0;
  block.z = 10.0;
  const auto bounds = m.add(block);
  m.at<model::Workpiece>(b.workpiece).its_bounding_geometry = bounds;
  bool accepted = true;
  EXPECT_THAT(said_of(b.plan, &accepted), Contains(AllOf(HasSubstr("error"), HasSubstr("EXC-SIZE"))));
  EXPECT_FALSE(accepted);
}

}  // namespace
}  // namespace capstan::exchange::ap238
