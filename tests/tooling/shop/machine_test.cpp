#include "tooling/shop/machine/machine.h"

#include <gtest/gtest.h>

#include "tests/support/corpus.h"
#include "tooling/shop/data/data.h"

namespace capstan::tooling {
namespace {

TEST(ShippedMachines, AreReadWithoutARemarkAndEachValueHasASource) {
  EXPECT_EQ(shipped_machines().size(), 6u);
  for (const std::string& id : shipped_machines()) {
    Job job;
    const auto m = load_machine(id, job);
    ASSERT_TRUE(m) << id << ": " << m.error().message;
    EXPECT_EQ(m->id, id);
    EXPECT_TRUE(job.diagnostics().empty());
    EXPECT_GE(m->sources.size(), 25u);
    for (const auto& [path, source] : m->sources) EXPECT_FALSE(source.empty()) << path;
  }
}

TEST(ShippedMachines, FillTheOtherOfPowerAndTorque) {
  Job job;
  const auto m = load_machine("generic_vmc", job).value();
  ASSERT_EQ(m.spindle.curve.size(), 3u);
  // P = 2 pi n M / 60: 7500 W at 1500 1/min is 47.746 Nm, and that torque at 60 1/min is 300 W.
  EXPECT_NEAR(m.spindle.curve[1].torque_nm, 47.746, 1e-3);
  EXPECT_NEAR(m.spindle.curve[0].power_w, 300.0, 0.01);
}

TEST(LoadMachine, NamesTheShippedOnesWhenThereIsNoSuchFile) {
  Job job;
  const auto m = load_machine("no_such_machine.yaml", job);
  ASSERT_FALSE(m);
  EXPECT_NE(m.error().hint.find("generic_vmc"), std::string::npos);
}

TEST(LoadMachine, RefusesAnUnknownNameWithTheNearestOnes) {
  Job job;
  const auto m = load_machine("smal_router", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "NAME-UNKNOWN");
  EXPECT_EQ(m.error().message, "unknown machine 'smal_router'. Did you mean 'small_router'?");
  EXPECT_NE(m.error().hint.find("capstan machines list"), std::string::npos);
}

struct Slip {
  const char* name;
  const char* from;
  const char* to;
  const char* code;
  const char* path;
};
void PrintTo(const Slip& s, std::ostream* out) { *out << s.name; }

class HostileMachine : public ::testing::TestWithParam<Slip> {};

TEST_P(HostileMachine, IsRefusedWithTheFaultTheLineAndThePlace) {
  std::string text = shipped_text("machines/generic_vmc.yaml");
  const auto at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().from).size(), GetParam().to);
  Job job;
  const auto m = read_machine(text, "shop.yaml", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, GetParam().code) << to_text(m.error());
  EXPECT_EQ(m.error().path, GetParam().path);
  EXPECT_EQ(m.error().file, "shop.yaml");
  EXPECT_GT(m.error().line, 0u);
  EXPECT_TRUE(job.diagnostics().empty()) << to_text(job.diagnostics().front());
}

