// A plan written as JSON, by the number of its features: the time grows in proportion (see the line BigO);
// and plans of long paths, written and read, by the number of their points.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "planner/files/json/json.h"
#include "planner/model/nouns/all.h"
#include "tests/support/empty_plan.h"
#include "tests/support/paths/long_paths.h"

namespace capstan {
namespace {

using model::Plan;

Plan plan_of(int features) {
  Plan plan = testing::empty_plan();
  for (int i = 0; i < features; ++i) {
    model::RoundHole hole;
    hole.its_id = "hole " + std::to_string(i);
    const auto feature = plan.model.add(hole);
    model::CutterPath path;
    path.start({0, 0, 5});
    for (int k = 0; k < 200; ++k) path.line({0.1 * k + i, 0.3 * k, -0.7 * k}, model::MoveRole::kCut);
    auto& step = testing::add_step(plan, "step " + std::to_string(i), "em18", path);
    plan.model.at<model::MachiningWorkingstep>(step.step).its_feature =
        model::Ref<model::ManufacturingFeature>(feature);
    plan.ledger.bind(step.step, "its_operation", model::Binder::kRule,
                     {"hole.drill", "drilled because of number " + std::to_string(i), "derived"});
  }
  return plan;
}

void write_plan(benchmark::State& state) {
  const Plan plan = plan_of(static_cast<int>(state.range(0)));
  std::string bytes;
  for (auto _ : state) bytes = json::write_json(plan);
  if (bytes.empty()) std::abort();
  state.SetComplexityN(state.range(0));
}
BENCHMARK(write_plan)->RangeMultiplier(2)->Range(250, 2000)->Unit(benchmark::kMillisecond)->Complexity();

void write_long_paths(benchmark::State& state) {
  const Plan plan = testing::long_paths_plan(static_cast<std::size_t>(state.range(0)));
  std::string bytes;
  for (auto _ : state) bytes = json::write_json(plan);
  Job job;
  state.counters["MB"] = static_cast<double>(bytes.size()) / 1e6;
  const auto back = json::read_json(std::move(bytes), "plan.json", job);
  if (!back || testing::sum_of_paths(*back) != testing::sum_of_paths(plan)) std::abort();
}
BENCHMARK(write_long_paths)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(1);

void read_long_paths(benchmark::State& state) {
  const Plan plan = testing::long_paths_plan(static_cast<std::size_t>(state.range(0)));
  const std::string bytes = json::write_json(plan);
  for (auto _ : state) {
    Job job;
    const auto back = json::read_json(bytes, "plan.json", job);
    state.PauseTiming();
    if (!back || testing::sum_of_paths(*back) != testing::sum_of_paths(plan)) std::abort();
    state.ResumeTiming();
  }
}
BENCHMARK(read_long_paths)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace capstan
