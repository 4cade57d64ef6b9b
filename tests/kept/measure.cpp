#include "tests/kept/measure.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"

namespace capstan::kept {
namespace {

double cpu_s() {
  timespec t = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_s() {
  timespec t = {};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  const std::size_t n = v.size();
  return n % 2 == 1 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

Cost cost_of(const Row& row, What what) {
  Cost out{row.name, std::nullopt, std::nullopt};
  if (what.instructions) out.instructions_1e6 = instructions_1e6(row.command);
  if (what.repeats == 0) return out;
  std::vector<double> time;
  Taken before = reference_kernel();
  for (std::size_t k = 0; k < what.repeats; ++k) {
    const Taken own = taken_by(row.command);
    const Taken after = reference_kernel();
    time.push_back(own.cpu_s / (0.5 * (before.cpu_s + after.cpu_s)));
    before = after;
  }
  out.time = median(time);
  return out;
}

/// Runs a program and waits for it. What it prints goes to /dev/null, or to a file where one is named. Throws
/// as taken_by does.
rusage ran(const std::vector<std::string>& command, int most_status, const char* errors = "/dev/null") {
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, errors, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t pid = 0;
  const int failed =
      ::posix_spawnp(&pid, command.front().c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (failed != 0) throw std::runtime_error(command.front() + " cannot be run");
  int status = 0;
  rusage usage = {};
  if (::wait4(pid, &status, 0, &usage) != pid || !WIFEXITED(status) || WEXITSTATUS(status) > most_status) {
    std::string all;
    for (const std::string& a : command) all += a + " ";
    throw std::runtime_error(all + "failed");
  }
  return usage;
}

/// The number behind "I refs:" in what cachegrind says of a run, or nothing.
std::optional<double> refs_of(const std::string& said) {
  constexpr std::string_view kRefs = "refs:";
  const auto at = said.rfind(kRefs);
  if (at == std::string::npos) return std::nullopt;
  std::string digits;
  for (std::size_t k = at + kRefs.size(); k < said.size() && said[k] != '\n'; ++k)
    if (said[k] >= '0' && said[k] <= '9') digits += said[k];
  return parse_double(digits);
}

/// What compiled this, and how far it optimised: another build has other instructions.
std::string build() {
#if defined(__clang__)
  const std::string compiler = "clang";
#else
  const std::string compiler = "gcc";
#endif
#if defined(__OPTIMIZE__)
  const char* optimised = "-O";
#else
  const char* optimised = "-O0";
#endif
  return compiler + " " + std::string(__VERSION__).substr(0, std::string(__VERSION__).find(' ')) + " " +
         optimised;
}

/// The instruction sets that change which code is run here, of those that Valgrind knows.
std::string instruction_sets() {
  utsname machine = {};
  ::uname(&machine);
  std::string out = machine.machine;
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("flags")) continue;
    for (const char* set : {"avx2", "fma"})
      if ((line + " ").find(" " + std::string(set) + " ") != std::string::npos) out += " " + std::string(set);
    break;
  }
  return out;
}

}  // namespace

std::string counter() {
  const testing::ScratchFolder scratch;
  const std::string said = scratch.file("version");
  try {
    (void)ran({"/bin/sh", "-c", "valgrind --version >&2"}, 0, said.c_str());
  } catch (const std::runtime_error&) {
    return {};
  }
  std::string version = read_file(said).value_or("");
  while (!version.empty() && version.back() == '\n') version.pop_back();
  return version + " " + instruction_sets() + " " + build();
}

double instructions_1e6(const std::vector<std::string>& command, int most_status) {
  const testing::ScratchFolder scratch;
  const std::string said = scratch.file("said");
  std::vector<std::string> all = {"valgrind", "--tool=cachegrind", "--cache-sim=no",
                                  "--cachegrind-out-file=/dev/null"};
  all.insert(all.end(), command.begin(), command.end());
  (void)ran(all, most_status, said.c_str());
  const auto refs = refs_of(read_file(said).value_or(""));
  if (!refs) throw std::runtime_error(command.front() + ": Valgrind says no number of instructions");
  return *refs * 1e-6;
}

Taken taken_by(const std::function<void()>& work) {
  const double from = cpu_s(), began = wall_s();
  work();
  return {cpu_s() - from, wall_s() - began, 0.0};
}

Taken taken_by(const std::vector<std::string>& command, int most_status) {
  constexpr double kMegabytes = 1e-3;  // of the kilobytes that Linux counts
  const double began = wall_s();
  const rusage usage = ran(command, most_status);
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), wall_s() - began,
          kMegabytes * static_cast<double>(usage.ru_maxrss)};
}

Taken reference_kernel() {
  constexpr std::size_t kSize = 200000;
  constexpr int kRounds = 20;
  return taken_by([] {
    std::vector<double> a(kSize);
    std::uint64_t seed = 88172645463325252U;  // xorshift64, G. Marsaglia, J. Statistical Software 8 (2003) 14
    for (double& v : a) {
      seed ^= seed << 13U;
      seed ^= seed >> 7U;
      seed ^= seed << 17U;
      v = static_cast<double>(seed >> 11U) * 0x1.0p-53;
    }
    double sum = 0.0;
    for (int k = 0; k < kRounds; ++k) {
      for (const double v : a) sum = 0.5 * sum + std::sqrt(v + sum);
    }
    std::sort(a.begin(), a.end());
    if (!(sum > 0.0) || !std::is_sorted(a.begin(), a.end())) throw std::runtime_error("the kernel is wrong");
  });
}

std::vector<Cost> measured(const std::vector<Row>& rows, What what) {
  std::vector<Cost> out;
  for (const Row& row : rows) out.push_back(cost_of(row, what));
  return out;
}

std::vector<std::string> check(const std::vector<Row>& rows, const std::vector<Cost>& table, What what,
                               std::vector<Cost>& costs) {
  std::vector<std::string> out;
  for (const Row& row : rows) {
    Cost cost = cost_of(row, what);
    auto wrong = fault(cost, table);
    for (std::size_t again = 1; wrong && !cost.instructions_1e6 && again <= 2; ++again) {
      cost = cost_of(row, {what.repeats * (again + 1), false});
      wrong = fault(cost, table);
    }
    if (wrong) out.push_back(*std::move(wrong));
    costs.push_back(std::move(cost));
  }
  return out;
}

}  // namespace capstan::kept
