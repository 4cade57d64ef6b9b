#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/edit/edit.h"

// Edits as a file beside the plan (docs/edits.schema.json): what a person decides outlives each planning.
//
//     capstan_edits: 1
//     edits:
//       - set: POCKET*/tool=T5
//       - limit: feed<=2000
//       - forbid: tool=em12*
//       - pin: SLOT rough/tool=em8
//       - order: HOLE<POCKET

namespace capstan::service {

inline constexpr long kEditsVersion = 1;
inline constexpr std::size_t kMostEdits = 10000;

/// The edits of a file, YAML or JSON; each is from "edit N of FILE", counted from 1, the folder left out. All
/// faults are reported, each with its line.
/// Fails  as tooling::parse_tree; EDIT-FILE for another shape or version, and as model::parse_edit.
[[nodiscard]] Result<std::vector<model::Edit>> read_edits(std::string_view text, const std::string& file,
                                                          Job& job);
[[nodiscard]] Result<std::vector<model::Edit>> load_edits(const std::string& file, Job& job);

/// What `read_edits` reads as the same edits, but for where they are from.
[[nodiscard]] std::string edits_text(const std::vector<model::Edit>& edits);

}  // namespace capstan::service
