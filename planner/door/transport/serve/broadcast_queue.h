#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/door/service/broadcast/run.h"
#include "planner/ground/base/result.h"

namespace capstan::transport {

/// The broadcasts of a session: the lines on their way to a reader and to a file, and the replies that come
/// back.
///
/// Thread safety  any thread.
class BroadcastQueue {
 public:
  BroadcastQueue() = default;
  BroadcastQueue(const BroadcastQueue&) = delete;
  BroadcastQueue& operator=(const BroadcastQueue&) = delete;
  ~BroadcastQueue();

  /// What is sent where the plan has no broadcasts, and a file or FIFO (empty: none) that gets each line.
  void set(std::optional<service::DefaultContent> otherwise, std::string file);
  /// Another plan was brought: the run begins anew. `bound`: it is the same, bound further.
  void plan_changed(bool bound);

  using Make = std::function<std::optional<service::Broadcasts>(
      const std::optional<service::DefaultContent>& otherwise)>;
  struct Queued {
    std::vector<service::BroadcastLine> lines;
    std::string
        warning;  ///< why the file did not get them, or lines that no reader took were dropped; a line
  };
  /// The lines that an event makes due (`over`: the run is); they are queued, at most `most`. `make` gives
  /// the broadcasts of the plan at hand, or nothing while they cannot be had: then those from before count.
  /// Fails  as Broadcasts; BROADCAST-PLAN: no plan is there.
  [[nodiscard]] Result<Queued> tell(const service::ControlEvent& event, bool over, std::size_t most,
                                    std::chrono::milliseconds patience, const Make& make);
  /// Whether all of these lines that wait were replied to in time.
  [[nodiscard]] bool replied(const std::vector<service::BroadcastLine>& lines,
                             std::chrono::steady_clock::time_point until);
  /// A reader replied to a line; false: nobody waits for that.
  bool reply(std::uint64_t number);

  /// One reader at a time: false while there is another.
  [[nodiscard]] bool open_stream();
  void close_stream();
  /// The lines that are queued, each with a line end; waits a moment for the first.
  [[nodiscard]] std::string take(std::chrono::milliseconds patience);

 private:
  std::string to_file(const std::vector<service::BroadcastLine>& lines, std::chrono::milliseconds patience);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<service::DefaultContent> otherwise_;
  std::string file_;
  int fd_ = -1;
  service::BroadcastRun run_;
  std::deque<std::string> queue_;
  std::set<std::uint64_t> awaited_;
  bool streamed_ = false;
};

}  // namespace capstan::transport
