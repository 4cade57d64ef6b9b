#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/proof/verify/volumes/form/form.h"

namespace capstan::verify::volumes {

/// The raw piece, or the part, as a block or an upright bar; workpiece coordinates.
struct Piece {
  geometry::Box3 box;
  std::optional<double> round_mm;  ///< radius of a bar along z about the middle of the box
};

/// What of a feature lies beyond the raw piece, or of a raw piece beyond a feature, counts from here on, mm.
/// Default, unsourced.
inline constexpr double kBeyondMm = 0.01;

// Each gives words, empty where there is nothing to say. Tilted forms are not judged.

/// That the circle of a hole or thread (of a tapered one its narrow end) runs out over a side of the raw
/// piece: a drill that meets a side walks off.
[[nodiscard]] std::string cuts_an_edge(const Form& f, const Piece& raw);
/// That the point below a drilled hole's depth runs through the underside of the raw piece, or of the part
/// where that is higher.
[[nodiscard]] std::string point_runs_through(const Form& f, const Piece& raw, const Piece& part);
/// That a blind hole, pocket or slot ends below the part's underside, in what is cut off there.
[[nodiscard]] std::string floor_below_part(const Form& f, const Piece& raw, const Piece& part);
/// That part of the piece stands above a form's top and that none of `others` takes it away; `above_mm` gets
/// how high. Faces, edges and surfaces lie open.
[[nodiscard]] std::string buried(const Form& f, const std::vector<Form>& others, const Piece& part,
                                 double& above_mm);

/// The largest radius that may stay in inside corners of walls so high for which nothing is stated, mm: 3 mm,
/// and where they are higher than a mill reaches in one hand, a sixth of the height. Default, unsourced.
[[nodiscard]] double unstated_corner_mm(double depth_mm);

}  // namespace capstan::verify::volumes
