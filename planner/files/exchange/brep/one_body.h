#pragma once

#include <string>

#include "planner/files/exchange/brep/brep.h"
#include "planner/ground/base/result.h"

namespace capstan::exchange {

/// The bodies of a file, each with its number from 1 as `one_body` takes it: "1 'plate' (solid, 40 faces)".
[[nodiscard]] std::string bodies_in_words(const Brep& shape);

/// One body of a file alone: its faces, edges and triangles, numbered anew, and what the file asks of them or
/// of the whole part. `asked` is its number from 1, or its name.
/// Fails  CAD-BODIES, with the list of bodies, where none or several are so called, one by its number and
/// another by its name among them, or it is a sheet.
[[nodiscard]] Result<Brep> one_body(const Brep& shape, const std::string& asked, const std::string& file);

}  // namespace capstan::exchange
