// Equal holes of one step as each control writes them: read back equal to the plan, and found by the check
// where one of their places, their number or their order is another.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "planner/proof/verify/verify.h"
#include "tests/controls/control_plans.h"

namespace capstan::service {
namespace {

using controls::plans::pattern_plan;
using controls::plans::program_of;
using controls::plans::ring;
using Places = std::vector<geometry::Vec2>;

const Places kGrid = {{10, 10}, {86, 10}, {10, 70}, {86, 70}}, kRow = {{20, 20}, {33.333, 25}, {46.666, 30}};

/// The codes of property 32, that the text is the plan, and of what cannot be followed.
std::set<std::string> against(const std::string& text, const model::Plan& plan) {
  Job job;
  std::set<std::string> out;
  for (const auto& f : verify::check_program({"program", text, ""}, &plan, plan.machine, plan.cutters, job)) {
    if (f.severity == Severity::kError) out.insert(f.code);
  }
  return out;
}

model::Plan with_cycles(const char* control, const Places& places) {
  model::Plan plan = pattern_plan(control, places);
  controls::plans::choose(plan, "cycles", "feature");
  return plan;
}

TEST(ProgramPatterns, AreReadBackEqualForEveryControlThatHasCycles) {
  for (const char* control : {"linuxcnc", "fanuc", "haas", "siemens", "heidenhain", "mach3"}) {
    for (const Places& places :
         {kGrid, kRow, ring({50, 40}, 30, -30, 60, 6), ring({7.7, -3.1}, 41.3, 11, 17, 5)}) {
      const model::Plan plan = with_cycles(control, places);
      const std::string text = program_of(plan);
      EXPECT_THAT(against(text, plan), ::testing::IsEmpty()) << control << "\n" << text;
    }
  }
}

TEST(ProgramPatterns, AreFoundWhereAPlaceOrTheirNumberIsAnother) {
  struct Spoilt {
    const char* control;
    Places places;
    const char *from, *to;
  };
  const Places circle = ring({50, 40}, 30, 0, 60, 6);
  const std::vector<Spoilt> all = {
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40,30.01,0,60,6)"},
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40.01,30,0,60,6)"},
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40,30,0,60,5)"},
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40,30,0,60,7)"},
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40,30,60,60,6)"},
      {"siemens", circle, "HOLES2(50,40,30,0,60,6)", "HOLES2(50,40,30,0,-60,6)"},
      {"siemens", {{20, 20}, {40, 20}, {60, 20}}, "HOLES1(20,20,0,0,20,3)", "HOLES1(20,20,0,0,20.01,3)"},
      {"siemens", {{20, 20}, {40, 20}, {60, 20}}, "HOLES1(20,20,0,0,20,3)", "HOLES1(20,20,0.1,0,20,3)"},
      {"siemens", {{20, 20}, {40, 20}, {60, 20}}, "HOLES1(20,20,0,0,20,3)", "HOLES1(20,20,0,1,20,3)"},
      {"siemens", {{20, 20}, {40, 20}, {60, 20}}, "HOLES1(20,20,0,0,20,3)\n", ""},
      {"siemens", kGrid, "G0 X10 Y70\n", "G0 X10 Y70.01\n"},
      {"fanuc", kGrid, "\nX10. Y70.\n", "\nX10. Y70.01\n"},
      {"fanuc", kGrid, "\nX10. Y70.\n", "\n"},
      {"fanuc", kGrid, "\nX10. Y70.\n", "\nX10. Y70. R12.\n"},
      {"fanuc", kGrid, "\nX10. Y70.\n", "\nX10. Y70. Z-19.\n"},
      {"haas", kGrid, "\nX10. Y70.\n", "\nG99 X10. Y70.\n"},
      {"linuxcnc", kGrid, "\nX10 Y70\n", "\nX10 Y70.01\n"},
      {"heidenhain", kGrid, "L X+10 Y+70 R0 FMAX M99", "L X+10 Y+70 R0 FMAX"},
      {"heidenhain", kGrid, "L X+10 Y+70 R0 FMAX M99", "L X+10 Y+70.01 R0 FMAX M99"},
  };
  for (const Spoilt& s : all) {
    const model::Plan plan = with_cycles(s.control, s.places);
    std::string text = program_of(plan);
    const std::size_t at = text.find(s.from);
    ASSERT_NE(at, std::string::npos) << s.control << ": " << s.from << "\n" << text;
    text.replace(at, std::string(s.from).size(), s.to);
    EXPECT_THAT(against(text, plan), ::testing::Not(::testing::IsEmpty())) << s.control << ": " << s.to;
  }
}

}  // namespace
}  // namespace capstan::service
