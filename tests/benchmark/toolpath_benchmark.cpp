#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/region/area/rings.h"
#include "planner/making/toolpath/region/area/work_area.h"

namespace {

using namespace capstan;  // a program of its own
using geometry::Vec2;

/// 200 x 150 mm with a wavy wall and five wavy islands; n vertices in all.
geometry::Region wavy_pocket(int n) {
  const auto wavy = [](Vec2 c, double rx, double ry, double wave, int count, int waves) {
    geometry::Loop loop;
    for (int i = 0; i < count; ++i) {
      const double a = 2.0 * std::numbers::pi * i / count;
      const double r = 1.0 + wave * std::cos(waves * a);
      loop.push_back({c.x + rx * r * std::cos(a), c.y + ry * r * std::sin(a)});
    }
    return loop;
  };
  std::vector<geometry::Loop> loops = {wavy({100, 75}, 98, 73, 0.015, n / 2, 24)};
  for (const Vec2 c : {Vec2{60, 50}, Vec2{140, 50}, Vec2{60, 100}, Vec2{140, 100}, Vec2{100, 75}}) {
    loops.push_back(wavy(c, 9, 9, 0.05, n / 10, 9));
    std::reverse(loops.back().begin(), loops.back().end());
  }
  return geometry::Region{loops};
}

/// Ten rings; how much the innermost strays from the true distance is checked, too.
void ten_rings(benchmark::State& state) {
  const geometry::Region pocket = wavy_pocket(static_cast<int>(state.range(0)));
  std::vector<toolpath::Ring> all;
  for (auto _ : state) {
    const auto centres = toolpath::inset(pocket, 3.0, toolpath::kWallChord);
    all = toolpath::rings(centres, 2.0, 2.0);
    benchmark::DoNotOptimize(all.data());
  }
  double worst = 0.0;
  int deepest = 0;
  for (const auto& r : all) {
    deepest = std::max(deepest, r.depth + 1);
    if (r.depth > 9) continue;
    const Vec2 p = r.piece.loops[0][0];
    worst = std::max(worst, std::abs(geometry::distance_to_boundary(pocket, p) - (3.0 + 2.0 * r.depth)));
  }
  if (worst > 0.02) state.SkipWithError("a ring strays");
  state.counters["rings_deep"] = deepest;
  state.counters["worst_um"] = worst * 1000.0;
}
BENCHMARK(ten_rings)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

void whole_pocket(benchmark::State& state) {
  toolpath::PathJob t;
  t.shape.kind = model::ShapeKind::kPocket;
  t.shape.area = t.shape.reach = wavy_pocket(static_cast<int>(state.range(0)));
  t.shape.depth_mm = 10.0;
  t.operation = model::TypeId::kBottomAndSideRoughMilling;
  t.strategy = static_cast<model::StrategyKind>(state.range(1));
  t.cutter.cutting_diameter_mm = 6.0;
  t.cutter.maximum_ramp_angle_rad = 0.05;
  t.cutter.centre_cutting = true;
  t.radial_depth_mm = 2.0;
  t.axial_depth_mm = 5.0;
  t.security_z_mm = 20.0;
  t.retract_z_mm = 5.0;
  std::size_t moves = 0;
  for (auto _ : state) {
    Job job;
    const auto g = toolpath::generate(t, job);
    if (!g) {
      state.SkipWithError(g.error().message.c_str());
      return;
    }
    moves = g->path.size();
  }
  state.counters["moves"] = static_cast<double>(moves);
}
BENCHMARK(whole_pocket)->ArgsProduct({{1'000, 10'000}, {1, 2, 3, 4, 5}})->Unit(benchmark::kMillisecond);

}  // namespace
