// capstan_bind_times FOLDER [CASE [TURNS]]: binds plans as a control does, again and again, and writes
// bind_times.csv (a line of the machine; then case, steps of the plan, points of what was bound, wall_ms,
// cpu_ms of each binding) into FOLDER; with CASE that case alone, with TURNS so many of its bindings: two
// runs under `valgrind --tool=callgrind` differ by the instructions of the bindings that the one has more.
// The time of a binding is that of the call, the tool table's change and the program included. Status 1 when
// one fails.

#include <sys/resource.h>
#include <time.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include "planner/door/service/session.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/plan/plan.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/shop.h"

namespace {

using namespace capstan;

constexpr auto kAtOnce = std::chrono::milliseconds(1);  // no time for an improvement
constexpr auto kInTime = std::chrono::minutes(10);
// Features of plates whose plans have some 50, and some 10,000 workingsteps.
constexpr std::size_t kFifty = 34, kTenThousand = 6667;

double cpu_ms() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// The processor's name, as the kernel has it.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "an unknown processor";
}

/// A plan as JSON, with the tool table of the tools that planning all of it takes.
struct Early {
  std::string json, table;
  std::size_t steps = 0;
};

std::string json_of(const model::Plan& plan) {
  Job job;
  auto text = pipeline::write_plan(plan, pipeline::Format::kJson, job);
  return text ? *std::move(text) : std::string();
}

Early early(const std::string& part, pipeline::Bind bind, const std::string& table = {}) {
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  const auto read = pipeline::read_plan(part, "part.p21", job);
  if (!shop || !read) return {};
  Early out;
  auto made = pipeline::bind(*read, *shop, {.bind = table.empty() ? pipeline::Bind::kAll : bind}, job);
  if (!made) return {};
  if (table.empty()) {
    auto text = pipeline::write_plan(*made, pipeline::Format::kToolTable, job);
    if (!text) return {};
    out.table = *std::move(text);
    if (bind != pipeline::Bind::kAll) made = pipeline::bind(*read, *shop, {.bind = bind}, job);
    if (!made) return {};
  } else {
    out.table = table;
  }
  out.json = json_of(*made);
  out.steps = given::steps_in_order(*made).size();
  return out;
}

class Measuring {
 public:
  /// One binding, timed. `call` gives its code.
  template <class Call>
  void turn(const std::string& name, std::size_t steps, service::Session& session, Call call) {
    const double cpu = cpu_ms();
    const auto began = std::chrono::steady_clock::now();
    const service::Code code = call();
    const std::string* program = session.output("linuxcnc");
    const double wall =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
    const double spent = cpu_ms() - cpu;
    if ((code != service::Code::kDone && code != service::Code::kLate) || program == nullptr) {
      std::cerr << name << ": " << session.message() << "\n";
      failed_ = true;
      return;
    }
    rows_ += name + "," + std::to_string(steps) + "," + std::to_string(points(*program)) + "," +
             fixed(wall, 2) + "," + fixed(spent, 2) + "\n";
  }
  [[nodiscard]] bool failed() const { return failed_; }
  void fail(const std::string& what) {
    std::cerr << what << "\n";
    failed_ = true;
  }
  [[nodiscard]] const std::string& rows() const { return rows_; }

 private:
  /// Lines of a program that move.
  static std::size_t points(const std::string& program) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = program.find("\nG", at)) != std::string::npos; ++at)
      n += program[at + 2] >= '0' && program[at + 2] <= '3' ? 1 : 0;
    return n;
  }
  std::string rows_;
  bool failed_ = false;
};

