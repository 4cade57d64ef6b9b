// What a shop has to add to its tools so that all of a part is planned.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/checked.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/corner_rest.h"
#include "tests/door/pipeline/block.h"
#include "tooling/library/formats/own/own_list.h"

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A plain hole of 6.6 mm through the block, one of 8 H7, and a pocket with corners of R3, 10 mm deep.
const char* const kParts =
    "#61=TOLERANCED_LENGTH_MEASURE(6.6,$);\n"
    "#62=CARTESIAN_POINT('',(0.,0.,-20.));\n#67=AXIS2_PLACEMENT_3D('',#62,#21,#22);\n#68=PLANE('',#67);\n"
    "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
    "#66=ROUND_HOLE('PLAIN',#4,(),#65,#68,#61,$,#58);\n"
    "#70=PLUS_MINUS_VALUE(0.015,0.,3);\n#71=TOLERANCED_LENGTH_MEASURE(8.,#70);\n"
    "#72=CARTESIAN_POINT('',(80.,20.,0.));\n#73=AXIS2_PLACEMENT_3D('',#72,#21,#22);\n"
    "#74=ROUND_HOLE('FITTED',#4,(),#73,#68,#71,$,#58);\n"
    "#80=TOLERANCED_LENGTH_MEASURE(40.,$);\n#81=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
    "#82=TOLERANCED_LENGTH_MEASURE(3.,$);\n#83=RECTANGULAR_CLOSED_PROFILE($,#81,#80);\n"
    "#84=CLOSED_POCKET('POCKET',#4,(),#50,#56,(),$,#57,$,#82,#83);\n";

Inputs shop_with(const std::vector<std::string>& ids) {
  Inputs in = shop();
  std::erase_if(in.library,
                [&](const model::Cutter& c) { return std::find(ids.begin(), ids.end(), c.id) == ids.end(); });
  return in;
}

std::vector<std::string> entries_of(const model::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& p : plan.provenance) {
    if (p.what.starts_with("needed tool ")) out.push_back(p.value);
  }
  return out;
}

std::vector<model::Cutter> read_list(const std::vector<std::string>& entries) {
  std::string text = "capstan_tools: 1\nunit: mm\nsource: \"the list of what is needed\"\ntools:\n";
  for (const std::string& e : entries) text += "  - " + e + "\n";
  Job job;
  auto cutters = tooling::read_own_list(text, "needed.yaml", job);
  EXPECT_TRUE(cutters) << (cutters ? "" : to_text(cutters.error())) << "\n" << text;
  return cutters ? *std::move(cutters) : std::vector<model::Cutter>{};
}

TEST(NeededTools, AreListedAtOnceAndAddingExactlyThesePlansAllOfThePart) {
  const Inputs poor = shop_with({"generic/spot_drill_90/8", "generic/endmill_3f_short/16"});
  const Planned lacking = bound(read(kParts), poor);
  ASSERT_EQ(lacking.plan.unplanned.size(), 2U) << lacking.said;
  ASSERT_EQ(model::corner_rests(lacking.plan).size(), 1U) << "the pocket keeps corners of the wide mill";
  EXPECT_THAT(lacking.said, HasSubstr("to plan all of this part you need: "));
  const auto entries = entries_of(lacking.plan);
  ASSERT_FALSE(entries.empty());

  Inputs richer = poor;
  for (model::Cutter& c : read_list(entries)) richer.library.push_back(std::move(c));
  const Planned whole = bound(read(kParts), richer);
  EXPECT_THAT(whole.plan.unplanned, IsEmpty()) << whole.said;
  EXPECT_THAT(model::corner_rests(whole.plan), IsEmpty()) << whole.said;
  EXPECT_THAT(entries_of(whole.plan), IsEmpty());

  // Exactly these: without any one of them something is missing again.
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::vector<std::string> fewer = entries;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    Inputs less = poor;
    if (!fewer.empty())
      for (model::Cutter& c : read_list(fewer)) less.library.push_back(std::move(c));
    const model::Plan lacks = bound(read(kParts), less).plan;
    EXPECT_FALSE(lacks.unplanned.empty() && model::corner_rests(lacks).empty()) << entries[i];
  }
}

