#pragma once

#include <cstddef>
#include <list>
#include <mutex>

namespace capstan::transport {

/// The connections whose peer is not known yet. Bounded: where all places are taken, the oldest gives way to
/// a new one, so that peers who never finish their handshake cannot keep out one who does.
///
/// Thread safety  any thread.
class HalfOpen {
 public:
  explicit HalfOpen(std::size_t most) : most_(most) {}

  /// Takes a place for a connected socket, which stays its caller's. It never waits; false: `full`.
  [[nodiscard]] bool enter(int fd);
  /// As many as there are places have been told to go and are still there: nobody enters before one leaves.
  [[nodiscard]] bool full() const;
  /// Before the socket is closed. True: it had been told to go (its socket is shut down).
  bool leave(int fd);
  [[nodiscard]] std::size_t count() const;

 private:
  struct One {
    int fd = -1;
    bool told = false;
  };
  std::size_t most_;
  mutable std::mutex mutex_;
  std::list<One> all_;  ///< the oldest first
};

}  // namespace capstan::transport
