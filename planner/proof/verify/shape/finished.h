#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

/// The shape that the finished part was to have, as its CAD file says it. Workpiece frame, mm.
struct AskedShape {
  std::string file;
  geometry::Mesh mesh;    ///< closed
  double chord_mm = 0.0;  ///< by which the mesh may leave the shape; added to the tolerance
  struct Plane {
    std::string name;  ///< "#12"
    std::vector<std::uint32_t> triangles;
  };
  std::vector<Plane> planes;
};

/// How what the cutters leave of the raw piece differs from the shape.
struct ShapeDifference {
  double step_mm = 0.0;                       ///< between the points that were compared
  double asked_mm3 = 0.0, removed_mm3 = 0.0;  ///< raw piece less shape; raw piece less what is left
  double tolerance_mm = 0.0;                  ///< kShapeMm and the chord of the mesh
  double left_mm3 = 0.0, gouged_mm3 = 0.0;    ///< further than that on the wrong side of the surface
  double deepest_left_mm = 0.0, deepest_gouge_mm = 0.0;
  geometry::Vec3 left_at, gouge_at;    ///< the worst places
  std::size_t edges_cut = 0;           ///< places at sharp edges of the shape that are cut away
  geometry::Vec3 edge_at;              ///< the first of them
  double overlap = 0.0;                ///< common volume over the volume of both together
  std::size_t planes = 0;              ///< that were compared
  std::vector<std::string> high, low;  ///< names of those that lie further than the tolerance out, or in
  /// How far the worst of them lie out, or in; kFarthestPlaneMm: that or more.
  double worst_high_mm = 0.0, worst_low_mm = 0.0;
};

/// What lies no further than this on the wrong side of the surface counts as right, mm, beside what the mesh
/// may leave the shape: general tolerance of the check (0.02 mm), chords of paths. Default, unsourced.
inline constexpr double kShapeMm = 0.04;
/// So far the distance of a plane face is measured, mm. Default, unsourced: more is another mistake.
inline constexpr double kFarthestPlaneMm = 3.2;

/// Sweeps every move through the raw piece and compares what is left with the shape: on a lattice of points,
/// at places of each plane face, where the height of the cutters is exact, and just inside its sharp edges.
///
/// Threads   what the steps of a thread cut beside its core counts as neither: a CAD model draws the core.
///
/// Accuracy  a point counts as left or as gouged where the cutters' moves say so exactly, in set-ups of any
///           direction; nothing between the points is seen. Overhanging cutters are taken as full up to their
///           top.
///
/// Cost      linear in the points and, for each move, in what it passes over; a point on the wrong side of
/// the
///           surface asks the moves about it, and the triangles over it. The worst places are found by the
///           whole mesh, at few points.
[[nodiscard]] ShapeDifference compare_with_shape(const model::Plan& plan, const std::vector<StepMoves>& steps,
                                                 const AskedShape& shape);

/// The same of a program that was written of a plan, as its reader reads it; of the plan's own paths where
/// the text is empty. Findings: CHK-SHAPE (a note with all figures), CHK-SHAPE-LEFT (a warning: 36;
/// CHK-SHAPE-FACES where plane faces are not reached), CHK-SHAPE-GOUGE (an error: 11).
[[nodiscard]] std::vector<model::Finding> check_shape(const ProgramText& program, const model::Plan& plan,
                                                      const AskedShape& shape);

}  // namespace capstan::verify
