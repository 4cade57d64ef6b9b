#pragma once

#include <string>

#include "planner/exchange/iso14649/reading.h"

namespace capstan::exchange {

/// What the file says, kind by kind of entity, as hashes:
///
///     !CAPSTAN_SEAL('MILLING_TECHNOLOGY',5,'hash')    all entities of a keyword, in the header or the data
///
/// By it a reader knows what was edited since, also where no record speaks of it. Numbers count by value;
/// spacing, comments and the order of entities do not. Words for people (reasons, provenance, the standard's
/// own header) are not sealed.
[[nodiscard]] std::string seals_of(const p21::File& file);
/// Warns EXC-EDITED, naming the kinds whose entities were edited since the file was sealed.
void compare_seals(Reading& reading);
[[nodiscard]] bool is_seal(std::string_view keyword);

}  // namespace capstan::exchange