/// A tool of the magazine is changed by so much at each turn, and the whole plan bound again in one session.
void changed_tool(Measuring& m, const std::string& name, const Early& plan, const std::string& tool,
                  const std::string& key, double by_mm, int turns) {
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  service::Session session;
  const auto bind = [&](int k) {
    std::ofstream(path) << capstan::testing::with_tool_changed(plan.table, tool, key, by_mm * k);
    const service::Code code = session.set("tools", path);
    return code == service::Code::kDone ? session.bind(plan.json, kAtOnce) : code;
  };
  if (const service::Code code = bind(0); code != service::Code::kDone && code != service::Code::kLate)
    return m.fail(name + ": " + session.message());
  for (int k = 1; k <= turns; ++k) m.turn(name, plan.steps, session, [&] { return bind(k); });
}

/// Each workingstep of a plan with everything open when its turn comes.
void step_by_step(Measuring& m, const std::string& name, const Early& plan, int times, std::size_t most) {
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  std::ofstream(path) << plan.table;
  for (int k = 0; k < times; ++k) {
    service::Session session;
    if (session.set("tools", path) != service::Code::kDone || session.open() != service::Code::kDone ||
        session.take(plan.json) != service::Code::kDone)
      return m.fail(name + ": " + session.message());
    for (std::size_t step = 0; step < std::min(most, plan.steps); ++step) {
      m.turn(name, plan.steps, session, [&] { return session.bind_next({}, 0, 1, kAtOnce); });
      // After a late answer the same step is bound again: one in time lets the session go on.
      if (step + 1 < std::min(most, plan.steps) &&
          session.bind_next({}, 0, 1, kInTime) != service::Code::kDone)
        return m.fail(name + ": " + session.message());
    }
  }
}

/// A plan with everything open, each time in a session that knows nothing.
void all_open(Measuring& m, const std::string& name, const Early& plan, int times) {
  const capstan::testing::ScratchFolder folder;
  const std::string path = folder.path() + "/tool.tbl";
  std::ofstream(path) << plan.table;
  for (int k = 0; k < times; ++k) {
    service::Session session;
    if (session.set("tools", path) != service::Code::kDone || session.open() != service::Code::kDone)
      return m.fail(name + ": " + session.message());
    m.turn(name, plan.steps, session, [&] { return session.bind(plan.json, kAtOnce); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int most = argc == 4 ? std::atoi(argv[3]) : 0;
  if (argc < 2 || argc > 4 || (argc == 4 && most < 1)) {
    std::cerr << "usage: capstan_bind_times FOLDER [length|diameter|next|bracket|first [TURNS]]\n";
    return 2;
  }
  const auto turns = [&](int usual) { return most > 0 ? most : usual; };
  const auto wanted = [&](const std::string& name) { return argc == 2 || name == argv[2]; };
  Measuring m;
  const std::string bracket =
      capstan::testing::slurp(capstan::testing::source_dir() + "/examples/bracket.p21");
  // What is there so far, so that a long run that is broken off leaves it.
  const auto write = [&] {
    const std::string machine =
        processor() + "," + std::to_string(std::thread::hardware_concurrency()) + "\n";
    if (!write_file(std::string(argv[1]) + "/bind_times.csv", machine + m.rows())) m.fail("cannot write");
  };
  const Early plate = early(capstan::testing::plate(kFifty).text, pipeline::Bind::kAll);
  if (wanted("length")) changed_tool(m, "length", plate, "7.8 mm", "Z", 0.01, turns(200));
  write();
  if (wanted("diameter")) changed_tool(m, "diameter", plate, "end mill", "D", -0.0011, turns(100));
  write();
  if (wanted("next"))
    step_by_step(m, "next", early(capstan::testing::plate(kFifty).text, pipeline::Bind::kStrategy),
                 most > 0 ? 1 : 10, static_cast<std::size_t>(turns(1000)));
  write();
  if (wanted("bracket")) all_open(m, "bracket", early(bracket, pipeline::Bind::kStrategy), turns(20));
  write();
  if (wanted("first"))
    step_by_step(m, "first",
                 early(capstan::testing::plate(kTenThousand).text, pipeline::Bind::kStrategy, plate.table),
                 turns(20), 1);
  write();
  return m.failed() ? 1 : 0;
}
