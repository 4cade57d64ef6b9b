#include "planner/door/transport/serve/peer_log.h"

namespace capstan::transport {

void PeerLog::connected(const std::string& address, const std::string& subject) {
  if (!write_) return;
  const std::lock_guard lock(mutex_);
  write_(address + " is '" + subject + "'");
}

void PeerLog::refused(const std::string& address, const std::string& why, Clock::time_point now) {
  if (!write_) return;
  const std::lock_guard lock(mutex_);
  if (now < next_) {
    ++left_out_;
    return;
  }
  next_ = now + std::chrono::seconds(1);
  write_(address + " is refused: " + why +
         (left_out_ == 0 ? "" : " (" + std::to_string(left_out_) + " more since the last such line)"));
  left_out_ = 0;
}

}  // namespace capstan::transport
