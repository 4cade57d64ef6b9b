#pragma once

#include <cstdint>
#include <string_view>

namespace capstan::casebase {

/// 128 bits.
struct Sum {
  std::uint64_t high = 0, low = 0;
  friend auto operator<=>(const Sum&, const Sum&) = default;
};

/// XXH3 of bytes. It finds what a disk, a cable or an editor altered; it does not resist somebody who looks
/// for other bytes of equal sum, who could as well write another sum beside them.
[[nodiscard]] Sum sum_of(std::string_view bytes, std::uint64_t seed = 0);

}  // namespace capstan::casebase
