#pragma once

#include <span>
#include <string>

#include "casebase/report/summary.h"

namespace capstan::casebase::report {

/// A picture (SVG). First what was observed over what was predicted by workingstep: a panel per quantity, a
/// row per group, a point per case, a bar at the geometric mean. Then what was observed, by workingstep, tool
/// and feature: a panel per column of the report, a row per group, a line over its range, thick for one
/// standard deviation to both sides, a bar at the mean. Groups without any such case are left out; a picture
/// of none says so.
[[nodiscard]] std::string picture_of(const std::string& title, std::span<const Group> workingsteps,
                                     std::span<const Group> tools, std::span<const Group> features);

}  // namespace capstan::casebase::report
