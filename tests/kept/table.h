#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::kept {

/// What one piece of work costs, in units of the reference kernel (measure.h), so that the machine's speed
/// cancels.
struct Cost {
  std::string row;
  double time = 0.0;                   ///< CPU time over that of the kernel
  std::optional<double> instructions;  ///< the same in instructions; nothing where they cannot be counted

  bool operator==(const Cost&) const = default;
};

/// By how much a row may cost more than the table says. Default, unsourced: twice what repeated runs on a
/// shared machine differ by.
inline constexpr double kLimit = 0.20;

/// The processor of this machine, as Linux names it. Ratios differ from one to another, so that a table holds
/// for its own.
[[nodiscard]] std::string processor();
/// The processor that a table was taken on; empty where it does not say.
[[nodiscard]] std::string processor_of(std::string_view text);

/// The table's text: the processor, and a line `row  time  instructions` each ("-": not counted), comments
/// from `#` on.
[[nodiscard]] std::string write(const std::vector<Cost>& costs);
/// Fails  KEPT-TABLE with the line.
[[nodiscard]] Result<std::vector<Cost>> read(std::string_view text, const std::string& name);

/// The row's fault, ready to be printed, or nothing: what was measured exceeds the table by more than the
/// limit, or the table has no such row. Instructions decide where both have them, else times.
[[nodiscard]] std::optional<std::string> fault(const Cost& measured, const std::vector<Cost>& table,
                                               double limit = kLimit);

}  // namespace capstan::kept
