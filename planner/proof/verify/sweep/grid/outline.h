#pragma once

#include <array>

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
    return d <= flat_ ? 0.0 : profile_.height(d < profile_.radius_mm ? d : profile_.radius_mm);
  }
  /// The profile's, without a search where all of it is below.
  [[nodiscard]] double radius_at(double height_mm) const {
    return height_mm >= top_ ? profile_.radius_mm : profile_.radius_at(height_mm);
  }
  /// Whether it is one plane across the whole end.
  [[nodiscard]] bool flat() const { return flat_ >= profile_.radius_mm; }
  /// The one sphere that its end is; null: it has another shape.
  [[nodiscard]] const geometry::ProfilePiece* ball() const {
    const auto& p = profile_.pieces;
    return p.size() == 1 && p[0].radius_mm > 0.0 && p[0].rc_mm == 0.0 ? p.data() : nullptr;
  }
  /// No more than `height(sqrt(square))`, for a square of at most that of the radius.
  [[nodiscard]] double at_least(double square) const {
    return floor_[static_cast<std::size_t>(square * bins_per_square_)];
  }
  /// Within this the cutter has no edge unless it cuts to its centre. Of a cone that is its tip's: its flank
  /// cuts. The share is a default, unsourced.
  [[nodiscard]] double middle() const;

 private:
  static constexpr std::size_t kBins = 256;
  geometry::CutterProfile profile_;
  double flat_ = 0.0, top_ = 1e300;  ///< the flat part's radius, the height of the rim
  double bins_per_square_ = 0.0;
  std::array<double, kBins + 2> floor_{};
};

/// Lowest height of the cutter over a point while it runs along a line; `d` is the distance of the point
/// from the line, `foot` where its foot lies along it, `length` the line's in XY, `dz` its rise.
[[nodiscard]] double lowest_on_line(const CutterOutline& o, double z0, double dz, double foot, double d,
                                    double length);

/// The same along a helix of that radius about an axis that the point is `away` from. `ahead`: the angle,
/// rad, in [0, 2 pi), from the helix's start to the point, in the way's direction; `sweep` that of the whole
/// way, in (0, 2 pi]. +inf where the cutter does not come over the point.
[[nodiscard]] double lowest_on_helix(const CutterOutline& o, double z0, double dz, double radius,
                                     double sweep, double away, double ahead);

}  // namespace capstan::verify