/// A shaped part in its own numbers: `at` places it, `below` is its depth.
struct Part {
  std::string text;
  int n = 100;
  std::string add(const std::string& noun) {
    text += "#" + std::to_string(++n) + "=" + noun + ";\n";
    return "#" + std::to_string(n);
  }
  std::string at(double x, double y) {
    const auto p = add("CARTESIAN_POINT('',(" + number(x) + "," + number(y) + ",0.))");
    return add("AXIS2_PLACEMENT_3D(''," + p + ",#21,#22)");
  }
  std::string below(double depth) {
    const auto p = add("CARTESIAN_POINT('',(0.,0.," + number(-depth) + "))");
    return add("PLANE(''," + add("AXIS2_PLACEMENT_3D(''," + p + ",#21,#22)") + ")");
  }
  std::string size(double v, double up = 0.1, double down = 0.1) {
    const auto t = add("PLUS_MINUS_VALUE(" + number(up) + "," + number(down) + ",3)");
    return add("TOLERANCED_LENGTH_MEASURE(" + number(v) + "," + t + ")");
  }
  std::string hole(const std::string& name, double x, double y, double d, double depth, const char* bottom,
                   double up = 0.1, double down = 0.1) {
    const auto where = at(x, y), to = below(depth), wide = size(d, up, down), end = add(bottom);
    return add("ROUND_HOLE('" + name + "',#4,()," + where + "," + to + "," + wide + ",$," + end + ")");
  }
  void thread(const std::string& name, double x, double y, double depth, const std::string& in, double major,
              double pitch, const char* hand) {
    const auto where = at(x, y), to = below(depth);
    const auto part = add("PARTIAL_AREA_DEFINITION(" + number(depth) + "," + where + ",$)");
    const auto fit = add("DESCRIPTIVE_PARAMETER('fit class','6H')"),
               form = add("DESCRIPTIVE_PARAMETER('form','M')");
    const auto count = add("NUMERIC_PARAMETER('threads per mm'," + number(1.0 / pitch) + ",'mm')");
    const auto turn = add(std::string("DESCRIPTIVE_PARAMETER('hand','") + hand + "')");
    add("DEFINED_THREAD('" + name + "',#4,()," + where + "," + to + "," + part + ",(" + in + "),.T.,$," +
        fit + "," + form + "," + number(major) + "," + count + "," + turn + "," +
        number(major - 0.65 * pitch) + "," + number(major - pitch) + ",$)");
  }
  void pocket(const std::string& name, double x, double y, double l, double w, double depth, double radius) {
    const auto where = at(x, y), to = below(depth), width = size(w), length = size(l),
               corner = size(radius, 0.2, 0.2);
    const auto profile = add("RECTANGULAR_CLOSED_PROFILE($," + width + "," + length + ")");
    add("CLOSED_POCKET('" + name + "',#4,()," + where + "," + to + ",(),$,#57,$," + corner + "," + profile +
        ")");
  }
  static std::string number(double v) { return trimmed(v, 6) + (v == std::floor(v) ? "." : ""); }
};

constexpr const char* kThrough = "THROUGH_BOTTOM_CONDITION()";
constexpr const char* kPoint = "CONICAL_HOLE_BOTTOM(118.,$)";
constexpr const char* kFlat = "FLAT_HOLE_BOTTOM()";

