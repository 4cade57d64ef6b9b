// A plan written as JSON, by the number of its features: the time grows in proportion (see the line BigO).
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "planner/files/json/json.h"
#include "planner/model/nouns/all.h"
#include "tests/support/empty_plan.h"

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

}  // namespace
}  // namespace capstan
