#pragma once

#include <cstddef>

namespace capstan::app {

/// What a start of planning touches of the heap, with room for a plan of some twenty steps.
inline constexpr std::size_t kStartOfHeap = std::size_t{30} << 20;

/// Asks the kernel to back the start of the heap by large pages, where it has them (Linux and glibc;
/// elsewhere it does nothing). Shop, tools and rules touch some 8 MB: by pages of 4 kB these are 2,400
/// faults, by large ones 450 to 900. No memory is taken before it is used, but by whole pages of 2 MB: about
/// 2 MB more at the peak.
void ask_for_large_pages();

}  // namespace capstan::app
