// A feed schedule: microseconds per sample, each answer checked against the limits without the grid.
#include <benchmark/benchmark.h>

#include <cmath>

#include "tests/making/optimise/feeds/examples.h"

namespace capstan::optimise {
namespace {

// 100,000 samples each 0.25 mm on long moves; widths swell and shrink as in a pocket, depths stay.
model::CutterPath pocket(FeedQuestion& q) {
  model::CutterPath p;
  p.start({0, 0, 0});
  for (std::uint32_t move = 1; move <= 1000; ++move) {
    p.line({move % 2 == 0 ? 0.0 : 25.0, 0.5 * move, 0.0}, model::MoveRole::kCut);
    const double length = model::move_length(p, move);
    for (int k = 1; k <= 100; ++k) {
      const double width = 3.0 + 2.9 * std::sin(0.07 * k + 0.001 * move);
      q.samples.push_back(examples::down_cut(move, 0.01 * k * length, 0.01 * length, 5.0, width));
    }
  }
  return p;
}

void checked(benchmark::State& state, const FeedQuestion& q, const FeedAnswer& a) {
  for (std::size_t k = 0; k < q.samples.size(); k += 997) {
    const auto excess = excess_at(q, q.samples[k], a.schedule.feed_mm_min[q.samples[k].move]);
    if (!excess || *excess > 1e-9) state.SkipWithError("a limit is exceeded");
  }
  state.counters["samples"] = benchmark::Counter(static_cast<double>(q.samples.size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void schedule_of_a_pocket(benchmark::State& state, bool explain) {
  FeedQuestion q = examples::question();
  q.cut.peak_force_limit_n = 800.0;
  q.explain = explain;
  const model::CutterPath p = pocket(q);
  FeedAnswer a;
  for (auto _ : state) {
    a = feeds(q, p);
    benchmark::DoNotOptimize(a.schedule.feed_mm_min.data());
  }
  checked(state, q, a);
}
BENCHMARK_CAPTURE(schedule_of_a_pocket, plain, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(schedule_of_a_pocket, explained, true)->Unit(benchmark::kMillisecond);

void split_of_a_pocket(benchmark::State& state) {
  FeedQuestion q = examples::question();
  q.cut.peak_force_limit_n = 800.0;
  const model::CutterPath p = pocket(q);
  for (auto _ : state) {
    FeedQuestion cut = q;
    model::CutterPath pieces = p;
    split_moves(cut, pieces, nullptr);
    benchmark::DoNotOptimize(pieces.x.data());
  }
  checked(state, q, feeds(q, p));
}
BENCHMARK(split_of_a_pocket)->Unit(benchmark::kMillisecond);

// Depths, widths and places all different: nearly each sample is judged by itself.
void schedule_of_random_cuts(benchmark::State& state) {
  std::mt19937 random(1);
  FeedQuestion q = examples::question();
  q.cut.peak_force_limit_n = 800.0;
  q.explain = false;
  const model::CutterPath p = examples::random_path(q, random, 400);
  FeedAnswer a;
  for (auto _ : state) {
    a = feeds(q, p);
    benchmark::DoNotOptimize(a.schedule.feed_mm_min.data());
  }
  state.counters["samples"] = benchmark::Counter(static_cast<double>(q.samples.size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(schedule_of_random_cuts)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace capstan::optimise
