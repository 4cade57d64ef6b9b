#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace capstan::transport {

/// The lines of a server about its peers. Who is refused makes at most one line a second, so that nobody
/// fills a disk with them; those left out are counted in the next.
///
/// Thread safety  any thread.
class PeerLog {
 public:
  using Clock = std::chrono::steady_clock;
  explicit PeerLog(std::function<void(const std::string&)> write) : write_(std::move(write)) {}

  void connected(const std::string& address, const std::string& subject);
  void refused(const std::string& address, const std::string& why, Clock::time_point now = Clock::now());

 private:
  std::function<void(const std::string&)> write_;
  std::mutex mutex_;
  Clock::time_point next_ = {};
  std::size_t left_out_ = 0;
};

}  // namespace capstan::transport
