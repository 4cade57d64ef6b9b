#include "planner/ground/base/job.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <utility>

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

void parallel_for(const Job& job, std::size_t n, const std::function<void(std::size_t)>& body) {
  const std::size_t workers = std::min<std::size_t>(std::max(1U, job.threads), n);
  if (workers <= 1) {
    for (std::size_t i = 0; i < n; ++i) body(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(n);
  std::vector<std::thread> pool;
  pool.reserve(workers);
  for (std::size_t w = 0; w < workers; ++w) {
    pool.emplace_back([&] {
      for (std::size_t i = next++; i < n; i = next++) {
        try {
          body(i);
        } catch (...) {
          errors[i] = std::current_exception();
        }
      }
    });
  }
  for (auto& t : pool) t.join();
  for (const auto& e : errors) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace capstan
