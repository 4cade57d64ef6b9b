#pragma once

#include <cstddef>

namespace capstan::tooling {

/// Largest file or folder that is read as a tool library, of any format. Default, unsourced.
inline constexpr std::size_t kLibraryBytesCap = std::size_t{256} << 20;

}  // namespace capstan::tooling
