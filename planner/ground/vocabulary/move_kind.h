#pragma once

#include <cstdint>

namespace capstan::model {

enum class MoveKind : std::uint8_t {
  kRapid,  ///< straight, at rapid; on a control it may not be straight in space
  kLine,   ///< straight, at feed
  kArcCw,  ///< in the XY plane, clockwise seen from +Z; a helix when z changes
  kArcCcw,
  kDwell,  ///< stands still; `dwell_s` of the schedule says how long
};
[[nodiscard]] constexpr bool is_arc(MoveKind k) { return k == MoveKind::kArcCw || k == MoveKind::kArcCcw; }

/// What a move is for; decides its feed and what may be checked of it.
enum class MoveRole : std::uint8_t { kApproach, kPlunge, kRamp, kCut, kLink, kRetract, kDrill, kTap };

}  // namespace capstan::model
