#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

namespace capstan::transport {

/// The lines of a server about its peers. Of who is refused at most one a second is told, of who connects 16,
/// so that nobody fills a disk with them; those left out are counted in the next such line. A line that
/// cannot be written yet holds the one thread that writes it; lines of the others wait, at most 64.
///
/// Thread safety  any thread.
class PeerLog {
 public:
  using Clock = std::chrono::steady_clock;
  /// `write`: called by one thread at a time; false: the line is left out. Null: nothing is told.
  explicit PeerLog(std::function<bool(const std::string&)> write) : write_(std::move(write)) {}

  void connected(const std::string& address, const std::string& subject,
                 Clock::time_point now = Clock::now());
  void refused(const std::string& address, const std::string& why, Clock::time_point now = Clock::now());

 private:
  /// Lines of one kind.
  struct Kind {
    std::size_t most;  ///< in a second
    Clock::time_point until = {};
    std::size_t told = 0, left_out = 0;
  };
  struct Line {
    Kind* kind;
    std::string text;
    std::size_t others;  ///< left out before it
  };
  void tell(Kind& kind, std::string text, Clock::time_point now);
  void write_waiting(std::unique_lock<std::mutex>& lock);

  std::function<bool(const std::string&)> write_;
  std::mutex mutex_;
  Kind connected_{16}, refused_{1};
  std::deque<Line> waiting_;
  bool writing_ = false;
};

/// Writes a line whole, or not at all where it would have to wait (a pipe that nobody reads); false then.
/// What is longer than a pipe takes at once (PIPE_BUF) is cut.
[[nodiscard]] bool write_line(int fd, std::string line);

}  // namespace capstan::transport
