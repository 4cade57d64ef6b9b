#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>

#include "planner/making/toolpath/freeform/drop_cutter.h"

namespace {

using namespace capstan;  // a program of its own
using toolpath::freeform::DropCutter;
using toolpath::freeform::Toroid;

/// A wavy surface of about 100,000 triangles, 100 x 100 mm.
geometry::Mesh wavy(int n) {
  geometry::Mesh m;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 100.0 * i / n;
      const double y = 100.0 * j / n;
      m.vertices.push_back({x, y, 5.0 * std::sin(0.15 * x) * std::cos(0.11 * y)});
    }
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

void drop(benchmark::State& state, const Toroid& t) {
  static const DropCutter cutter(wavy(224));
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
  const auto mesh = wavy(224);
  for (auto _ : s) benchmark::DoNotOptimize(DropCutter(mesh).triangles());
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

}  // namespace
