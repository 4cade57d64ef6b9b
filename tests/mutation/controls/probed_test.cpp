#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// Touches that the machine's macro makes: written where their way is clear, read back, and held to it.

namespace capstan::mutation {
namespace {

namespace plans = verify::testing;

struct Touched {
  geometry::Vec3 from, along;
  double distance = 0.0;
};

constexpr double kBall = 3.0;
constexpr const char* kMacro = "G65 P9810 X{x} Y{y} Z{z} | G65 P9811 {axis}{nominal} T{probe}";

/// A pocket, this touch, and a drilled hole; a jaw 5 mm high beside the piece's front.
model::Plan measured(const Touched& t, const std::string& dialect,
                     std::vector<model::ControlOption> more = {}) {
  auto k = plans::good_plan();
  model::Plan& plan = k.plan;
  model::TouchProbe probe;
  probe.its_id = "probe";
  probe.ball_radius = kBall;
  model::ToolUsage usage;
  usage.its_position = "20";
  probe.its_usage = plan.model.add(usage);
  model::Direction along;
  along.direction_ratios = {{t.along.x, t.along.y, t.along.z}, true};
  model::WorkpieceProbing p;
  p.its_id = "P measure +z";
  p.start_position = k.at(t.from.x, t.from.y, t.from.z);
  p.direction = plan.model.add(along);
  p.expected_value = k.length(t.distance);
  p.its_probe = plan.model.add(probe);
  model::Workplan w;
  w.its_elements.items = {plan.steps[0].step, plan.model.add(p), plan.steps[1].step};
  model::Project project;
  project.main_workplan = plan.model.add(w);
  plan.project = plan.model.add(project);
  plan.machine = controls::with_control(std::move(plan.machine), dialect);
  more.push_back({"probe_macro", kMacro});
  plan.machine.control_options = model::ControlOptions{std::move(more)};
  plan.setups[0].work_offset = std::string(controls::find_dialect(dialect)->work_offsets[0]);
  auto& holding = plan.setups[0].holding;
  holding.solids.push_back({"jaw", "jaw", {{0, -40}, {100, -40}, {100, 0}, {0, 0}}, -50, -45, true});
  holding.clearance_mm = 2.0;
  return plan;
}
const Touched kTop{{80, 80, 8}, {0, 0, -1}, 5.0};  // the ball meets Z0
const std::vector<model::ControlOption> kProbe{{"probe_radius_mm", "25"}, {"probe_stylus_mm", "50"}};

std::string text_of(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}
std::string found(const model::Plan& plan, const std::string& text) {
  Job job;
  std::string out;
  for (const auto& f : verify::check_program({"a.nc", text, ""}, &plan, plan.machine, plan.cutters, job))
    if (f.severity == Severity::kError) out += f.code + " " + f.message + "\n";
  return out;
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(has(text, from)) << from << "\n" << text;
  return has(text, from) ? text.replace(text.find(from), from.size(), to) : text;
}

TEST(ProbeMacro, ATouchWhoseWayIsClearIsMadeByTheMachinesMacroAndTheStopStays) {
  for (const char* dialect : {"fanuc", "haas", "siemens"}) {
    const model::Plan plan = measured(kTop, dialect, kProbe);
    const std::string text = text_of(plan);
    const bool points = std::string(dialect) != "siemens";
    const std::string macro = points ? "\nG65 P9810 X80. Y80. Z8.\nG65 P9811 Z0. T20\n"
                                     : "\nG65 P9810 X80 Y80 Z8\nG65 P9811 Z0 T20\n";
    EXPECT_TRUE(has(text, macro)) << text;
    const std::size_t at = text.find(macro);
    EXPECT_LT(at, text.find("\nM0\n", at)) << "it stops behind it";
    EXPECT_EQ(found(plan, text), "") << text;
  }
}

TEST(ProbeMacro, BesideThePieceTheStylusGoesDownWhereTheProbeStaysAbove) {
  const Touched side{{110, 50, -5}, {-1, 0, 0}, 7.0};
  const model::Plan plan = measured(side, "fanuc", kProbe);
  const std::string text = text_of(plan);
  EXPECT_TRUE(has(text, "\nG65 P9810 X110. Y50. Z-5.\nG65 P9811 X100. T20\n")) << text;
  EXPECT_EQ(found(plan, text), "");
  const model::Plan tight = measured(side, "fanuc", {{"probe_radius_mm", "25"}, {"probe_stylus_mm", "4"}});
  EXPECT_FALSE(has(text_of(tight), "G65"));
  EXPECT_NE(found(tight, text).find("CHK-PROBE-WAY"), std::string::npos);
}

TEST(ProbeMacro, WhatIsNotProvenClearStaysAStopThatSaysWhy) {
  const auto says = [](const Touched& t, std::vector<model::ControlOption> more, const char* why) {
    const model::Plan plan = measured(t, "haas", std::move(more));
    const std::string text = text_of(plan);
    EXPECT_FALSE(has(text, "G65")) << text;
    EXPECT_TRUE(has(text, why)) << why << "\n" << text;
    EXPECT_EQ(found(plan, text), "");
  };
  says({{50, 50, -5}, {1, 0, 0}, 17.0}, kProbe,
       "by hand, not by the macro: its way is not proven clear of the piece");
  says({{50, -4, -30}, {0, 1, 0}, 3.0}, kProbe,
       "by hand, not by the macro: its way is not proven clear of the piece");
  says(kTop, {}, "probe_radius_mm");
  says({{80, 80, 8}, {0, 0.6, -0.8}, 5.0}, kProbe, "along no axis");
  // Down to where the jaw stands: 5 mm of its height and 2 of clearance.
  says({{50, -20, -41}, {0, 1, 0}, 17.0}, {{"probe_radius_mm", "5"}, {"probe_stylus_mm", "100"}},
       "clear of jaw");
}

// Without its point X12 is 0.012 mm on one machine and 12 mm on another: FANUC parameter 3401, Haas settings
// 77 and 162. A Siemens counts millimetres, and zero is zero.
TEST(ProbeMacro, APlaceWithoutADecimalPointIsFoundWhereAControlMayCountThousandths) {
  const Touched at{{12, 80, 8}, {0, 0, -1}, 5.0};
  for (const char* dialect : {"fanuc", "haas"}) {
    const model::Plan plan = measured(at, dialect, kProbe);
    const std::string text = text_of(plan);
    const std::string call = "G65 P9810 X12. Y80. Z8.\nG65 P9811 Z0. T20\n";
    ASSERT_EQ(found(plan, text), "") << text;
    for (const char* other :
         {"G65 P9810 X12 Y80. Z8.\nG65 P9811 Z0. T20\n", "G65 P9810 X12. Y80 Z8.\nG65 P9811 Z0. T20\n",
          "G65 P9810 X12. Y80. Z8\nG65 P9811 Z0. T20\n"})
      EXPECT_NE(found(plan, replaced(text, call, other)), "") << dialect << " " << other;
    EXPECT_EQ(found(plan, replaced(text, call, "G65 P9810 X12.0 Y80. Z8.\nG65 P9811 Z0 T20\n")), "");
  }
  const model::Plan siemens = measured(at, "siemens", kProbe);
  const std::string text = text_of(siemens);
  EXPECT_TRUE(has(text, "G65 P9810 X12 Y80 Z8\n")) << text;
  EXPECT_EQ(found(siemens, text), "");
}

TEST(ProbeMacro, AMacroElsewhereOrOtherwiseIsFound) {
  const model::Plan plan = measured(kTop, "fanuc", kProbe);
  const std::string text = text_of(plan);
  const std::string macro = "G65 P9810 X80. Y80. Z8.\nG65 P9811 Z0. T20\n";
  ASSERT_EQ(found(plan, text), "");
  for (const auto& [from, to] : {std::pair{"X80. Y80. Z8.", "X80. Y80.01 Z8."},
                                 std::pair{"Z8.\nG65", "Z6.\nG65"}, std::pair{"P9811 Z0.", "P9811 Z-2."},
                                 std::pair{"P9811 Z0.", "P9811 X0."}, std::pair{"Z0. T20", "Z0. T2"}})
    EXPECT_NE(found(plan, replaced(text, from, to)), "") << to;
  const std::string without = replaced(text, macro, "");
  EXPECT_EQ(found(plan, without), "") << "by hand";
  EXPECT_NE(found(plan, replaced(text, macro, macro + macro)), "") << "twice";
  EXPECT_TRUE(has(found(plan, replaced(without, "\nM30", "\n" + macro + "M30")), "CHK-PROBE-CALL"));
  // Before the tool is away; and without going there again behind it.
  const std::string away = "G0 G49 G53 Z0.\nM5\nM9\n";
  EXPECT_NE(found(plan, replaced(text, macro + away, macro)), "");
  model::Plan same = plan;
  same.cutters[0].pocket = 2;
  EXPECT_TRUE(has(found(same, text), "CHK-PROBE-CALL"));
}

}  // namespace
}  // namespace capstan::mutation
