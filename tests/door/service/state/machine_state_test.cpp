#include "planner/door/service/state/machine_state.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/door/service/options.h"

namespace capstan::service {
namespace {

/// A spindle of 10 kW from 1000 1/min on.
model::Machine machine() {
  constexpr double kTorque = 10e3 * 60.0 / (2.0 * std::numbers::pi * 1000.0);
  model::Machine m;
  m.id = "mill";
  const auto axis = [](const char* name, double from_mm, double to_mm) {
    model::LinearAxis out;
    out.name = name;
    out.travel_min_mm = from_mm;
    out.travel_max_mm = to_mm;
    return out;
  };
  m.axes = {axis("X", 0.0, 400.0), axis("Y", 0.0, 300.0), axis("Z", -250.0, 0.0)};
  m.spindle.curve = {{100.0, 0.1 * 10e3, kTorque}, {1000.0, 10e3, kTorque}, {8000.0, 10e3, kTorque / 8.0}};
  return m;
}

Request with(const std::string& option, const std::string& value) {
  Request r;
  const auto ok = set(r, option, value);
  EXPECT_TRUE(ok) << (ok ? "" : to_text(ok.error()));
  return r;
}

struct Taken {
  model::Machine machine;
  std::vector<model::Provenance> rows;
  std::string said;
};
Taken taken(const Request& r, model::Machine m = machine()) {
  Taken out{std::move(m), {}, {}};
  Job job;
  take_state(r.state, "--", out.machine, out.rows, job);
  for (const Diagnostic& d : job.diagnostics()) out.said += to_text(d) + "\n";
  return out;
}

TEST(MachineState, WithoutOneTheMachineIsAsItsFileHasIt) {
  const Taken out = taken({});
  EXPECT_EQ(out.machine, machine());
  EXPECT_TRUE(out.rows.empty());
  EXPECT_EQ(out.said, "");
}

TEST(MachineState, ASpindlesPowerIsCappedWithItsTorqueWhereItIsMore) {
  const Taken out = taken(with("spindle-power", "4"));
  const auto& was = machine().spindle.curve;
  const auto& is = out.machine.spindle.curve;
  EXPECT_EQ(is[0], was[0]);  // 1 kW there
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_DOUBLE_EQ(is[i].power_w, 4e3);
    EXPECT_DOUBLE_EQ(is[i].torque_nm, 0.4 * was[i].torque_nm);
  }
  ASSERT_EQ(out.rows.size(), 1U);
  EXPECT_EQ(out.rows[0].value, "4 kW");
  EXPECT_EQ(out.rows[0].source, "--spindle-power");
}

TEST(MachineState, OfASpindleThatStatesTorqueAloneThePowerOfThatIsCapped) {
  model::Machine m = machine();
  m.spindle.curve = {{3000.0, 0.0, 20.0}};
  const double power_w = 20.0 * 2.0 * std::numbers::pi * 3000.0 / 60.0;
  const Taken out = taken(with("spindle-power", "2"), m);
  EXPECT_EQ(out.machine.spindle.curve[0].power_w, 0.0);
  EXPECT_DOUBLE_EQ(out.machine.spindle.curve[0].torque_nm, 20.0 * 2e3 / power_w);
}

TEST(MachineState, SaidAgainChangesNothingMore) {
  for (const auto& [option, value] : {std::pair{"spindle-power", "3.3"}, {"feed-override", "80"}}) {
    const Request r = with(option, value);
    const Taken once = taken(r);
    EXPECT_EQ(taken(r, once.machine).machine, once.machine) << option;
  }
}

TEST(MachineState, AnOverrideBelowTheWholeFeedIsToldAndMoreIsNoValue) {
  EXPECT_NE(taken(with("feed-override", "80")).said.find("80 % of the programmed feeds"), std::string::npos);
  EXPECT_EQ(taken(with("feed-override", "100")).said, "");
  for (const char* more : {"101", "120", "0", "-5"}) {
    Request r;
    EXPECT_FALSE(set(r, "feed-override", more)) << more;
  }
}

TEST(MachineState, WhatIsNoPowerAndNoRangeIsRefused) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"spindle-power", "0"},
                                                        {"spindle-power", "-1"},
                                                        {"spindle-power", "nan"},
                                                        {"spindle-power", "60%"}}) {
    Request r;
    EXPECT_FALSE(set(r, option, value)) << option << " " << value;
  }
}

TEST(MachineState, LimitsOfAxesAndWorkOffsetsAreRecordedAndMoveNothing) {
  Request r = with("axis-limits", "X=-50:350,Z=-200:-5.5");
  ASSERT_TRUE(set(r, "work-offset", "G54:X=120,Y=80,Z=-310;G55:Z=1,Y=2,X=3"));
  const Taken out = taken(r);
  EXPECT_EQ(out.machine, machine());
  ASSERT_EQ(out.rows.size(), 2U);
  EXPECT_EQ(out.rows[0].value, "X=-50:350,Z=-200:-5.5");
  EXPECT_EQ(out.rows[1].value, "G54:X=120,Y=80,Z=-310;G55:X=3,Y=2,Z=1");
}

TEST(MachineState, WhatIsNoRangeOrNoPlaceIsNoValue) {
  Request r;
  for (const char* text : {"X", "X=", "X=1", "X=1:", "X=:1", "=0:1", "X=2:1", "X=1:1", "X=0:nan", "X=0:1e999",
                           "X=0:1,", "X=0:1,X=0:2", "X=0:1;Y=0:1"})
    EXPECT_FALSE(set(r, "axis-limits", text)) << text;
  for (const char* text : {"X=1", "X=1,Y=2", "X=1,Y=2,Z=", "X=1,Y=2,Z=3,", "X=1,Y=2,Z=3,X=4", "X=1,Y=2,W=3",
                           "X=1,Y=2,Z=inf", ":X=1,Y=2,Z=3", "G54:X=1,Y=2,Z=3;G54:X=1,Y=2,Z=3",
                           "X=1,Y=2,Z=3;G55:X=1,Y=2,Z=3", "G55:X=1,Y=2,Z=3;X=1,Y=2,Z=3", "X1,Y2,Z3"})
    EXPECT_FALSE(set(r, "work-offset", text)) << text;
  EXPECT_TRUE(r.state.axis_limits.empty());
  EXPECT_TRUE(r.state.work_offsets.empty());
}

}  // namespace
}  // namespace capstan::service
