#pragma once

#include <span>
#include <string>

#include "casebase/report/summary.h"

namespace capstan::casebase::report {

/// A picture (SVG) of what was observed over what was predicted: a panel per quantity, a row per group, a
/// point per case, a bar at the geometric mean. Groups without any such case are left out; a picture of none
/// says so.
[[nodiscard]] std::string picture_of(const std::string& title, std::span<const Group> groups);

}  // namespace capstan::casebase::report
