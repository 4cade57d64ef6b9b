#pragma once

#include <string>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

enum class Content : std::uint8_t { kPlanJson, kPart, kProgram, kToolTable };

/// What the bytes are: JSON by its first character, Part 21 and STL as `exchange` tells them, a LinuxCNC tool
/// table by its lines (`T1 P1 ...`), anything else a program.
[[nodiscard]] Content content_of(std::string_view bytes);

/// A part or a plan from a file, told by its content.
/// Fails  FILE-READ, and as json::read_json and exchange::read; faults went to the job before.
[[nodiscard]] Result<model::Plan> load_plan(const std::string& path, Job& job, bool strict = false);
[[nodiscard]] Result<model::Plan> plan_of_bytes(std::string bytes, const std::string& path, Job& job,
                                                bool strict = false);

}  // namespace capstan::app
