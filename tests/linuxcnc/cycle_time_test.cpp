#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <sstream>

#include "planner/ground/base/job.h"
#include "planner/ground/base/number.h"
#include "tests/linuxcnc/planned.h"
#include "tests/linuxcnc/simulator.h"
#include "tests/linuxcnc/times.h"
#include "tests/support/corpus.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::linuxcnc {
namespace {

/// Where LinuxCNC is absent or cannot start, a test says so and is skipped.
#define CAPSTAN_NEEDS_LINUXCNC(record) \
  if (!(record).absent.empty()) GTEST_SKIP() << (record).absent

double moving_s(const Record& r) {
  double out = 0.0;
  for (const double v : r.speed_mm_s) out += v > 0.0 ? kServoPeriod : 0.0;
  return out;
}

std::string ini_value(const std::string& section, const std::string& key) {
  std::istringstream lines(
      testing::slurp(capstan::testing::source_dir() + "/examples/linuxcnc/machine/machine.ini"));
  std::string in;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) in = line;
    if (in == "[" + section + "]" && line.starts_with(key + " = ")) return line.substr(key.size() + 3);
  }
  return {};
}

TEST(SimulatedMachine, HasTheLimitsOfItsMachineFile) {
  Job job;
  const auto machine = tooling::load_machine("linuxcnc_axis_mm", job);
  ASSERT_TRUE(machine) << to_text(machine.error());
  for (std::size_t i = 0; i < 3; ++i) {
    const model::LinearAxis& axis = machine->axes[i];
    const std::string sections[] = {"AXIS_" + axis.name, "JOINT_" + std::to_string(i)};
    for (const std::string& s : sections) {
      EXPECT_EQ(parse_double(ini_value(s, "MIN_LIMIT")), axis.travel_min_mm) << s;
      EXPECT_EQ(parse_double(ini_value(s, "MAX_LIMIT")), axis.travel_max_mm) << s;
      EXPECT_NEAR(parse_double(ini_value(s, "MAX_VELOCITY")).value_or(0.0), axis.rapid_mm_min / 60.0, 1e-9)
          << s;
      EXPECT_EQ(parse_double(ini_value(s, "MAX_ACCELERATION")), axis.acceleration_mm_s2) << s;
    }
  }
}

TEST(SimulatedMachine, TakesTheTimeThatItsLimitsGiveAtAnyRate) {
  // Exact stops (G61); 100 mm at 10 mm/s, 30 mm at 5 mm/s, and back by a rapid along X at 30.48 mm/s.
  const std::string program = "G21 G17 G90 G94 G54 G61\nG1 X100 F600\nG1 Y30 F300\nG4 P0.5\nG0 X0\nM2\n";
  const double a = 508.0;
  const double wanted = (100.0 / 10.0 + 10.0 / a) + (30.0 / 5.0 + 5.0 / a) + (100.0 / 30.48 + 30.48 / a);
  for (const double rate : {4.0, 16.0}) {
    const Record r = run({.program = program, .tools = "T1 P1 Z0 D6\n", .rate = rate});
    CAPSTAN_NEEDS_LINUXCNC(r);
    ASSERT_EQ(r.failed, "");
    // Each move is a whole number of servo periods, and ends in one more.
    EXPECT_NEAR(moving_s(r), wanted, 3 * 2 * kServoPeriod) << rate;
    EXPECT_NEAR(r.x_mm.back(), 0.0, 1e-6);
    EXPECT_NEAR(r.y_mm.back(), 30.0, 1e-6);
  }
}

TEST(SimulatedMachine, SaysWhyItRefusesAProgram) {
  const Record r = run({.program = "G21 G90 G54\nG1 X1000 F600\nM2\n", .tools = "T1 P1 Z0 D6\n"});
  CAPSTAN_NEEDS_LINUXCNC(r);
  EXPECT_THAT(r.failed, ::testing::HasSubstr("limit"));
}

/// The aim of the prediction: this close to the simulated machine.
constexpr double kWithin = 0.05;

void expect_predicted(const std::vector<std::string>& arguments) {
  const Planned p = plan(arguments);
  ASSERT_EQ(p.failed, "");
  const Record r = run({.program = p.program, .tools = p.tools, .offsets = offsets_for(p.plan)});
  CAPSTAN_NEEDS_LINUXCNC(r);
  ASSERT_EQ(r.failed, "");
  const auto foreseen = predicted(p.plan);
  ASSERT_TRUE(foreseen) << to_text(foreseen.error());
  const std::vector<StepSeconds> steps = measured(p.program, r);
  ASSERT_EQ(steps.size(), foreseen->steps.size());
  const Comparison c = compare(steps, *foreseen);
  std::cout << c.table;
  EXPECT_LE(std::abs(c.error()), kWithin);
}

TEST(CycleTime, OfTheBracketIsPredicted) {
  expect_predicted({"examples/bracket.p21", "--machine", "linuxcnc_axis_mm"});
}

TEST(CycleTime, OfTheSurfaceIsPredicted) {
  expect_predicted({"examples/surface.stl", "--material", "EN AW-6061", "--machine", "linuxcnc_axis_mm"});
}

TEST(CycleTime, OfTheReferencePocketIsPredicted) {
  expect_predicted({"examples/reference_pocket.p21", "--machine", "examples/reference_pocket_machine.yaml",
                    "--tools", "examples/reference_pocket_tools.yaml"});
}

}  // namespace
}  // namespace capstan::linuxcnc
