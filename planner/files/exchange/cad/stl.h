#pragma once

#include <string>
#include <string_view>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/mesh.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// Whether the bytes are an STL mesh: a binary one by its size, which its triangle count fixes; else ASCII.
[[nodiscard]] bool looks_like_stl(std::string_view bytes);

/// Reads an STL mesh, binary or ASCII. STL has no unit: mm are assumed. Corners at the very same place
/// become one vertex; normals are dropped, the order of corners tells the outside. Triangles without area
/// are left out, with a warning.
///
/// Fails  STL-SYNTAX (with the line), STL-TRUNCATED, STL-NUMBER (not finite), STL-EMPTY.
/// Cost   linear; a binary triangle is 50 bytes.
[[nodiscard]] Result<geometry::Mesh> read_stl(std::string_view bytes, const std::string& name, Job& job);

/// Whether a mesh says what is to be made: a closed solid, or a sheet with one height over each place of its
/// outline. Corners within geometry::kWeldMm are one. What is left of its edges: STL-SHEET, STL-CROWDED,
/// STL-TURNED and STL-INSIDE-OUT are warnings, for heights do not depend on them.
///
/// Fails  STL-OPEN  with the first opening: what is to stand beneath it, nobody knows.
[[nodiscard]] Status judge_mesh(const geometry::Mesh& mesh, const std::string& name, Job& job);

/// A plan whose part is the mesh: a project with one workpiece, an empty workplan and one region.
[[nodiscard]] model::Plan plan_of_mesh(geometry::Mesh mesh, const std::string& name);

}  // namespace capstan::exchange
