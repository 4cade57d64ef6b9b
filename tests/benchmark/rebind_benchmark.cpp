#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "planner/door/service/session.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/shop.h"

// A tool of the magazine is changed, and a session binds the plan again: 22 features, 49 steps, pockets with
// helices among them; or the bracket, 20 steps. Each turn measures the tool anew, so that no table is known
// from before. p50_ms and p99_ms are of the turns, by the clock.

namespace {

using namespace capstan;  // a program of its own

/// The plan as JSON, and the tool table that it was made for.
struct Early {
  std::string json, table;
};
Early early(const std::string& part, pipeline::Bind bind = pipeline::Bind::kAll) {
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  auto plan = pipeline::read_plan(part, "part.p21", job);
  if (!shop || !plan) return {};
  const model::Plan as_read = *plan;
  auto made = pipeline::bind(*std::move(plan), *shop, {}, job);
  if (!made) return {};
  auto table = pipeline::write_plan(*made, pipeline::Format::kToolTable, job);
  if (bind != pipeline::Bind::kAll) made = pipeline::bind(as_read, *shop, {.bind = bind}, job);
  if (!made) return {};
  auto json = pipeline::write_plan(*made, pipeline::Format::kJson, job);
  return json && table ? Early{*std::move(json), *std::move(table)} : Early{};
}
std::string bracket() {
  return capstan::testing::slurp(capstan::testing::source_dir() + "/examples/bracket.p21");
}

void tell_shares(benchmark::State& state, std::vector<double> ms) {
  if (ms.empty()) return;
  std::sort(ms.begin(), ms.end());
  const auto at = [&](double share) {
    return ms[std::min(ms.size() - 1, static_cast<std::size_t>(share * static_cast<double>(ms.size())))];
  };
  state.counters["p50_ms"] = at(0.5);
  state.counters["p99_ms"] = at(0.99);
}

/// `by_mm`: what changes at each turn.
void bind_again(benchmark::State& state, const std::string& part, const std::string& tool,
                const std::string& key, double by_mm) {
  const Early plan = early(part);
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  service::Session session;
  double in_all_mm = 0.0;
  std::string fault;
  const auto bind = [&] {
    const std::string table = capstan::testing::with_tool_changed(plan.table, tool, key, in_all_mm);
    if (table.empty()) fault = "the table has no such tool";
    std::ofstream(path) << table;
    if (fault.empty() && session.set("tools", path) != service::Code::kDone) fault = session.message();
    if (fault.empty() && session.bind(plan.json, std::nullopt) != service::Code::kDone)
      fault = session.message();
    if (fault.empty() && session.output("linuxcnc") == nullptr) fault = "no program";
  };
  bind();
  std::vector<double> ms;
  for (auto _ : state) {
    in_all_mm += by_mm;
    const auto began = std::chrono::steady_clock::now();
    bind();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
  }
  if (!fault.empty()) return state.SkipWithError(fault.c_str());
  service::Session anew;
  const std::string last = *session.output("linuxcnc");
  (void)anew.set("tools", path);
  if (anew.bind(plan.json, std::nullopt) != service::Code::kDone || *anew.output("linuxcnc") != last)
    state.SkipWithError("a new session gives another program");
  tell_shares(state, std::move(ms));
}

/// A plan of which operations are all that is bound, each turn in a session that knows nothing.
void bind_open(benchmark::State& state, const std::string& part) {
  const Early plan = early(part, pipeline::Bind::kStrategy);
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  std::ofstream(path) << plan.table;
  std::vector<double> ms;
  std::string fault;
  for (auto _ : state) {
    state.PauseTiming();
    service::Session session;
    (void)session.set("tools", path);
    (void)session.open();
    state.ResumeTiming();
    const auto began = std::chrono::steady_clock::now();
    if (session.bind(plan.json, std::chrono::milliseconds(1)) == service::Code::kImpossible ||
        session.output("linuxcnc") == nullptr)
      fault = session.message();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
  }
  if (!fault.empty()) return state.SkipWithError(fault.c_str());
  tell_shares(state, std::move(ms));
}

const std::string kPlate = capstan::testing::plate(22).text;

BENCHMARK_CAPTURE(bind_again, plate_length_of_the_drill, kPlate, "7.8 mm", "Z", 0.01)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(200);
BENCHMARK_CAPTURE(bind_again, plate_length_of_the_mill, kPlate, "end mill", "Z", 0.01)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(200);
BENCHMARK_CAPTURE(bind_again, plate_diameter_of_the_mill, kPlate, "end mill", "D", -0.0011)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(100);
BENCHMARK_CAPTURE(bind_again, bracket_length_of_the_mill, bracket(), "10 mm carbide end mill", "Z", 0.01)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(200);
BENCHMARK_CAPTURE(bind_again, bracket_diameter_of_the_mill, bracket(), "10 mm carbide end mill", "D", -0.0011)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(100);
BENCHMARK_CAPTURE(bind_open, bracket, bracket())->Unit(benchmark::kMillisecond)->Iterations(20);

}  // namespace
