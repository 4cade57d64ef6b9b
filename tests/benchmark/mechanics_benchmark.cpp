// Loads of one section, microseconds per call, and the feed that keeps its limits.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/loads/section.h"
#include "tests/support/mechanics/section_loads.h"
#include "tests/support/mechanics/wall_error.h"

namespace capstan::mechanics {
namespace {

const ForceLaw kMeasured{.mechanistic = CuttingCoefficients{767.01, 27.7, 168.8, 26.6, 222.0, 0.7}};
const ForceLaw kTabulated{.kienzle = {641.0, 0.27}};

Section shoulder() { return {.ap_mm = 4.0, .arc = immersion_arc(3.0, 12.0, CutDirection::kDown)}; }
Section slot() { return {.ap_mm = 4.0, .arc = {0.0, std::numbers::pi}}; }
Tooth flat() { return {.cutting_diameter_mm = 12.0, .helix_rad = 0.5, .teeth = 4}; }
Tooth ball() { return {.cutting_diameter_mm = 12.0, .corner_radius_mm = 6.0, .helix_rad = 0.5, .teeth = 2}; }

void loads(benchmark::State& state, const Section& s, const Tooth& t, const ForceLaw& law) {
  double fz = 0.05;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fz);
    auto l = section_loads(s, t, law, fz, 6000.0);
    benchmark::DoNotOptimize(l);
  }
  const auto l = section_loads(s, t, law, fz, 6000.0);
  if (!l || !(l->peak_force_n > 0.0)) state.SkipWithError("no loads");
}
BENCHMARK_CAPTURE(loads, shoulder_tabulated, shoulder(), flat(), kTabulated);
BENCHMARK_CAPTURE(loads, shoulder_measured, shoulder(), flat(), kMeasured);
BENCHMARK_CAPTURE(loads, slot_tabulated, slot(), flat(), kTabulated);
BENCHMARK_CAPTURE(loads, slot_measured, slot(), flat(), kMeasured);
BENCHMARK_CAPTURE(loads, ball_tabulated, slot(), ball(), kTabulated);

void error_of_a_wall(benchmark::State& state) {
  model::Cutter c;
  c.cutting_diameter_mm = c.shank_diameter_mm = 12.0;
  c.maximum_depth_of_cut_mm = 26.0;
  c.stick_out_mm = 40.0;
  const ToolBeam beam = beam_of(c).value();
  double error = 0.0;
  for (auto _ : state) {
    const auto e = wall_error(shoulder(), flat(), kTabulated, 0.05, WallSide::kRight, beam);
    error = e ? e->largest_mm() : 0.0;
    benchmark::DoNotOptimize(error);
  }
  if (!(error > 0.0)) state.SkipWithError("down milling leaves material");
}
BENCHMARK(error_of_a_wall);

}  // namespace
}  // namespace capstan::mechanics
