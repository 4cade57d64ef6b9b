#pragma once

#include <string_view>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/preset_feeds.h"

namespace capstan::tooling {

/// Completes missing values (zeros, no presets) from the generic cutter of the same class nearest in
/// diameter, and records this in `sources`; stated values stay. Lengths stay consistent with stated ones:
/// flutes and usable length within the stick-out, the stick-out within the length to the gage line.
///
/// Speeds are those of a bare edge, of plain HSS or of carbide, times what `edges.h` gives for the grade that
/// the cutter's words state; a group without a figure stays bare, and its preset says so.
///
/// Whether it cuts to the centre and how steeply it may ramp are not taken over: an unnamed end mill is held
/// not to cut to the centre and to ramp at model::kUsualRampRad.
void complete(model::Cutter& c, const std::vector<model::Cutter>& generic);

using model::borrowed;

/// How `sources` begins of a field that reading or `complete` fills in (a generic cutter's id follows
/// kAsGeneric). The own format writes no such field.
using model::kAsGeneric;
inline constexpr std::string_view kNotStated = "default: not stated";  ///< what is taken then may follow
inline constexpr std::string_view kRampUnstated = "default: 3 degrees, unsourced";
inline constexpr std::string_view kSubstrateUnstated = "default: the slower one";

/// Text in the source of a generic preset whose speed is that of a coated edge. A cutter that is not stated
/// to be coated takes the material's own speed.
inline constexpr std::string_view kCoated = "(coated";

/// The entry of a field in `sources`, or null.
[[nodiscard]] const std::string* source_of(const model::Cutter& c, std::string_view field);

}  // namespace capstan::tooling
