#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/proposal.h"
#include "tooling/library/nouns/tool_material.h"

namespace capstan::tooling {

/// Whether a tool of a file only says what is wanted: a milling_cutting_tool with a body, without tool_usage,
/// cutting edges or assembly length. A tool that someone has put together has at least one of these. An unset
/// handle counts as a requirement (of nothing in particular).
[[nodiscard]] bool is_requirement(const model::Model& m, model::Ref<model::MachiningTool> tool);

/// A given tool as a cutter.
///
/// When tool_usage names a cutter of `library` (its_library_reference, else its_product) and the sizes agree,
/// that cutter, with the pocket of its_position; sizes that disagree warn TOOL-DIFFERS and the file's hold.
/// Otherwise from the nouns; what they leave out is completed as in complete.h, each field with its source:
///
///     functional length   overall_assembly_length, else tool_offset_length of the first cutting edge
///     stick-out           the same: no holder is described, so all of it counts as slender tool
///     usable length       the stick-out
///     point angle         tool_top_angle, see `point_angle_from`
///     number of teeth     as stated, else as the generic series
///     tool material       its_material of the first cutting edge, else by `hints` (tool_material.h), HSS
///                         without them
///
/// A face mill below 25 mm is taken as an end mill (TOOL-CLASS): no such face mill exists. Tapered kinds
/// without a taper angle are plain tools.
/// Fails  TOOL-NONE unset or no milling tool, TOOL-BODY no body or no dimension, TOOL-VALUE a fault of its
///        values, TOOL-KIND a body that no cutter describes (side mill, woodruff, tapered, user-defined).
[[nodiscard]] Result<model::Cutter> cutter_from_nouns(const model::Model& m,
                                                      model::Ref<model::MachiningTool> tool, Job& job,
                                                      const std::vector<model::Cutter>& library = {},
                                                      const ToolMaterialHints* hints = nullptr);

/// The full point angle that a file's tool_top_angle means, rad. The standard's is half of it; real files
/// hold the complement (31 deg for a 118 deg drill) or the full angle. The reading whose result is a usual
/// point for the class is taken, the standard's first; 0 when none is, or none is stated. `reading`:
/// "stated", or how it was read.
[[nodiscard]] double point_angle_from(double tool_top_angle_rad, model::CutterClass c, std::string& reading);

/// Requirement from a tool of a file. Hole-making tools: its size; mills: at most its diameter, at least half
/// of it. Fails as above.
[[nodiscard]] Result<model::ToolRequirement> requirement_from_nouns(const model::Model& m,
                                                                    model::Ref<model::MachiningTool> tool,
                                                                    Job& job);

/// A cutter as nouns: milling_cutting_tool with body, dimension, one cutting_component and a tool_usage
/// (its_position: the tool number; its_library_reference: the cutter's id; description: its description).
[[nodiscard]] model::Ref<model::MachiningTool> nouns_from_cutter(model::Model& m, const model::Cutter& c);

/// The noun of a cutter that planning chose, made once per model.
[[nodiscard]] model::Ref<model::MachiningTool> tool_noun(model::Model& m, const model::Cutter& c);

/// A requirement as nouns: class and dimensions, nothing else.
[[nodiscard]] model::Ref<model::MachiningTool> nouns_from_requirement(model::Model& m,
                                                                      const model::ToolRequirement& r);

}  // namespace capstan::tooling
