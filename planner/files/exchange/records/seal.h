#pragma once

#include <set>
#include <string>
#include <string_view>

#include "planner/files/exchange/common/report.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/contradicted.h"

namespace capstan::exchange {

/// A whole Part 21 file with its seal, the last entities of its header: what it says, kind by kind of entity,
/// as hashes:
///
///     !CAPSTAN_SEAL('MILLING_TECHNOLOGY',5,'hash')    all entities of a keyword, in the header or the data
///     !CAPSTAN_SEAL('capstan step',5,'hash')          all records of a kind that AP238 holds as properties
///
/// By it a reader knows what was edited since, also where no record speaks of it. Numbers count by value;
/// spacing, comments and the order of entities do not. Words for people (reasons, provenance, the standard's
/// own header) are not sealed. Fails  P21-... when the file cannot be read.
[[nodiscard]] Result<std::string> with_seal(std::string file);
/// Result of comparing a file with its seal.
struct SealState {
  bool holds = false;       ///< there is one, and nothing was edited
  bool paths_hold = false;  ///< there is one, and nothing was edited but lists of the plan in the header
  std::set<model::Listed> edited;  ///< these lists
};
/// Where the seal does not hold, warns EXC-EDITED, naming the kinds whose entities were edited since.
[[nodiscard]] SealState seal_of(const p21::File& file, Reporter& reporter);
[[nodiscard]] bool is_seal(std::string_view keyword);

}  // namespace capstan::exchange
