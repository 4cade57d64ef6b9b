#include "planner/door/transport/serve/wire/connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace capstan::transport {
namespace {

int left_ms(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000));
}

constexpr short kGone = POLLHUP | POLLERR | POLLNVAL;

}  // namespace

Connection::Connection(int fd, int stop) : fd_(fd), stop_(stop) {}
Connection::~Connection() { ::close(fd_); }

bool Connection::peer(std::uint32_t& user) const {
  ucred who = {};
  socklen_t size = sizeof(who);
  if (::getsockopt(fd_, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0 || size != sizeof(who)) return false;
  user = who.uid;
  return true;
}

Connection::Read Connection::read(std::string& into, Clock::time_point until) {
  for (;;) {
    std::array<pollfd, 2> of = {pollfd{fd_, POLLIN, 0}, pollfd{stop_, POLLIN, 0}};
    const int n = ::poll(of.data(), of.size(), left_ms(until));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) return Read::kTime;
    if (of[1].revents != 0) return Read::kStop;
    std::array<char, 16384> bytes;
    const ssize_t got = ::recv(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) return Read::kEnd;
    into.assign(bytes.data(), static_cast<std::size_t>(got));
    return Read::kBytes;
  }
}

bool Connection::write(std::string_view bytes, std::chrono::milliseconds patience) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return false;
    pollfd of = {fd_, POLLOUT, 0};
    if (::poll(&of, 1, static_cast<int>(patience.count())) == 0 || (of.revents & kGone) != 0) return false;
  }
  return true;
}

bool Connection::wait(int event, Clock::time_point until) const {
  for (;;) {
    std::array<pollfd, 2> of = {pollfd{event, POLLIN, 0}, pollfd{fd_, 0, 0}};
    const int n = ::poll(of.data(), of.size(), left_ms(until));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0 || of[0].revents != 0) return true;
    return false;
  }
}

void Connection::finish() {
  ::shutdown(fd_, SHUT_WR);
  // A close with bytes unread would take the reply from a peer that has not read it yet.
  std::string rest;
  const auto until = Clock::now() + std::chrono::milliseconds(200);  // default, unsourced
  for (int i = 0; i < 64 && read(rest, until) == Read::kBytes; ++i) rest.clear();
}

}  // namespace capstan::transport
