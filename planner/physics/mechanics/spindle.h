#pragma once

#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::model {
struct Spindle;
}

/// Power and torque of a spindle at a speed.
namespace capstan::mechanics {

/// A point of the maker's diagram, continuous rating (S1) unless the caller says otherwise.
/// Zero means "not stated" for power or torque, but not for both: then the one follows from the other.
struct SpindlePoint {
  double rpm = 0.0;
  double power_w = 0.0;
  double torque_nm = 0.0;
};

struct SpindleCapacity {
  double power_w = 0.0;
  double torque_nm = 0.0;
};

/// The points of one gear, checked: speeds rising strictly, values finite, none negative.
class SpindleCurve {
 public:
  /// Fails     SPINDLE-CURVE.
  [[nodiscard]] static Result<SpindleCurve> make(std::vector<SpindlePoint> points);

  /// Capacity at a speed between the first and the last point.
  ///
  /// Between two points both power and torque are read on the straight line, and the smaller of the two
  /// (as P = M 2 pi n / 60) holds. That is exact for a range of constant torque (power is the line) and
  /// for one of constant power (torque would be overstated by its chord; power rules).
  /// Fails     SPINDLE-RANGE outside the points: nothing is extrapolated.
  [[nodiscard]] Result<SpindleCapacity> at(double rpm) const;

  [[nodiscard]] double min_rpm() const { return points_.front().rpm; }
  [[nodiscard]] double max_rpm() const { return points_.back().rpm; }
  [[nodiscard]] const std::vector<SpindlePoint>& points() const { return points_; }

 private:
  explicit SpindleCurve(std::vector<SpindlePoint> points) : points_(std::move(points)) {}
  std::vector<SpindlePoint> points_;
};

/// The curve of a machine's spindle, of the gear in use.
/// Fails     SPINDLE-CURVE.
[[nodiscard]] Result<SpindleCurve> curve_of(const model::Spindle& spindle);

}  // namespace capstan::mechanics
