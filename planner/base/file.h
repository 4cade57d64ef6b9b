#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "planner/base/result.h"

namespace capstan {

inline constexpr std::size_t kDefaultFileCap = std::size_t{2} << 30;  ///< 2 GiB

/// The whole file as bytes. Fails with FILE-READ when it cannot be opened, FILE-TOO-LARGE past `cap`.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::size_t cap = kDefaultFileCap);

/// Writes a temporary beside the target, fsyncs it, and renames it over the target: whole or not at all.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

/// 64-bit FNV-1a of bytes: stable across machines, for identity, not for security.
[[nodiscard]] std::uint64_t fnv1a(std::string_view bytes, std::uint64_t seed = 14695981039346656037ULL);

/// Sixteen lower-case hex digits.
[[nodiscard]] std::string hex64(std::uint64_t value);

}  // namespace capstan
