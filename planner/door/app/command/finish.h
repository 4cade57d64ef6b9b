#pragma once

#include <optional>
#include <vector>

#include "planner/door/app/command/session.h"
#include "planner/door/app/files/outputs.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

/// What plan and bind have in common at their end: makes the outputs, checks the plan and its programs, and
/// writes. A program that the check condemns (model::condemned) is not written, nor its tool table, unless
/// `--allow-findings`; a program of that name from before is put aside, so that nobody takes it for the new
/// one. Gives the exit code.
///
/// known   what the check says of the plan, where it is known already; else the plan is checked here.
using KnownFindings = std::optional<std::vector<model::Finding>>;
[[nodiscard]] int finish(Session& s, const model::Plan& plan, std::vector<Output> outputs,
                         const KnownFindings& known = std::nullopt);

/// Puts programs from before aside whose names were asked for, where none is written now: whatever ended the
/// run, once its command line was understood.
void put_programs_aside(const std::vector<Output>& outputs, Job& job);

/// Whether a program is asked for.
[[nodiscard]] bool makes_program(const std::vector<Output>& outputs);

}  // namespace capstan::app
