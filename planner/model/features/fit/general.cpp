#include "planner/model/features/fit/general.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <span>

#include "planner/ground/base/number.h"

namespace capstan::model {
namespace {

constexpr double kNone = 0.0;  // the standard states no value
constexpr double kMostByValue = 10.0;
constexpr double kLeastSize = 0.5;  // mm; below, deviations stand beside the size

// One row per class; a range ends with, and includes, its upper limit.
constexpr std::array<double, 8> kSizes{3, 6, 30, 120, 400, 1000, 2000, 4000};
constexpr std::array<std::array<double, 8>, 4> kSize{{
    {0.05, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, kNone},  // f
    {0.1, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2},         // m
    {0.2, 0.3, 0.5, 0.8, 1.2, 2, 3, 4},             // c
    {kNone, 0.5, 1, 1.5, 2.5, 4, 6, 8},             // v
}};
constexpr std::array<double, 6> kLengths{10, 30, 100, 300, 1000, 3000};
constexpr std::array<std::array<double, 6>, 3> kFlatness{{
    {0.02, 0.05, 0.1, 0.2, 0.3, 0.4},  // H
    {0.05, 0.1, 0.2, 0.4, 0.6, 0.8},   // K
    {0.1, 0.2, 0.4, 0.8, 1.2, 1.6},    // L
}};
constexpr std::array<double, 4> kWide{100, 300, 1000, 3000};
constexpr std::array<std::array<double, 4>, 3> kPerpendicularity{
    {{0.2, 0.3, 0.4, 0.5}, {0.4, 0.6, 0.8, 1}, {0.6, 1, 1.5, 2}}};
constexpr std::string_view kSizeClasses = "fmcv";
constexpr std::string_view kGeometryClasses = "HKL";

std::optional<double> look_up(std::span<const double> limits, std::span<const double> values, double at) {
  if (!(at > 0.0)) return std::nullopt;
  const auto it = std::lower_bound(limits.begin(), limits.end(), at);
  if (it == limits.end()) return std::nullopt;
  const double v = values[static_cast<std::size_t>(it - limits.begin())];
  return v == kNone ? std::nullopt : std::optional<double>(v);
}

tl::unexpected<Diagnostic> bad(std::string_view text) {
  return fail({.code = "MDL-GENERAL",
               .message = "'" + std::string(text) + "' is no general tolerance that is understood",
               .expected = "ISO 2768-m, ISO 2768-mK (f, m, c, v; H, K, L), ISO 22081 0.2, or +-0.1"});
}

/// Blanks out; "±" and "+/-" as "+-"; a decimal comma as a point.
std::string normal(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (std::isspace(c) != 0) continue;
    if (text.substr(i, 2) == "\xc2\xb1") {
      out += "+-";
      ++i;
    } else if (text.substr(i, 3) == "+/-") {
      out += "+-";
      i += 2;
    } else {
      out += c == ',' ? '.' : static_cast<char>(c);
    }
  }
  return out;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (text.size() < prefix.size()) return false;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (std::toupper(static_cast<unsigned char>(text[i])) != prefix[i]) return false;
  }
  text.remove_prefix(prefix.size());
  return true;
}

void take_year(std::string_view& text) {
  if (text.size() >= 5 && text.front() == ':' &&
      std::all_of(text.begin() + 1, text.begin() + 5, [](char c) { return c >= '0' && c <= '9'; }))
    text.remove_prefix(5);
}

std::optional<double> value(std::string_view text) {
  if (text.ends_with("mm")) text.remove_suffix(2);
  if (text.empty() || text.front() < '.' || text.front() > '9') return std::nullopt;
  double v = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), v, std::chars_format::fixed);
  if (error != std::errc{} || end != text.data() + text.size() || !(v > 0.0) || v > kMostByValue)
    return std::nullopt;
  return v;
}

bool by_class(std::string_view rest, GeneralTolerance& g) {
  // "2768-m", "2768-mK", "2768-1-m" (the part named), "2768m".
  if (rest.starts_with("-1-") || rest.starts_with("-1:")) rest.remove_prefix(2);
  take_year(rest);
  if (rest.starts_with("-")) rest.remove_prefix(1);
  if (rest.empty() || rest.size() > 2) return false;
  if (kSizeClasses.find(rest.front()) != std::string_view::npos) {
    g.size_class = rest.front();
    rest.remove_prefix(1);
  }
  if (!rest.empty() && kGeometryClasses.find(rest.front()) != std::string_view::npos) {
    g.geometry_class = rest.front();
    rest.remove_prefix(1);
  }
  return rest.empty();
}

}  // namespace

Result<GeneralTolerance> parse_general(std::string_view text) {
  const std::string plain = normal(text);
  std::string_view rest = plain;
  GeneralTolerance g;
  (void)take(rest, "DIN");
  const bool iso = take(rest, "ISO");
  if (iso && take(rest, "2768")) {
    if (!by_class(rest, g)) return bad(text);
    g.text = "ISO 2768-";
    if (g.size_class != 0) g.text += g.size_class;
    if (g.geometry_class != 0) g.text += g.geometry_class;
    return g;
  }
  if (iso && take(rest, "22081")) {
    take_year(rest);
    const bool size = take(rest, "+-");
    const auto v = value(rest);
    if (!v) return bad(text);
    (size ? g.size_mm : g.profile_mm) = v;
    g.text = std::string("ISO 22081 ") + (size ? "+-" : "") + trimmed(*v, 6);
    return g;
  }
  if (!iso && rest.size() == plain.size() && take(rest, "+-")) {
    const auto v = value(rest);
    if (!v) return bad(text);
    g.size_mm = v;
    g.text = "+-" + trimmed(*v, 6);
    return g;
  }
  return bad(text);
}

std::optional<double> general_size(const GeneralTolerance& g, double nominal_mm) {
  if (g.size_mm) return g.size_mm;
  if (g.profile_mm) return 0.5 * *g.profile_mm;
  const auto row = kSizeClasses.find(g.size_class);
  if (g.size_class == 0 || row == std::string_view::npos || nominal_mm < kLeastSize) return std::nullopt;
  return look_up(kSizes, kSize[row], nominal_mm);
}

std::optional<double> general_flatness(const GeneralTolerance& g, double length_mm) {
  if (g.profile_mm) return g.profile_mm;
  const auto row = kGeometryClasses.find(g.geometry_class);
  if (g.geometry_class == 0 || row == std::string_view::npos) return std::nullopt;
  return look_up(kLengths, kFlatness[row], length_mm);
}

std::optional<double> general_perpendicularity(const GeneralTolerance& g, double shorter_mm) {
  if (g.profile_mm) return g.profile_mm;
  const auto row = kGeometryClasses.find(g.geometry_class);
  if (g.geometry_class == 0 || row == std::string_view::npos) return std::nullopt;
  return look_up(kWide, kPerpendicularity[row], shorter_mm);
}

}  // namespace capstan::model
