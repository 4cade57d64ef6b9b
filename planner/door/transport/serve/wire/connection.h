#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "planner/door/transport/serve/sessions.h"

namespace capstan::transport {

/// A connected socket with a limit in time on everything that waits for the peer. Owns the file descriptor.
class Connection {
 public:
  /// `stop`: a file descriptor that can be read when all is to end.
  Connection(int fd, int stop);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection();

  /// User id of the peer, as the kernel has it; nothing: the kernel does not say.
  [[nodiscard]] bool peer(std::uint32_t& user) const;

  enum class Read : std::uint8_t { kBytes, kEnd, kTime, kStop };
  /// Waits for bytes until `until`. kEnd: the peer sends no more (it may still read), or is gone.
  Read read(std::string& into, Clock::time_point until);
  /// False: the peer is gone, or takes no byte for so long.
  bool write(std::string_view bytes, std::chrono::milliseconds patience);
  /// Waits until `event` (a file descriptor) can be read; false: the peer is gone before. A peer that only
  /// sends no more is not gone.
  bool wait(int event, Clock::time_point until) const;
  /// Sends no more, and takes for a moment what the peer still sends, so that it reads the reply.
  void finish();

 private:
  int fd_, stop_;
};

}  // namespace capstan::transport