std::vector<std::pair<std::string, std::string>> parts() {
  std::vector<std::pair<std::string, std::string>> out;
  const auto keep = [&](const char* name, const Part& p) { out.emplace_back(name, p.text); };
  Part holes;
  holes.hole("THROUGH", 20, 20, 6.6, 20, kThrough);
  holes.hole("BLIND", 50, 20, 6, 14, kPoint);
  holes.hole("SLENDER", 80, 20, 2.5, 20, kThrough);
  holes.hole("WIDE", 50, 60, 30, 20, kThrough);
  keep("holes", holes);
  Part reamed;
  reamed.hole("H7 THROUGH", 20, 20, 6, 20, kThrough, 0.012, 0.0);
  reamed.hole("H7 BLIND", 60, 20, 10, 15, kPoint, 0.015, 0.0);
  keep("reamed bores", reamed);
  Part threads;
  threads.thread("M6", 20, 20, 12, threads.hole("CORE 6", 20, 20, 5, 17, kPoint, 0.2, 0.05), 6, 1, "right");
  threads.thread("M8 LEFT", 60, 20, 12, threads.hole("CORE 8", 60, 20, 6.8, 17, kFlat, 0.2, 0.05), 8, 1.25,
                 "left");
  keep("threads", threads);
  Part deep;
  deep.pocket("NARROW", 50, 50, 60, 12, 18, 3);
  keep("a deep and narrow pocket", deep);
  Part corners;
  corners.pocket("CORNERS", 50, 50, 40, 30, 12, 1.6);
  keep("a pocket with small corners", corners);
  Part flat;
  flat.hole("FLAT", 50, 50, 18, 12, kFlat);
  keep("a flat bottom", flat);
  return out;
}

TEST(NeededToolsProperty, OfAnEmptyShopPlanAllOfThePartInOneGo) {
  for (const auto& [name, text] : parts()) {
    const Inputs empty = shop_with({"generic/endmill_3f_short/16"});
    const Planned lacking = bound(read(text), empty);
    const auto entries = entries_of(lacking.plan);
    EXPECT_FALSE(entries.empty()) << name << "\n" << lacking.said;
    Inputs richer = empty;
    for (model::Cutter& c : read_list(entries)) richer.library.push_back(std::move(c));
    const Planned whole = bound(read(text), richer);
    EXPECT_THAT(whole.plan.unplanned, IsEmpty()) << name << "\n" << whole.said;
    EXPECT_THAT(entries_of(whole.plan), IsEmpty()) << name;
  }
}

/// Three features that lack a tool each, and how what they need is told.
struct Lacking {
  model::Plan plan;
  std::vector<model::NeededTool> needed;
  Inputs poor;

  Lacking() : poor(shop_with({"generic/spot_drill_90/8", "generic/endmill_3f_short/16"})) {
    const auto cutters = read_list(entries_of(bound(read(kParts), poor).plan));
    plan = read(kParts);
    const std::vector<std::string> names = {"PLAIN", "FITTED", "POCKET"};
    EXPECT_GE(cutters.size(), names.size());
    for (std::size_t i = 0; i < std::min(cutters.size(), names.size()); ++i) {
      const model::AnyRef f = feature(plan, names[i]);
      plan.unplanned.push_back({.feature = f, .reason = "no tool"});
      needed.push_back({f, names[i], cutters[i], names[i]});
    }
  }
  /// The plan where these features are left out.
  [[nodiscard]] model::Plan without(const std::vector<std::string>& names) const {
    model::Plan out = plan;
    std::erase_if(out.unplanned, [&](const model::Unplanned& u) {
      return std::none_of(names.begin(), names.end(),
                          [&](const std::string& n) { return feature(plan, n) == u.feature; });
    });
    return out;
  }
  [[nodiscard]] Planned named(const Planner& planner, const Inputs& inputs) const {
    Job job;
    auto out = name_needed(plan, needed, inputs, {}, planner, job);
    EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
    Planned p{out ? *std::move(out) : model::Plan{}, {}};
    for (const auto& d : job.diagnostics()) p.said += to_text(d) + "\n";
    return p;
  }
};

TEST(NeededTools, OneThatBendsIsNotNamedAndTheOthersPlanMoreOfThePart) {
  const Lacking l;
  int plannings = 0;
  const Planned p = l.named(
      [&](const Inputs&, Job&) -> Result<model::Plan> {
        ++plannings;
        return l.without({"FITTED"});
      },
      l.poor);
  EXPECT_EQ(plannings, 2);
  EXPECT_EQ(entries_of(p.plan).size(), 2U) << p.said;
  EXPECT_THAT(p.said, HasSubstr("to plan more of this part you need: "));
  EXPECT_THAT(p.said, ::testing::Not(HasSubstr("'FITTED'")));
}

