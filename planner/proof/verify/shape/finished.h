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
  double chord_mm = 0.0;  ///< by which the mesh may leave the shape
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
  double left_mm3 = 0.0, gouged_mm3 = 0.0;    ///< further than kShapeMm on the wrong side of the surface
  double deepest_left_mm = 0.0, deepest_gouge_mm = 0.0;
  geometry::Vec3 left_at, gouge_at;    ///< the worst places
  double overlap = 0.0;                ///< common volume over the volume of both together
  std::size_t planes = 0;              ///< that were compared
  std::vector<std::string> high, low;  ///< names of those that lie more than kShapeMm out, or in
  double worst_plane_mm = 0.0;
};

/// What lies no further than this on the wrong side of the surface counts as right, mm: general tolerance of
/// the check (0.02 mm), chord of the mesh, chords of paths. Default, unsourced.
inline constexpr double kShapeMm = 0.06;

/// Sweeps every move through the raw piece and compares what is left with the shape: on a lattice of points,
/// and at places of each plane face, where the height of the cutters is exact.
///
/// Accuracy  exact at each point for tools along an axis of the raw piece, within a step of the lattice for
///           others; nothing between the points is seen. Overhanging cutters are taken as full up to their
///           top.
/// Cost      linear in moves and points.
[[nodiscard]] ShapeDifference compare_with_shape(const model::Plan& plan, const std::vector<StepMoves>& steps,
                                                 const AskedShape& shape);

/// The same of a program that was written of a plan, as its reader reads it; of the plan's own paths where
/// the text is empty. Findings: CHK-SHAPE (a note with all figures), CHK-SHAPE-LEFT (a warning: 36),
/// CHK-SHAPE-GOUGE (an error: 11).
[[nodiscard]] std::vector<model::Finding> check_shape(const ProgramText& program, const model::Plan& plan,
                                                      const AskedShape& shape);

}  // namespace capstan::verify
