#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/geometry/profile.h"

namespace capstan::verify {

/// A cutter's outline as the sweep asks for it: its flat part apart, and a floor under its heights that is
/// found without a root.
///
/// Units  mm.
class CutterOutline {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): an outline is its profile, prepared.
  CutterOutline(geometry::CutterProfile profile);

  [[nodiscard]] const geometry::CutterProfile& profile() const { return profile_; }
  [[nodiscard]] double radius() const { return profile_.radius_mm; }
  [[nodiscard]] double height(double d) const {
    if (d <= flat_) return 0.0;
    const double r = d < profile_.radius_mm ? d : profile_.radius_mm;
    return sphere_ ? height_of_sphere(r) : profile_.height(r);
  }
  /// The profile's, without a search where all of it is below.
  [[nodiscard]] double radius_at(double height_mm) const {
    return height_mm >= top_ ? profile_.radius_mm : profile_.radius_at(height_mm);
  }
  /// Whether it is one plane across the whole end.
  [[nodiscard]] bool flat() const { return flat_ >= profile_.radius_mm; }
  /// The one sphere that its end is; null: it has another shape.
  [[nodiscard]] const geometry::ProfilePiece* ball() const {
    return ball_ ? profile_.pieces.data() : nullptr;
  }
  /// No more than `height(sqrt(square))`, for a square of at most that of the radius.
  [[nodiscard]] double at_least(double square) const {
    return floor_[static_cast<std::size_t>(square * bins_per_square_)];
  }
  /// Heights above the tip of at_0 + per_square s, which are no more than `height(sqrt(s))` for any s up to
  /// the radius's.
  struct Floor {
    double at_0 = 0.0, per_square = 0.0;
  };
  /// One that is close near the axis, one near the rim.
  [[nodiscard]] const std::array<Floor, 2>& floors() const { return floors_; }
  /// Within this the cutter has no edge unless it cuts to its centre. Of a cone that is its tip's: its flank
  /// cuts. The share is a default, unsourced.
  [[nodiscard]] double middle() const;

 private:
  static constexpr std::size_t kBins = 256;
  /// As the profile has it, of a ball that reaches to the rim.
  [[nodiscard]] double height_of_sphere(double r) const {
    const geometry::ProfilePiece& p = profile_.pieces[0];
    const double d = std::min(r, p.radius_mm);
    return p.zc_mm - std::sqrt((p.radius_mm - d) * (p.radius_mm + d));
  }
  [[nodiscard]] Floor floor_of(double per_square) const;

  geometry::CutterProfile profile_;
  bool ball_ = false, sphere_ = false;  ///< `ball()`; one whose sphere reaches to the rim
  double flat_ = 0.0, top_ = 1e300;     ///< the flat part's radius, the height of the rim
  double bins_per_square_ = 0.0;
  std::array<double, kBins + 2> floor_{};
  std::array<Floor, 2> floors_;
};

/// Lowest height of a cutter whose end is not one sphere over a point while it runs along a line; `d` is the
/// distance of the point from the line, `foot` where its foot lies along it, `length` the line's in XY, `dz`
/// its rise.
[[nodiscard]] double lowest_on_line(const CutterOutline& o, double z0, double dz, double foot, double d,
                                    double length);

/// The same along a helix of that radius about an axis that the point is `away` from. `ahead`: the angle,
/// rad, in [0, 2 pi), from the helix's start to the point, in the way's direction; `sweep` that of the whole
/// way, in (0, 2 pi]. +inf where the cutter does not come over the point.
[[nodiscard]] double lowest_on_helix(const CutterOutline& o, double z0, double dz, double radius,
                                     double sweep, double away, double ahead);

}  // namespace capstan::verify
