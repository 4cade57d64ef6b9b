#include "planner/door/transport/serve/wire/tcp_listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

namespace capstan::transport {
namespace {

tl::unexpected<Diagnostic> wrong(const std::string& address, const std::string& what,
                                 const std::string& hint = {}) {
  return fail({.code = "SERVE-TCP",
               .message = "'" + address + "': " + what,
               .expected =
                   "an address and a port in numbers: 127.0.0.1:8443, [::1]:8443, or 0.0.0.0:8443 for "
                   "all addresses of this machine",
               .hint = hint});
}

std::string text_of(const sockaddr_storage& address, socklen_t size) {
  std::array<char, NI_MAXHOST> host = {};
  std::array<char, NI_MAXSERV> port = {};
  if (::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host.data(), host.size(), port.data(),
                    port.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return "?";
  const bool six = address.ss_family == AF_INET6;
  return (six ? "[" : "") + std::string(host.data()) + (six ? "]:" : ":") + port.data();
}

/// Without it a peer whose cable was pulled would hold its connection for hours. s and tries; defaults,
/// unsourced.
void watch(int fd) {
  constexpr int kOn = 1, kIdle = 20, kBetween = 10, kTries = 3;
  ::setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &kOn, sizeof(kOn));
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &kIdle, sizeof(kIdle));
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &kBetween, sizeof(kBetween));
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &kTries, sizeof(kTries));
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &kOn, sizeof(kOn));
}

}  // namespace

Result<TcpListener> TcpListener::listen(const std::string& address) {
  const auto colon = address.rfind(':');
  std::string host = colon == std::string::npos ? std::string() : address.substr(0, colon);
  const std::string port = colon == std::string::npos ? std::string() : address.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string::npos) {
    host.clear();
  }
  const bool number = !port.empty() && port.size() <= 5 &&
                      std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; }) &&
                      std::stoi(port) <= 65535;
  if (host.empty() || !number) return wrong(address, "it is no address with a port");
  addrinfo how = {};
  how.ai_family = AF_UNSPEC;
  how.ai_socktype = SOCK_STREAM;
  how.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &how, &found) != 0 || found == nullptr)
    return wrong(address, "it is no address in numbers");
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> freeing(found, &::freeaddrinfo);
  TcpListener made(::socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), address);
  const int on = 1;
  if (made.fd_ < 0 || ::setsockopt(made.fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0 ||
      ::bind(made.fd_, found->ai_addr, found->ai_addrlen) != 0 || ::listen(made.fd_, SOMAXCONN) != 0)
    return wrong(address, "it cannot be listened on: " + std::string(std::strerror(errno)),
                 errno == EADDRINUSE ? "stop what listens there, or name another port" : "");
  sockaddr_storage is = {};
  socklen_t size = sizeof(is);
  if (::getsockname(made.fd_, reinterpret_cast<sockaddr*>(&is), &size) == 0)
    made.address_ = text_of(is, size);
  return made;
}

TcpListener::~TcpListener() {
  if (fd_ >= 0) ::close(fd_);
}

std::pair<int, std::string> TcpListener::accept() const {
  sockaddr_storage peer = {};
  socklen_t size = sizeof(peer);
  const int fd = ::accept4(fd_, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_CLOEXEC);
  if (fd < 0) return {-1, {}};
  watch(fd);
  return {fd, text_of(peer, size)};
}

}  // namespace capstan::transport
