#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "planner/door/app/command/session.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/planning.h"

namespace capstan::app {

/// What plan and bind have in common at their end: makes the outputs, checks their programs, and writes. A
/// program that the check condemns (model::condemned) is not written, nor its tool table, unless
/// `--allow-findings`; a program of that name from before is put aside, so that nobody takes it for the new
/// one. Gives the exit code.
///
/// `began`  bind: when the caller began to wait; checking and writing take their time of the deadline, too.
[[nodiscard]] int finish(Session& s, const service::Planned& planned, std::vector<service::Output> outputs,
                         std::optional<std::chrono::steady_clock::time_point> began = std::nullopt);

/// Puts programs from before aside whose names were asked for, where none is written now: whatever ended the
/// run, once its command line was understood.
void put_programs_aside(const std::vector<service::Output>& outputs, Job& job);

/// Whether a program is asked for.
[[nodiscard]] bool makes_program(const std::vector<service::Output>& outputs);

}  // namespace capstan::app
