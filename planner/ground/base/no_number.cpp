#include "planner/ground/base/no_number.h"

#include <charconv>

namespace capstan {

std::string no_number(std::string_view text) {
  constexpr std::size_t kShown = 60;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const std::string out = "'" + std::string(text.substr(0, kShown)) + "' is ";
  if (error != std::errc::result_out_of_range || stop != end) return out + "not a number";
  // What is out of range by its exponent is so by a negative one when it is too small.
  const bool small = text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
  return out + (small ? "nearer to 0 than a number can be (4.9e-324)"
                      : "beyond what a number can be (1.8e308 either way)");
}

}  // namespace capstan
