#include "planner/door/transport/serve/peer_log.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <exception>
#include <utility>

// The thread that finds nobody writing writes what waits, without the lock: who is slow to take the lines
// holds no other connection.

namespace capstan::transport {
namespace {

/// Lines that wait to be written. Default, unsourced.
constexpr std::size_t kMostWaiting = 64;

}  // namespace

void PeerLog::connected(const std::string& address, const std::string& subject, Clock::time_point now) {
  tell(connected_, address + " is '" + subject + "'", now);
}

void PeerLog::refused(const std::string& address, const std::string& why, Clock::time_point now) {
  tell(refused_, address + " is refused: " + why, now);
}

void PeerLog::tell(Kind& kind, std::string text, Clock::time_point now) {
  if (!write_) return;
  std::unique_lock lock(mutex_);
  if (now >= kind.until) {
    kind.until = now + std::chrono::seconds(1);
    kind.told = 0;
  }
  if (kind.told >= kind.most || waiting_.size() >= kMostWaiting) {
    ++kind.left_out;
    return;
  }
  ++kind.told;
  waiting_.push_back({&kind, std::move(text), std::exchange(kind.left_out, 0)});
  if (!writing_) write_waiting(lock);
}

void PeerLog::write_waiting(std::unique_lock<std::mutex>& lock) {
  writing_ = true;
  while (!waiting_.empty()) {
    Line line = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    bool written = false;
    try {
      if (line.others > 0)
        line.text += " (" + std::to_string(line.others) + " more since the last such line)";
      written = write_(line.text);
    } catch (const std::exception&) {
      // No memory: it is left out.
    }
    lock.lock();
    if (!written) line.kind->left_out += line.others + 1;
  }
  writing_ = false;
}

bool write_line(int fd, std::string line) {
  line.resize(std::min<std::size_t>(line.size(), PIPE_BUF - 1));
  line += '\n';
  pollfd of = {fd, POLLOUT, 0};
  return ::poll(&of, 1, 0) == 1 && (of.revents & POLLOUT) != 0 &&
         ::write(fd, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

}  // namespace capstan::transport
