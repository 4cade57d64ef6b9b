#include "planner/door/transport/serve/broadcast_queue.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace capstan::transport {

BroadcastQueue::~BroadcastQueue() {
  if (fd_ >= 0) ::close(fd_);
}

void BroadcastQueue::set(std::optional<service::DefaultContent> otherwise, std::string file) {
  const std::lock_guard lock(mutex_);
  otherwise_ = std::move(otherwise);
  file_ = std::move(file);
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  run_.plan_changed(true);
}

void BroadcastQueue::plan_changed(bool bound) {
  const std::lock_guard lock(mutex_);
  run_.plan_changed(bound);
}

Result<BroadcastQueue::Queued> BroadcastQueue::tell(const service::ControlEvent& event, bool over,
                                                    std::size_t most, std::chrono::milliseconds patience,
                                                    const Make& make) {
  const std::lock_guard lock(mutex_);
  auto lines = run_.tell(event, over, [&] { return make(otherwise_); });
  if (!lines) return tl::unexpected(lines.error());
  Queued told{*std::move(lines), {}};
  std::size_t dropped = 0;
  for (const service::BroadcastLine& line : told.lines) {
    if (line.waits) awaited_.insert(line.number);
    queue_.push_back(line.json + "\n");
  }
  for (; queue_.size() > most; ++dropped) queue_.pop_front();
  if (dropped > 0)
    told.warning = "warning: no reader took the broadcasts: the oldest " + std::to_string(dropped) +
                   " are dropped [BROADCAST-DROPPED]\n";
  if (!file_.empty()) told.warning += to_file(told.lines, patience);
  changed_.notify_all();
  return told;
}

std::string BroadcastQueue::to_file(const std::vector<service::BroadcastLine>& lines,
                                    std::chrono::milliseconds patience) {
  const auto failed = [&](const std::string& what) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
    return "warning: " + file_ + ": " + what + "; the broadcasts are not in it [BROADCAST-FILE]\n";
  };
  // A FIFO without a reader must not hold the control: it is opened, and written, without waiting.
  if (fd_ < 0)
    fd_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd_ < 0) return failed(errno == ENXIO ? "nobody reads it" : std::strerror(errno));
  std::string all;
  for (const service::BroadcastLine& line : lines) all += line.json + "\n";
  for (std::string_view rest = all; !rest.empty();) {
    const ssize_t n = ::write(fd_, rest.data(), rest.size());
    if (n > 0) {
      rest.remove_prefix(static_cast<std::size_t>(n));
      continue;
    }
    if (errno == EINTR) continue;
    pollfd of = {fd_, POLLOUT, 0};
    if (errno != EAGAIN) return failed(std::strerror(errno));
    if (::poll(&of, 1, static_cast<int>(patience.count())) == 0) return failed("its reader takes nothing");
  }
  return {};
}

bool BroadcastQueue::replied(const std::vector<service::BroadcastLine>& lines,
                             std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  const auto none_waits = [&] {
    return std::none_of(lines.begin(), lines.end(),
                        [&](const auto& line) { return line.waits && awaited_.contains(line.number); });
  };
  const bool all = changed_.wait_until(lock, until, none_waits);
  for (const service::BroadcastLine& line : lines) awaited_.erase(line.number);
  return all;
}

bool BroadcastQueue::reply(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  const bool waits = awaited_.erase(number) > 0;
  changed_.notify_all();
  return waits;
}

bool BroadcastQueue::open_stream() {
  const std::lock_guard lock(mutex_);
  return !std::exchange(streamed_, true);
}

void BroadcastQueue::close_stream() {
  const std::lock_guard lock(mutex_);
  streamed_ = false;
}

std::string BroadcastQueue::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return !queue_.empty(); });
  std::string out;
  for (; !queue_.empty(); queue_.pop_front()) out += queue_.front();
  return out;
}

}  // namespace capstan::transport
