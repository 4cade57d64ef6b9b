#pragma once

#include <cstddef>
#include <string>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::json {

/// Version of the plan's JSON form; a reader takes this one only.
inline constexpr int kPlanJsonVersion = 1;

/// What a plan's JSON may be written without.
struct Without {
  /// The columns of cross sections: steps keep their "peak". The plan that is read back
  /// has none, else it is the same.
  bool sections = false;
};

/// The plan without the cross sections along its paths; all else is as it was.
[[nodiscard]] model::Plan without_sections(model::Plan plan);

/// The whole plan as JSON (UTF-8): nothing of it is lost, `read_json` gives the same plan back.
///
///   objects     every application object by kind; "round_hole:3" is the third of kind round_hole. Only
///   attributes
///               that have a value; "@instance", "@line" say where it stood in its file.
///   steps       in the order of execution, with tool, times, loads; "id", "tool_number", "operation",
///               "feature", "peak" and what lies beside its moves ("link_s", "tool_change_s", "spindle_s")
///               are derived, as the top's "summary" is; on reading they are only compared
///   decisions   who bound what and why ("reasons"), what it depends on, what was rejected; "value_hash" is
///               of the value as it was written: one that is unlike it was edited
///               (model/plan/decision/edited.h)
///   paths, schedules, sections   columns, shared by reference ("path:1")
///
///   seals       a hash of each part, by which the reader tells what was edited since
///
/// Units  the model's: mm, rad, mm/min, 1/min, s, N/mm2; ratios as fractions of one. The schema names each.
/// Text   bytes that are not UTF-8 are written as characters of a private plane, and come back as they were.
/// Needs  finite numbers. Throws std::logic_error otherwise.
/// Cost   linear.
[[nodiscard]] std::string write_json(const model::Plan& plan, const Without& without = {});

/// Reads the output of `write_json`. Notes EXC-EDITED for decided values that were edited since, and warns
/// JSON-EDITED, naming the edited parts.
///
/// Fails  JSON-SIZE past `cap` bytes, JSON-DEPTH past 32 levels, JSON-SYNTAX with the line, JSON-VERSION,
///        JSON-VALUE naming the place (/objects/round_hole/3/depth) and what was expected there.
[[nodiscard]] Result<model::Plan> read_json(std::string bytes, std::string file_name, Job& job,
                                            std::size_t cap = std::size_t{1} << 30);

/// The JSON Schema (draft-07) of the plan, from the descriptor table; docs/plan.schema.json is this text.
[[nodiscard]] std::string json_schema();

}  // namespace capstan::json