INSTANTIATE_TEST_SUITE_P(
    Machines, HostileMachine,
    ::testing::Values(
        Slip{"min above max", "travel_min_mm: -380", "travel_min_mm: 400", "MACHINE-RANGE",
             "axes.X.travel_min_mm"},
        Slip{"zero acceleration", "acceleration_mm_s2: 3000", "acceleration_mm_s2: 0", "MACHINE-ACCELERATION",
             "axes.X.acceleration_mm_s2"},
        Slip{"backward curve", "{rpm: 1500, power_w: 7500}", "{rpm: 50, power_w: 7500}", "MACHINE-CURVE",
             "spindle.curve"},
        Slip{"curve too short", "{rpm: 10000, power_w: 7500}", "{rpm: 9000, power_w: 7500}", "MACHINE-CURVE",
             "spindle.curve"},
        Slip{"revolutions per second", "rpm_max: 10000", "rpm_max: 166.7", "MACHINE-RPM", "spindle.rpm_max"},
        Slip{"unknown axis", "  Z: {", "  W: {travel_min_mm: 0, travel_max_mm: 1}\n  Z: {", "MACHINE-AXIS",
             "axes.W"},
        Slip{"unknown key", "taper: BT40", "tapper: BT40", "DATA-UNKNOWN", "spindle.tapper"},
        Slip{"not a number", "rpm_min: 60", "rpm_min: 6O", "DATA-NUMBER", "spindle.rpm_min"},
        Slip{"infinite", "spin_up_s: 1.5", "spin_up_s: 1e400", "DATA-NUMBER", "spindle.spin_up_s"},
        Slip{"given twice", "rpm_min: 60", "rpm_min: 60\n  rpm_min: 60", "DATA-DUPLICATE", ""},
        Slip{"override as percent", "feed_override_max: 1.2", "feed_override_max: 120", "MACHINE-RANGE",
             "abilities.feed_override_max"},
        Slip{"more axes at once than there are", "simultaneous_axes: 3", "simultaneous_axes: 5",
             "MACHINE-RANGE", "abilities.control_axes"},
        Slip{"unknown ability", "control_axes: 3", "axes_of_control: 3", "DATA-UNKNOWN",
             "abilities.axes_of_control"},
        Slip{"half a pocket", "pockets: 24", "pockets: 23.5", "DATA-NUMBER", "magazine.pockets"},
        Slip{"negative cost", "cost_per_hour: 60", "cost_per_hour: -1", "MACHINE-RANGE", "cost_per_hour"}));

TEST(ReadMachine, SeesRevolutionsPerSecondWherePowerAndTorqueAreBothGiven) {
  std::string text = shipped_text("machines/generic_vmc.yaml");
  const std::string point = "- {rpm: 10000, power_w: 7500}";
  // 7500 W and 7.162 Nm belong to 10000 1/min, which is 166.67 rev/s.
  text.replace(text.find(point), point.size(), "- {rpm: 10000, power_w: 450000, torque_nm: 7.162}");
  Job job;
  const auto m = read_machine(text, "shop.yaml", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "MACHINE-RPM");
}

TEST(ReadMachine, WantsASourceForEveryNumber) {
  std::string text = shipped_text("machines/generic_vmc.yaml");
  const auto at = text.find("source:");
  text.erase(at, text.find('\n', at) - at);
  Job job;
  const auto m = read_machine(text, "shop.yaml", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "DATA-SOURCE");
  EXPECT_GE(job.diagnostics().size(), 20u);  // all of them are told
}

TEST(Gears, TheFirstIsInUseUnlessAnotherIsNamed) {
  Job job;
  const auto high = load_machine("tormach_1100mx", job).value();
  ASSERT_EQ(high.spindle.gears.size(), 2u);
  EXPECT_DOUBLE_EQ(high.spindle.rpm_min, 250.0);
  EXPECT_EQ(high.spindle.curve, high.spindle.gears[0].curve);
  const auto low = load_machine("tormach_1100mx:low", job).value();
  EXPECT_DOUBLE_EQ(low.spindle.rpm_min, 70.0);
  EXPECT_DOUBLE_EQ(low.spindle.rpm_max, 1500.0);
  EXPECT_EQ(low.spindle.curve, high.spindle.gears[1].curve);
  const auto none = load_machine("tormach_1100mx:third", job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "MACHINE-GEAR");
  EXPECT_NE(none.error().expected.find("high, low"), std::string::npos);
}

TEST(Gears, TheLowRangeNeverGivesMoreThanTheHighOneOverEitherRatio) {
  Job job;
  const auto m = load_machine("tormach_1100mx", job).value();
  const auto power = [](const std::vector<model::SpindlePoint>& curve, double rpm) {
    for (std::size_t i = 1; i < curve.size(); ++i) {
      if (rpm > curve[i].rpm) continue;
      const double t = (rpm - curve[i - 1].rpm) / (curve[i].rpm - curve[i - 1].rpm);
      return curve[i - 1].power_w + t * (curve[i].power_w - curve[i - 1].power_w);
    }
    return curve.back().power_w;
  };
  const auto& high = m.spindle.gears[0].curve;
  const auto& low = m.spindle.gears[1].curve;
  for (double n = 70.0; n <= 1500.0; n += 5.0)
    EXPECT_LE(power(low, n), std::min(power(high, n * 250.0 / 70.0), power(high, n * 5.0)) + 0.1) << n;
}

