#pragma once

/// The door for programs that plan with Capstan: link `capstan::capstan`, include this header.
/// It names nothing but the standard library.

#include <string>

namespace capstan {

/// The version of the library that is linked, as "major.minor.patch": what the program got, which need not be
/// what it was compiled against.
[[nodiscard]] std::string version();

}  // namespace capstan
