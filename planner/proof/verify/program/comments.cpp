#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"

// What a program's comments say of itself, and the names of work offsets.

namespace capstan::verify {
namespace {

constexpr std::size_t kMostInHeader = 100000;
constexpr std::size_t kLongestTold = 1000;  // characters; no control takes lines as long

/// `name="value"` or `name=value` in a marker, values percent-encoded.
std::string field(const std::string& text, const std::string& name) {
  std::size_t at = text.find(" " + name + "=");
  if (at == std::string::npos) return {};
  at += name.size() + 2;
  const bool quoted = at < text.size() && text[at] == '"';
  const std::size_t end = quoted ? text.find('"', at + 1) : text.find(' ', at);
  const std::string raw = quoted ? text.substr(at + 1, end == std::string::npos ? end : end - at - 1)
                                 : text.substr(at, end == std::string::npos ? end : end - at);
  std::string out;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const auto hex = [](char c) {
      if (c >= '0' && c <= '9') return c - '0';
      if (c >= 'a' && c <= 'f') return c - 'a' + 10;
      if (c >= 'A' && c <= 'F') return c - 'A' + 10;
      return -1;
    };
    if (raw[i] == '%' && i + 2 < raw.size() && hex(raw[i + 1]) >= 0 && hex(raw[i + 2]) >= 0) {
      out.push_back(static_cast<char>(hex(raw[i + 1]) * 16 + hex(raw[i + 2])));
      i += 2;
    } else {
      out.push_back(raw[i]);
    }
  }
  return out;
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(v)) return std::nullopt;
  return v;
}

constexpr int kMostNumbered = 1000;  ///< offsets of one name

/// Whether a comment begins with these words, one or two blanks before them allowed.
bool begins(const std::string& text, const char* words) {
  const std::size_t at = text.find(words);
  return at != std::string::npos && at <= 2;
}

/// `MSG, text` in any case of its letters, as LinuxCNC and Mach3 show it.
bool shows(const std::string& text) {
  constexpr std::string_view kShows = "MSG";
  std::size_t at = std::min(text.find_first_not_of(" \t"), text.size());
  for (const char c : kShows) {
    if (at >= text.size() || (text[at] != c && text[at] != c - 'A' + 'a')) return false;
    ++at;
  }
  at = std::min(text.find_first_not_of(" \t", at), text.size());
  return at < text.size() && text[at] == ',';
}

}  // namespace

int offset_code(std::string_view name) {
  for (const DialectReader& reader : readers()) {
    const std::string_view prefix = reader.numbered_name;
    if (prefix.empty() || !name.starts_with(prefix)) continue;
    const auto n = number(std::string(name.substr(prefix.size())));
    return n && *n >= 1.0 && *n < kMostNumbered && *n == std::floor(*n)
               ? reader.numbered_code + static_cast<int>(*n)
               : 0;
  }
  static constexpr std::string_view kDigits = "0123456789";
  if (name.size() == 4 && name.starts_with("G5")) {  // Siemens: G505 to G599
    const auto code = number(std::string(name.substr(1)));
    return code && *code >= 505.0 && *code <= 599.0 && *code == std::floor(*code)
               ? 10 * static_cast<int>(*code)
               : 0;
  }
  if (!name.starts_with("G5") || name.size() < 3 || name[2] < '4' || name[2] > '9') return 0;
  const int whole = 500 + 10 * (name[2] - '0');
  if (name.size() == 3) return whole;
  const bool tenth = name.size() == 5 && name[3] == '.' && kDigits.find(name[4]) != std::string_view::npos;
  return tenth ? whole + (name[4] - '0') : 0;
}

std::string offset_name(int code) {
  if (code == 0) return "no work offset";
  for (const DialectReader& reader : readers()) {
    const int first = reader.numbered_code;
    if (first > 0 && code > first && code < first + kMostNumbered)
      return std::string(reader.numbered_name) + std::to_string(code - first);
  }
  return "G" + std::to_string(code / 10) + (code % 10 != 0 ? "." + std::to_string(code % 10) : "");
}

void keep_told(std::string_view text, long line, bool shown, Program& out) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (out.told.size() < kMostInHeader)
    out.told.push_back({line, std::string(text.substr(0, kLongestTold)), shown});
}

bool read_comment(const std::string& text, long line, Program& out) {
  const auto whole_number = [&](const char* name) {
    return std::strtol(field(text, name).c_str(), nullptr, 10);
  };
  if (begins(text, "CAPSTAN STEP ")) {
    out.markers.push_back({field(text, "id"), whole_number("n"), line, whole_number("setup"),
                           whole_number("tool"), !field(text, "condemned").empty()});
    return true;
  }
  if (begins(text, "CAPSTAN SETUP ") && out.setups.size() < kMostInHeader) {
    out.setups.push_back(
        {whole_number("n"), offset_code(field(text, "offset")), number(field(text, "security")), line});
  } else if (begins(text, "CAPSTAN TOOL T") && out.tools.size() < kMostInHeader) {
    const long t = std::strtol(text.c_str() + text.find("TOOL T") + 6, nullptr, 10);
    if (t <= 0 || t >= 1000000000) return false;
    out.tools.push_back({static_cast<int>(t), number(field(text, "length")), number(field(text, "diameter")),
                         line, field(text, "id"), text.substr(text.rfind(' ') + 1)});
  } else {
    if (out.stock.empty() && begins(text, "stock: ")) out.stock = text.substr(text.find("stock: ") + 7, 100);
    const bool shown = shows(text);
    keep_told(shown ? std::string_view(text).substr(text.find(',') + 1) : text, line, shown, out);
  }
  return false;
}

}  // namespace capstan::verify
