#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tooling/shop/data/tree.h"

namespace capstan::tooling {

/// A file of tooling/data as compiled in, by its path there ("materials.yaml"); data() is null when there is
/// no such file.
[[nodiscard]] std::string_view embedded_file(std::string_view name);
[[nodiscard]] std::span<const std::string_view> embedded_names();
/// What stands in it, packed while building.
[[nodiscard]] std::string_view embedded_tree(std::string_view name);

/// The text of a data file: $CAPSTAN_DATA/tooling/data/<name> when that variable is set and the file is
/// there, else the one compiled in; empty when there is neither.
[[nodiscard]] std::string shipped_text(std::string_view name);
/// What stands in that text; what is compiled in is copied, not parsed.
/// Fails  as `parse_tree`, for a file of $CAPSTAN_DATA.
[[nodiscard]] Result<Node> shipped_tree(std::string_view name);

}  // namespace capstan::tooling
