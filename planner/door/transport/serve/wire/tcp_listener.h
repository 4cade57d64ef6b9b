#pragma once

#include <string>
#include <utility>

#include "planner/ground/base/result.h"

namespace capstan::transport {

/// A listening socket of TCP, for as long as this lives.
class TcpListener {
 public:
  /// `address`: "127.0.0.1:8443", "[::1]:8443", "0.0.0.0:8443"; numbers, for no name is looked up. Port 0:
  /// the kernel chooses one.
  /// Fails  SERVE-TCP: it is no such address, is in use, or is none of this machine.
  [[nodiscard]] static Result<TcpListener> listen(const std::string& address);
  TcpListener(TcpListener&& other) noexcept
      : fd_(std::exchange(other.fd_, -1)), address_(std::move(other.address_)) {}
  TcpListener& operator=(TcpListener&&) = delete;
  ~TcpListener();

  [[nodiscard]] int fd() const { return fd_; }
  /// With the port that it has.
  [[nodiscard]] const std::string& address() const { return address_; }
  /// A connection that waits, and the address of its peer; -1: there is none (errno says why). A peer that is
  /// gone without a word is found out within a minute.
  [[nodiscard]] std::pair<int, std::string> accept() const;

 private:
  TcpListener(int fd, std::string address) : fd_(fd), address_(std::move(address)) {}
  int fd_;
  std::string address_;
};

}  // namespace capstan::transport
