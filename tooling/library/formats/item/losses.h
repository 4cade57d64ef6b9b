#pragma once

#include <string>
#include <vector>

#include "tooling/library/records/records.h"

namespace capstan::tooling {

/// One line of a report for people: "6 mm ball, LCF: the shape Ballend has no parameter for it".
[[nodiscard]] std::string line_text(const LossReport::Line& line);

/// The lines for people, alike ones together: tools that lose the same field for the same reason are counted,
/// fields that the same tools lose for the same reason stand in one line ("18 tools, LPR, HAND: the shape
/// Ballend has no parameter for it"). Symbols of ISO 13399 and ours come first, then names of ours, then the
/// other system's own paths ("post-process.length-offset"), last its bookkeeping ("presets.0.guid"). Else in
/// the order of the report.
[[nodiscard]] std::vector<std::string> lines_together(const std::vector<LossReport::Line>& lines);

}  // namespace capstan::tooling
