#include "planner/ground/base/loading/process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "planner/ground/base/stopping.h"

namespace capstan {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// A file in memory, without a name.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("capstan", MFD_CLOEXEC)) {
    if (fd_ < 0 || fd_ > STDERR_FILENO) return;
    // This process runs without standard files; the child needs the numbers.
    const int low = std::exchange(fd_, ::fcntl(fd_, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    ::close(low);
  }
  ~MemoryFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] bool fill(std::string_view bytes) const {
    while (!bytes.empty()) {
      const auto n = ::write(fd_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return ::lseek(fd_, 0, SEEK_SET) == 0;
  }
  [[nodiscard]] std::string content(std::size_t most) const {
    struct stat about {};
    if (::fstat(fd_, &about) != 0 || about.st_size <= 0) return {};
    std::string out(std::min(most, static_cast<std::size_t>(about.st_size)), '\0');
    std::size_t at = 0;
    while (at < out.size()) {
      const auto n = ::pread(fd_, out.data() + at, out.size() - at, static_cast<off_t>(at));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      at += static_cast<std::size_t>(n);
    }
    out.resize(at);
    return out;
  }

 private:
  int fd_;
};

void limit(int which, std::uint64_t soft, std::uint64_t hard) {
  const rlimit both{soft, hard};
  ::setrlimit(which, &both);
}

constexpr int kNotStarted = 127;  // as a shell says it, and the dynamic loader

/// In the child, between fork and exec: only what is safe there.
[[noreturn]] void become(const char* program, char* const* arguments, const int (&files)[3],
                         const ProcessLimits& limits, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNotStarted);  // it died before that was asked for
  // Of an interrupt at the terminal the parent hears, and decides.
  ::signal(SIGINT, SIG_IGN);
  for (const int usual : {SIGPIPE, SIGXCPU, SIGXFSZ}) ::signal(usual, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  limit(RLIMIT_CORE, 0, 0);
  if (limits.processor_s != 0) limit(RLIMIT_CPU, limits.processor_s, limits.processor_s + 1);
  if (limits.memory_bytes != 0) limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
  if (limits.output_bytes != 0) limit(RLIMIT_FSIZE, limits.output_bytes, limits.output_bytes);
  for (int i = 0; i < 3; ++i) {
    if (::dup2(files[i], i) < 0) ::_exit(kNotStarted);
  }
  ::close_range(3, ~0U, 0);
  ::execv(program, arguments);
  const char* why = std::strerror(errno);
  if (::write(STDERR_FILENO, why, std::strlen(why)) < 0) ::_exit(kNotStarted);
  ::_exit(kNotStarted);
}

bool to_stop(const Job& job) {
  const StopScope* scope = StopScope::innermost();
  return job.stop_requested() || (scope != nullptr && scope->to_stop());
}

/// Waits for the end; ends it where it must not go on.
ProcessEnd await(pid_t child, const ProcessLimits& limits, const Job& job) {
  const auto start = steady_clock::now();
  milliseconds pause{0};
  ProcessEnd out;
  int status = 0;
  for (;;) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    // Somebody else waited for it, or the system does where SIGCHLD is ignored: what it wrote tells how it
    // ended.
    if (ended < 0 && errno != EINTR) return out;
    const bool late = limits.wall.count() != 0 && steady_clock::now() - start > limits.wall;
    if (late || to_stop(job)) {
      out.kind = late ? ProcessEnd::Kind::kWall : ProcessEnd::Kind::kStopped;
      ::kill(child, SIGKILL);
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      return out;
    }
    pause = std::min(pause + milliseconds{1}, milliseconds{5});
    std::this_thread::sleep_for(pause);
  }
  if (to_stop(job)) {
    out.kind = ProcessEnd::Kind::kStopped;
  } else if (WIFEXITED(status)) {
    out.status = WEXITSTATUS(status);
  } else {
    out.status = WTERMSIG(status);
    out.kind = out.status == SIGXCPU   ? ProcessEnd::Kind::kProcessor
               : out.status == SIGXFSZ ? ProcessEnd::Kind::kOutput
                                       : ProcessEnd::Kind::kSignal;
  }
  return out;
}

}  // namespace

Result<ProcessEnd> run_process(const std::string& program, const std::vector<std::string>& arguments,
                               std::string_view input, const ProcessLimits& limits, const Job& job) {
  const auto impossible = [](const char* what) {
    return fail("PROCESS-START", std::string(what) + ": " + std::strerror(errno));
  };
  const MemoryFile in, out, error;
  if (in.fd() < 0 || out.fd() < 0 || error.fd() < 0) return impossible("no memory file can be had");
  if (!in.fill(input)) return impossible("there is no memory for the program's input");
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int files[3] = {in.fd(), out.fd(), error.fd()};
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return impossible("no process can be started");
  if (child == 0) become(program.c_str(), argv.data(), files, limits, parent);
  ProcessEnd end = await(child, limits, job);
  constexpr std::size_t kErrorShown = 4096;
  end.error = error.content(kErrorShown);
  if (end.kind == ProcessEnd::Kind::kExited) end.out = out.content(~std::size_t{0});
  return end;
}

}  // namespace capstan
