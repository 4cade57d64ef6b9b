// The case base at size: looking up among 100,000 points of 16 dimensions, opening a file of 100,000 cases,
// adding one to it, adding a million, and importing a table of a million rows. Each answer is held against
// the plain search, or counted, after the timing.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "casebase/casebase.h"
#include "casebase/index/index.h"
#include "casebase/intake.h"
#include "casebase/retain/join/import.h"
#include "tests/casebase/many_cases.h"

namespace capstan::casebase {
namespace {

constexpr std::size_t kNearest = 10;

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

/// Wall times of single calls, the disk's included: their mean says little where some wait for it.
class Waits {
 public:
  template <class Call>
  auto of(Call call) {
    const auto begin = std::chrono::steady_clock::now();
    auto out = call();
    ms_.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    return out;
  }
  void tell(benchmark::State& state) {
    std::sort(ms_.begin(), ms_.end());
    if (ms_.empty()) return;
    state.counters["wall_ms_median"] = ms_[ms_.size() / 2];
    state.counters["wall_ms_worst"] = ms_.back();
  }

 private:
  std::vector<double> ms_;
};

void add_one(benchmark::State& state) {
  Job job;
  auto base = CaseBase::open(file(), job).value();
  std::uint64_t n = 1'000'000'000 + static_cast<std::uint64_t>(base.size());
  bool good = true;
  Waits waits;
  for (auto _ : state) good = waits.of([&] { return base.add(made(n++)).has_value(); }) && good;
  waits.tell(state);
  if (!good) state.SkipWithError("a case was not added");
}
BENCHMARK(add_one)->Unit(benchmark::kMillisecond)->MinTime(0.5);

/// The same to a base that is not read for that, opening it included: what `capstan cases add` does.
void add_one_unread(benchmark::State& state) {
  Job job;
  std::uint64_t n = 2'000'000'000 + static_cast<std::uint64_t>(CaseBase::open(file(), job)->size());
  bool good = true;
  Waits waits;
  for (auto _ : state) {
    Case one = made(n++);
    one.observed.verdict = Verdict::kUnknown;
    const auto added = waits.of([&] {
      auto intake = Intake::open_or_create(file(), job);
      return intake->add(std::span(&one, 1));
    });
    good = added && *added && (*added)->added == 1 && good;
  }
  waits.tell(state);
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

/// What `capstan cases import BASE times` does with a table of a million rows: 100,000 parts of ten tools
/// each, read, joined with their sheet and added at once, as all cases of a call are kept or none. Memory is
/// the most that the program took: run it alone (--benchmark_filter=import_million).
void import_million(benchmark::State& state) {
  constexpr int kParts = 100'000;
  const std::string uri = path() + ".import";
  const std::string csv = path() + ".times.csv";
  std::ofstream(csv, std::ios::binary) << table_of_times(kParts);
  const auto steps = steps_of_times();
  for (auto _ : state) {
    std::filesystem::remove(uri);
    Job job;
    std::ifstream in(csv, std::ios::binary);
    const auto cases = retain::import_log(in, retain::LogFormat::kTimes, steps, {.file = csv}, {}, job);
    auto base = CaseBase::open_or_create(uri, job);
    if (!cases || !base) {
      state.SkipWithError((cases ? base.error() : cases.error()).message.c_str());
      break;
    }
    if (const auto kept = base->add(*cases); !kept) {
      state.SkipWithError(kept.error().message.c_str());
      break;
    }
    if (base->size() != std::size_t{kParts} * kToolsOfTimes) state.SkipWithError("not all rows are cases");
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  state.counters["max_rss_MB"] = static_cast<double>(used.ru_maxrss) / 1024.0;
  state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(uri)) / 1e6;
  std::filesystem::remove(uri);
  std::filesystem::remove(csv);
}
BENCHMARK(import_million)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace capstan::casebase
