#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/resources/machine.h"

namespace capstan::verify {

// What a program says of itself, before it is checked.

/// What a program says of the control that it was written for.
struct DialectSign {
  std::vector<std::string_view> dialects;  ///< controls that read it so, as model::Control has them
  std::string text;                        ///< "O0001, a program number"
  long line = 0;                           ///< counted from 1
};

/// The first thing in a program that only some of the known controls read; nothing: any of them may.
///
/// Source  the signs of each control's reader (program/readers.h).
[[nodiscard]] std::optional<DialectSign> dialect_sign(std::string_view program);

/// The machine that a program's header says it is written for, `(machine: generic_vmc)`, as it is written
/// there, in capitals or not; empty: none.
[[nodiscard]] std::string machine_of_program(std::string_view program);

/// The ids of the steps that a program says it has, in its order; empty for one without markers, and for a
/// control that nothing reads.
[[nodiscard]] std::vector<std::string> steps_of_program(std::string_view text, const model::Machine& machine);

}  // namespace capstan::verify
