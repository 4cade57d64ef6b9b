#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "planner/door/app/command/session.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/planning.h"

namespace capstan::app {

/// The common end of plan and bind: makes the outputs, checks their programs, and writes. A program that the
/// check condemns (model::condemned) is not written, nor its tool table, unless `--allow-findings`. An older
/// program of that name is renamed, so that nobody takes it for the new one. Returns the exit code.
///
/// `began`  bind: when the caller began to wait; checking and writing take their time of the deadline, too.
[[nodiscard]] int finish(Session& s, const service::Planned& planned, std::vector<service::Output> outputs,
                         std::optional<std::chrono::steady_clock::time_point> began = std::nullopt);

/// Renames older programs whose names were requested, if none is written now, whatever ended the run after
/// its command line was understood.
void put_programs_aside(const std::vector<service::Output>& outputs, Job& job);

/// True if a program is among the outputs.
[[nodiscard]] bool makes_program(const std::vector<service::Output>& outputs);

}  // namespace capstan::app
