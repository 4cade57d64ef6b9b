#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "planner/physics/engagement/planar/planar.h"

namespace {

using namespace capstan;  // a program of its own

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;
const geometry::Box3 kBlock{{0, 0, -20}, {100, 80, 0}};

geometry::Vec3 skewed(double s, double left, double z) {
  return {20.0 + s * std::cos(kSkew) - left * std::sin(kSkew),
          8.0 + s * std::sin(kSkew) + left * std::cos(kSkew), z};
}

model::Cutter end_mill() {
  model::Cutter c;
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = 10.0;
  c.maximum_depth_of_cut_mm = 20.0;
  return c;
}

/// The zigzag of the height map's benchmark: passes 4 mm apart at 27 degrees, 2 mm deep.
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

/// Circles of 4 mm advancing by 1 mm through solid, `pieces` per turn (0: arcs), on three levels.
model::CutterPath trochoid(int pieces) {
  model::CutterPath p;
  p.start({20.0, 40.0, 5.0});
  for (int level = 1; level <= 3; ++level) {
    const double z = -2.0 * level;
    p.line({20.0, 40.0, 5.0}, model::MoveRole::kLink);
    p.line({20.0, 40.0, z}, model::MoveRole::kPlunge);
    for (int k = 0; k < 40; ++k) {
      const double x = 16.0 + k;
      p.line({x + 4.0, 40.0, z}, model::MoveRole::kCut);
      if (pieces == 0) p.arc({x + 4.0, 40.0, z}, {x, 40.0}, false, model::MoveRole::kCut);
      for (int i = 1; i <= pieces; ++i) {
        const double a = 2.0 * kPi * i / pieces;
        p.line({x + 4.0 * std::cos(a), 40.0 + 4.0 * std::sin(a), z}, model::MoveRole::kCut);
      }
    }
  }
  return p;
}

void measure(benchmark::State& state, const model::CutterPath& path, double expected_mm3, double tolerance) {
  const auto c = end_mill();
  const auto block = stock::PlanarStock::from_box(kBlock);
  std::size_t samples = 0;
  double removed = 0.0;
  for (auto _ : state) {
    auto stock = block;
    const auto m = engagement::measure(path, c, stock, {.step_mm = 0.25});
    samples += m->sections.size();
    removed = m->removed_mm3;
  }
  if (std::abs(removed - expected_mm3) > tolerance * expected_mm3) std::abort();
  state.counters["us_per_point"] = benchmark::Counter(
      static_cast<double>(samples) * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["points"] = static_cast<double>(samples) / static_cast<double>(state.iterations());
  state.counters["removed_mm3"] = removed;
}

void zigzag_lines(benchmark::State& s) {
  // 60 x 32 grown by 5, less the far corners between passes 8 mm apart, where the links do not reach.
  auto stock = stock::PlanarStock::from_box(kBlock);
  if (!stock.cut(model::profile_of(end_mill()), zigzag())) std::abort();
  const geometry::Vec3 size = kBlock.size();
  measure(s, zigzag(), size.x * size.y * size.z - stock.volume(), 1e-5);
}
void circles(benchmark::State& s) {
  const auto path = trochoid(static_cast<int>(s.range(0)));
  auto stock = stock::PlanarStock::from_box(kBlock);
  if (!stock.cut(model::profile_of(end_mill()), path)) std::abort();
  const geometry::Vec3 size = kBlock.size();
  measure(s, path, size.x * size.y * size.z - stock.volume(1e-7), 1e-4);
}
void cut_only(benchmark::State& state) {
  const auto profile = model::profile_of(end_mill());
  const auto path = state.range(0) < 0 ? zigzag() : trochoid(static_cast<int>(state.range(0)));
  const auto block = stock::PlanarStock::from_box(kBlock);
  for (auto _ : state) {
    auto stock = block;
    if (!stock.cut(profile, path)) std::abort();
    benchmark::DoNotOptimize(stock);
  }
  state.counters["us_per_move"] =
      benchmark::Counter(static_cast<double>(path.size()) * 1e-6,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(zigzag_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(circles)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(cut_only)->Arg(-1)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
