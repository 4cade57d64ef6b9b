#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "planner/files/exchange/exchange.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/file.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/paths/long_paths.h"

// AP238 files of 25, 50 and 100 MB, from bytes in memory to the model: one full of toolpaths, one full of
// B-rep solids that no attribute of a noun holds and that are kept verbatim. And plans of long paths with
// feeds and sections, written and read, by the number of their points.

namespace capstan::exchange {
namespace {

constexpr std::size_t kMega = 1000000;

struct Input {
  std::string bytes;
  std::size_t points = 0;  ///< of toolpaths
  double sum_mm = 0.0;     ///< of their coordinates
  std::size_t solids = 0;  ///< MANIFOLD_SOLID_BREPs
};

// --- toolpaths ---

constexpr std::size_t kPointsPerPath = 1000;

/// A spiral on a bowl: coordinates of different length, as real ones have.
geometry::Vec3 point(std::size_t path, std::size_t i) {
  const double t = 0.01 * static_cast<double>(i), r = 1.0 + t;
  const auto round = [](double v) { return std::round(v * 1e4) / 1e4; };
  return {round(r * std::cos(t)), round(r * std::sin(t)),
          round(0.05 * r * r - 0.1 * static_cast<double>(path % 50))};
}

Input toolpaths(std::size_t bytes) {
  using namespace model;
  Input out;
  Plan plan;
  Model& m = plan.model;
  const auto piece = m.add<Workpiece>();
  m.at<Workpiece>(piece).its_id = "part";
  const auto workplan = m.add<Workplan>();
  m.at<Workplan>(workplan).its_id = "main";
  plan.project = m.add<Project>();
  m.at<Project>(plan.project).its_id = "bowl";
  m.at<Project>(plan.project).main_workplan = workplan;
  m.at<Project>(plan.project).its_workpieces.push_back(piece);
  const auto list = m.add<ToolpathList>();
  const auto operation = m.add<FreeformOperation>();
  m.at<FreeformOperation>(operation).its_id = "finish";
  m.at<FreeformOperation>(operation).its_toolpath = list;
  const auto feature = m.add<ToolpathFeature>();
  m.at<ToolpathFeature>(feature).its_id = "bowl";
  m.at<ToolpathFeature>(feature).its_workpiece = piece;
  const auto step = m.add<MachiningWorkingstep>();
  m.at<MachiningWorkingstep>(step).its_id = "step";
  m.at<MachiningWorkingstep>(step).its_feature = feature;
  m.at<MachiningWorkingstep>(step).its_operation = operation;
  m.at<Workplan>(workplan).its_elements.push_back(step);
  constexpr std::size_t kBytesPerPoint = 50;  // of an instance and its number in the polyline
  for (std::size_t p = 0; p * kPointsPerPath * kBytesPerPoint < bytes; ++p) {
    const auto path = m.add<CutterLocationTrajectory>();
    const auto curve = m.add<Polyline>();
    m.at<Polyline>(curve).name = "";
    for (std::size_t i = 0; i < kPointsPerPath; ++i) {
      const auto at = point(p, i);
      const auto c = m.add<CartesianPoint>();
      m.at<CartesianPoint>(c).name = "";
      m.at<CartesianPoint>(c).coordinates = {{at.x, at.y, at.z}, true};
      m.at<Polyline>(curve).points.push_back(c);
      out.sum_mm += at.x + at.y + at.z;
    }
    out.points += kPointsPerPath;
    m.at<CutterLocationTrajectory>(path).its_id = "path " + std::to_string(p);
    m.at<CutterLocationTrajectory>(path).its_priority = true;
    m.at<CutterLocationTrajectory>(path).its_type = ToolpathType::kTrajectoryPath;
    m.at<CutterLocationTrajectory>(path).basiccurve = curve;
    m.at<ToolpathList>(list).its_list.push_back(path);
  }
  Job job;
  auto written = write_ap238(plan, job);
  if (!written) throw std::runtime_error(to_text(written.error()));
  out.bytes = std::move(written->bytes);
  return out;
}

// --- solids ---

/// The solids of annex J's second example, again and again, each in a representation of its own that is
/// related to the workpiece's; on the text, so that it says nothing about the reader that is measured with
/// it.
Input solids(std::size_t bytes) {
  Input out;
  const std::string folder = capstan::testing::corpus_folder();
  auto text = folder.empty() ? Result<std::string>(std::string())
                             : read_file(folder + "/ap238/ap238e4dis_annexJ_cc2.stp");
  if (!text || text->empty()) return out;
  Job job;
  const auto file = p21::parse(*text, "cc2", {}, job);
  if (!file) throw std::runtime_error("annex J does not parse");
  constexpr std::uint64_t kBrep = 48, kShape = 43, kContext = 1026, kStep = 2000;
  // Everything below the solid, as text with places for its numbers.
  std::vector<std::uint64_t> pending = {kBrep};
  std::set<std::uint64_t> seen = {kContext};
  std::vector<std::string> pieces;
  std::vector<std::uint64_t> numbers;
  std::string last;
  const auto number = [&](std::uint64_t n) {
    pieces.push_back(last + "#");
    numbers.push_back(n);
    last.clear();
  };
  while (!pending.empty()) {
    const std::uint64_t n = pending.back();
    pending.pop_back();
    if (!seen.insert(n).second) continue;
    const auto begin = text->find("\n#" + std::to_string(n) + "=");
    const std::string line = text->substr(begin + 1, text->find(";\n", begin) - begin);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] != '#') {
        last += line[i];
        continue;
      }
      std::uint64_t to = 0;
      while (i + 1 < line.size() && line[i + 1] >= '0' && line[i + 1] <= '9') {
        to = 10 * to + static_cast<std::uint64_t>(line[++i] - '0');
      }
      number(to);
      pending.push_back(to);
    }
    last += "\n";
  }
  const auto end = text->rfind("ENDSEC;");
  out.bytes = text->substr(0, end);
  out.solids = 2;  // the file's own
  for (std::uint64_t copy = 1; out.bytes.size() < bytes; ++copy) {
    const auto shifted = [&](std::uint64_t n) {
      return std::to_string(n == kContext ? n : n + copy * kStep);
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) out.bytes += pieces[i] + shifted(numbers[i]);
    out.bytes += last + "#" + shifted(kStep - 1) + "=SHAPE_REPRESENTATION_RELATIONSHIP('none','',#" +
                 std::to_string(kShape) + ",#" + shifted(kBrep) + ");\n";
    ++out.solids;
  }
  out.bytes += text->substr(end);
  return out;
}

