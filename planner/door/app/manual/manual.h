#pragma once

#include <string>
#include <vector>

#include "planner/door/app/command/reference.h"

namespace capstan::app {

/// A manual page in man(7)'s macros.
struct ManualPage {
  std::string name;  ///< of the file: capstan.1, capstan-plan.1, ...
  std::string text;
};

/// One page of the whole command and one of each command below it.
[[nodiscard]] std::vector<ManualPage> manual_pages(const CommandText& capstan, const std::string& version);

/// A script that bash reads to complete commands, options and the values that an option lists; other words
/// are completed as file names. Needs nothing but bash.
[[nodiscard]] std::string bash_completion(const CommandText& capstan);

}  // namespace capstan::app
