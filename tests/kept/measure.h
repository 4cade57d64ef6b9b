#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tests/kept/table.h"

namespace capstan::kept {

/// What some work took: of this process or of a child that it waited for.
struct Taken {
  double cpu_s = 0.0;
  double instructions = 0.0;  ///< 0 where they cannot be counted
};

/// A piece of work. `run` does it once and gives what it took; it throws std::runtime_error if it fails.
struct Row {
  std::string name;
  std::function<Taken()> run;
};

/// The fixed work that all rows are compared with: square roots of an array, multiplied and added in one
/// chain, and a sort of it. It uses nothing of this program, so that no change of ours makes it faster.
[[nodiscard]] Taken reference_kernel();

/// What `work` takes in this process, user and system.
[[nodiscard]] Taken taken_by(const std::function<void()>& work);
/// The same of a program, its threads and children included. Its output is dropped. Throws std::runtime_error
/// if it ends with a higher status than `most_status` (1: done, with findings).
[[nodiscard]] Taken taken_by(const std::vector<std::string>& command, int most_status = 1);

/// Whether instructions can be counted; in a virtual machine often not.
[[nodiscard]] bool instructions_can_be_counted();

/// The costs of rows: each repeat runs the kernel before and after each row, and the median of the row's
/// ratios counts, so that neither a burst of other work nor a slow drift of the machine's speed does.
[[nodiscard]] std::vector<Cost> measured(const std::vector<Row>& rows, std::size_t repeats);

/// Measures and compares. A row beyond the limit is measured again, twice at most, with more repeats: what is
/// slower stays so. Gives what is wrong, and the costs in `costs`.
[[nodiscard]] std::vector<std::string> check(const std::vector<Row>& rows, const std::vector<Cost>& table,
                                             std::size_t repeats, std::vector<Cost>& costs);

}  // namespace capstan::kept
