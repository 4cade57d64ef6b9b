#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// Holes of explicit moves that call one subprogram: written by the control's own, and followed beside the
// plan.

namespace capstan::mutation {
namespace {

namespace plans = verify::testing;
using model::MoveRole;

/// Three holes in one step, pecked: the chip is cleared once.
model::Plan three_holes() {
  auto k = plans::empty_plan();
  k.plan.machine.spindle.spin_up_s = 1.0;
  model::CutterPath p;
  p.start({15, 15, 10});
  for (const double x : {15.0, 40.0, 65.0}) {
    if (x > 15.0) p.rapid({x, 15, 10});
    p.rapid({x, 15, 2});
    p.line({x, 15, -7.3}, MoveRole::kDrill);
    p.rapid({x, 15, 2}, MoveRole::kRetract);
    p.line({x, 15, -6.8}, MoveRole::kLink);
    p.line({x, 15, -16}, MoveRole::kDrill);
    p.rapid({x, 15, 10}, MoveRole::kRetract);
  }
  k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", p, 225, 1500);
  k.plan.machine = controls::with_control(std::move(k.plan.machine), "fanuc");
  k.plan.machine.control_options = model::ControlOptions{{{"cycles", "explicit"}, {"subprograms", "7001"}}};
  k.plan.setups[0].work_offset = std::string(controls::find_dialect("fanuc")->work_offsets[0]);
  return k.plan;
}

/// Departures of the text from the plan.
std::string departures(const model::Plan& plan, const std::string& text) {
  Job job;
  std::string out;
  for (const auto& f : verify::check_program({"a.nc", text, ""}, &plan, plan.machine, plan.cutters, job)) {
    const bool of_text = f.code.starts_with("CHK-TEXT") || f.code == "CHK-UNVERIFIABLE" ||
                         f.code == "CHK-END" || f.code == "CHK-CODE" || f.code == "CHK-WORD" ||
                         f.code == "CHK-SYNTAX";
    if (of_text) out += f.code + " " + f.message + "\n";
  }
  return out;
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from << "\n" << text;
  return text.find(from) == std::string::npos ? text : text.replace(text.find(from), from.size(), to);
}

TEST(Subprograms, EqualHolesAreCallsThatAreFollowedMoveForMove) {
  const model::Plan plan = three_holes();
  Job job;
  const auto text = controls::write_program(plan, job);
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_NE(text->find("\nM98 P7001\nG0 X40.\nM98 P7001\nG0 X65.\nM98 P7001\n"), std::string::npos) << *text;
  EXPECT_EQ(departures(plan, *text), "") << *text;
  for (const auto& [from, to] :
       {std::pair{"G1 Z-16.", "G1 Z-16.003"}, std::pair{"G0 X40.\nM98 P7001\n", "G0 X40.\n"},
        std::pair{"G0 X40.\nM98 P7001", "G0 X40.\nM98 P7002"},
        std::pair{"G0 X40.\nM98 P7001", "G0 X40.\nM98 P7001\nM98 P7001"}, std::pair{"\nM99\n", "\n"},
        std::pair{"\nO7001\n", "\nO7003\n"}, std::pair{"%\nO0001\n", "%\nO7001\n"}})
    EXPECT_NE(departures(plan, replaced(*text, from, to)), "") << to;
}

// The same text is no program of a Haas: its M98 calls a program of the list.
TEST(Subprograms, OfAHaasAreNotFollowed) {
  model::Plan plan = three_holes();
  Job job;
  const auto text = controls::write_program(plan, job);
  ASSERT_TRUE(text) << to_text(text.error());
  plan.machine = controls::with_control(std::move(plan.machine), "haas");
  plan.machine.control_options = model::ControlOptions{{{"cycles", "explicit"}}};
  EXPECT_NE(departures(plan, *text).find("M98"), std::string::npos) << departures(plan, *text);
}

}  // namespace
}  // namespace capstan::mutation
