#pragma once

#include <string>

namespace capstan::verify {

/// "12.5 mm" and the like, three decimals at most.
[[nodiscard]] std::string mm(double v);
[[nodiscard]] std::string plain(double v);

}  // namespace capstan::verify
