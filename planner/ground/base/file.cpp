#include "planner/ground/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
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

 private:
  int fd_;
};

/// Whether a path leads to a pipe in a folder. What the shell opened (`/dev/stdin`, `/dev/fd/63`) is none,
/// even where it is such a pipe: somebody asked for it.
bool is_named_pipe(const std::string& path) {
  if (path.starts_with("/dev/") || path.starts_with("/proc/")) return false;
  std::error_code none;
  const auto at = std::filesystem::canonical(path, none);
  return !none && std::filesystem::is_fifo(at, none);
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t cap) {
  // Without O_NONBLOCK a named pipe that nobody writes holds the call before it can be looked at.
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (fd.get() < 0) return io_fault("FILE-READ", path, "the file cannot be opened for reading");
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) return io_fault("FILE-READ", path, "the file cannot be examined");
  if (S_ISFIFO(info.st_mode) && is_named_pipe(path))
    return fail({.code = "FILE-READ",
                 .message = "this is a named pipe, and nobody may ever write to it",
                 .file = path,
                 .expected = "a regular file"});
  const int flags = ::fcntl(fd.get(), F_GETFL);
  if (flags < 0 || ::fcntl(fd.get(), F_SETFL, flags & ~O_NONBLOCK) != 0)
    return io_fault("FILE-READ", path, "the file cannot be examined");
  if (S_ISDIR(info.st_mode))
    return fail({.code = "FILE-READ", .message = "this is a folder", .file = path, .expected = "a file"});
  // A pipe or a device may never end; what is piped in is a program, a part or a plan.
  constexpr std::size_t kStreamCap = std::size_t{64} << 20;
  const bool stream = !S_ISREG(info.st_mode);
  if (stream) cap = std::min(cap, kStreamCap);
  const auto too_large = [&] {
    return fail({.code = "FILE-TOO-LARGE",
                 .message = std::string(stream ? "this is no regular file, and gives more than "
                                               : "the file is larger than ") +
                            "the limit of " + std::to_string(cap) + " bytes",
                 .file = path});
  };
  if (!stream && info.st_size > 0 && static_cast<std::size_t>(info.st_size) > cap) return too_large();
  std::string bytes;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  // A file of known size is read at once, and one byte more tells that it ends there.
  std::size_t left = !stream && info.st_size > 0 ? static_cast<std::size_t>(info.st_size) + 1 : kChunk;
  for (;;) {
    const std::size_t at = bytes.size();
    bytes.resize(at + left);
    const ssize_t got = ::read(fd.get(), bytes.data() + at, left);
    if (got < 0) {
      if (errno == EINTR) {
        bytes.resize(at);
        continue;
      }
      return io_fault("FILE-READ", path, "the file cannot be read");
    }
    bytes.resize(at + static_cast<std::size_t>(got));
    left -= static_cast<std::size_t>(got);
    if (left == 0) left = kChunk;
    if (bytes.size() > cap) return too_large();
    if (got == 0) return bytes;
  }
}

std::string resolved(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as Linux follows
  std::error_code ec;
  // Relative and absent, weakly_canonical would leave it relative.
  fs::path at = fs::absolute(path, ec);
  if (ec) return path;
  // weakly_canonical leaves a link to nothing as it is.
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(at, ec)) && !fs::exists(at, ec); ++i) {
    const fs::path to = fs::read_symlink(at, ec);
    if (ec) break;
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  const fs::path real = fs::weakly_canonical(at, ec);
  return ec ? path : real.string();
}

Result<StagedFile> StagedFile::make(const std::string& path, std::string_view bytes) {
  StagedFile out;
  out.path_ = path;
  out.target_ = resolved(path);
  std::error_code ec;
  const auto at = std::filesystem::status(out.target_, ec);
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(out.target_, ec)))
    return fail({.code = "FILE-WRITE", .message = "this is a link that leads to itself", .file = path});
  if (std::filesystem::is_directory(at))
    return fail({.code = "FILE-WRITE", .message = "this is a folder", .file = path, .expected = "a file"});
  if (std::filesystem::exists(at) && !std::filesystem::is_regular_file(at))
    return fail(
        {.code = "FILE-WRITE", .message = "this is a pipe or a device", .file = path, .expected = "a file"});
  const auto parent = std::filesystem::path(out.target_).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  // A nameless file gets its name through /proc.
  const bool nameless = std::filesystem::exists("/proc/self/fd", ec);
  if (nameless) out.fd_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (out.fd_ < 0 && (!nameless || errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL)) {
    out.temporary_ = out.temporary_name();
    out.fd_ = ::open(out.temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (out.fd_ < 0) out.temporary_.clear();
  }
  if (out.fd_ < 0) return io_fault("FILE-WRITE", path, "the file cannot be written");
  while (!bytes.empty()) {
    const ssize_t put = ::write(out.fd_, bytes.data(), bytes.size());
    if (put < 0) {
      if (errno == EINTR) continue;
      return io_fault("FILE-WRITE", path, "the file cannot be written");
    }
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  if (::fsync(out.fd_) != 0) return io_fault("FILE-WRITE", path, "the file cannot be brought to disk");
  return out;
}

std::string StagedFile::temporary_name() const {
  return target_ + ".capstan-" + std::to_string(::getpid()) + ".tmp";
}

StagedFile::StagedFile(StagedFile&& other) noexcept { *this = std::move(other); }

StagedFile& StagedFile::operator=(StagedFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(fd_, other.fd_);
  return *this;
}

StagedFile::~StagedFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status StagedFile::put() {
  if (temporary_.empty()) {
    // Only a link can give a nameless file its name, and a link replaces nothing: hence the rename after it.
    const std::string name = temporary_name();
    const std::string open = "/proc/self/fd/" + std::to_string(fd_);
    ::unlink(name.c_str());
    if (::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
      return io_fault("FILE-WRITE", path_, "the file cannot be given its name");
    temporary_ = name;
  }
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0)
    return io_fault("FILE-WRITE", path_, "the file cannot be put in place");
  temporary_.clear();
  if (::close(std::exchange(fd_, -1)) != 0) return io_fault("FILE-WRITE", path_, "the file cannot be closed");
  return {};
}

Status writable(const std::string& path) {
  const auto staged = StagedFile::make(path, {});
  return staged ? Status() : Status(tl::unexpected(staged.error()));
}

Status write_file(const std::string& path, std::string_view bytes) {
  auto staged = StagedFile::make(path, bytes);
  if (!staged) return tl::unexpected(staged.error());
  return staged->put();
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
