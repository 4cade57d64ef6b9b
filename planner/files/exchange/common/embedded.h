#pragma once

#include <span>
#include <string_view>

namespace capstan::exchange {

/// The tables (*.table, *.map) of this room, compiled in; the name is the path below planner/files/exchange,
/// such as "express/ap238.table". data() is null when there is no such file.
[[nodiscard]] std::string_view embedded_file(std::string_view name);
[[nodiscard]] std::span<const std::string_view> embedded_names();

}  // namespace capstan::exchange
