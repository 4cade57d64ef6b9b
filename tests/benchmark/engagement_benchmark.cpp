#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "planner/engagement/engagement.h"

namespace {

using namespace capstan;  // a program of its own

constexpr double kSkew = 27.0 * std::numbers::pi / 180.0;

geometry::Vec3 skewed(double s, double left, double z) {
  return {20.0 + s * std::cos(kSkew) - left * std::sin(kSkew),
          8.0 + s * std::sin(kSkew) + left * std::cos(kSkew), z};
}

/// Zigzag passes 4 mm apart at 27 degrees to the grid, D = 10 mm, 2 mm deep, sampled every 0.25 mm.
model::CutterPath zigzag() {
  model::CutterPath p;
  p.start(skewed(0.0, 0.0, 5.0));
  p.line(skewed(0.0, 0.0, -2.0), model::MoveRole::kPlunge);
  for (int k = 0; k < 8; ++k) {
    p.line(skewed(k % 2 == 0 ? 60.0 : 0.0, 4.0 * k, -2.0), model::MoveRole::kCut);
    p.line(skewed(k % 2 == 0 ? 60.0 : 0.0, 4.0 * (k + 1), -2.0), model::MoveRole::kLink);
  }
  return p;
}

void measure(benchmark::State& state, model::CutterClass kind, double corner) {
  model::Cutter c;
  c.cutter_class = kind;
  c.cutting_diameter_mm = 10.0;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 20.0;
  const auto block = stock::from_box({{0, 0, -10}, {100, 80, 0}}, 0.01 * static_cast<double>(state.range(0)));
  const auto path = zigzag();
  std::size_t samples = 0;
  double removed = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    auto map = block;
    state.ResumeTiming();
    const auto m = engagement::measure(path, c, map, {.step_mm = 0.25});
    samples += m->sections.size();
    removed = m->removed_mm3;
  }
  if (kind == model::CutterClass::kEndmill) {
    // Band of eight passes and nine links with round corners: 60 x 32 grown by 5.
    const double expected = 2.0 * (70.0 * 42.0 - (4.0 - std::numbers::pi) * 25.0);
    if (removed > expected * 1.001) std::abort();  // the far corners stay: passes 8 mm apart at the ends
  }
  state.counters["us_per_point"] = benchmark::Counter(
      static_cast<double>(samples) * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["points"] = static_cast<double>(samples) / static_cast<double>(state.iterations());
  state.counters["removed_mm3"] = removed;
}

void flat(benchmark::State& s) { measure(s, model::CutterClass::kEndmill, 0.0); }
void ball(benchmark::State& s) { measure(s, model::CutterClass::kBallEndmill, 5.0); }
void bull(benchmark::State& s) { measure(s, model::CutterClass::kBullnoseEndmill, 1.0); }
// Cells of D/100 and of D/40.
BENCHMARK(flat)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(ball)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(bull)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);

}  // namespace
