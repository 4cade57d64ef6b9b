// A store of 10,000 tools: opening it, and answering a requirement from it. Held against a plain search over
// all of them after the timing.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

#include "planner/ground/base/file.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/store/store.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

constexpr std::size_t kTools = 10000;

/// The generic library over and over, each round in a different length.
const std::vector<Cutter>& tools() {
  static const std::vector<Cutter> kTen = [] {
    const auto generic = generic_library().value();
    std::vector<Cutter> out;
    for (std::size_t i = 0; i < kTools; ++i) {
      Cutter c = generic[i % generic.size()];
      const double longer = static_cast<double>(i / generic.size());
      c.id += "#" + std::to_string(i / generic.size());
      c.stick_out_mm += longer;
      c.usable_length_mm += longer;
      c.functional_length_mm += longer;
      out.push_back(std::move(c));
    }
    return out;
  }();
  return kTen;
}

const std::string& file() {
  static const std::string kFile = [] {
    const auto path = (std::filesystem::temp_directory_path() / "capstan_tooling_benchmark.sqlite").string();
    if (!write_file(path, store_of({}, tools()).value())) std::abort();
    return path;
  }();
  return kFile;
}

model::ToolRequirement drill() {
  model::ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 6.8;
  r.reach_mm = 30.0;
  return r;
}
model::ToolRequirement mill() {
  model::ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_min_mm = 9.0;
  r.diameter_max_mm = 12.0;
  r.reach_mm = 35.0;
  r.depth_of_cut_mm = 20.0;
  r.centre_cutting = true;
  return r;
}

void open(benchmark::State& state) {
  std::size_t n = 0;
  for (auto _ : state) {
    const auto s = ToolStore::open(file());
    n = s ? s->size() : 0;
    benchmark::DoNotOptimize(n);
  }
  if (n != kTools) state.SkipWithError("not all tools are there");
}
BENCHMARK(open)->Unit(benchmark::kMillisecond);

void everything(benchmark::State& state) {
  const auto s = ToolStore::open(file()).value();
  std::vector<Cutter> all;
  for (auto _ : state) all = s.all_cutters().value();
  if (all != tools()) state.SkipWithError("the tools are not those stored");
}
BENCHMARK(everything)->Unit(benchmark::kMillisecond);

std::vector<Cutter> plainly(const model::ToolRequirement& r) {
  std::vector<Cutter> out;
  for (const Cutter& c : tools()) {
    const double d = c.cutting_diameter_mm;
    const bool size = r.diameter_exact_mm > 0.0 ? d == r.diameter_exact_mm
                                                : d >= r.diameter_min_mm && d <= r.diameter_max_mm;
    if (c.cutter_class == r.classes.front() && size && reach_of(c) >= r.reach_mm &&
        c.maximum_depth_of_cut_mm >= r.depth_of_cut_mm)
      out.push_back(c);
  }
  return out;
}

void ids(benchmark::State& state) {
  const auto r = state.range(0) == 0 ? drill() : mill();
  const auto s = ToolStore::open(file()).value();
  std::vector<std::int64_t> found;
  for (auto _ : state) {
    found = s.find(r);
    benchmark::DoNotOptimize(found);
  }
  const auto expected = plainly(r);
  if (expected.empty() || s.cutters(found).value() != expected) state.SkipWithError("other tools");
  state.counters["found"] = static_cast<double>(found.size());
}
BENCHMARK(ids)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void answer(benchmark::State& state) {
  const auto r = state.range(0) == 0 ? drill() : mill();
  const auto s = ToolStore::open(file()).value();
  std::vector<Cutter> found;
  for (auto _ : state) {
    found = s.cutters(s.find(r)).value();
    benchmark::DoNotOptimize(found);
  }
  if (found.empty() || found != plainly(r)) state.SkipWithError("other tools");
  state.counters["found"] = static_cast<double>(found.size());
}
BENCHMARK(answer)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void ranked(benchmark::State& state) {
  const auto r = state.range(0) == 0 ? drill() : mill();
  const auto s = ToolStore::open(file()).value();
  Job job;
  const auto machine = load_machine("generic_vmc", job).value();
  const auto material = find_material("mild_steel", shipped_materials().value(), job).value();
  model::Selection out;
  for (auto _ : state) out = select(r, s.cutters(s.find(r)).value(), material, machine);
  const auto all = select(r, tools(), material, machine);
  bool same = !all.ranked.empty() && all.ranked.size() == out.ranked.size();
  for (std::size_t i = 0; same && i < all.ranked.size(); ++i)
    same = all.ranked[i].cutter == out.ranked[i].cutter;
  if (!same) state.SkipWithError("another choice than from all tools");
}
BENCHMARK(ranked)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace capstan::tooling
