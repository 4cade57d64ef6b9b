// A roughing cut held by the limits of tool and machine: the formulas of `mechanics` under the solver.

#include <gtest/gtest.h>

#include <cmath>

#include "planner/making/optimise/solver/solver.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/loads/loads.h"

namespace capstan::optimise {
namespace {

using mechanics::Loads;
using mechanics::MillingCut;

const mechanics::WorkMaterial kMildSteel{2298.0, 0.20};
const mechanics::ToolStiffness kTool{.stickout_mm = 35.0,
                                     .shank_diameter_mm = 10.0,
                                     .flute_length_mm = 22.0,
                                     .cutting_diameter_mm = 10.0,
                                     .youngs_modulus_n_mm2 = mechanics::kCarbideYoungsModulusNMm2};
constexpr double kChipLimitMm = 0.05;
constexpr double kPowerLimitW = 1500.0;
constexpr double kDeflectionLimitMm = 0.05;

MillingCut cut_at(std::span<const double> x) {
  return {.ap_mm = 6.0,
          .ae_mm = x[0],
          .fz_mm = x[1],
          .n_rpm = x[2],
          .cutting_diameter_mm = 10.0,
          .teeth = 4,
          .helix_rad = 0.5,
          .corner_radius_mm = 0.0,
          .ball = false};
}

Problem roughing() {
  Problem p{.variables = {{"width", "mm", 0.3, 10.0, 3.0, Walk::kLogarithmic},
                          {"feed", "mm", 0.01, 0.3, 0.03, Walk::kLogarithmic},
                          {"speed", "1/min", 1000.0, 3000.0, 1500.0, Walk::kLogarithmic}},
            .constraints = {"chip", "power", "deflection"},
            .model = {}};
  p.model = central_differences(
      [](std::span<const double> x, double& objective, std::span<double> c) {
        const Loads loads = mechanics::milling_loads(cut_at(x), kMildSteel, kTool).value();
        objective = -std::log(loads.mrr_mm3_min);
        c[0] = loads.h_max_mm / kChipLimitMm - 1.0;
        c[1] = loads.power_w / kPowerLimitW - 1.0;
        c[2] = loads.deflection_mm / kDeflectionLimitMm - 1.0;
      },
      p.variables);
  return p;
}

TEST(Roughing, EndsAtALimitAndKeepsThemAll) {
  Job job;
  const auto s = solve(roughing(), {}, job);
  if (!s && s.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << "NLopt is absent";
  ASSERT_TRUE(s);
  ASSERT_TRUE(s->feasible);
  const Loads loads = mechanics::milling_loads(cut_at(s->x), kMildSteel, kTool).value();
  EXPECT_LE(loads.h_max_mm, kChipLimitMm * (1.0 + 1e-5));
  EXPECT_LE(loads.power_w, kPowerLimitW * (1.0 + 1e-5));
  EXPECT_LE(loads.deflection_mm, kDeflectionLimitMm * (1.0 + 1e-5));
  EXPECT_FALSE(s->active.empty());
  // No grid point that keeps the limits removes more than a hair more.
  double best = 0.0;
  for (double ae = 0.3; ae <= 10.0; ae *= 1.05) {
    for (double fz = 0.01; fz <= 0.3; fz *= 1.05) {
      for (const double n : {1000.0, 1500.0, 2000.0, 2500.0, 3000.0}) {
        const Loads at = mechanics::milling_loads(cut_at(std::array{ae, fz, n}), kMildSteel, kTool).value();
        if (at.h_max_mm <= kChipLimitMm && at.power_w <= kPowerLimitW &&
            at.deflection_mm <= kDeflectionLimitMm) {
          best = std::max(best, at.mrr_mm3_min);
        }
      }
    }
  }
  EXPECT_GE(loads.mrr_mm3_min, 0.999 * best);
  RecordProperty("outcome", to_text(s->outcome));
}

TEST(Roughing, DoesNotEscapeIntoASlotAtTheFeedBound) {
  // With the square root used beyond half immersion the chip would vanish at ae = D and the feed run to 0.3.
  Job job;
  const auto s = solve(roughing(), {}, job);
  if (!s && s.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << "NLopt is absent";
  ASSERT_TRUE(s);
  if (s->x[0] > 5.0) {
    EXPECT_LE(s->x[1], kChipLimitMm * (1.0 + 1e-5));
  }
}

}  // namespace
}  // namespace capstan::optimise
