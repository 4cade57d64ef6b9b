#include "planner/door/transport/serve/wire/socket_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace capstan::transport {
namespace {

tl::unexpected<Diagnostic> refused(const std::string& path, std::string what, std::string hint = {}) {
  return fail({.code = "SERVE-SOCKET",
               .message = std::move(what),
               .file = path,
               .expected = "a path where a socket can be made",
               .hint = std::move(hint)});
}

std::string said(const char* call) { return std::string(call) + ": " + std::strerror(errno); }

/// Holds the lock of a path, or nothing (-1) with what is wrong.
Result<int> locked(const std::string& path) {
  const std::string name = path + ".lock";
  for (;;) {
    const int fd = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (fd < 0) return refused(path, "its lock cannot be made: " + said("open"));
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      ::close(fd);
      return refused(path, "another server has this socket", "stop that one, or name another path");
    }
    // A server that ended in between has removed the file that was opened.
    struct stat opened = {}, there = {};
    if (::fstat(fd, &opened) == 0 && ::stat(name.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
        opened.st_dev == there.st_dev)
      return fd;
    ::close(fd);
  }
}

/// Removes a socket whose server is dead.
Status free_path(const std::string& path, const sockaddr_un& address) {
  struct stat there = {};
  if (::lstat(path.c_str(), &there) != 0) {
    if (errno == ENOENT) return {};
    return refused(path, said("stat"));
  }
  if (!S_ISSOCK(there.st_mode))
    return refused(path, "something that is no socket is there", "name another path");
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const bool alive = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 ||
                     errno != ECONNREFUSED;
  ::close(probe);
  if (alive) return refused(path, "another program listens there", "stop that one, or name another path");
  if (::unlink(path.c_str()) != 0) return refused(path, said("unlink"));
  return {};
}

}  // namespace

Result<SocketFile> SocketFile::listen(const std::string& path, bool for_others) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path))
    return refused(path, "the path has " + std::to_string(path.size()) + " characters; a socket's has 1 to " +
                             std::to_string(sizeof(address.sun_path) - 1));
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const auto lock = locked(path);
  if (!lock) return tl::unexpected(lock.error());
  SocketFile made({}, *lock, -1);
  made.path_ = path;
  if (auto ok = free_path(path, address); !ok) {
    made.path_.clear();
    ::unlink((path + ".lock").c_str());
    return tl::unexpected(ok.error());
  }
  made.fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const mode_t mode = for_others ? 0666 : 0600;
  // Before it has a name, so that it never has another mode.
  if (made.fd_ < 0 || ::fchmod(made.fd_, mode) != 0 ||
      ::bind(made.fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::chmod(path.c_str(), mode) != 0 || ::listen(made.fd_, SOMAXCONN) != 0)
    return refused(path, "the socket cannot be made: " + std::string(std::strerror(errno)));
  return made;
}

SocketFile::SocketFile(SocketFile&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      lock_(std::exchange(other.lock_, -1)),
      fd_(std::exchange(other.fd_, -1)) {}

SocketFile::~SocketFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!path_.empty()) {
    ::unlink(path_.c_str());
    ::unlink((path_ + ".lock").c_str());
  }
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace capstan::transport
