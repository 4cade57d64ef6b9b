#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/profile.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::model {

/// The raw piece, or the part, as a block or an upright bar; workpiece coordinates.
struct PieceForm {
  geometry::Box3 box;
  std::optional<double> round_mm;  ///< radius of a bar along z about the middle of the box
};

/// What of a feature lies beyond the raw piece, or of a raw piece beyond a feature, counts from here on, mm.
/// Default, unsourced.
inline constexpr double kBeyondPieceMm = 0.01;

/// By how much the circle of a hole or thread (of a tapered one its narrow end) runs out over the sides of
/// the raw piece, mm; 0: it lies within them. A drill that meets a side walks off. Tilted ones are not
/// judged: 0.
[[nodiscard]] double beyond_sides(const FeatureShape& hole, const PieceForm& raw);
/// That, in words; empty when it lies within.
[[nodiscard]] std::string cuts_an_edge(const FeatureShape& hole, const PieceForm& raw);

/// By how much the point below a drilled hole's depth runs through the underside of the raw piece, or of the
/// finished part where that is higher, in words; empty when it does not.
[[nodiscard]] std::string point_runs_through(const FeatureShape& hole, const PieceForm& raw,
                                             const PieceForm& part);

/// Why a blind hole, pocket or slot has no floor in the finished part: it ends below that one's underside, in
/// what is cut off there, though not below the raw piece's; in words, empty when it has one.
[[nodiscard]] std::string floor_below_part(const FeatureShape& s, const PieceForm& raw,
                                           const PieceForm& part);

/// Whether a feature takes this point of the workpiece away: a face all that stands above its floor.
[[nodiscard]] bool takes(const FeatureShape& s, geometry::Vec3 p);

/// Part of the piece that stands above a feature's top and that none of the features takes away.
struct Buried {
  geometry::Vec3 at;  ///< the highest place that was found, workpiece coordinates
  double above_mm = 0.0;
  double volume_mm3 = 0.0;  ///< roughly
};
/// `features`: all of the part, elements and bosses of others left out; it may be among them. Faces, tilted
/// features and freeform surfaces lie open.
[[nodiscard]] std::optional<Buried> buried(const FeatureShape& s, const std::vector<FeatureShape>& features,
                                           const PieceForm& part);
[[nodiscard]] std::string to_text(const Buried& b);

/// An inside corner of a feature's walls, drawn by a turn of 20 degrees or more, with solid all round it.
struct SharpCorner {
  geometry::Vec3 at;  ///< at the feature's top, workpiece coordinates
  bool open = false;  ///< at the open side of a pocket, beyond which solid stands
};
/// `features` and `part` as above; upright walls only.
[[nodiscard]] std::vector<SharpCorner> sharp_corners(const FeatureShape& s,
                                                     const std::vector<FeatureShape>& features,
                                                     const PieceForm& part);

/// Whether solid stands beside a face above its floor, so that its reach ends there.
[[nodiscard]] bool stops_at_walls(const FeatureShape& face);

/// The largest radius that may stay in the inside corners of what can state none (steps, outsides, faces),
/// and of a pocket that states none, mm: 3 mm, and where that is deeper than a mill reaches in one hand, a
/// sixth of the depth, which is a mill three diameters deep. Of an open pocket, which is drawn with the
/// corners that it has, 0.35 of the narrower side of its box. Default, unsourced.
[[nodiscard]] double unstated_corner_mm(const FeatureShape& s);
/// The same for walls that are this high.
[[nodiscard]] double unstated_corner_mm(double depth_mm);

/// An inside corner that no mill makes nor comes near to, in words; empty when there is none: a slot that is
/// drawn as open where solid stands beyond its end, a woodruff end, one that states two radii (`features` as
/// above), a pocket whose open side lies within solid. `stated_only`: where only what the nouns say of an end
/// counts, because the features do not tell where material is.
[[nodiscard]] std::string square_corner(const Model& m, const FeatureShape& s,
                                        const std::vector<FeatureShape>& features, const PieceForm& part,
                                        bool stated_only = false);

/// Inside corners that a mill leaves round, in words; empty when there are none: a slot whose flat end has
/// solid beyond it and states no radius, or a pocket that states a radius of 0 (less than 0.02 mm).
[[nodiscard]] std::string drawn_square(const Model& m, const FeatureShape& s,
                                       const std::vector<FeatureShape>& features, const PieceForm& part);

}  // namespace capstan::model
