#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"

namespace capstan {

inline constexpr std::size_t kDefaultFileCap = std::size_t{2} << 30;  ///< 2 GiB

/// The whole file as bytes. Fails with FILE-READ when it cannot be opened, FILE-TOO-LARGE past `cap`.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::size_t cap = kDefaultFileCap);

/// A file's new content, on disk but not yet under its name. What is not put in place is gone with this
/// object, and with the process: it has no name before (Linux's O_TMPFILE; where a file system lacks that, a
/// name ending in .capstan-PID.tmp). A link is followed: what it leads to is replaced, not the link.
class StagedFile {
 public:
  /// Fails  FILE-WRITE: the folder is missing or cannot be written, the disk is full, or the path leads to a
  /// folder, a pipe, a device, or a link to itself.
  [[nodiscard]] static Result<StagedFile> make(const std::string& path, std::string_view bytes);
  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&& other) noexcept;
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();

  /// Puts it under its name, over what was there. Fails  FILE-WRITE.
  [[nodiscard]] Status put();
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  StagedFile() = default;
  [[nodiscard]] std::string temporary_name() const;
  std::string path_;       ///< as the caller named it
  std::string target_;     ///< with links followed
  std::string temporary_;  ///< empty: it has no name
  int fd_ = -1;
};

/// Whether a file can be written at this path, found by making a nameless one in its folder.
/// Fails  as StagedFile::make.
[[nodiscard]] Status writable(const std::string& path);

/// The file that a path leads to, links followed, also when it is not there yet.
[[nodiscard]] std::string resolved(const std::string& path);

/// Writes a file whole or not at all.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

/// 64-bit FNV-1a of bytes: stable across machines, for identity, not for security.
[[nodiscard]] std::uint64_t fnv1a(std::string_view bytes, std::uint64_t seed = 14695981039346656037ULL);

/// Sixteen lower-case hex digits.
[[nodiscard]] std::string hex64(std::uint64_t value);

}  // namespace capstan
