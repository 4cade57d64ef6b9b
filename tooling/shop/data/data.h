#pragma once

#include <span>
#include <string>
#include <string_view>

namespace capstan::tooling {

/// A file of tooling/data as compiled in, by its path there ("materials.yaml"); data() is null when there is
/// no such file.
[[nodiscard]] std::string_view embedded_file(std::string_view name);
[[nodiscard]] std::span<const std::string_view> embedded_names();

/// The text of a data file: $CAPSTAN_DATA/tooling/data/<name> when that variable is set and the file is
/// there, else the one compiled in; empty when there is neither.
[[nodiscard]] std::string shipped_text(std::string_view name);

}  // namespace capstan::tooling