// --- measuring ---

/// Peak resident memory since the last `reset_peak`, in bytes (Linux).
double memory(const char* line_name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(line_name)) return std::strtod(line.c_str() + 6, nullptr) * 1024.0;
  }
  return 0.0;
}

void reset_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

void verify(const Input& in, const model::Plan& plan) {
  std::size_t points = 0, solids = 0;
  double sum = 0.0;
  for (const auto at : plan.model.all(model::TypeId::kPolyline)) {
    for (const auto p : plan.model.at<model::Polyline>(at).points.items) {
      const auto* c = plan.model.get<model::CartesianPoint>(p);
      if (c == nullptr) throw std::runtime_error("a point of a toolpath is no point");
      ++points;
      for (const double v : c->coordinates.items) sum += v;
    }
  }
  for (const auto at : plan.model.all(model::TypeId::kKeptInstance)) {
    solids += plan.model.at<model::KeptInstance>(at).keyword == "MANIFOLD_SOLID_BREP";
  }
  if (in.points != 0 && (points != in.points || std::abs(sum - in.sum_mm) > 1e-6 * std::abs(in.sum_mm)))
    throw std::runtime_error("the toolpaths were not read: " + std::to_string(points) + " points");
  solids += plan.model.count(model::TypeId::kManifoldSolidBrep);
  if (solids != in.solids) throw std::runtime_error("solids were lost: " + std::to_string(solids));
}

void read_into_model(benchmark::State& state, Input (*make)(std::size_t)) {
  const Input in = make(static_cast<std::size_t>(state.range(0)) * kMega);
  if (in.bytes.empty()) return state.SkipWithError("the corpus is absent");
  double peak = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = in.bytes;
    reset_peak();
    const double before = memory("VmRSS:") - static_cast<double>(bytes.size());
    Job job;
    state.ResumeTiming();
    auto plan = read_bytes(std::move(bytes), "benchmark.stpnc", {}, job);
    state.PauseTiming();
    peak = std::max(peak, memory("VmHWM:") - before);
    if (!plan) throw std::runtime_error(to_text(plan.error()));
    verify(in, *plan);
    plan = model::Plan{};
    state.ResumeTiming();
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(static_cast<std::size_t>(state.iterations()) * in.bytes.size()));
  state.counters["MB"] = static_cast<double>(in.bytes.size()) / 1e6;
  state.counters["peak_per_byte"] = peak / static_cast<double>(in.bytes.size());
}

void toolpaths_into_model(benchmark::State& state) { read_into_model(state, &toolpaths); }
void solids_into_model(benchmark::State& state) { read_into_model(state, &solids); }

// --- plans of long paths ---

std::string written(const model::Plan& plan) {
  Job job;
  auto file = write_ap238(plan, job);
  if (!file) throw std::runtime_error(to_text(file.error()));
  return std::move(file->bytes);
}

model::Plan read_back(std::string bytes, const model::Plan& plan) {
  Job job;
  auto back = read_bytes(std::move(bytes), "benchmark.stpnc", {}, job);
  if (!back) throw std::runtime_error(to_text(back.error()));
  if (capstan::testing::sum_of_paths(*back) != capstan::testing::sum_of_paths(plan))
    throw std::runtime_error("the paths were not read as they were written");
  return *std::move(back);
}

void write_long_paths(benchmark::State& state) {
  const auto plan = capstan::testing::long_paths_plan(static_cast<std::size_t>(state.range(0)));
  std::string bytes;
  for (auto _ : state) bytes = written(plan);
  state.counters["MB"] = static_cast<double>(bytes.size()) / 1e6;
  read_back(std::move(bytes), plan);
}

void read_long_paths(benchmark::State& state) {
  const auto plan = capstan::testing::long_paths_plan(static_cast<std::size_t>(state.range(0)));
  const std::string bytes = written(plan);
  for (auto _ : state) read_back(bytes, plan);
}

BENCHMARK(write_long_paths)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(read_long_paths)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(toolpaths_into_model)->Arg(25)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(solids_into_model)->Arg(25)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace capstan::exchange
