#include "planner/physics/mechanics/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

model::ToolPointMode mode(const char* direction, double f, double zeta, double k) {
  return {
      .cutter_id = "", .direction = direction, .frequency_hz = f, .damping_ratio = zeta, .stiffness_n_mm = k};
}

// m 0.03993 kg, 922 Hz, zeta 0.011, Kt 600, Kn 200 N/mm2, two teeth: the example of Insperger & Stepan 2004
// ("Updated semi-discretization method ..."), as later papers repeat it [S]. k = m w^2 = 1340 N/mm.
const std::vector<model::ToolPointMode> kInsperger = {mode("x", 922.0, 0.011, 1340.0),
                                                      mode("y", 922.0, 0.011, 1340.0)};
const std::vector<model::ToolPointMode> kTwoModes = {
    mode("x", 620.0, 0.035, 6000.0), mode("y", 700.0, 0.03, 7000.0), mode("x", 1500.0, 0.04, 20000.0)};

/// Whether the cut dies out, by the clock: straight teeth, each at its own angle, chips from what the tooth
/// before left, modes integrated in small steps. Nothing in common with the lobes.
bool dies_out(const std::vector<model::ToolPointMode>& modes, const ChatterCut& cut, double n_rpm,
              double depth_mm) {
  const double period = 60.0 / (cut.teeth * n_rpm);
  double fastest = 0.0;
  for (const auto& m : modes) fastest = std::max(fastest, m.frequency_hz);
  const int steps = std::max(200, static_cast<int>(std::ceil(period * fastest * 150.0)));
  const double dt = period / steps;
  struct State {
    double q = 0.0, v = 0.0;
  };
  std::vector<State> state(modes.size());
  for (auto& s : state) s.q = 1e-3;
  std::vector<double> old_x(static_cast<std::size_t>(steps), 0.0), old_y = old_x;
  double early = 0.0, late = 0.0;
  constexpr int kPeriods = 240;
  for (int t = 0; t < kPeriods * steps; ++t) {
    const auto slot = static_cast<std::size_t>(t % steps);
    double x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < modes.size(); ++i) (modes[i].direction == "x" ? x : y) += state[i].q;
    const double dx = x - old_x[slot], dy = y - old_y[slot];
    double fx = 0.0, fy = 0.0;
    const double turned = 2.0 * kPi * t / (static_cast<double>(steps) * cut.teeth);
    for (int j = 0; j < cut.teeth; ++j) {
      double a = turned + 2.0 * kPi * j / cut.teeth;
      a -= 2.0 * kPi * std::floor(a / (2.0 * kPi));
      if (a < cut.arc.entry_rad || a >= cut.arc.exit_rad) continue;
      const double h = dx * std::sin(a) + dy * std::cos(a);
      const double ft = cut.ktc_n_mm2 * depth_mm * h;
      const double fr = cut.krc_n_mm2 * depth_mm * h;
      fx += -ft * std::cos(a) - fr * std::sin(a);
      fy += ft * std::sin(a) - fr * std::cos(a);
    }
    old_x[slot] = x;
    old_y[slot] = y;
    double size = 0.0;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const double w = 2.0 * kPi * modes[i].frequency_hz;
      const double force = modes[i].direction == "x" ? fx : fy;
      const double a = w * w * (force / modes[i].stiffness_n_mm - state[i].q) -
                       2.0 * modes[i].damping_ratio * w * state[i].v;
      state[i].v += dt * a;
      state[i].q += dt * state[i].v;
      size = std::max({size, std::abs(state[i].q), std::abs(state[i].v) / w});
    }
    if (size > 1e6) return false;
    if (t >= (kPeriods / 3) * steps && t < (kPeriods / 2) * steps) early = std::max(early, size);
    if (t >= (kPeriods * 5 / 6) * steps) late = std::max(late, size);
  }
  return late < early;
}

struct Timed {
  const char* name;
  const std::vector<model::ToolPointMode>* modes;
  ChatterCut cut;
  std::vector<double> rpm;
};

