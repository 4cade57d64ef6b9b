#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::kept {

/// What one piece of work costs.
struct Cost {
  std::string row;
  std::optional<double> time;  ///< CPU time in units of the reference kernel (measure.h)
  std::optional<double> instructions_1e6;

  bool operator==(const Cost&) const = default;
};

/// By how much a row's time may exceed the table's. Default, unsourced: twice what repeated runs on a shared
/// machine differ by.
inline constexpr double kTimeLimit = 0.20;
/// The same of instructions. Default, unsourced: counts of the same binary differ by less than 0.1 %, those
/// of one more core by some 2 %; the rest is for changes that are worth what they cost.
inline constexpr double kInstructionLimit = 0.10;

/// The table, and where it was taken: a processor as Linux names it, and what counted (measure.h: counter).
struct Table {
  std::string processor, counter;
  std::vector<Cost> costs;

  bool operator==(const Table&) const = default;
};

/// The processor of this machine, as Linux names it. Ratios differ from one to another, so that a table's
/// times hold for its own.
[[nodiscard]] std::string processor();

/// The table's text: where it was taken, and a line `row  time  instructions` each ("-": not measured),
/// comments from `#` on.
[[nodiscard]] std::string write(const Table& table);
/// Fails  KEPT-TABLE with the line.
[[nodiscard]] Result<Table> read(std::string_view text, const std::string& name);

/// The row's fault, ready to be printed, or nothing: what was measured exceeds the table by more than the
/// limit, or the table has no such row. Instructions decide where both have them, else times.
[[nodiscard]] std::optional<std::string> fault(const Cost& measured, const std::vector<Cost>& table);

/// The rows that were measured and have nothing in the table to be held against.
[[nodiscard]] std::vector<std::string> not_judged(const std::vector<Cost>& measured,
                                                  const std::vector<Cost>& table);

}  // namespace capstan::kept
