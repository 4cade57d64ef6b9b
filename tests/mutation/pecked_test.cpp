#include <gtest/gtest.h>

#include <string>

#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"
#include "planner/proof/verify/verify.h"
#include "tests/mutation/emitted.h"

// Pecks that a control's cycle makes: written by the control's own, read back by its reader, and followed
// beside the plan.

namespace capstan::mutation {
namespace {

std::string told(const std::vector<model::Finding>& findings) {
  std::string out;
  for (const auto& f : findings) out += f.code + " " + f.message + "\n";
  return out;
}

/// What the plan by itself is not found for.
std::vector<model::Finding> check(const Emitted& e, const std::string& text) {
  Job job;
  auto all = verify::check_program({e.name, text, e.table}, &e.plan, e.plan.machine, e.plan.cutters, job);
  std::erase_if(all, [&](const model::Finding& f) { return e.found.contains(f.code); });
  return all;
}

TEST(PeckedProgram, ACycleThatMakesThePlansPecksIsWrittenAndFollowed) {
  for (const char* dialect : {"linuxcnc", "fanuc", "haas", "siemens", "heidenhain"}) {
    for (const Emitted& e : emitted_pecked(dialect)) {
      const bool cycle =
          e.text.find("G83 ") != std::string::npos || e.text.find("G73 ") != std::string::npos ||
          e.text.find("CYCLE83(") != std::string::npos || e.text.find("CYCL DEF 203 ") != std::string::npos ||
          e.text.find("CYCL DEF 205 ") != std::string::npos;
      EXPECT_TRUE(cycle) << dialect << ", " << e.name << "\n" << e.text;
      const auto findings = check(e, e.text);
      EXPECT_TRUE(findings.empty()) << dialect << ", " << e.name << "\n" << told(findings) << e.text;
    }
  }
}

TEST(BoredProgram, ACycleThatStopsTheSpindleIsWrittenAndFollowed) {
  for (const auto& [dialect, cycle] :
       {std::pair{"siemens", "CYCLE86("}, std::pair{"heidenhain", "CYCL DEF 202 "}}) {
    for (const Emitted& e : emitted_bored(dialect)) {
      EXPECT_NE(e.text.find(cycle), std::string::npos) << e.text;
      const auto findings = check(e, e.text);
      EXPECT_TRUE(findings.empty()) << dialect << ", " << e.name << "\n" << told(findings) << e.text;
    }
  }
}

TEST(TappedProgram, ACompensatingChuckHasTheCycleForItAndNoOtherTap) {
  const Emitted chuck = emitted_chuck("siemens");
  EXPECT_NE(chuck.text.find("\nF750\nMCALL CYCLE840(5,4,1,-12,,0,4,3,0,,1.5)\n"), std::string::npos)
      << chuck.text;
  EXPECT_EQ(told(check(chuck, chuck.text)), "") << chuck.text;
  Emitted rigid = chuck;
  const auto* step = rigid.plan.model.get<model::MachiningWorkingstep>(rigid.plan.steps[1].step);
  rigid.plan.model.get<model::Tapping>(step->its_operation)->compensation_chuck = false;
  EXPECT_NE(told(check(rigid, rigid.text)).find("CHK-TEXT-TAP"), std::string::npos);
}

/// The check's words on the program with one text of it replaced.
std::string with(const Emitted& e, const std::string& from, const std::string& to) {
  std::string text = e.text;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  if (text.find(from) != std::string::npos) text.replace(text.find(from), from.size(), to);
  return told(check(e, text));
}

TEST(PeckedProgram, APlantedFaultInAHeidenhainCycleIsFound) {
  for (const Emitted& e : emitted_pecked("heidenhain")) {
    const bool broken = e.name == "chips broken";
    EXPECT_NE(with(e, "Q202=+8 ", "Q202=+8.003 "), "") << e.name;
    EXPECT_NE(with(e, "Q203=-2 ", "Q203=-2.003 "), "") << e.name;
    EXPECT_NE(with(e, "Q212=+0 ", "Q212=+0.5 "), "") << e.name;
    EXPECT_NE(with(e, "Q211=+0 ", "Q211=+0.5 "), "") << e.name;
    if (broken) {
      EXPECT_NE(with(e, "Q213=+3 ", "Q213=+1 "), "");
      EXPECT_NE(with(e, "Q256=+0.5 ", "Q256=+0.7 "), "");
      EXPECT_NE(with(e, "Q208= MAX ", "Q208=+300 "), "");
    } else {
      EXPECT_NE(with(e, "Q258=+0.5 ", "Q258=+0 "), "") << e.name;
      EXPECT_NE(with(e, "Q259=+0.5 ", "Q259=+0.2 "), "") << e.name;
      EXPECT_NE(with(e, "Q257=+0 ", "Q257=+3 "), "") << e.name;
      EXPECT_NE(with(e, "Q200=+8 ", "Q200=+4 "), "") << e.name;  // comes back to 2 in place of 6
    }
  }
  for (const Emitted& e : emitted_bored("heidenhain")) {
    EXPECT_NE(with(e, "CYCL DEF 202 BORING", "CYCL DEF 203 BORING"), "");
    EXPECT_NE(with(e, "Q214=+0 ", "Q214=+2 "), "");
    EXPECT_NE(with(e, "Q208= MAX ", "Q208=+300 "), "");
  }
  for (const Emitted& e : emitted_bored("siemens")) {
    EXPECT_NE(with(e, ",3,0,0,0,0)", ",3,0.2,0,0,0)"), "");
    EXPECT_NE(with(e, ",3,0,0,0,0)", ",4,0,0,0,0)"), "");
  }
  const Emitted chuck = emitted_chuck("siemens");
  EXPECT_NE(with(chuck, ",4,3,0,,1.5)", ",4,3,0,,1.25)"), "");
  EXPECT_NE(with(chuck, ",4,3,0,,1.5)", ",3,3,0,,1.5)"), "");
  EXPECT_NE(with(chuck, ",4,3,0,,1.5)", ",4,3,1,,1.5)"), "");
}

TEST(PeckedProgram, ARapidIntoTheBottomIsADeparture) {
  // The machine's file says that G83 is fed again where it was fed to.
  for (Emitted& e : emitted_pecked("haas")) {
    if (e.name == "chips broken") continue;
    e.plan.machine.control_options = model::ControlOptions{{{"peck_clearance_mm", "0"}}};
    EXPECT_NE(told(check(e, e.text)).find("between pecks"), std::string::npos) << e.name;
  }
}

}  // namespace
}  // namespace capstan::mutation
