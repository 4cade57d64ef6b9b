// The case base at size: looking up among 100,000 points of 16 dimensions, opening a file of 100,000 cases,
// adding one to it, and adding a million. Each answer is held against the plain search, or counted, after the
// timing.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>

#include "casebase/casebase.h"
#include "casebase/index/index.h"
#include "casebase/intake.h"

namespace capstan::casebase {
namespace {

constexpr std::size_t kPoints = 100'000, kDims = 16, kNearest = 10;

/// Points all over a cube, or around 500 centres, as the parts of a shop are.
const Points& points(bool clustered) {
  static const auto kMake = [](bool around) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-5.0, 5.0);
    std::normal_distribution<double> near(0.0, 0.1);
    std::vector<double> centres(500 * kDims);
    for (double& v : centres) v = any(random);
    Points out{kDims, {}};
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double* c = centres.data() + (random() % 500) * kDims;
      for (std::size_t d = 0; d < kDims; ++d)
        out.values.push_back(around ? c[d] + near(random) : any(random));
    }
    return out;
  };
  static const Points kUniform = kMake(false), kClustered = kMake(true);
  return clustered ? kClustered : kUniform;
}

using Make = std::unique_ptr<Index> (*)(Points);

void look_up(benchmark::State& state, Make make, bool clustered) {
  const Points& all = points(clustered);
  const auto index = make(all);
  const std::vector<double> weight(kDims, 1.0);
  std::mt19937_64 random(9);
  std::normal_distribution<double> near(0.0, 0.1);
  std::vector<std::vector<double>> questions;
  for (int i = 0; i < 200; ++i) {
    const double* p = all.row(random() % kPoints);
    questions.emplace_back(p, p + kDims);
    for (double& v : questions.back()) v += near(random);
  }
  std::size_t i = 0;
  std::vector<Hit> hits;
  for (auto _ : state) {
    hits = index->nearest({questions[i % 200], weight}, kNearest);
    ++i;
  }
  if (hits != make_linear_index(all)->nearest({questions[(i - 1) % 200], weight}, kNearest))
    state.SkipWithError("other neighbours than the plain search");
}
BENCHMARK_CAPTURE(look_up, tree_clustered, &make_tree_index, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(look_up, built_clustered, &make_index, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(look_up, linear_clustered, &make_linear_index, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(look_up, tree_uniform, &make_tree_index, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(look_up, built_uniform, &make_index, false)->Unit(benchmark::kMicrosecond);

void build(benchmark::State& state, Make make) {
  for (auto _ : state) benchmark::DoNotOptimize(make(points(true)));
}
BENCHMARK_CAPTURE(build, tree, &make_tree_index)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, built, &make_index)->Unit(benchmark::kMillisecond);

/// Cases of some dozen categories, each with some twenty numbers.
Case made(std::uint64_t n) {
  std::mt19937_64 random(n);
  const auto pick = [&](std::uint64_t below) { return static_cast<double>(random() % below); };
  constexpr std::string_view kOperations[] = {"DRILLING", "REAMING", "SIDE_ROUGH_MILLING",
                                              "PLANE_FINISH_MILLING"};
  constexpr std::string_view kMaterials[] = {"P/c45", "N/6061", "M/304"};
  Case c;
  c.origin = Origin::kMeasured;
  c.asked.operation = kOperations[random() % 4];
  c.asked.material_group = kMaterials[random() % 3];
  c.asked.tool_class = "carbide/endmill";
  c.asked.machine_class = "generic_vmc";
  c.asked.diameter_mm = 3.0 + 0.1 * pick(300);
  c.asked.depth_mm = 5.0 + pick(40);
  c.asked.cutter_diameter_mm = 3.0 + pick(20);
  c.asked.teeth = static_cast<int>(2 + random() % 4);
  c.asked.stick_out_mm = 20.0 + pick(60);
  c.asked.hardness_hb = 100.0 + pick(150);
  c.asked.coolant = Coolant::kFlood;
  c.bound.vc_m_min = 50.0 + pick(200);
  c.bound.fz_mm = 0.01 + 0.001 * pick(100);
  c.bound.ap_mm = 1.0 + pick(5);
  c.observed.time_s = Figure{10.0 + pick(100), 0.1, Origin::kMeasured};
  c.observed.peak_force_n = Figure{100.0 + pick(900), 20.0, Origin::kMeasured};
  c.observed.verdict = random() % 10 == 0 ? Verdict::kBad : Verdict::kGood;
  c.from.part = "part " + std::to_string(n);
  c.from.source = "lot " + std::to_string(n / 1000);
  return c;
}

std::vector<Case> many(std::size_t n) {
  std::vector<Case> out;
  out.reserve(n);
  for (std::size_t i = 0; i < n; ++i) out.push_back(made(i));
  return out;
}

std::string path() {
  return (std::filesystem::temp_directory_path() / "capstan_casebase_benchmark.db").string();
}

const std::string& file() {
  static const std::string kFile = [] {
    std::filesystem::remove(path());
    Job job;
    auto base = CaseBase::open_or_create(path(), job);
    if (!base || !base->add(many(kPoints))) std::abort();
    return path();
  }();
  return kFile;
}

void open(benchmark::State& state) {
  const std::string& uri = file();
  std::size_t n = 0;
  for (auto _ : state) {
    Job job;
    n = CaseBase::open(uri, job)->size();
  }
  if (n < kPoints) state.SkipWithError("not all cases are there");
}
BENCHMARK(open)->Unit(benchmark::kMillisecond);

void first_question(benchmark::State& state) {
  Job job;
  std::size_t n = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto base = CaseBase::open(file(), job).value();
    state.ResumeTiming();
    n = base.nearest(made(5).asked, kNearest)->size();
  }
  if (n != kNearest) state.SkipWithError("too few neighbours");
}
BENCHMARK(first_question)->Unit(benchmark::kMillisecond);

void question(benchmark::State& state) {
  Job job;
  const auto base = CaseBase::open(file(), job).value();
  std::uint64_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(base.nearest(made(n++ % 1000).asked, kNearest));
}
BENCHMARK(question)->Unit(benchmark::kMicrosecond);

void add_one(benchmark::State& state) {
  Job job;
  auto base = CaseBase::open(file(), job).value();
  std::uint64_t n = 1'000'000'000 + static_cast<std::uint64_t>(base.size());
  bool good = true;
  for (auto _ : state) good = base.add(made(n++)).has_value() && good;
  if (!good) state.SkipWithError("a case was not added");
}
BENCHMARK(add_one)->Unit(benchmark::kMillisecond)->MinTime(0.5);

/// The same to a base that is not read for that, opening it included: what `capstan cases add` does.
void add_one_unread(benchmark::State& state) {
  Job job;
  std::uint64_t n = 2'000'000'000 + static_cast<std::uint64_t>(CaseBase::open(file(), job)->size());
  bool good = true;
  for (auto _ : state) {
    Case one = made(n++);
    one.observed.verdict = Verdict::kUnknown;
    auto intake = Intake::open_or_create(file(), job);
    const auto added = intake->add(std::span(&one, 1));
    good = added && *added && (*added)->added == 1 && good;
  }
  if (!good) state.SkipWithError("a case was not added");
}
BENCHMARK(add_one_unread)->Unit(benchmark::kMillisecond)->MinTime(0.5);

/// The base of 100,000 cases on the server that CAPSTAN_BENCHMARK_SERVER names (a URI of an empty database);
/// its local copy where CAPSTAN_CASES says. Nothing where there is none.
std::optional<std::string> on_server(benchmark::State& state) {
  const char* uri = std::getenv("CAPSTAN_BENCHMARK_SERVER");
  if (uri == nullptr) {
    state.SkipWithError("CAPSTAN_BENCHMARK_SERVER names no server");
    return std::nullopt;
  }
  static const bool kFilled = [&] {
    Job job;
    auto base = CaseBase::open_or_create(uri, job);
    return base && (base->size() >= kPoints || base->add(many(kPoints)));
  }();
  if (!kFilled) state.SkipWithError("the server takes no cases");
  return kFilled ? std::optional<std::string>(uri) : std::nullopt;
}

void open_on_server(benchmark::State& state) {
  const auto uri = on_server(state);
  if (!uri) return;
  std::size_t n = 0;
  for (auto _ : state) {
    Job job;
    n = CaseBase::open(*uri, job)->size();
  }
  if (n < kPoints) state.SkipWithError("not all cases are there");
}
BENCHMARK(open_on_server)->Unit(benchmark::kMillisecond);

/// What the connection alone costs: a base without a case, on the server that CAPSTAN_BENCHMARK_EMPTY names.
void connect_to_server(benchmark::State& state) {
  const char* uri = std::getenv("CAPSTAN_BENCHMARK_EMPTY");
  if (uri == nullptr) {
    state.SkipWithError("CAPSTAN_BENCHMARK_EMPTY names no server");
    return;
  }
  Job job;
  if (!CaseBase::open_or_create(uri, job)) state.SkipWithError("the server takes no cases");
  for (auto _ : state) benchmark::DoNotOptimize(CaseBase::open(uri, job));
}
BENCHMARK(connect_to_server)->Unit(benchmark::kMillisecond);

void add_one_on_server(benchmark::State& state) {
  const auto uri = on_server(state);
  if (!uri) return;
  Job job;
  auto base = CaseBase::open(*uri, job).value();
  std::uint64_t n = 1'000'000'000 + static_cast<std::uint64_t>(base.size());
  bool good = true;
  for (auto _ : state) good = base.add(made(n++)).has_value() && good;
  if (!good) state.SkipWithError("a case was not added");
}
BENCHMARK(add_one_on_server)->Unit(benchmark::kMillisecond)->MinTime(0.5);

/// A million in batches of 10,000; memory is the most that the program took, the cases being added included.
void add_million(benchmark::State& state) {
  const std::string uri = path() + ".million";
  for (auto _ : state) {
    std::filesystem::remove(uri);
    Job job;
    auto base = CaseBase::open_or_create(uri, job).value();
    for (std::uint64_t batch = 0; batch < 100; ++batch) {
      std::vector<Case> cases;
      for (std::uint64_t i = 0; i < 10'000; ++i) cases.push_back(made(batch * 10'000 + i));
      if (!base.add(cases)) std::abort();
    }
    if (base.size() != 1'000'000) state.SkipWithError("not all cases are there");
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  state.counters["max_rss_MB"] = static_cast<double>(used.ru_maxrss) / 1024.0;
  state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(uri)) / 1e6;
  std::filesystem::remove(uri);
}
BENCHMARK(add_million)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace capstan::casebase
