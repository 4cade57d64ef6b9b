#include <gtest/gtest.h>

#include <string>

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

std::vector<model::Finding> check(const Emitted& e, const std::string& text) {
  Job job;
  return verify::check_program({e.name, text, e.table}, &e.plan, e.plan.machine, e.plan.cutters, job);
}

TEST(PeckedProgram, ACycleThatMakesThePlansPecksIsWrittenAndFollowed) {
  for (const char* dialect : {"linuxcnc", "fanuc", "haas", "siemens"}) {
    for (const Emitted& e : emitted_pecked(dialect)) {
      const bool cycle = e.text.find("G83 ") != std::string::npos ||
                         e.text.find("G73 ") != std::string::npos ||
                         e.text.find("CYCLE83(") != std::string::npos;
      EXPECT_TRUE(cycle) << dialect << ", " << e.name << "\n" << e.text;
      const auto findings = check(e, e.text);
      EXPECT_TRUE(findings.empty()) << dialect << ", " << e.name << "\n" << told(findings) << e.text;
    }
  }
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