std::string with_gears(const std::string& gears) {
  std::string text = shipped_text("machines/tormach_1100mx.yaml");
  const auto a = text.find("  gears:"), b = text.find("magazine:");
  return text.replace(a, b - a, gears);
}

TEST(Gears, AreRefusedLikeASpindleThatHasOne) {
  const std::pair<const char*, const char*> cases[] = {
      {"  gears: []\n", "DATA-MISSING"},
      {"  gears: [{id: a, rpm_min: 900, rpm_max: 700, curve: [{rpm: 700, power_w: 1}]}]\n", "MACHINE-RANGE"},
      {"  gears: [{id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 700, power_w: 1}, {rpm: 100, power_w: "
       "1}]}]\n",
       "MACHINE-CURVE"},
      {"  gears: [{id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 100, power_w: 1}, {rpm: 600, power_w: "
       "1}]}]\n",
       "MACHINE-CURVE"},
      {"  gears: [{id: a, rpm_min: 10, rpm_max: 170, curve: [{rpm: 10, power_w: 1}, {rpm: 170, power_w: "
       "1}]}]\n",
       "MACHINE-RPM"},
      {"  gears: [{id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 100, power_w: 1}, {rpm: 700, power_w: "
       "1}],"
       " curve_s6: [{rpm: 700, power_w: 2}, {rpm: 100, power_w: 2}]}]\n",
       "MACHINE-CURVE"},
      {"  gears: [{id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 100, power_w: 1}, {rpm: 700, power_w: "
       "1}]},"
       " {id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 100, power_w: 1}, {rpm: 700, power_w: 1}]}]\n",
       "DATA-DUPLICATE"}};
  for (const auto& [gears, code] : cases) {
    Job job;
    const auto m = read_machine(with_gears(gears), "shop.yaml", job);
    ASSERT_FALSE(m) << gears;
    EXPECT_EQ(m.error().code, code) << gears << to_text(m.error());
  }
}

TEST(Gears, KeepTheRatingForIntermittentRunning) {
  Job job;
  const auto m = read_machine(
      with_gears("  gears: [{id: a, rpm_min: 100, rpm_max: 700, curve: [{rpm: 100, power_w: 1}, {rpm: 700, "
                 "power_w: 1}], curve_s6: [{rpm: 100, power_w: 2}, {rpm: 700, power_w: 2}]}]\n"),
      "shop.yaml", job);
  ASSERT_TRUE(m) << to_text(m.error());
  ASSERT_EQ(m->spindle.gears.size(), 1u);
  EXPECT_EQ(m->spindle.gears[0].curve_s6.size(), 2u);
  EXPECT_DOUBLE_EQ(m->spindle.curve[0].power_w, 1.0);  // S1 rules
}

TEST(ReadMachine, DoesNotDieOfDepth) {
  Job job;
  const auto m = read_machine(std::string(1000000, '['), "deep.yaml", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "DATA-SYNTAX");
}

constexpr const char* kIni = R"([EMC]
MACHINE = mill
[TRAJ]
LINEAR_UNITS = inch
MAX_LINEAR_VELOCITY = 1.5
[AXIS_X]
MIN_LIMIT = 0
MAX_LIMIT = 18.0   # inch
MAX_VELOCITY = 2
MAX_ACCELERATION = 9.0
[AXIS_Y]
MIN_LIMIT = 0
MAX_LIMIT = 9.5
MAX_VELOCITY = 1.5
MAX_ACCELERATION = 9.0
[AXIS_Z]
MIN_LIMIT = -20
MAX_LIMIT = 0
MAX_VELOCITY = 1
MAX_ACCELERATION = 6.0
)";

