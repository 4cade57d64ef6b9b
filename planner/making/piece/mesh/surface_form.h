#pragma once

#include <optional>
#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/mesh/mesh_corners.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/piece.h"

// A surface given as a mesh: what of it mills and balls make.

namespace capstan::piece {

/// Radius of the largest ball that finishes a surface from above, mm, from its concave creases and curves; 0:
/// no limit. In a crease that states no radius may stay what may stay in an unstated corner
/// (unstated_corner_mm).
[[nodiscard]] double surface_radius(const geometry::Mesh& mesh);
/// Height of the lowest place of a mesh that is seen from above, in the frame of a placement, mm; nothing of
/// a mesh that has no such place.
[[nodiscard]] std::optional<double> lowest_seen_mm(const geometry::Mesh& mesh,
                                                   const geometry::Placement& frame);
/// Walls and level floors of a mesh, seen along z. A sheet has none; walls on the sides of the raw piece do
/// not count, for they are there already.
struct SurfaceForm {
  bool walls = false;             ///< upright ones, of a closed solid
  bool curved = false;            ///< anything else that is seen from above
  std::vector<double> floors_mm;  ///< heights of level parts, from above
  std::optional<double> foot_mm;  ///< height of the highest place at which a facet of a wall ends below
  double corner_mm = 0.0;         ///< least radius of the walls' inside corners, mm; 0: none, or sharp
  std::vector<geometry::MeshCorner> sharp;  ///< inside corners that no mill makes
  bool inside_out = false;                  ///< as geometry::form_of says
};
[[nodiscard]] SurfaceForm surface_form(const geometry::Mesh& mesh, const geometry::Box3& raw);
/// The radius that may stay in the sharp corners, mm; 0: there are none.
[[nodiscard]] double sharp_corner_of(const SurfaceForm& form);
/// Diameter of the largest cutter that passes between all walls, over each level floor, over all other
/// floors that end at walls and around the solid, mm; 0: no limit.
[[nodiscard]] double passage_between(const geometry::Mesh& mesh, const SurfaceForm& form,
                                     const geometry::Box3& raw);
/// Says which corners of the plan's mesh keep the radius of the narrowest mill (PIP-CORNER).
void tell_mesh_corners(const model::Plan& plan, const std::vector<draft::StepDraft>& steps, Job& job);
/// Radius of the last ball that finishes the plan's mesh, of the steps that it executes, mm; 0: there is
/// none.
[[nodiscard]] double last_ball_mm(const model::Plan& plan, const std::vector<draft::StepDraft>& steps);
/// Says that the last ball's radius stays in sharp creases of the plan's mesh (PIP-CREASE).
void tell_mesh_creases(const model::Plan& plan, const std::vector<draft::StepDraft>& steps, Job& job);

}  // namespace capstan::piece
