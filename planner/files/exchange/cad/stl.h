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

/// Reads an STL mesh, binary or ASCII. STL has no unit: mm are assumed. Corners at the same place become one
/// vertex. Normals are dropped: the order of corners determines the outside. Triangles without area are left
/// out, with a warning.
///
/// Fails  STL-SYNTAX (with the line), STL-TRUNCATED, STL-NUMBER (not finite), STL-EMPTY.
/// Cost   linear; a binary triangle is 50 bytes.
[[nodiscard]] Result<geometry::Mesh> read_stl(std::string_view bytes, const std::string& name, Job& job);

/// True if a mesh describes a part: a closed solid, or a sheet with one height over each place of its
/// outline. Corners within geometry::kWeldMm are one. Other faults of its edges, STL-SHEET, STL-CROWDED,
/// STL-TURNED and STL-INSIDE-OUT, are warnings, for heights do not depend on them.
///
/// Fails  STL-OPEN  with the first opening: the surface beneath it is unknown.
[[nodiscard]] Status judge_mesh(const geometry::Mesh& mesh, const std::string& name, Job& job);

/// A plan whose part is the mesh: a project with one workpiece, an empty workplan and one region.
[[nodiscard]] model::Plan plan_of_mesh(geometry::Mesh mesh, const std::string& name);

}  // namespace capstan::exchange
