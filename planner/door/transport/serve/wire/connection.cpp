#include "planner/door/transport/serve/wire/connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace capstan::transport {
namespace {

int left_ms(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000));
}

constexpr short kGone = POLLHUP | POLLERR | POLLNVAL;
/// For the peer to take the few bytes of a handshake or an end. Default, unsourced.
constexpr std::chrono::milliseconds kFewBytes{1000};
/// What is encrypted at once, so that a large reply is not kept twice.
constexpr std::size_t kPiece = 256 << 10;

}  // namespace

Connection::Connection(int fd, int stop, std::unique_ptr<TlsStream> tls)
    : fd_(fd), stop_(stop), tls_(std::move(tls)) {}
Connection::~Connection() { ::close(fd_); }

bool Connection::peer(std::uint32_t& user) const {
  ucred who = {};
  socklen_t size = sizeof(who);
  if (::getsockopt(fd_, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0 || size != sizeof(who)) return false;
  user = who.uid;
  return true;
}

Connection::Shake Connection::shake_hands(Clock::time_point until) {
  std::string came;
  for (;;) {
    std::string out;
    const TlsStream::State state = tls_->handshake(came, out);
    const bool taken = out.empty() || put(out, kFewBytes);
    if (state == TlsStream::State::kWrong) return Shake::kRefused;
    if (!taken) return Shake::kEnd;
    if (state == TlsStream::State::kReady) return Shake::kDone;
    switch (receive(came, until)) {
      case Read::kBytes:
        break;
      case Read::kEnd:
        return Shake::kEnd;
      case Read::kTime:
        return Shake::kTime;
      case Read::kStop:
        return Shake::kStop;
    }
  }
}

Connection::Read Connection::read(std::string& into, Clock::time_point until) {
  if (!tls_) return receive(into, until);
  into.clear();
  std::string came;  // at first nothing: bytes may have come with those before
  for (;;) {
    std::string out;
    const TlsStream::State state = tls_->read(came, into, out);
    if (!out.empty() && !put(out, kFewBytes)) return Read::kEnd;
    if (!into.empty()) return Read::kBytes;
    if (state != TlsStream::State::kMore) return Read::kEnd;
    if (const Read got = receive(came, until); got != Read::kBytes) return got;
  }
}

Connection::Read Connection::receive(std::string& into, Clock::time_point until) const {
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
  if (!tls_) return put(bytes, patience);
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, kPiece);
    std::string out;
    if (!tls_->write(piece, out) || !put(out, patience)) return false;
    bytes.remove_prefix(piece.size());
  }
  return true;
}

bool Connection::put(std::string_view bytes, std::chrono::milliseconds patience) const {
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
  const short gone = tls_ ? POLLRDHUP : 0;
  for (;;) {
    std::array<pollfd, 2> of = {pollfd{event, POLLIN, 0}, pollfd{fd_, gone, 0}};
    const int n = ::poll(of.data(), of.size(), left_ms(until));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0 || of[0].revents != 0) return true;
    return false;
  }
}

void Connection::finish() {
  if (tls_) {
    std::string out;
    tls_->end(out);
    if (!put(out, kFewBytes)) return;
  }
  ::shutdown(fd_, SHUT_WR);
  // A close with bytes unread would take the reply from a peer that has not read it yet.
  std::string rest;
  const auto until = Clock::now() + std::chrono::milliseconds(200);  // default, unsourced
  for (int i = 0; i < 64 && receive(rest, until) == Read::kBytes; ++i) rest.clear();
}

}  // namespace capstan::transport
