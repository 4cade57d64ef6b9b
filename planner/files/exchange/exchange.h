#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/files/p21/file.h"
#include "planner/files/p21/parse.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

struct ReadOptions {
  p21::Limits limits;  ///< what a file may cost
  /// One wrong reference keeps the whole file from being read. Otherwise that attribute is unset, which is an
  /// error in the job, and what needs it is not planned (planner/model/plan/unreadable.h).
  bool strict = true;
};

/// Reads a part or a plan, told by its content and not by its name: ISO 14649 or ISO 10303-238 (Part 21), or
/// STL, which gives a plan with a target mesh and one region to machine.
///
/// Fails  FILE-READ, P21-… (not a Part 21 file), EXC-… (not a plan), EXC-UNKNOWN-FORMAT for anything else,
///        EXC-UNSUPPORTED for Part 21 files of other schemas; each fault went to `job` before.
[[nodiscard]] Result<model::Plan> read(const std::string& path, Job& job);
[[nodiscard]] Result<model::Plan> read(const std::string& path, const ReadOptions& options, Job& job);
/// As above, from bytes; `name` is what diagnostics call the file.
[[nodiscard]] Result<model::Plan> read_bytes(std::string bytes, const std::string& name,
                                             const ReadOptions& options, Job& job);

/// Reads an ISO 14649 plan. Instances that no noun describes are kept verbatim and stay connected.
///
/// Numbers   are converted to the model's units; deviations of real files (revolutions per minute, radians,
///           ...) are recognised and reported, see iso14649/deviations.h.
/// Open      `$` in its_tool, its_technology, its_operation, and a technology without feed or speed, is
///           open in the plan's ledger.
/// Fails     with one summary, after each fault went to `job`: EXC-REFERENCE, EXC-PARAMETERS, EXC-VALUE,
///           EXC-CYCLE, EXC-GEOMETRY. Faults of what the project does not reach are warnings. `strict` as in
///           ReadOptions.
/// Source    ISO 14649-10, -11, -111 at the published and at the 2001 draft level.
[[nodiscard]] Result<model::Plan> read_iso14649(const p21::File& file, Job& job, bool strict = true);

/// What was written, and what could not be.
struct Written {
  std::string bytes;
  std::vector<std::string> losses;  ///< sentences; empty when the file holds all of the plan
};

/// Writes the plan as ISO 14649 at the published level, by instance number; numbers of objects that came
/// from a file are kept. Who bound what goes into user-defined header entities, see the room's README.
[[nodiscard]] Result<Written> write_iso14649(const model::Plan& plan, Job& job);

/// Reads an ISO 10303-238 plan (AIM; editions 1 to 4) by the tables of ap238/mapping. What they do not
/// explain is kept verbatim and stays connected.
///
/// Numbers   are converted from the file's units, which may differ from one to the next.
/// Fails     with one summary, after each fault went to `job`.
[[nodiscard]] Result<model::Plan> read_ap238(const p21::File& file, Job& job, bool strict = true);

/// Writes the plan as ISO 10303-238, edition 3 with what edition 4 adds where the plan has it.
[[nodiscard]] Result<Written> write_ap238(const model::Plan& plan, Job& job);

}  // namespace capstan::exchange
