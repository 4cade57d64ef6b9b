#include "planner/ground/base/number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace capstan {
namespace {

void need_finite(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a number that is not finite cannot be printed");
}

}  // namespace

std::string shortest(double value) {
  need_finite(value);
  if (value == 0.0) return "0";
  std::array<char, 32> buffer{};
  const auto [end, ec] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string fixed(double value, int decimals) {
  need_finite(value);
  std::array<char, 400> buffer{};
  const auto [end, ec] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  std::string out(buffer.data(), end);
  if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

std::string trimmed(double value, int decimals) {
  std::string out = fixed(value, decimals);
  if (out.find('.') == std::string::npos) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

std::string part21_real(double value) {
  std::string out = shortest(value);
  const auto e = out.find('e');
  const std::string exponent = e == std::string::npos ? "" : "E" + out.substr(e + 1);
  std::string mantissa = out.substr(0, e);
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  return mantissa + exponent;
}

double rounded(double value, int decimals) { return *parse_double(fixed(value, decimals)); }

std::optional<double> parse_double(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double unconverted(double value, double factor) {
  const double raw = value / factor;
  if (!std::isfinite(raw)) return raw;
  std::array<char, 40> buffer{};
  for (int digits = 12; digits <= 17; ++digits) {
    const auto [end, ec] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), raw, std::chars_format::general, digits);
    double candidate = 0.0;
    std::from_chars(buffer.data(), end, candidate);
    if (candidate * factor == value) return candidate;
  }
  return raw;
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  if (n == 0) return "no " + one;
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace capstan
