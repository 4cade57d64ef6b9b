#pragma once

#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/mesh/mesh_corners.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/piece.h"

// A surface given as a mesh: what of it mills and balls make.

namespace capstan::piece {

/// Radius of the largest ball that finishes a surface from above, mm, from its concave creases and curves; 0:
/// no limit. Corners sharper than 20 degrees keep any ball's radius and do not count.
[[nodiscard]] double surface_radius(const geometry::Mesh& mesh);
/// Walls and level floors of a mesh, seen along z. A sheet has none; walls on the sides of the raw piece do
/// not count, for they are there already.
struct SurfaceForm {
  bool walls = false;             ///< upright ones, of a closed solid
  bool curved = false;            ///< anything else that is seen from above
  std::vector<double> floors_mm;  ///< heights of level parts, from above
  double corner_mm = 0.0;         ///< least radius of the walls' inside corners, mm; 0: none, or sharp
  std::vector<geometry::MeshCorner> sharp;  ///< inside corners that no mill makes
  bool inside_out = false;                  ///< as geometry::form_of says
};
[[nodiscard]] SurfaceForm surface_form(const geometry::Mesh& mesh, const geometry::Box3& raw);
/// The radius that may stay in the sharp corners, mm; 0: there are none.
[[nodiscard]] double sharp_corner_of(const SurfaceForm& form);
/// Diameter of the largest cutter that passes between all walls, over each level floor and around the solid,
/// mm; 0: no limit.
[[nodiscard]] double passage_between(const geometry::Mesh& mesh, const SurfaceForm& form,
                                     const geometry::Box3& raw);
/// Says which corners of the plan's mesh keep the radius of the narrowest mill (PIP-CORNER).
void tell_mesh_corners(const model::Plan& plan, const std::vector<draft::StepDraft>& steps, Job& job);

}  // namespace capstan::piece
