#include "planner/door/transport/serve/half_open.h"

#include <sys/socket.h>

#include <algorithm>

namespace capstan::transport {

bool HalfOpen::enter(int fd) {
  const std::lock_guard lock(mutex_);
  if (all_.size() >= 2 * most_) return false;
  const auto staying = [](const One& one) { return !one.told; };
  if (static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), staying)) >= most_) {
    const auto oldest = std::find_if(all_.begin(), all_.end(), staying);
    if (oldest == all_.end()) return false;
    oldest->told = true;
    ::shutdown(oldest->fd, SHUT_RDWR);  // its thread sees the end
  }
  all_.push_back({fd, false});
  return true;
}

bool HalfOpen::leave(int fd) {
  const std::lock_guard lock(mutex_);
  const auto at = std::find_if(all_.begin(), all_.end(), [&](const One& one) { return one.fd == fd; });
  if (at == all_.end()) return false;
  const bool told = at->told;
  all_.erase(at);
  return told;
}

bool HalfOpen::full() const { return count() >= 2 * most_; }

std::size_t HalfOpen::count() const {
  const std::lock_guard lock(mutex_);
  return all_.size();
}

}  // namespace capstan::transport
