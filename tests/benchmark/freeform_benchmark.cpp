#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "tests/kept/wavy.h"

namespace {

using namespace capstan;  // a program of its own
using toolpath::freeform::DropCutter;
using toolpath::freeform::Toroid;

void drop(benchmark::State& state, const Toroid& t) {
  static const DropCutter cutter(capstan::testing::wavy(224));  // about 100,000 triangles
  std::vector<geometry::Vec2> points;
  const int n = 200;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) points.push_back({100.0 * (j % 2 == 0 ? i : n - 1 - i) / n, 100.0 * j / n});
  }
  const Job job;
  std::vector<double> z;
  for (auto _ : state) z = cutter.drop(t, points, 0.0, job);
  for (std::size_t i = 0; i < z.size(); i += 997) {
    if (z[i] != cutter.drop(t, points[i].x, points[i].y)) std::abort();
  }
  state.counters["points_per_s"] =
      benchmark::Counter(static_cast<double>(points.size()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

void ball(benchmark::State& s) { drop(s, {0.0, 3.0}); }
void bull(benchmark::State& s) { drop(s, {2.0, 1.0}); }
void flat(benchmark::State& s) { drop(s, {3.0, 0.0}); }
BENCHMARK(ball)->Unit(benchmark::kMillisecond);
BENCHMARK(bull)->Unit(benchmark::kMillisecond);
BENCHMARK(flat)->Unit(benchmark::kMillisecond);

void build(benchmark::State& s) {
  const auto mesh = capstan::testing::wavy(224);
  for (auto _ : s) benchmark::DoNotOptimize(DropCutter(mesh).triangles());
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

}  // namespace
