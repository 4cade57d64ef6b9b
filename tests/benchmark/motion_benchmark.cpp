// The feed profile: microseconds per point of a path of short chords, checked against a closed form.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/physics/motion/time.h"

namespace capstan::motion {
namespace {

model::Machine machine(bool jerk) {
  model::Machine m;
  for (auto& axis : m.axes) {
    axis.rapid_mm_min = 12000.0;
    axis.feed_max_mm_min = 6000.0;
    axis.acceleration_mm_s2 = 500.0;
    if (jerk) axis.jerk_mm_s3 = 10000.0;
  }
  m.control.path_tolerance_mm = 0.01;
  return m;
}

// A circle of 50 mm radius, run again and again in chords of half a degree.
void feed_profile(benchmark::State& state, bool jerk) {
  const auto n = static_cast<std::size_t>(state.range(0));
  constexpr double kRadius = 50.0;
  constexpr double kStep = std::numbers::pi / 360.0;
  constexpr double kFeed = 60.0;  // mm/s, below what the bend allows
  model::CutterPath path;
  path.start({kRadius, 0, 0});
  for (std::size_t i = 1; i <= n; ++i) {
    const double a = kStep * static_cast<double>(i);
    path.line({kRadius * std::cos(a), kRadius * std::sin(a), 0}, model::MoveRole::kCut);
  }
  const model::FeedSchedule schedule{std::vector<double>(n + 1, 60.0 * kFeed),
                                     std::vector<double>(n + 1, 1000.0), std::vector<double>(n + 1, 0.0)};
  const model::Machine m = machine(jerk);
  double seconds = 0.0;
  for (auto _ : state) {
    const auto time = time_of(path, schedule, m);
    seconds = time ? time->cutting_s : -1.0;
    benchmark::DoNotOptimize(seconds);
  }
  // At constant feed but for the ramps at both ends: L / v + v / a, and a / j for each ramp's rounding.
  const double length = static_cast<double>(n) * 2.0 * kRadius * std::sin(0.5 * kStep);
  const double expected = length / kFeed + kFeed / 500.0 + (jerk ? 500.0 / 10000.0 : 0.0);
  if (std::abs(seconds - expected) > 0.01 * expected) state.SkipWithError("the time is wrong");
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(feed_profile, acceleration, false)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(feed_profile, jerk, true)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMicrosecond);

// Random chords at random feeds: ramps begin and end everywhere.
void uneven_profile(benchmark::State& state, bool jerk) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-0.3, 0.3), length(0.1, 3.0), feed(600.0, 6000.0);
  model::CutterPath path;
  path.start({0, 0, 0});
  model::FeedSchedule schedule{{0.0}, std::vector<double>(n + 1, 1000.0), std::vector<double>(n + 1, 0.0)};
  double heading = 0.0;
  geometry::Vec3 at{0, 0, 0};
  double whole = 0.0;
  for (std::size_t i = 1; i <= n; ++i) {
    heading += turn(random);
    const double l = length(random);
    at = at + geometry::Vec3{l * std::cos(heading), l * std::sin(heading), 0.0};
    path.line(at, model::MoveRole::kCut);
    schedule.feed_mm_min.push_back(feed(random));
    whole += 60.0 * l / schedule.feed_mm_min.back();
  }
  const model::Machine m = machine(jerk);
  double seconds = 0.0;
  for (auto _ : state) {
    const auto time = time_of(path, schedule, m);
    seconds = time ? time->cutting_s : -1.0;
    benchmark::DoNotOptimize(seconds);
  }
  if (!(seconds >= whole)) state.SkipWithError("faster than its feeds");
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(uneven_profile, acceleration, false)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(uneven_profile, jerk, true)->Arg(100000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace capstan::motion
