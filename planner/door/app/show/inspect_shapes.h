#pragma once

#include <string>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/ground/base/result.h"

namespace capstan::app {

/// Summary of a CAD model: its unit, box, volume and area, each body, faces and edges by kind. `diagnostics`
/// are those of reading it.
[[nodiscard]] std::string inspect(const exchange::Brep& shapes, const std::vector<Diagnostic>& diagnostics);

}  // namespace capstan::app
