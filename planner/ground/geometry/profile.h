#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace capstan::geometry {

/// The outline of a rotating cutter in its axial half-plane: height above the tip as a function of the
/// distance r from the axis, for the side that faces the work. One description for every cutter.
///
///     piece: z(r) = z0 + slope (r - r0)                           straight
///            z(r) = zc - sqrt(radius^2 - (r - rc)^2)              arc (radius > 0), convex towards the work
///
/// Units  mm. Pieces cover [0, R] without gaps, z(0) = 0 unless the centre does not cut, z does not fall.
struct ProfilePiece {
  double r0_mm = 0.0;
  double r1_mm = 0.0;
  double z0_mm = 0.0;      ///< straight: height at r0
  double slope = 0.0;      ///< straight: dz/dr
  double radius_mm = 0.0;  ///< arc when > 0
  double rc_mm = 0.0;
  double zc_mm = 0.0;
  friend bool operator==(const ProfilePiece&, const ProfilePiece&) = default;
};

/// Whether an arc goes on until it is upright, as a ball's and a corner's do and a lens's does not.
[[nodiscard]] bool ends_upright(const ProfilePiece& arc);

struct CutterProfile {
  std::vector<ProfilePiece> pieces;
  double radius_mm = 0.0;          ///< R, the largest cutting radius
  double cutting_length_mm = 0.0;  ///< height above the tip up to which the flanks cut (APMX or flute length)
  /// Height of the cutter's surface above its tip at distance r; +inf outside R.
  [[nodiscard]] double height(double r_mm) const;
  /// The largest distance from the axis at which the surface is no higher than this above the tip; at most R,
  /// 0 when none is.
  [[nodiscard]] double radius_at(double height_mm) const;
  friend bool operator==(const CutterProfile&, const CutterProfile&) = default;
};

/// An outline whose slope dz/dr never falls outwards: what a plane, a line or a point touches it at is found
/// from the slope alone. It holds its pieces itself, so that making one allocates nothing.
struct ConvexOutline {
  static constexpr std::size_t kMost = 12;
  std::array<ProfilePiece, kMost> piece;
  std::size_t pieces = 0;
  double radius_mm = 0.0;
  /// As that of CutterProfile; beyond the radius, where rounding leads, the height of the rim.
  [[nodiscard]] double height(double r_mm) const;
  /// The least distance from the axis at which a plane that rises outwards by `slope` (dz/dr > 0) touches.
  [[nodiscard]] double touch_radius(double slope) const;
  /// The radius of the plane at the tip; 0 where there is none.
  [[nodiscard]] double level_radius() const;
  /// The radius of the largest ball that, rolled inside, reaches all of the outline; 0 where it has a corner.
  [[nodiscard]] double sharpest_radius() const;
};
/// Nothing for an outline that is hollow, has a hole at its axis, or more pieces than kMost lets grow.
[[nodiscard]] std::optional<ConvexOutline> convex_outline(const CutterProfile& profile);
/// The outline with a ball of radius `by_mm` rolled all round it, its tip at height 0 again: arcs grow,
/// straight pieces move along their normals, corners become arcs. Needs  by >= 0.
[[nodiscard]] ConvexOutline grown(const ConvexOutline& outline, double by_mm);

/// One plane across the whole end: no corner, no cone, no ball.
[[nodiscard]] bool is_flat(const CutterProfile& profile);

[[nodiscard]] CutterProfile flat_profile(double diameter_mm, double cutting_length_mm);
[[nodiscard]] CutterProfile ball_profile(double diameter_mm, double cutting_length_mm);
/// Corner radius 0: flat; R: ball.
[[nodiscard]] CutterProfile bull_profile(double diameter_mm, double corner_radius_mm,
                                         double cutting_length_mm);
/// A cone with the given full point angle (rad) up to the diameter: drills, countersinks, vee cutters.
/// `tip_diameter_mm`: flat at the tip (0: sharp).
[[nodiscard]] CutterProfile cone_profile(double diameter_mm, double point_angle_rad, double cutting_length_mm,
                                         double tip_diameter_mm = 0.0);
/// A hollow quarter round from the rim of the flat tip, where it is upright, out to the diameter, where it is
/// level: what rounds an edge. Its tip is what the round leaves of the diameter. In ten chords, which lie on
/// the side of the material, 0.3 % of the radius from the arc.
[[nodiscard]] CutterProfile rounding_profile(double diameter_mm, double round_radius_mm,
                                             double cutting_length_mm);

}  // namespace capstan::geometry
