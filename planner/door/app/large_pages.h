#pragma once

#include <cstddef>

namespace capstan::app {

/// What a start of planning touches of the heap, with room for a plan of some twenty steps.
inline constexpr std::size_t kStartOfHeap = std::size_t{30} << 20;

/// Asks the kernel to back the start of the heap by large pages, where it has them (Linux and glibc;
/// elsewhere it does nothing). A start touches some 20 MB: by pages of 4 kB these are more than 5,000 faults,
/// a quarter of its time. No memory is taken before it is used, but by whole pages of 2 MB.
void ask_for_large_pages();

}  // namespace capstan::app
