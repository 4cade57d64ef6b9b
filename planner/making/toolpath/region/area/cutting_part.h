#pragma once

#include <cstdint>

#include "planner/making/toolpath/region/area/track.h"

namespace capstan::toolpath {

/// Where the part of a track may begin.
enum class Begun : std::uint8_t {
  kAnywhere,  ///< at its first contact, where that leaves the shortest part
  kAtStart,   ///< where the track does, whatever is cut there
};

/// The stretch of a closed track along which a cutter that clears `cover_mm` to each side of its centre takes
/// all that it would take of `uncut` on the whole track: without the ways before its first contact and behind
/// its last, begun where that leaves the shortest stretch. `uncut` is then without what it takes. Returns the
/// whole track, closed, where less than a tenth of it cuts nothing; without segments where all of it does.
/// Accuracy  contact is told by pieces of a quarter of `cover_mm`, each of which counts whole.
/// Cost      pieces times kPartStarts cuts of one polygon from another.
[[nodiscard]] Track cutting_part(const Track& track, geometry::Region& uncut, double cover_mm, Begun begun);
inline constexpr int kPartStarts = 6;

}  // namespace capstan::toolpath
