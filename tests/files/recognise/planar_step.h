#pragma once

#include <string>

#include "planner/files/exchange/brep/brep.h"

namespace capstan::testing {

/// Reads the faces of a STEP file whose solids have planes and straight edges alone, without OCCT: enough for
/// parts of MFCAD, and for tests that must not depend on the helper that reads real files.
///
/// Units   mm; the file's length unit is taken for mm.
/// Leaves  no tessellation; faces in file order, areas by their loops.
/// Fails   an empty Brep, where the file cannot be parsed or has another surface.
[[nodiscard]] exchange::Brep read_planar_step(const std::string& bytes);

/// Works out normals of edges, convexity, dihedral angles and areas of a Brep of planes, from the loops.
void complete_planar(exchange::Brep& brep);

}  // namespace capstan::testing
