#include "casebase/store/checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace capstan::casebase {

Sum sum_of(std::string_view bytes, std::uint64_t seed) {
  const XXH128_hash_t h = XXH3_128bits_withSeed(bytes.data(), bytes.size(), seed);
  return {h.high64, h.low64};
}

}  // namespace capstan::casebase
