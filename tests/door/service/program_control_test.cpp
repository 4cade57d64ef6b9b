#include <gtest/gtest.h>

#include <string>

#include "planner/door/service/check.h"
#include "tests/support/shop.h"

// For which control a program is checked that nobody names one for.

namespace capstan::service {
namespace {

const std::string kFanuc =
    "%\nO0001\nG21 G17 G90 G94 G40 G80 G49\nG28 Z0.\nT1 M6\nG54\nS1000 M3\nM29 S1000\nM5\nM30\n%\n";
const std::string kLinuxCnc = "G21 G17 G90 G94 G40 G80 G49\nG64 P0.01\nM5\nM2\n";

struct Said {
  std::string notes, findings, code, message, hint;
};
Said checked(Request request, std::vector<Source> sources) {
  Job job;
  const auto result = check(request, std::move(sources), {}, job);
  Said out;
  for (const auto& d : job.diagnostics()) out.notes += to_text(d) + "\n";
  if (!result) {
    out.code = result.error().what.code;
    out.message = result.error().what.message;
    out.hint = result.error().what.hint;
    return out;
  }
  for (const auto& f : result->findings) out.findings += f.finding.code + ": " + f.finding.message + "\n";
  return out;
}
bool told(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(ProgramControl, AProgramOfAnotherControlIsReadAsThatOnesAndItIsTold) {
  const Said said = checked(pipeline::kAsksNothing, {{"x.nc", kFanuc}});
  EXPECT_EQ(said.code, "");
  EXPECT_TRUE(told(said.notes, "read as a program of Fanuc, for O0001, a program number is in line 2"))
      << said.notes;
  EXPECT_FALSE(told(said.findings, "O-words, parameters")) << said.findings;
}

TEST(ProgramControl, AProgramThatTheControlReadsIsReadAsBefore) {
  const Said said = checked(pipeline::kAsksNothing, {{"x.ngc", kLinuxCnc}});
  EXPECT_EQ(said.code, "");
  EXPECT_FALSE(told(said.notes, "APP-CONTROL")) << said.notes;
}

TEST(ProgramControl, ANamedControlCounts) {
  Request request = pipeline::kAsksNothing;
  request.control = "linuxcnc";
  const Said said = checked(request, {{"x.nc", kFanuc}});
  EXPECT_EQ(said.code, "");
  EXPECT_TRUE(told(said.findings, "O-words, parameters")) << said.findings;
}

TEST(ProgramControl, BesideAMachineOfAnotherControlItIsRefusedWithTheOption) {
  Request request = pipeline::kAsksNothing;
  request.machine = "generic_vmc";
  const Said said = checked(request, {{"x.nc", kFanuc}});
  EXPECT_EQ(said.code, "OPTION-CONTROL");
  EXPECT_TRUE(told(said.message, "written for Fanuc (O0001, a program number), and the machine for LinuxCNC"))
      << said.message;
  EXPECT_TRUE(told(said.hint, "--control fanuc")) << said.hint;
}

TEST(ProgramControl, TwoProgramsOfTwoControlsAreRefused) {
  const Said said = checked(pipeline::kAsksNothing, {{"x.nc", kFanuc}, {"y.ngc", kLinuxCnc}});
  EXPECT_EQ(said.code, "OPTION-CONTROL") << said.notes;
}

}  // namespace
}  // namespace capstan::service
