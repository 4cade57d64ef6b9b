#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::tooling {

/// How much of an archive is unpacked: guards against archives made to fill the memory.
struct ZipCaps {
  std::size_t entries = 10'000;
  std::size_t entry_bytes = std::size_t{128} << 20;
  std::size_t total_bytes = std::size_t{256} << 20;
  std::size_t ratio = 1000;  ///< unpacked to packed; text compresses at most some hundredfold
};

struct ZipEntry {
  std::string name, bytes;
};

[[nodiscard]] bool is_zip(std::string_view bytes);

/// The entries that are wanted, in the archive's order; null: all. Folders are left out; names are only
/// compared, never used as paths. `library`: libzip, by the name by which the system's loader finds it, or a
/// path; null: the one that this was built with.
/// Fails  ZIP-SYNTAX, ZIP-CAP (too many, too large, packed too densely), ZIP-CRYPT; ZIP-LIBRARY libzip is not
///        there.
[[nodiscard]] Result<std::vector<ZipEntry>> read_zip(std::string_view bytes, const std::string& file,
                                                     bool (*wanted)(std::string_view name) = nullptr,
                                                     const ZipCaps& caps = {}, const char* library = nullptr);

/// An archive whose bytes depend on the entries alone (fixed times).
/// Fails  ZIP-WRITE, ZIP-LIBRARY.
[[nodiscard]] Result<std::string> write_zip(const std::vector<ZipEntry>& entries,
                                            const char* library = nullptr);

}  // namespace capstan::tooling
