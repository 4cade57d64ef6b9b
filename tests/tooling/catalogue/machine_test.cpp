#include "tooling/catalogue/machine.h"

#include <gtest/gtest.h>

#include "tests/support/corpus.h"
#include "tooling/catalogue/data.h"

namespace capstan::tooling {
namespace {

TEST(ShippedMachines, AreReadWithoutARemarkAndEachValueHasASource) {
  EXPECT_EQ(shipped_machines().size(), 4u);
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
  const auto m = load_machine("no_such_machine", job);
  ASSERT_FALSE(m);
  EXPECT_NE(m.error().hint.find("generic_vmc"), std::string::npos);
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

}  // namespace
}  // namespace capstan::tooling
