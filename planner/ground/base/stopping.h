#pragma once

#include <utility>

namespace capstan {

class Job;

/// What `poll` throws when the work is to end. No `std::exception`, so that no catch for faults takes it for
/// one; `stoppable` alone catches it.
struct Stopped {};

/// While one lives, `poll` on this thread asks its job, and the jobs of the scopes around it: who stops a
/// call stops each try within it.
class StopScope {
 public:
  /// The job must outlive this.
  explicit StopScope(const Job& job);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

  [[nodiscard]] static const StopScope* innermost();
  [[nodiscard]] bool to_stop() const;

 private:
  const Job& job_;
  const StopScope* outer_;
};

/// The scopes of another thread, taken over by one that helps it.
class SharedStopScope {
 public:
  explicit SharedStopScope(const StopScope* of_helped);
  ~SharedStopScope();
  SharedStopScope(const SharedStopScope&) = delete;
  SharedStopScope& operator=(const SharedStopScope&) = delete;

 private:
  const StopScope* own_;
};

/// Throws `Stopped` if a job of this thread's scopes is to stop; without a scope it does nothing. For loops
/// that have no job at hand: paths, sections, sweeps. Costs some 10 ns, with a deadline 50 ns: for turns of a
/// microsecond and more.
void poll();

/// `poll` at every 64th call on this thread: for turns of 20 ns to 50 us. A turn of more counts for `turns`.
inline void tick(unsigned turns = 1) {
  thread_local unsigned counted = 0;
  if ((counted += turns) < 64U) return;
  counted = 0;
  poll();
}

/// What `body` gives; if the work was stopped within it, what `stopped` gives. Both give the same type.
template <class Body, class Otherwise>
auto stoppable(const Job& job, Body body, Otherwise stopped) -> decltype(body()) {
  const StopScope scope(job);
  try {
    return body();
  } catch (const Stopped&) {
    return stopped();
  }
}

}  // namespace capstan
