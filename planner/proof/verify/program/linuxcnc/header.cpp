#include <cmath>
#include <cstdlib>

#include "planner/proof/verify/program/linuxcnc/interpreter.h"

// What a program's comments say of itself: the markers of its steps, its set-ups, tools, raw piece.

namespace capstan::verify {
namespace {

constexpr std::size_t kMostInHeader = 100000;

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

/// Whether a comment begins with these words, one or two blanks before them allowed.
bool begins(const std::string& text, const char* words) {
  const std::size_t at = text.find(words);
  return at != std::string::npos && at <= 2;
}

}  // namespace

int offset_code(std::string_view name) {
  static constexpr std::pair<std::string_view, int> kOffsets[] = {
      {"G54", 540}, {"G55", 550},   {"G56", 560},   {"G57", 570},  {"G58", 580},
      {"G59", 590}, {"G59.1", 591}, {"G59.2", 592}, {"G59.3", 593}};
  for (const auto& [text, code] : kOffsets) {
    if (text == name) return code;
  }
  return 0;
}

std::string offset_name(int code) {
  if (code == 0) return "no work offset";
  return "G" + std::to_string(code / 10) + (code % 10 != 0 ? "." + std::to_string(code % 10) : "");
}

void Interpreter::marker(const std::string& text) {
  const auto whole_number = [&](const char* name) {
    return std::strtol(field(text, name).c_str(), nullptr, 10);
  };
  out_.markers.push_back({field(text, "id"), whole_number("n"), line_, whole_number("setup"),
                          whole_number("tool"), !field(text, "condemned").empty()});
  marker_ = static_cast<int>(out_.markers.size()) - 1;
  stated_ = 0;
}

void Interpreter::comment(const std::string& text) {
  if (begins(text, "CAPSTAN STEP ")) {
    marker(text);
  } else if (begins(text, "CAPSTAN SETUP ") && out_.setups.size() < kMostInHeader) {
    out_.setups.push_back({std::strtol(field(text, "n").c_str(), nullptr, 10),
                           offset_code(field(text, "offset")), number(field(text, "security")), line_});
  } else if (begins(text, "CAPSTAN TOOL T") && out_.tools.size() < kMostInHeader) {
    const long t = std::strtol(text.c_str() + text.find("TOOL T") + 6, nullptr, 10);
    if (t <= 0 || t >= 1000000000) return;
    out_.tools.push_back({static_cast<int>(t), number(field(text, "length")), number(field(text, "diameter")),
                          line_, field(text, "id"), text.substr(text.rfind(' ') + 1)});
  } else if (out_.stock.empty() && begins(text, "stock: ")) {
    out_.stock = text.substr(text.find("stock: ") + 7, 100);
  }
}

void Interpreter::command(const std::string& name) {
  if (name.empty()) return;
  const std::string what = name == "ABORT"           ? "ends the program here"
                           : name.starts_with("PY")  ? "runs Python, which is not followed"
                           : name.starts_with("LOG") ? "writes into a file of the control"
                                                     : "opens a file of the control for probed points";
  fault(33, "CHK-COMMENT",
        "the comment (" + name + ",...) is a command to LinuxCNC: it " + what + "; take it out");
}

}  // namespace capstan::verify
