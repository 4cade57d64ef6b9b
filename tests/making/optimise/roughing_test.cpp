// A roughing cut held by the limits of tool and machine: the formulas of `mechanics` under the solver.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "planner/making/optimise/solver/solver.h"
#include "planner/physics/mechanics/bending/deflection.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/loads/side_section.h"
#include "tests/support/mechanics/section_loads.h"

namespace capstan::optimise {
namespace {

const mechanics::ForceLaw kMildSteel{.kienzle = {2298.0, 0.20}};
const mechanics::ToolStiffness kTool{.stickout_mm = 35.0,
                                     .shank_diameter_mm = 10.0,
                                     .flute_length_mm = 22.0,
                                     .cutting_diameter_mm = 10.0,
                                     .youngs_modulus_n_mm2 = mechanics::kCarbideYoungsModulusNMm2};
const mechanics::Tooth kTooth{.cutting_diameter_mm = 10.0, .helix_rad = 0.5, .teeth = 4};
constexpr double kDepthMm = 6.0;
constexpr double kChipLimitMm = 0.05;
constexpr double kPowerLimitW = 1500.0;
constexpr double kDeflectionLimitMm = 0.05;

struct Loads {
  double h_max_mm = 0.0, power_w = 0.0, deflection_mm = 0.0, mrr_mm3_min = 0.0;
};

/// Of a side cut of width x[0], feed per tooth x[1], speed x[2]: the larger of up and of down milling.
Loads loads_at(std::span<const double> x) {
  Loads out{.mrr_mm3_min = kDepthMm * x[0] * x[1] * kTooth.teeth * x[2]};
  for (const auto direction : {mechanics::CutDirection::kUp, mechanics::CutDirection::kDown}) {
    const auto section = mechanics::side_section(kDepthMm, x[0], kTooth, direction);
    const auto l = mechanics::section_loads(section, kTooth, kMildSteel, x[1], x[2]).value();
    out.h_max_mm = std::max(out.h_max_mm, l.h_max_mm);
    out.power_w = std::max(out.power_w, l.power_w);
    out.deflection_mm =
        std::max(out.deflection_mm, l.peak_force_n * mechanics::tip_compliance_mm_n(kTool).value());
  }
  return out;
}

Problem roughing() {
  Problem p{.variables = {{"width", "mm", 0.3, 10.0, 3.0, Walk::kLogarithmic},
                          {"feed", "mm", 0.01, 0.3, 0.03, Walk::kLogarithmic},
                          {"speed", "1/min", 1000.0, 3000.0, 1500.0, Walk::kLogarithmic}},
            .constraints = {"chip", "power", "deflection"},
            .model = {}};
  p.model = central_differences(
      [](std::span<const double> x, double& objective, std::span<double> c) {
        const Loads loads = loads_at(x);
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
  const Loads loads = loads_at(s->x);
  EXPECT_LE(loads.h_max_mm, kChipLimitMm * (1.0 + 1e-5));
  EXPECT_LE(loads.power_w, kPowerLimitW * (1.0 + 1e-5));
  EXPECT_LE(loads.deflection_mm, kDeflectionLimitMm * (1.0 + 1e-5));
  EXPECT_FALSE(s->active.empty());
  // No grid point that keeps the limits removes more than a hair more.
  double best = 0.0;
  for (double ae = 0.3; ae <= 10.0; ae *= 1.05) {
    for (double fz = 0.01; fz <= 0.3; fz *= 1.05) {
      for (const double n : {1000.0, 1500.0, 2000.0, 2500.0, 3000.0}) {
        const Loads at = loads_at(std::array{ae, fz, n});
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
  // From the least width of 0.03 D up the chip is at least 2 sqrt(0.03 x 0.97) = 0.34 of the feed, so that
  // 0.05 mm of chip are 0.147 mm per tooth at most: half of the feed's bound.
  EXPECT_LE(s->x[1], 0.147);
  EXPECT_LE(loads_at(s->x).h_max_mm, kChipLimitMm * (1.0 + 1e-5));
}

}  // namespace
}  // namespace capstan::optimise
