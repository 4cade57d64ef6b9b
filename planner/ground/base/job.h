#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan {

/// What a piece of work is given besides its inputs: where to say things, how to be stopped, how much
/// it may compute. One `Job` per command or late-binding call; rooms take `Job&` last.
///
/// Thread safety   `report` may be called from any thread; order is that of the calls, so code that
///                 runs in parallel collects its diagnostics and reports them in a fixed order.
class Job {
 public:
  /// Called with the stage's name and its fraction in [0, 1].
  using Progress = std::function<void(std::string_view stage, double fraction)>;

  /// Adds a diagnostic to the sink.
  void report(Diagnostic d);
  void note(std::string code, std::string message, std::string path = {});
  void warn(std::string code, std::string message, std::string path = {});

  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] std::vector<Diagnostic> take_diagnostics();
  [[nodiscard]] std::size_t count(Severity s) const;
  [[nodiscard]] bool has_errors() const { return count(Severity::kError) != 0; }

  void set_progress(Progress p) { progress_ = std::move(p); }
  void progress(std::string_view stage, double fraction) const {
    if (progress_) progress_(stage, fraction);
  }

  /// Asks the work to end; it returns what it verified so far. Safe from any thread.
  void request_stop() { stop_.store(true, std::memory_order_relaxed); }
  /// A guard in wall time (monotonic clock). Decisions must not depend on it: budgets do that.
  void set_deadline(std::chrono::steady_clock::time_point t) { deadline_ = t; }
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> deadline() const { return deadline_; }
  /// What tells the time for the deadline; nothing: the monotonic clock. A test may bring its own.
  using Clock = std::function<std::chrono::steady_clock::time_point()>;
  void set_clock(Clock clock) { clock_ = std::move(clock); }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] std::chrono::steady_clock::time_point now() const {
    return clock_ ? clock_() : std::chrono::steady_clock::now();
  }
  [[nodiscard]] bool stop_requested() const;

  /// Objective evaluations an optimiser may spend on one problem: deterministic, unlike time.
  std::uint32_t evaluation_budget = 2000;
  /// Worker threads a room may use; results never depend on it.
  unsigned threads = 1;

 private:
  std::vector<Diagnostic> diagnostics_;
  mutable std::mutex mutex_;
  Progress progress_;
  std::atomic<bool> stop_{false};
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  Clock clock_;
};

/// Calls body(i) for i in [0, n) on up to job.threads threads. The body writes only to its own slot i,
/// so that the outcome does not depend on the number of threads. Rethrows the first (lowest i) exception.
void parallel_for(const Job& job, std::size_t n, const std::function<void(std::size_t)>& body);

}  // namespace capstan
