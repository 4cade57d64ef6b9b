// The longest time that work goes on without asking whether it is to stop: CPU time between two questions of
// planning, writing, and checking again what was written. Counters: longest_ms, gaps over 5 ms, questions,
// and where the longest is (1 planning, 2 writing, 3 checking its program, 4 checking files).

#include <benchmark/benchmark.h>

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/door/service/check.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "tests/support/corpus.h"

namespace {

using namespace capstan;  // a program of its own

double cpu_ms() {
  timespec t = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// A job whose clock notes when it is read; it never stops.
class Asked {
 public:
  Asked() {
    job.set_deadline(std::chrono::steady_clock::time_point::max());
    job.set_clock([this] {
      ask();
      return std::chrono::steady_clock::time_point();
    });
  }
  void ask() {
    const double now = cpu_ms();
    if (now - last_ > longest_ms) {
      longest_ms = now - last_;
      longest_in = stage;
    }
    over += now - last_ > 5.0 ? 1 : 0;
    last_ = now;
    ++questions;
  }
  Job job;
  int stage = 1, longest_in = 0;
  double longest_ms = 0.0;
  long questions = 0, over = 0;

 private:
  double last_ = cpu_ms();
};

bool written_and_checked(const service::Request& request, const service::Planned& planned, Asked& a) {
  a.stage = 2;
  auto outputs = service::outputs_of({"p.json", "p.p21", "p.stpnc", "p.ngc", "p.tbl"});
  const bool made = service::make(planned.plan, *outputs, a.job).has_value();
  a.ask();
  a.stage = 3;
  const bool judged = service::judge(request, planned, *outputs, a.job).has_value();
  a.ask();
  a.stage = 4;
  std::vector<service::Source> sources;
  for (const std::size_t i : {0U, 3U, 4U}) sources.push_back({(*outputs)[i].path, (*outputs)[i].bytes});
  const bool checked = service::check(request, std::move(sources), {}, a.job).has_value();
  a.ask();
  return made && judged && checked;
}

void longest_gap(benchmark::State& state, const std::string& part, bool reopen) {
  if (!std::filesystem::exists(part)) return state.SkipWithError("the part is absent");
  service::Request request;
  if (reopen && !service::set(request, "reopen", "all")) return state.SkipWithError("no option reopen");
  for (auto _ : state) {
    Asked a;
    const auto planned = service::plan(request, {part}, a.job);
    a.ask();
    if (!planned) return state.SkipWithError(to_text(planned.error().what).c_str());
    if (!planned->plan.steps.empty() && !written_and_checked(request, *planned, a))
      return state.SkipWithError("the work failed");
    state.counters["longest_ms"] = a.longest_ms;
    state.counters["over_5_ms"] = static_cast<double>(a.over);
    state.counters["longest_in"] = a.longest_in;
    state.counters["questions"] = static_cast<double>(a.questions);
  }
}

const std::string kExamples = capstan::testing::source_dir() + "/examples/";
const std::string kCorpus = capstan::testing::corpus_folder() + "/iso14649/";
BENCHMARK_CAPTURE(longest_gap, bracket, kExamples + "bracket.p21", false)->Iterations(1);
BENCHMARK_CAPTURE(longest_gap, surface, kExamples + "surface.stl", false)->Iterations(1);
BENCHMARK_CAPTURE(longest_gap, nist_ex1, kCorpus + "nist_ex1.stp", true)->Iterations(1);
BENCHMARK_CAPTURE(longest_gap, fdis_ex2, kCorpus + "fdis_ex2.p21", true)->Iterations(1);
BENCHMARK_CAPTURE(longest_gap, FuroConico, kCorpus + "ufsc_FuroConico.p21", true)->Iterations(1);

}  // namespace