TEST(StabilityLobes, AgreeWithASimulationInTime) {
  const Timed cases[] = {
      {"four teeth, slot", &kTwoModes, {{0.0, kPi}, 4, 700.0, 200.0, 0.0}, {3000.0, 4600.0, 7000.0}},
      {"four teeth, half up", &kTwoModes, {{0.0, 0.5 * kPi}, 4, 700.0, 200.0, 0.0}, {3000.0, 7000.0}},
      {"six teeth, three quarters", &kTwoModes, {{0.25 * kPi, kPi}, 6, 700.0, 200.0, 0.0}, {3000.0, 7000.0}},
      {"six teeth, half down", &kTwoModes, {{0.5 * kPi, kPi}, 6, 700.0, 200.0, 0.0}, {4600.0, 7000.0}},
      {"two teeth, slot", &kInsperger, {{0.0, kPi}, 2, 600.0, 200.0, 0.0}, {5000.0, 14000.0}},
  };
  for (const Timed& c : cases) {
    const StabilityLobes lobes = StabilityLobes::make(*c.modes, c.cut).value();
    for (const double n : c.rpm) {
      const double limit = lobes.limit_mm(n, 0.0);
      ASSERT_LT(limit, 100.0) << c.name << " " << n;
      EXPECT_TRUE(dies_out(*c.modes, c.cut, n, 0.88 * limit)) << c.name << " " << n << " " << limit;
      EXPECT_FALSE(dies_out(*c.modes, c.cut, n, 1.12 * limit)) << c.name << " " << n << " " << limit;
    }
  }
}

TEST(StabilityLobes, AreTooHighForDownMillingWithASingleToothInTheCutByNoMoreThanTheMargin) {
  // Four teeth, half immersion: the mean over a turn does not speak for the cut. Found by the simulation: the
  // lobes lie at 0.95 to 1.64 of the truth.
  const ChatterCut cut{{0.5 * kPi, kPi}, 4, 700.0, 200.0, 0.0};
  const StabilityLobes lobes = StabilityLobes::make(kTwoModes, cut).value();
  for (const double n : {2000.0, 3000.0, 4600.0, 7000.0, 10000.0})
    EXPECT_TRUE(dies_out(kTwoModes, cut, n, kSingleToothMargin * lobes.limit_mm(n, 0.0))) << n;
  EXPECT_FALSE(dies_out(kTwoModes, cut, 3000.0, 0.8 * lobes.limit_mm(3000.0, 0.0)));
}

TEST(StabilityLobes, HaveTheClosedAbsoluteLimitOfOneDirection) {
  // A slot and one direction: A0 = -kr pi / 2, and the least real part of a mode is -1 / (4 k z (1 + z)):
  // a = 8 k z (1 + z) / (N Kr). Derived; the other direction is made too stiff to matter.
  const ChatterCut cut{
      .arc = {0.0, kPi}, .teeth = 3, .ktc_n_mm2 = 600.0, .krc_n_mm2 = 180.0, .feed_direction_rad = 0.0};
  const auto lobes =
      StabilityLobes::make({mode("x", 800.0, 0.02, 5000.0), mode("y", 800.0, 0.02, 1e12)}, cut);
  EXPECT_NEAR(lobes->absolute_limit_mm(), 8.0 * 5000.0 * 0.02 * 1.02 / (3.0 * 180.0), 1e-3);
}

TEST(StabilityLobes, AreNowhereBelowTheAbsoluteLimitAndComeDownToIt) {
  const ChatterCut cut{.arc = {0.5 * kPi, kPi}, .teeth = 4, .ktc_n_mm2 = 700.0, .krc_n_mm2 = 200.0};
  const StabilityLobes lobes = StabilityLobes::make(kTwoModes, cut).value();
  double least = 1e9;
  for (double n = 1000.0; n < 20000.0; n += 50.0) {
    const double limit = lobes.limit_mm(n);
    EXPECT_GE(limit, lobes.absolute_limit_mm() * (1.0 - 1e-9));
    EXPECT_LE(limit, lobes.limit_mm(n, 0.0) * (1.0 + 1e-12));
    least = std::min(least, limit);
  }
  EXPECT_NEAR(least, lobes.absolute_limit_mm(), 0.02 * least);
  EXPECT_EQ(lobes.limit_mm(0.0), lobes.absolute_limit_mm());
}

