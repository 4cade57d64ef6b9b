#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/region.h"
#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/proof/verify/volumes/form/limits.h"
#include "planner/proof/verify/volumes/reading.h"

namespace capstan::verify::volumes {

/// What stands in a form's area.
struct Island {
  geometry::Region area;
  double top_mm = 0.0;  ///< form's frame
};

/// A solid of the own reading as the checks of heights and walls judge it: with chords for its arcs, with its
/// tolerances, and with a definite answer where the text leaves a place open.
///
/// Frame   that of `solid`.
/// Where the text leaves it open, a form goes: outsides and steps out past the raw piece; leaning walls from
/// the outline at the foot; a ball's lowest place at the depth; a conical bottom's point by its tip_angle
/// where that is no drill's; ends of slots that are not stated round.
struct Form {
  model::AnyRef feature;  ///< as the caller names it; `solid.noun` is the element or base that it comes from
  model::ShapeKind kind = model::ShapeKind::kFace;
  std::string name;  ///< its_id, with "[n]" for one of several
  Solid solid;
  Limits depth, width, length, diameter;
  geometry::Region area;  ///< cut at the depth, what stands in it not subtracted
  std::vector<Island> islands;
  geometry::Region before_mouth;  ///< of an open pocket: its area and what lies before its mouth
  double corner_radius_mm = 0.0;  ///< stated for inside corners; 0: none, or sharp
  bool corner_stated = false;
  double slope_rad = 0.0;                    ///< by which walls lean; 0: upright
  std::vector<geometry::Vec2> course;        ///< of a slot
  std::vector<geometry::Vec2> half_section;  ///< (height above the floor, half width); empty: square
  double tip_mm = 0.0;                       ///< of a conical bottom below the depth

  [[nodiscard]] const geometry::Placement& frame() const { return solid.frame; }
  [[nodiscard]] double depth_mm() const { return solid.depth_mm; }
  [[nodiscard]] const Bore* bore() const { return std::get_if<Bore>(&solid.form); }
  [[nodiscard]] const Bevel* bevel() const { return std::get_if<Bevel>(&solid.form); }
  /// The radius between walls and floor; 0: none.
  [[nodiscard]] double foot_radius_mm() const;
  /// A cutter can come in from the side.
  [[nodiscard]] bool open() const;
};

/// The forms of a feature, wherever its compounds and patterns put it. Of what has no volume one form without
/// an area. Empty: it was not read.
[[nodiscard]] std::vector<Form> forms_of(const Source& source, model::AnyRef feature, const Reading& reading);

/// How far beyond raw piece and outline what has no outer wall is drawn, mm. Default, unsourced.
inline constexpr double kDrawnBeyondMm = 100.0;

/// Height of the form's finished surface above q, form's frame; nothing where it takes nothing away.
[[nodiscard]] std::optional<double> floor_at(const Form& f, geometry::Vec2 q);
/// Whether `floor_at` is the same everywhere within that distance of q; false where that is not known at
/// once.
[[nodiscard]] bool level_about(const Form& f, geometry::Vec2 q, double distance_mm);
/// Whether it takes a place of the workpiece away; a face all above its floor.
[[nodiscard]] bool takes(const Form& f, geometry::Vec3 p);

/// The upper edge of a form, broken by a cone: one form for each outline of it. Frame and feature are the
/// form's.
[[nodiscard]] std::vector<Form> broken_edges(const Form& f, double depth_mm, double width_mm);

}  // namespace capstan::verify::volumes
