#include "tests/kept/measure.h"

#include <fcntl.h>
#include <linux/perf_event.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <stdexcept>

namespace capstan::kept {
namespace {

/// Instructions in user mode of this process and the children it makes while this lives (perf_event_open(2)).
class Instructions {
 public:
  Instructions() {
    perf_event_attr a = {};
    a.type = PERF_TYPE_HARDWARE;
    a.size = sizeof a;
    a.config = PERF_COUNT_HW_INSTRUCTIONS;
    a.exclude_kernel = 1;
    a.exclude_hv = 1;
    a.inherit = 1;
    fd_ = static_cast<int>(::syscall(SYS_perf_event_open, &a, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
  }
  ~Instructions() {
    if (fd_ >= 0) ::close(fd_);
  }
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

  [[nodiscard]] bool known() const { return fd_ >= 0; }
  [[nodiscard]] double so_far() const {
    std::uint64_t n = 0;
    return fd_ >= 0 && ::read(fd_, &n, sizeof n) == static_cast<ssize_t>(sizeof n) ? static_cast<double>(n)
                                                                                   : 0.0;
  }

 private:
  int fd_ = -1;
};

double cpu_s() {
  timespec t = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
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

Cost cost_of(const Row& row, std::size_t repeats) {
  std::vector<double> time, instructions;
  Taken before = reference_kernel();
  for (std::size_t k = 0; k < repeats; ++k) {
    const Taken own = row.run();
    const Taken after = reference_kernel();
    time.push_back(own.cpu_s / (0.5 * (before.cpu_s + after.cpu_s)));
    if (own.instructions > 0.0 && after.instructions > 0.0)
      instructions.push_back(own.instructions / after.instructions);
    before = after;
  }
  Cost out{row.name, median(time), std::nullopt};
  if (instructions.size() == repeats) out.instructions = median(instructions);
  return out;
}

}  // namespace

bool instructions_can_be_counted() {
  static const bool can = Instructions().known();
  return can;
}

Taken taken_by(const std::function<void()>& work) {
  const Instructions counter;
  const double from = cpu_s();
  const double counted = counter.so_far();
  work();
  return {cpu_s() - from, counter.so_far() - counted};
}

Taken taken_by(const std::vector<std::string>& command, int most_status) {
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int fd : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, fd, "/dev/null", O_WRONLY, 0);
  const Instructions counter;
  const double counted = counter.so_far();
  pid_t pid = 0;
  const int failed = ::posix_spawn(&pid, command.front().c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (failed != 0) throw std::runtime_error(command.front() + " cannot be run");
  int status = 0;
  rusage usage = {};
  if (::wait4(pid, &status, 0, &usage) != pid || !WIFEXITED(status) || WEXITSTATUS(status) > most_status) {
    std::string all;
    for (const std::string& a : command) all += a + " ";
    throw std::runtime_error(all + "failed");
  }
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), counter.so_far() - counted};
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

std::vector<Cost> measured(const std::vector<Row>& rows, std::size_t repeats) {
  std::vector<Cost> out;
  for (const Row& row : rows) out.push_back(cost_of(row, repeats));
  return out;
}

std::vector<std::string> check(const std::vector<Row>& rows, const std::vector<Cost>& table,
                               std::size_t repeats, std::vector<Cost>& costs) {
  std::vector<std::string> out;
  for (const Row& row : rows) {
    Cost cost = cost_of(row, repeats);
    auto wrong = fault(cost, table);
    for (std::size_t again = 1; wrong && again <= 2; ++again) {
      cost = cost_of(row, repeats * (again + 1));
      wrong = fault(cost, table);
    }
    if (wrong) out.push_back(*std::move(wrong));
    costs.push_back(std::move(cost));
  }
  return out;
}

}  // namespace capstan::kept
