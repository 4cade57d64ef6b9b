#include "planner/ground/base/job.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <thread>
#include <utility>

#include "planner/ground/base/stopping.h"

namespace capstan {

void Job::report(Diagnostic d) {
  const std::lock_guard lock(mutex_);
  diagnostics_.push_back(std::move(d));
}

void Job::note(std::string code, std::string message, std::string path) {
  report({.code = std::move(code),
          .severity = Severity::kNote,
          .message = std::move(message),
          .path = std::move(path)});
}

void Job::warn(std::string code, std::string message, std::string path) {
  report({.code = std::move(code),
          .severity = Severity::kWarning,
          .message = std::move(message),
          .path = std::move(path)});
}

std::vector<Diagnostic> Job::take_diagnostics() {
  const std::lock_guard lock(mutex_);
  return std::exchange(diagnostics_, {});
}

std::size_t Job::count(Severity s) const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count_if(diagnostics_.begin(), diagnostics_.end(),
                                                [s](const auto& d) { return d.severity == s; }));
}

bool Job::stop_requested() const {
  if (stop_.load(std::memory_order_relaxed)) return true;
  return deadline_ && now() >= *deadline_;
}

// The innermost scope of each thread is a variable of the thread: kernels are called from many rooms, most of
// which hand on no job, and a stop must reach all of them.

namespace {

thread_local const StopScope* innermost_scope = nullptr;

}  // namespace

StopScope::StopScope(const Job& job) : job_(job), outer_(std::exchange(innermost_scope, this)) {}
StopScope::~StopScope() { innermost_scope = outer_; }

const StopScope* StopScope::innermost() { return innermost_scope; }

bool StopScope::to_stop() const {
  for (const StopScope* s = this; s != nullptr; s = s->outer_) {
    if (s->job_.stop_requested()) return true;
  }
  return false;
}

SharedStopScope::SharedStopScope(const StopScope* of_helped)
    : own_(std::exchange(innermost_scope, of_helped)) {}
SharedStopScope::~SharedStopScope() { innermost_scope = own_; }

void poll() {
  if (innermost_scope != nullptr && innermost_scope->to_stop()) throw Stopped{};
}

namespace {

/// One call of parallel_for, on the stack of its caller. Indices are claimed in order; after a stop no more
/// are.
class SharedLoop {
 public:
  SharedLoop(std::size_t n, const std::function<void(std::size_t)>& body)
      : n_(n), body_(body), scope_(StopScope::innermost()) {}

  /// Claims and does indices until none is left. Throws nothing.
  void work() {
    for (std::size_t i = next_++; i < n_ && !stopped_; i = next_++) {
      try {
        poll();
        body_(i);
      } catch (const Stopped&) {
        stopped_ = true;
        keep(i);
      } catch (...) {
        keep(i);
      }
    }
  }
  void help() {
    const SharedStopScope scope(scope_);
    work();
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  // Of the pool, under its lock.
  std::size_t wanted = 0;   ///< helpers that may still join
  std::size_t helping = 0;  ///< that are at work

 private:
  void keep(std::size_t i) {
    const std::lock_guard lock(mutex_);
    if (i >= lowest_) return;
    lowest_ = i;
    error_ = std::current_exception();
  }

  const std::size_t n_;
  const std::function<void(std::size_t)>& body_;
  const StopScope* scope_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::size_t lowest_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

/// The threads of the process, made when first wanted and kept. Who calls parallel_for does its share and
/// needs no helper to come, so that calls within calls cannot wait for each other.
class Pool {
 public:
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    for (auto& t : threads_) {
      // A process that was forked has no threads of its parent's.
      if (::getpid() == process_) {
        t.join();
      } else {
        t.detach();
      }
    }
  }

  void run(SharedLoop& shared, std::size_t helpers) {
    {
      const std::lock_guard lock(mutex_);
      while (threads_.size() < helpers) threads_.emplace_back([this] { serve(); });
      shared.wanted = helpers;
      open_.push_back(&shared);
    }
    if (helpers == 1) {
      wake_.notify_one();
    } else {
      wake_.notify_all();
    }
    shared.work();
    std::unique_lock lock(mutex_);
    std::erase(open_, &shared);
    left_.wait(lock, [&] { return shared.helping == 0; });
  }

 private:
  SharedLoop* next() {
    for (SharedLoop* s : open_) {
      if (s->wanted > 0) return s;
    }
    return nullptr;
  }

  void serve() {
    sigset_t all;  // signals are the business of the caller's threads
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
    std::unique_lock lock(mutex_);
    for (;;) {
      SharedLoop* shared = nullptr;
      wake_.wait(lock, [&] { return ending_ || (shared = next()) != nullptr; });
      if (ending_) return;
      --shared->wanted;
      ++shared->helping;
      lock.unlock();
      shared->help();
      lock.lock();
      if (--shared->helping == 0) left_.notify_all();
    }
  }

  const pid_t process_ = ::getpid();
  std::mutex mutex_;
  std::condition_variable wake_, left_;
  std::vector<std::thread> threads_;
  std::vector<SharedLoop*> open_;
  bool ending_ = false;
};

Pool& pool() {
  static Pool one;
  return one;
}

}  // namespace

void parallel_for(const Job& job, std::size_t n, const std::function<void(std::size_t)>& body) {
  const std::size_t workers = std::min<std::size_t>(std::max(1U, job.threads), n);
  SharedLoop shared(n, body);
  if (workers <= 1) {
    shared.work();
  } else {
    pool().run(shared, workers - 1);
  }
  shared.rethrow();
}

}  // namespace capstan
