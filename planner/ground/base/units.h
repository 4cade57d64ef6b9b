#pragma once

#include <compare>
#include <numbers>

namespace capstan {

/// A quantity that cannot be mistaken for another: built and read only through a unit.
///
/// Units     one per kind: mm, mm/min, 1/min, N, Nm, W, s, rad. Kernels take bare doubles whose
///           names wear the unit (`depth_mm`); doors between rooms take these types.
template <class Kind>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}
  [[nodiscard]] constexpr double value() const { return value_; }
  friend constexpr auto operator<=>(Quantity, Quantity) = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity(a.value_ + b.value_); }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity(a.value_ - b.value_); }
  friend constexpr Quantity operator*(double k, Quantity a) { return Quantity(k * a.value_); }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value_ / b.value_; }

 private:
  double value_ = 0.0;
};

using Length = Quantity<struct LengthKind>;                    ///< mm
using FeedRate = Quantity<struct FeedRateKind>;                ///< mm/min
using RotationalSpeed = Quantity<struct RotationalSpeedKind>;  ///< 1/min
using Force = Quantity<struct ForceKind>;                      ///< N
using Torque = Quantity<struct TorqueKind>;                    ///< Nm
using Power = Quantity<struct PowerKind>;                      ///< W
using Duration = Quantity<struct DurationKind>;                ///< s
using Angle = Quantity<struct AngleKind>;                      ///< rad

namespace units {
constexpr Length mm(double v) { return Length(v); }
constexpr FeedRate mm_per_min(double v) { return FeedRate(v); }
constexpr RotationalSpeed per_min(double v) { return RotationalSpeed(v); }
constexpr Force newton(double v) { return Force(v); }
constexpr Torque newton_metre(double v) { return Torque(v); }
constexpr Power watt(double v) { return Power(v); }
constexpr Duration seconds(double v) { return Duration(v); }
constexpr Angle radians(double v) { return Angle(v); }
constexpr Angle degrees(double v) { return Angle(v * std::numbers::pi / 180.0); }
}  // namespace units

}  // namespace capstan
