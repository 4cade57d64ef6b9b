#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

enum class HoleBottom : std::uint8_t { kThrough, kFlat, kFlatWithRadius, kConical, kSpherical };

/// Axes this near are one, mm.
inline constexpr double kCoaxialMm = 1e-4;

/// A nominal size with its allowed deviations, mm.
struct Toleranced {
  double nominal_mm = 0.0;
  double lower_mm = 0.0, upper_mm = 0.0;  ///< deviations, lower <= upper
  bool given = false;                     ///< whether a tolerance was stated
  [[nodiscard]] double middle() const { return nominal_mm + 0.5 * (lower_mm + upper_mm); }
  [[nodiscard]] double width() const { return upper_mm - lower_mm; }
  friend bool operator==(const Toleranced&, const Toleranced&) = default;
};

/// A material left standing inside a pocket.
struct Island {
  geometry::Region area;  ///< at the pocket's bottom, feature frame
  double top_z_mm = 0.0;  ///< feature frame; 0 is the pocket's top
  double foot_radius_mm = 0.0;  ///< between it and the bottom (fillet_radius, else planar_radius)
};

/// What one feature removes, in plain geometry.
///
/// Frame   `frame` is the feature's, in workpiece coordinates: z points out of the material, the feature's
/// top
///         is at z = 0 (face: the level of the raw surface), its bottom at z = -depth_mm. Areas are in frame
///         XY.
struct FeatureShape {
  AnyRef feature;  ///< the noun it came from (a member of a pattern: its base feature)
  int member = 0;  ///< number within a pattern or compound, from 0
  /// Of a compound or pattern: the element (or base) that this is, the elements of that one, and so on.
  std::vector<AnyRef> made_of;
  ShapeKind kind = ShapeKind::kFace;
  std::string name;  ///< its_id, with "[n]" for members
  geometry::Placement frame;
  double depth_mm = 0.0;  ///< > 0
  Toleranced depth_tolerance;
  bool through = false;  ///< the bottom is open: cut past it where the machine allows

  geometry::Region area;   ///< what is removed at the bottom (islands not subtracted)
  geometry::Region reach;  ///< area, grown over its open sides: where a cutter may move without
                           ///< touching a wall of this feature; equals area when closed all round
  std::vector<Island> islands;
  bool open = false;              ///< has an open side, so that a cutter can enter from outside
  double corner_radius_mm = 0.0;  ///< concave corners of the walls (orthogonal_radius); 0 sharp or unknown
  double bottom_radius_mm = 0.0;  ///< between wall and bottom (planar_radius)
  double slope_rad = 0.0;         ///< of the walls against the axis; 0 upright
  Toleranced width, length;       ///< of pockets and slots where they have one

  std::vector<geometry::Vec2> spine;  ///< slots: the path of travel in frame XY
  /// Slots that are not square: half width as a function of height above the bottom, (height, half width)
  /// by rising height; empty for a square profile. Radius 0 .. depth.
  std::vector<geometry::Vec2> slot_profile;
  double slot_bottom_radius_mm = 0.0;  ///< rounded U: the ball that makes it
  double slot_angle_rad = 0.0;         ///< vee: the full angle

  Toleranced diameter;              ///< holes: at the top
  double bottom_diameter_mm = 0.0;  ///< tapered holes; else diameter.nominal
  HoleBottom bottom = HoleBottom::kThrough;
  double bottom_angle_rad = 0.0;       ///< conical: angle of the bottom's flank against the plane z = const
  double bottom_hole_radius_mm = 0.0;  ///< spherical, flat with radius; conical: a stated tip radius

  double thread_pitch_mm = 0.0, thread_major_mm = 0.0, thread_depth_mm = 0.0;
  bool thread_left_hand = false;
  double chamfer_width_mm = 0.0, chamfer_angle_rad = 0.0;  ///< along the plane of the edge; against it
  double round_radius_mm = 0.0;                            ///< edge_round
  double sphere_radius_mm = 0.0;                           ///< spherical_cap
  std::vector<std::string> assumptions;  ///< how an unusual or incomplete noun was read, a sentence each
  std::vector<std::string> remarks;      ///< how it is made where nobody needs to act, a sentence each
};

/// The shapes of a feature: one for a simple one, several for compounds, patterns, counterbored holes.
/// Elements of a compound are placed relative to it, the base of a pattern relative to the pattern, and so
/// on. An element that is asked for by itself has a shape for each compound or pattern that lists it. Where
/// this places an element outside the piece, and workpiece coordinates would not, the placement is read in
/// workpiece coordinates, and `assumptions` says so (shape/containers.cpp).
/// Fails  SHP-… when the noun lacks what a shape needs (no depth, no profile), naming the attribute.
[[nodiscard]] Result<std::vector<FeatureShape>> shapes_of(const Model& model,
                                                          Ref<ManufacturingFeature> feature);

/// Whether two shapes have the same form, sizes and tolerances, wherever they lie; areas are not compared.
[[nodiscard]] bool same_form(const FeatureShape& a, const FeatureShape& b);

/// Features that are parts of others: elements of compounds, bases of patterns, bosses of pockets, faces and
/// steps.
[[nodiscard]] std::set<AnyRef> parts_of_others(const Model& model);

/// The radius of the fillets between the bottom and what stands beside it: walls and islands; 0: none.
/// Nothing: they differ by more than kFilletSlackMm, so that no one cutter makes them.
[[nodiscard]] std::optional<double> floor_fillet_mm(const FeatureShape& shape);
/// The largest of them, 0 where there is none: what a flat cutter keeps clear of.
[[nodiscard]] double largest_fillet_mm(const FeatureShape& shape);

/// Height of the finished surface of this one feature above p, frame coordinates: -depth on the bottom,
/// higher on sloped or rounded walls, 0 or nothing outside: nothing means that the feature leaves p alone.
[[nodiscard]] std::optional<double> floor_at(const FeatureShape& shape, geometry::Vec2 p);

}  // namespace capstan::model
