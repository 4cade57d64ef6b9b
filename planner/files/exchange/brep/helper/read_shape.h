#pragma once

#include <string>

#include "planner/files/exchange/brep/message.h"

namespace capstan::exchange {

/// Reads the shapes of a STEP file by OpenCASCADE, mends them, and tessellates them to `chord_mm`.
///
/// Names are left out: the caller has them from the file itself.
///
/// Fails   a message without a brep and with an error: BREP-SYNTAX (OpenCASCADE cannot read the file),
///         BREP-EMPTY (no shape in it), BREP-LOST (faces of which no body can be made), BREP-WIRE (shapes
///         without faces), BREP-TESSELLATED (faces without a surface), BREP-OPEN (a solid that is not
///         closed), BREP-GAPS (edges far beside their faces), BREP-MESH (a solid whose tessellation is not
///         closed), BREP-VOLUME (faces and tessellation of a solid hold different volumes), BREP-NUMBER (a
///         figure that is not finite), BREP-MEMORY, BREP-OCCT (what OpenCASCADE threw). It may crash or never
///         return: only a process of its own may call it.
/// Warns   BREP-INVALID (inconsistent, and not mended), BREP-MENDED, BREP-GAPS, BREP-LOST (some faces),
///         BREP-SHEET, BREP-LOOP, BREP-CROWDED, BREP-SHORT, BREP-MESH (single faces). Notes BREP-PLACED.
[[nodiscard]] BrepMessage read_shape(const std::string& step, double chord_mm);

}  // namespace capstan::exchange
