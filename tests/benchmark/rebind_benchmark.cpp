#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

#include "planner/door/service/session.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/shop.h"

// A tool of the magazine is changed, and a session binds the plan again: 22 features, 49 steps, pockets with
// helices among them. Each turn measures the tool's length anew, so that no table is known from before.

namespace {

using namespace capstan;  // a program of its own

/// The plan as JSON, and the tool table that it was made for.
struct Early {
  std::string json, table;
};
Early early(std::size_t features) {
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  auto plan = pipeline::read_plan(capstan::testing::plate(features).text, "plate.p21", job);
  if (!shop || !plan) return {};
  auto made = pipeline::bind(*std::move(plan), *shop, {}, job);
  if (!made) return {};
  auto json = pipeline::write_plan(*made, pipeline::Format::kJson, job);
  auto table = pipeline::write_plan(*made, pipeline::Format::kToolTable, job);
  return json && table ? Early{*std::move(json), *std::move(table)} : Early{};
}

/// `tool`: its number. T2 mills the pockets, T3 drills.
void bind_again(benchmark::State& state) {
  const Early plan = early(22);
  const std::string tool = "T" + std::to_string(state.range(0)) + " ";
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  service::Session session;
  double longer_mm = 0.0;
  const auto bind = [&]() -> std::string {
    std::string table = plan.table;
    const auto at = table.find("Z+", table.find(tool)), end = table.find(' ', at);
    if (end == std::string::npos) return "the table has no such tool";
    const double length = parse_double(table.substr(at + 2, end - at - 2)).value_or(0.0) + longer_mm;
    table.replace(at, end - at, "Z+" + shortest(length));
    std::ofstream(path) << table;
    if (session.set("tools", path) != service::Code::kDone) return session.message();
    if (session.bind(plan.json, std::nullopt) != service::Code::kDone) return session.message();
    return {};
  };
  std::string fault = bind();
  for (auto _ : state) {
    longer_mm += 0.01;
    if (fault.empty()) fault = bind();
    if (fault.empty() && session.output("linuxcnc") == nullptr) fault = "no program";
  }
  if (!fault.empty()) return state.SkipWithError(fault.c_str());
  service::Session anew;
  const std::string last = *session.output("linuxcnc");
  (void)anew.set("tools", path);
  if (anew.bind(plan.json, std::nullopt) != service::Code::kDone || *anew.output("linuxcnc") != last)
    state.SkipWithError("a new session gives another program");
}
BENCHMARK(bind_again)->Arg(3)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(10);

}  // namespace
