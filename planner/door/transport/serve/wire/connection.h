#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "planner/door/transport/serve/sessions.h"
#include "planner/door/transport/serve/wire/tls.h"

namespace capstan::transport {

/// A connected socket with a limit in time on everything that waits for the peer. Owns the file descriptor.
/// With TLS what is read and written goes through it.
class Connection {
 public:
  /// `stop`: a file descriptor that can be read when all is to end.
  Connection(int fd, int stop, std::unique_ptr<TlsStream> tls = nullptr);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection();

  /// User id of the peer, as the kernel has it; nothing: the kernel does not say.
  [[nodiscard]] bool peer(std::uint32_t& user) const;

  enum class Shake : std::uint8_t { kDone, kRefused, kEnd, kTime, kStop };
  /// The handshake of TLS, whole until `until`. kRefused: `tls()` says why. kEnd: the peer is gone.
  Shake shake_hands(Clock::time_point until);
  /// Null without TLS.
  [[nodiscard]] const TlsStream* tls() const { return tls_.get(); }

  enum class Read : std::uint8_t { kBytes, kEnd, kTime, kStop };
  /// Waits for bytes until `until`. kEnd: the peer sends no more (it may still read), or is gone.
  Read read(std::string& into, Clock::time_point until);
  /// False: the peer is gone, or takes no byte for so long.
  bool write(std::string_view bytes, std::chrono::milliseconds patience);
  /// Waits until `event` (a file descriptor) can be read; false: the peer is gone before. A peer that only
  /// sends no more is not gone; with TLS it says so by TLS, and one that closes its side of TCP is gone.
  bool wait(int event, Clock::time_point until) const;
  /// Sends no more, and takes for a moment what the peer still sends, so that it reads the reply.
  void finish();

 private:
  Read receive(std::string& into, Clock::time_point until) const;
  [[nodiscard]] bool put(std::string_view bytes, std::chrono::milliseconds patience) const;

  int fd_, stop_;
  std::unique_ptr<TlsStream> tls_;
};

}  // namespace capstan::transport
