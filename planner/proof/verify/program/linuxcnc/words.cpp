#include "planner/proof/verify/program/linuxcnc/words.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::verify::linuxcnc {
namespace {

char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

/// A number as RS274 writes it: sign, digits, point; no exponent. Spaces inside were taken out before.
std::size_t number_length(std::string_view t) {
  std::size_t i = 0;
  if (i < t.size() && (t[i] == '+' || t[i] == '-')) ++i;
  while (i < t.size() && ((t[i] >= '0' && t[i] <= '9') || t[i] == '.')) ++i;
  return i;
}

/// The length of "E9" or "E-9" at the beginning of what follows a number: what other languages call its
/// exponent; 0: none stands there.
std::size_t exponent_length(std::string_view t) {
  if (t.empty() || t.front() != 'E') return 0;
  std::size_t i = 1;
  if (i < t.size() && (t[i] == '+' || t[i] == '-')) ++i;
  const std::size_t sign = i;
  while (i < t.size() && t[i] >= '0' && t[i] <= '9') ++i;
  return i == sign ? 0 : i;
}

/// Whether the line has these characters without a space between them: "P1 E2" is two words.
bool stands_together(std::string_view line, std::string_view capitals) {
  return std::search(line.begin(), line.end(), capitals.begin(), capitals.end(),
                     [](char a, char b) { return upper(a) == b; }) != line.end();
}

/// "F1E9: ...; write F1000000000".
std::string no_exponents(char letter, std::string_view number) {
  std::string out = letter + std::string(number) +
                    ": a number of an NC program has a sign, digits and a point, and no exponent (E); write ";
  if (!number.empty() && number.front() == '+') number.remove_prefix(1);
  const auto value = parse_double(number);
  const bool short_enough = value && std::abs(*value) < 1e12;
  return out + (short_enough ? letter + trimmed(*value, 9) : "all its digits");
}

/// The command that a comment is to LinuxCNC 2.9, in capitals; empty: it is words for people
/// (interp_convert.cc, convert_comment; emccanon.cc, COMMENT). Messages (MSG, DEBUG, PRINT, LOG, LOGCLOSE,
/// PROBECLOSE) change nothing.
std::string command_in(std::string_view comment) {
  const std::size_t begin = comment.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  std::string name(comment.substr(begin, comment.find(',', begin) - begin));
  for (char& c : name) c = upper(c);
  const bool comma = comment.find(',', begin) != std::string_view::npos;
  for (const char* takes_text : {"ABORT", "LOGOPEN", "LOGAPPEND", "PY", "PYRUN"}) {
    if (comma && name == takes_text) return name;
  }
  if (name == "PYRELOAD") return name;
  return name.starts_with("PROBEOPEN ") ? "PROBEOPEN" : "";
}

/// Takes comments out and spaces away; gives false when a parenthesis stays open.
bool strip(std::string_view text, std::string& code, Line& out) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ';') {
      out.semicolon = true;
      out.comments.emplace_back(text.substr(i + 1));
      // Behind a semicolon Python alone is more than words.
      if (const std::string command = command_in(out.comments.back()); command == "PY") out.command = command;
      return true;
    }
    if (c == '(') {
      const std::size_t end = text.find(')', i);
      if (end == std::string_view::npos) return false;
      if (text.substr(i + 1, end - i - 1).find('(') != std::string_view::npos) {
        out.fault = "a comment in a comment";
        return true;
      }
      out.comments.emplace_back(text.substr(i + 1, end - i - 1));
      out.command = command_in(out.comments.back());  // LinuxCNC carries out the last one of a line
      i = end;
      continue;
    }
    if (c != ' ' && c != '\t' && c != '\r') code.push_back(upper(c));
  }
  return true;
}

}  // namespace

void split_line(std::string_view text, Line& out) {
  out.words.clear();
  out.comments.clear();
  out.command.clear();
  out.percent = out.deleted = out.semicolon = out.unverifiable = out.no_number = false;
  out.fault.clear();
  std::string code;
  if (!strip(text, code, out)) {
    out.fault = "a comment is not closed";
    return;
  }
  if (!out.fault.empty()) return;
  std::string_view rest = code;
  if (!rest.empty() && rest.front() == '%') {
    out.percent = true;
    if (rest.size() > 1) out.fault = "text after %";
    return;
  }
  if (!rest.empty() && rest.front() == '/') {
    out.deleted = true;
    rest.remove_prefix(1);
  }
  while (!rest.empty()) {
    const char letter = rest.front();
    if (letter == 'O' || letter == '#' || letter == '[') {
      out.unverifiable = true;
      out.fault = std::string("'") + letter + "': O-words, parameters and expressions are not followed";
      return;
    }
    if (letter < 'A' || letter > 'Z') {
      out.fault = std::string("'") + letter + "' is not a word";
      return;
    }
    rest.remove_prefix(1);
    if (!rest.empty() && (rest.front() == '#' || rest.front() == '[')) {
      out.unverifiable = true;
      out.fault = std::string(1, letter) + " has a parameter or an expression, which is not followed";
      return;
    }
    const std::size_t n = number_length(rest);
    std::string_view digits = rest.substr(0, n);
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    const auto value = parse_double(digits);
    if (!value || !std::isfinite(*value)) {
      out.no_number = true;
      out.fault = std::string(1, letter) + " is not followed by a finite number (\"" +
                  std::string(rest.substr(0, 12)) + "\")";
      return;
    }
    const std::string_view number = rest.substr(0, n + exponent_length(rest.substr(n)));
    if (number.size() > n && stands_together(text, letter + std::string(number))) {
      out.no_number = true;
      out.fault = no_exponents(letter, number);
      return;
    }
    out.words.push_back({letter, *value});
    rest.remove_prefix(n);
  }
}

}  // namespace capstan::verify::linuxcnc
