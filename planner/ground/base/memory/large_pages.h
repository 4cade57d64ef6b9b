#pragma once

#include <cstddef>

namespace capstan {

/// Bytes of a large page (x86-64; arm64 with pages of 4 kB).
inline constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Asks the kernel to back memory that was allocated, and not yet touched, by large pages, where it has them
/// (Linux; elsewhere it does nothing): one fault for 2 MB instead of 512. Only whole pages within it are
/// asked for, and none where it has less than two large ones. A wish; a refusal does no harm.
void ask_for_large_pages(void* memory, std::size_t bytes);

}  // namespace capstan