TEST(LinuxcncIni, IsConvertedToMillimetresAndMinutes) {
  Job job;
  const auto m = read_linuxcnc_ini(kIni, "mill.ini", job).value();
  EXPECT_DOUBLE_EQ(m.axes[0].travel_max_mm, 18.0 * 25.4);
  EXPECT_DOUBLE_EQ(m.axes[0].rapid_mm_min, 2.0 * 25.4 * 60.0);
  EXPECT_DOUBLE_EQ(m.axes[0].feed_max_mm_min, 1.5 * 25.4 * 60.0);
  EXPECT_DOUBLE_EQ(m.axes[2].acceleration_mm_s2, 6.0 * 25.4);
  EXPECT_EQ(job.count(Severity::kWarning), 1u);  // the spindle is assumed, and that is said
}

TEST(LinuxcncIni, IsRefusedWithoutAUnitOrWithAZeroAcceleration) {
  Job job;
  std::string text = kIni;
  text.replace(text.find("LINEAR_UNITS"), 5, "XXXXX");
  EXPECT_EQ(read_linuxcnc_ini(text, "mill.ini", job).error().code, "MACHINE-INI");
  text = kIni;
  text.replace(text.find("MAX_ACCELERATION = 9.0"), 22, "MAX_ACCELERATION = 0.0");
  const auto m = read_linuxcnc_ini(text, "mill.ini", job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "MACHINE-ACCELERATION");
}

TEST(LinuxcncIni, ReadsTheMachinesOfTheCorpus) {
  CAPSTAN_CORPUS_FILE(folder, "tools/machines/");
  for (const char* name :
       {"configs_by_machine_tormach_pcnc-1100-seriesII.ini", "configs_sim_axis_axis.ini"}) {
    Job job;
    const auto m = load_machine(folder + name, job);
    ASSERT_TRUE(m) << name << ": " << to_text(m.error());
    EXPECT_GT(m->axes[2].acceleration_mm_s2, 0.0);
  }
}

TEST(ReadMachine, ReadsModesOfTheToolPoint) {
  const std::string plain = shipped_text("machines/generic_vmc.yaml");
  const auto read = [&](const std::string& rows) {
    Job job;
    return read_machine(plain + "\nmodes:\n" + rows, "shop.yaml", job);
  };
  const auto m = read(
      "  - {direction: x, frequency_hz: 922, damping_ratio: 0.011, stiffness_n_mm: 1340, source: tap}\n"
      "  - {cutter: em12, direction: y, frequency_hz: 800, damping_ratio: 0.03, stiffness_n_mm: 9e3, source: "
      "tap}\n");
  ASSERT_TRUE(m) << m.error().message;
  ASSERT_EQ(m->modes.size(), 2u);
  EXPECT_EQ(m->modes[0].cutter_id, "");
  EXPECT_EQ(m->modes[1].cutter_id, "em12");
  EXPECT_EQ(m->modes[1].stiffness_n_mm, 9000.0);
  const auto refused = [&](const char* row) {
    return read(std::string("  - {source: tap, ") + row + "}\n").error();
  };
  EXPECT_EQ(refused("direction: z, frequency_hz: 922, damping_ratio: 0.01, stiffness_n_mm: 1340").code,
            "MACHINE-RANGE");
  EXPECT_EQ(refused("direction: x, frequency_hz: 922, damping_ratio: 1.1, stiffness_n_mm: 1340").path,
            "modes[0].damping_ratio");
  EXPECT_EQ(refused("direction: x, frequency_hz: -1, damping_ratio: 0.01, stiffness_n_mm: 1340").path,
            "modes[0].frequency_hz");
  EXPECT_EQ(refused("direction: x, frequency_hz: 922, damping_ratio: 0.01").code, "DATA-MISSING");
}

}  // namespace
}  // namespace capstan::tooling
