#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"

namespace capstan::service {

/// A program that is to be checked, by its file's name.
struct NamedProgram {
  std::string file;
  std::string_view text;
};

/// The machine that programs are checked for without a plan: what the call names (`stated`), else what the
/// header of the first that names one says, where the shop (`value`) or the planner has it, else the shop's,
/// else the built-in one. Notes by which they are judged and why, where the call does not say it.
[[nodiscard]] std::string machine_for_programs(const std::optional<std::string>& value, bool stated,
                                               const std::vector<NamedProgram>& programs, Job& job);

}  // namespace capstan::service
