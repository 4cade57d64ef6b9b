#pragma once

#include <string>

namespace capstan::testing {

/// A file or folder of this name in a folder of this process, which is removed when it ends: tests that run
/// at the same time never meet there.
[[nodiscard]] std::string scratch_file(const std::string& name);

}  // namespace capstan::testing
