#pragma once

#include <string_view>

namespace capstan::app {

/// What the help of a command shows as examples, a line each; `called`: "capstan tools list". Empty: there is
/// no such command.
[[nodiscard]] std::string_view examples_of(std::string_view called);

}  // namespace capstan::app