// With a wide mill alone the pocket is planned, but not as it is stated.
TEST(NeededTools, OneThatLeavesRestInTheCornersIsNotNamed) {
  const Lacking l;
  const Planned p = l.named(
      [&](const Inputs&, Job&) -> Result<model::Plan> {
        model::Plan out = l.without({});
        out.provenance.push_back(model::provenance_of({"POCKET", 3.0, 12.5, "no mill is narrower"}));
        return out;
      },
      l.poor);
  EXPECT_EQ(entries_of(p.plan).size(), 2U) << p.said;
  EXPECT_THAT(p.said, HasSubstr("to plan more of this part you need: "));
  EXPECT_THAT(p.said, ::testing::Not(HasSubstr("'POCKET'")));
}

TEST(NeededTools, WhereTheSecondProofDropsOneTooTheRestIsToldAsNotProved) {
  const Lacking l;
  int plannings = 0;
  const Planned p = l.named(
      [&](const Inputs&, Job&) -> Result<model::Plan> {
        return l.without(++plannings == 1 ? std::vector<std::string>{"FITTED"}
                                          : std::vector<std::string>{"FITTED", "POCKET"});
      },
      l.poor);
  EXPECT_EQ(plannings, 2);
  EXPECT_EQ(entries_of(p.plan).size(), 1U) << p.said;
  EXPECT_THAT(p.said, HasSubstr("to plan more of this part you need at least: "));
  EXPECT_THAT(p.said, HasSubstr("(not proved: "));
}

TEST(NeededTools, AreToldAlsoWhereTheirProofFails) {
  const Lacking l;
  const Planned p = l.named(
      [](const Inputs&, Job&) -> Result<model::Plan> { return fail("TEST", "no such luck"); }, l.poor);
  EXPECT_EQ(entries_of(p.plan).size(), 3U) << p.said;
  EXPECT_THAT(p.said, HasSubstr("to plan all of this part you need at least: "));
  EXPECT_THAT(p.said, HasSubstr("(not proved: planning with them fails: no such luck)"));
}

TEST(NeededTools, OfAnEditedPlanAreNotProved) {
  const Lacking l;
  Inputs edited = l.poor;
  edited.edits.emplace_back();
  const Planned p = l.named(
      [](const Inputs&, Job&) -> Result<model::Plan> { return fail("TEST", "not to be planned"); }, edited);
  EXPECT_EQ(entries_of(p.plan).size(), 3U) << p.said;
  EXPECT_THAT(p.said, HasSubstr("to plan all of this part you need at least: "));
}

TEST(NeededTools, OfOneKindAreOneToolForAllFeaturesThatAskForIt) {
  const Inputs poor = shop_with({"generic/spot_drill_90/8"});
  const Planned p = bound(read(kTwoHoles), poor);
  ASSERT_EQ(p.plan.unplanned.size(), 2U) << p.said;
  const auto entries = entries_of(p.plan);
  ASSERT_EQ(entries.size(), 1U) << p.said;
  EXPECT_THAT(entries[0], HasSubstr("class: twist_drill"));
  EXPECT_THAT(entries[0], HasSubstr("cutting_diameter: 8,"));
  const auto row = std::find_if(p.plan.provenance.begin(), p.plan.provenance.end(),
                                [](const auto& x) { return x.what == "needed tool 1"; });
  EXPECT_EQ(row->source, "for 'H1', 'H2'");
}

TEST(NeededTools, AreNotNamedWhereNoToolWouldHelp) {
  // This machine's spindle is too weak for any drill.
  Inputs weak = shop_with({"generic/spot_drill_90/8"});
  for (auto& point : weak.machine.spindle.curve) point.torque_nm *= 1e-6, point.power_w *= 1e-6;
  const Planned p = bound(read(kTwoHoles), weak);
  ASSERT_FALSE(p.plan.unplanned.empty());
  EXPECT_THAT(entries_of(p.plan), IsEmpty()) << p.said;
}

}  // namespace
}  // namespace capstan::pipeline
