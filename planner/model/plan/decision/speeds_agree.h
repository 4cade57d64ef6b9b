#pragma once

namespace capstan::model {

/// Whether a stated speed and the one that follows from another statement (cutspeed, and pi D n of a spindle
/// speed) say the same within what people round. Both in one unit, above 0. Default, unsourced: a factor of
/// 1.25, the step of the preferred numbers R10 (ISO 3) that speeds are rounded to.
[[nodiscard]] constexpr bool speeds_agree(double stated, double follows) {
  constexpr double kFactor = 1.25;
  return stated < kFactor * follows && follows < kFactor * stated;
}

}  // namespace capstan::model
