#pragma once

#include "planner/making/toolpath/region/area/track.h"

// How far down the pieces of a ramp may go, so that the program's ramp is no steeper than asked. A program
// rounds the ends of each piece to its digits: over a piece of 0.5 mm one digit of 0.0001 mm is 0.011 degrees
// more. A piece therefore goes down by a digit less than its slope allows over its length, and a piece too
// short for that stays level.

namespace capstan::toolpath {

class Descent {
 public:
  /// Of a slope in rad, below a right angle, by a program that writes coordinates to `digit_mm`.
  Descent(double slope_rad, double digit_mm);

  /// Of one line, or of one arc of up to about half a turn, mm.
  [[nodiscard]] double of(double length_mm) const;
  /// Of all pieces of a track.
  [[nodiscard]] double of(const Track& t) const;
  /// Length of the track, from its start, over which it goes down by `drop_mm`; all of it where that is more
  /// than `of` it.
  [[nodiscard]] double length_for(const Track& t, double drop_mm) const;

 private:
  double tan_;
  double digit_mm_;
  double shorter_mm_;  ///< a piece may come out by this
};

}  // namespace capstan::toolpath
