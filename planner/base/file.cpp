#include "planner/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace capstan {
namespace {

tl::unexpected<Diagnostic> io_fault(const char* code, const std::string& path, const std::string& what) {
  return fail({.code = code, .message = what + ": " + std::strerror(errno), .file = path});
}

/// Closes on every way out.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t cap) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.get() < 0) return io_fault("FILE-READ", path, "cannot be opened for reading");
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) return io_fault("FILE-READ", path, "cannot be examined");
  if (S_ISDIR(info.st_mode))
    return fail({.code = "FILE-READ", .message = "is a folder", .file = path, .expected = "a file"});
  std::string bytes;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  if (info.st_size > 0 && static_cast<std::size_t>(info.st_size) <= cap) {
    bytes.reserve(static_cast<std::size_t>(info.st_size) + kChunk);  // the last read finds the end in place
  }
  for (;;) {
    const std::size_t at = bytes.size();
    bytes.resize(at + kChunk);
    const ssize_t got = ::read(fd.get(), bytes.data() + at, kChunk);
    if (got < 0) {
      if (errno == EINTR) {
        bytes.resize(at);
        continue;
      }
      return io_fault("FILE-READ", path, "cannot be read");
    }
    bytes.resize(at + static_cast<std::size_t>(got));
    if (bytes.size() > cap) {
      return fail({.code = "FILE-TOO-LARGE",
                   .message = "is larger than the limit of " + std::to_string(cap) + " bytes",
                   .file = path});
    }
    if (got == 0) return bytes;
  }
}

Status write_file(const std::string& path, std::string_view bytes) {
  const std::string temporary = path + ".capstan-" + std::to_string(::getpid()) + ".tmp";
  Descriptor fd(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (fd.get() < 0) return io_fault("FILE-WRITE", path, "cannot be written");
  const auto give_up = [&](const char* what) -> Status {
    auto fault = io_fault("FILE-WRITE", path, what);
    ::unlink(temporary.c_str());
    return fault;
  };
  while (!bytes.empty()) {
    const ssize_t put = ::write(fd.get(), bytes.data(), bytes.size());
    if (put < 0) {
      if (errno == EINTR) continue;
      return give_up("cannot be written");
    }
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  if (::fsync(fd.get()) != 0) return give_up("cannot be brought to disk");
  if (::close(fd.release()) != 0) return give_up("cannot be closed");
  if (std::rename(temporary.c_str(), path.c_str()) != 0) return give_up("cannot be put in place");
  return {};
}

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t seed) {
  std::uint64_t h = seed;
  for (const char c : bytes) {
    h ^= static_cast<unsigned char>(c);
    h *= 1099511628211ULL;
  }
  return h;
}

std::string hex64(std::uint64_t value) {
  std::string out(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4U) out[i] = "0123456789abcdef"[value & 15U];
  return out;
}

}  // namespace capstan
