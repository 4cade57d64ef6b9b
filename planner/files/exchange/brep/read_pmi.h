#pragma once

#include "planner/files/exchange/brep/pmi.h"
#include "planner/files/p21/file.h"

namespace capstan::exchange {

/// Reads the semantic PMI of a STEP file from its instances: sizes and distances with limits, deviations or
/// fits; geometric tolerances with their datums; surface texture. Graphic annotations are not looked at.
///
/// Units   mm and micrometres, whatever the file has.
/// Fails   never: what is wrong or not understood is in `unread`.
/// Source  ISO 10303-47 (tolerances), ISO 10303-242 (which faces: geometric_item_specific_usage), ISO
///         10303-1110 (surface conditions).
[[nodiscard]] Pmi read_pmi(const p21::File& file);

}  // namespace capstan::exchange
