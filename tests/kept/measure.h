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
  double wall_s = 0.0;
  double peak_mb = 0.0;  ///< of a program, resident; 0 of work in this process
};

/// A piece of work: a program and its arguments, run once in a process of its own. What it does is in `name`.
struct Row {
  std::string name;
  std::vector<std::string> command;
};

/// The fixed work that all rows' times are compared with: square roots of an array, multiplied and added in
/// one chain, and a sort of it. It uses nothing of this program, so that no change of ours makes it faster.
[[nodiscard]] Taken reference_kernel();

/// What `work` takes in this process, user and system.
[[nodiscard]] Taken taken_by(const std::function<void()>& work);
/// The same of a program, its threads and children included. Its output is dropped. Throws std::runtime_error
/// if it ends with a higher status than `most_status` (1: done, with findings).
[[nodiscard]] Taken taken_by(const std::vector<std::string>& command, int most_status = 1);

/// What counts instructions here, with the instruction sets that it offers to programs, for example
/// "valgrind-3.19.0 x86_64 avx2 gcc 12.2.0 -O", and what compiled it. Counts of two machines compare where
/// these texts are equal. Empty where Valgrind is not installed.
[[nodiscard]] std::string counter();
/// The program's instructions in user mode, all threads, in millions, counted by Valgrind (cachegrind without
/// its caches): the same whatever else the machine does. Throws std::runtime_error as taken_by does.
[[nodiscard]] double instructions_1e6(const std::vector<std::string>& command, int most_status = 1);

/// What is measured of a row.
struct What {
  std::size_t repeats = 0;  ///< of times; 0: none are taken
  bool instructions = true;
};

/// The costs of rows. Of times, each repeat runs the kernel before and after each row, and the median of the
/// row's ratios counts, so that neither a burst of other work nor a slow drift of the machine's speed does.
[[nodiscard]] std::vector<Cost> measured(const std::vector<Row>& rows, What what);

/// Measures and compares. A row whose time is beyond the limit is measured again, twice at most, with more
/// repeats: what is slower stays so. Gives what is wrong, and the costs in `costs`.
[[nodiscard]] std::vector<std::string> check(const std::vector<Row>& rows, const std::vector<Cost>& table,
                                             What what, std::vector<Cost>& costs);

}  // namespace capstan::kept
