#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/app/command/options.h"

namespace capstan::app {

/// Texts as the command line has them, before they mean anything.
struct RawOptions {
  std::string file, diagnostics = "text", progress = "auto";
  std::map<std::string_view, std::string> of;  ///< by the name of the service's option
  std::map<std::string_view, bool> flags;
  std::map<std::string_view, std::vector<std::string>> lists;  ///< of options that may be repeated
};

/// Takes the texts, and what of `out` the command line set itself, for what they mean: into the service's
/// request. Gives the fault of the command line; empty: none.
[[nodiscard]] std::string understand(const RawOptions& raw, Options& out);

}  // namespace capstan::app
