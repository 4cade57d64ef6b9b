#pragma once

#include <string>

#include "planner/ground/base/result.h"

namespace capstan::transport {

/// A listening UNIX socket at a path, for as long as this lives; the path is removed then.
///
/// A socket that a dead server left is taken over; its lock says that it is dead (PATH.lock, held by
/// a server for its life) and by a connection that is refused. Whatever else is there stays.
class SocketFile {
 public:
  /// `for_others`: other users may connect, too (the server looks at who they are); else the mode is 0600.
  /// Fails  SERVE-SOCKET: the path is too long, is no socket, is in use, or cannot be made.
  [[nodiscard]] static Result<SocketFile> listen(const std::string& path, bool for_others);
  SocketFile(SocketFile&& other) noexcept;
  SocketFile& operator=(SocketFile&&) = delete;
  ~SocketFile();

  [[nodiscard]] int fd() const { return fd_; }

 private:
  SocketFile(std::string path, int lock, int fd) : path_(std::move(path)), lock_(lock), fd_(fd) {}
  std::string path_;
  int lock_ = -1, fd_ = -1;
};

}  // namespace capstan::transport