TEST(StabilityLobes, GrowWithStiffnessAndShrinkWithTheForce) {
  const ChatterCut cut{.arc = {0.0, kPi}, .teeth = 3, .ktc_n_mm2 = 700.0, .krc_n_mm2 = 200.0};
  const double one = StabilityLobes::make(kTwoModes, cut)->absolute_limit_mm();
  auto stiff = kTwoModes;
  for (auto& m : stiff) m.stiffness_n_mm *= 2.0;
  EXPECT_NEAR(StabilityLobes::make(stiff, cut)->absolute_limit_mm(), 2.0 * one, 1e-9);
  ChatterCut hard = cut;
  hard.ktc_n_mm2 *= 2.0;
  hard.krc_n_mm2 *= 2.0;
  EXPECT_NEAR(StabilityLobes::make(kTwoModes, hard)->absolute_limit_mm(), 0.5 * one, 1e-9);
  // The worst direction is no better than any one.
  ChatterCut along = cut;
  for (const double beta : {0.0, 0.5, 1.0, 2.0}) {
    along.feed_direction_rad = beta;
    EXPECT_LE(one, 1.01 * StabilityLobes::make(kTwoModes, along)->absolute_limit_mm());
  }
}

TEST(StabilityLobes, RefuseWhatIsNoModeOrNoCut) {
  const ChatterCut cut{.arc = {0.0, kPi}, .teeth = 3, .ktc_n_mm2 = 700.0};
  EXPECT_EQ(StabilityLobes::make({}, cut).error().code, "MECH-MODES");
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(StabilityLobes::make({mode("x", bad, 0.02, 5000.0)}, cut).error().code, "MECH-MODES");
    EXPECT_EQ(StabilityLobes::make({mode("x", 800.0, bad, 5000.0)}, cut).error().code, "MECH-MODES");
    ChatterCut none = cut;
    none.ktc_n_mm2 = bad;
    EXPECT_EQ(StabilityLobes::make(kTwoModes, none).error().code, "MECH-DOMAIN");
  }
  EXPECT_EQ(StabilityLobes::make(kTwoModes, {.arc = {2.0, 1.0}, .teeth = 3, .ktc_n_mm2 = 700.0}).error().code,
            "MECH-DOMAIN");
}

TEST(SlenderDepth, FallsWithTheCubeBeyondFourDiameters) {
  EXPECT_DOUBLE_EQ(slender_depth_mm(10.0, 30.0), 15.0);
  EXPECT_DOUBLE_EQ(slender_depth_mm(10.0, 40.0), 15.0);
  EXPECT_DOUBLE_EQ(slender_depth_mm(10.0, 80.0), 15.0 / 8.0);
  EXPECT_EQ(slender_depth_mm(10.0, std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_EQ(slender_depth_mm(-1.0, 30.0), 0.0);
}

// A mode that names the cutter takes the place of those that name none.
TEST(Modes, AreThoseOfTheCutterBeforeThoseOfAny) {
  model::Machine machine;
  machine.modes = kTwoModes;
  EXPECT_EQ(modes_for(machine, "em10").size(), kTwoModes.size());
  machine.modes.push_back(mode("x", 900.0, 0.02, 2000.0));
  machine.modes.back().cutter_id = "em10";
  ASSERT_EQ(modes_for(machine, "em10").size(), 1U);
  EXPECT_EQ(modes_for(machine, "em10")[0].cutter_id, "em10");
  EXPECT_EQ(modes_for(machine, "em8").size(), kTwoModes.size());
}

}  // namespace
}  // namespace capstan::mechanics
