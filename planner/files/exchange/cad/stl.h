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

/// Reads an STL mesh, binary or ASCII, in mm; STL has no unit, so that the caller says how many mm are one.
/// Corners at the same place become one vertex. The order of corners determines the outside; normals that are
/// stated against it are a warning (STL-NORMAL). Triangles without area, and all but one of those that are
/// there more than once, are left out with a warning (STL-FLAT, STL-TWICE).
///
/// Fails  STL-SYNTAX (with the line), STL-TRUNCATED, STL-NUMBER (not finite), STL-EMPTY.
/// Cost   n log n; a binary triangle is 50 bytes.
[[nodiscard]] Result<geometry::Mesh> read_stl(std::string_view bytes, const std::string& name, Job& job,
                                              double mm_per_unit = 1.0);

/// The mesh if it describes a part: a closed solid, or a sheet with one height over each place of its
/// outline. Corners within geometry::kWeldMm are one. Triangles that face against their neighbours, and a
/// sheet that faces down, are turned with a warning (STL-TURNED, STL-FACES-DOWN). Further warnings:
/// STL-SHEET, STL-CROWDED, STL-INSIDE-OUT, STL-UNDERCUT (area that no cutter reaches from above), and
/// STL-INCH where nobody stated the unit and the mesh is as small as one in inches would be.
///
/// Fails  STL-OPEN  with the first opening: the surface beneath it is unknown.
[[nodiscard]] Result<geometry::Mesh> judged_mesh(geometry::Mesh mesh, const std::string& name, Job& job,
                                                 bool unit_stated);

/// A plan whose part is the mesh: a project with one workpiece, an empty workplan and one region. `unit` is
/// the row that says what the mesh's unit was, and by whom.
[[nodiscard]] model::Plan plan_of_mesh(geometry::Mesh mesh, const std::string& name, model::Provenance unit);

}  // namespace capstan::exchange
