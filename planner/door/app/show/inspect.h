#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

/// Summary of a file: project, workpiece, features, steps, counts by kind, unhandled entities, deviations
/// from the standard. `diagnostics` are those of reading it.
[[nodiscard]] std::string inspect(const model::Plan& plan, const std::vector<Diagnostic>& diagnostics);

/// The value at a path (see query.h): a value in a line, an object with its attributes, a list with an item
/// per line, results of a search with the path of each. A trailing `#size` counts the items of each list that
/// the path leads to, else the places. Fails  INS-PATH.
[[nodiscard]] Result<std::string> inspect(const model::Plan& plan, std::string_view path);

/// What reading a file said, a line each, under a heading; empty where it said nothing.
[[nodiscard]] std::string faults(const std::vector<Diagnostic>& diagnostics);

}  // namespace capstan::app
