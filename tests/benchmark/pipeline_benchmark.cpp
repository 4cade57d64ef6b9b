#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/support/shop.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/plate.h"

// How planning grows with a part: read, plan and write a program, by the number of features.

namespace {

using namespace capstan;  // a program of its own

/// Up to here the checker has its say too: it holds every move against every feature.
constexpr std::size_t kChecked = 125;

/// Whether all that a step does below the plate's top is done about its feature's place, near to it.
bool in_its_place(const model::Plan& plan, const model::StepResult& step, model::AnyRef feature) {
  const auto* f = plan.model.get<model::MachiningFeature>(feature);
  if (f == nullptr) return false;
  const auto place = model::placement(plan.model, f->feature_placement);
  if (!place) return false;
  constexpr double kWithin = 5.0;  // mm: half the longest side of a pocket
  double lowest = 0.0;
  for (std::size_t i = 0; i < step.path->size(); ++i) {
    const auto p = step.path->point(i);
    lowest = std::min(lowest, p.z);
    if (p.z < 0.0 && (std::abs(p.x - place->origin.x) > kWithin || std::abs(p.y - place->origin.y) > kWithin))
      return false;
  }
  return lowest < -1.0;
}

/// What is wrong with the outcome; empty when nothing is.
std::string fault_of(const model::Plan& plan, const testing::Plate& part) {
  if (!plan.unplanned.empty()) return "not planned: " + plan.unplanned.front().reason;
  std::set<model::AnyRef> made;
  for (const auto& step : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
    if (ws == nullptr || !step.path || step.path->size() < 3 || step.feed_mm_min <= 0.0)
      return "an empty step";
    if (!in_its_place(plan, step, ws->its_feature)) return "a step away from its feature";
    made.insert(ws->its_feature);
  }
  if (made.size() != part.features) return "features left out";
  if (part.features > kChecked) return {};
  Job job;
  for (const auto& f : verify::check_plan(plan, job)) {
    if (f.severity != Severity::kNote) return f.code + " " + f.step + ": " + f.message;
  }
  return {};
}

void plan_a_plate(benchmark::State& state) {
  const testing::Plate part = testing::plate(static_cast<std::size_t>(state.range(0)));
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  if (!shop) return state.SkipWithError(to_text(shop.error()).c_str());
  model::Plan last;
  std::size_t program = 0;
  for (auto _ : state) {
    auto plan = pipeline::read_plan(part.text, "plate.p21", job);
    if (!plan) return state.SkipWithError(to_text(plan.error()).c_str());
    auto bound = pipeline::bind(*std::move(plan), *shop, {}, job);
    if (!bound) return state.SkipWithError(to_text(bound.error()).c_str());
    const auto text = pipeline::write_plan(*bound, pipeline::Format::kLinuxCnc, job);
    if (!text) return state.SkipWithError(to_text(text.error()).c_str());
    program = text->size();
    last = *std::move(bound);
  }
  if (const std::string fault = fault_of(last, part); !fault.empty())
    return state.SkipWithError(fault.c_str());
  const auto n = static_cast<double>(part.features);
  state.counters["per_feature"] =
      benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["steps"] = static_cast<double>(last.steps.size());
  state.counters["program_kB"] = static_cast<double>(program) / 1000.0;
  state.SetComplexityN(state.range(0));
}
BENCHMARK(plan_a_plate)->Arg(125)->Arg(250)->Arg(500)->Arg(1000)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace
