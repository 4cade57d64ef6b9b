#include "planner/proof/verify/program/linuxcnc/reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

// LinuxCNC takes a line to its first ';', splits it at blanks, and reads from each piece its letter and as
// much of a number as C's scanf finds; what stands behind that number it leaves out without a word. A piece
// that is not all letter and number is therefore a fault here: nobody can have meant what the control reads.

namespace capstan::verify::linuxcnc {

namespace {

int whole(double v) { return v >= 0.0 && v < 1e9 ? static_cast<int>(v) : 1000000000; }

/// Offsets that a tool of three axes, pointing along -Z, does not have.
bool is_other_offset(char c) {
  return c != '\0' && std::string_view("XYABCUVWIJQ").find(c) != std::string_view::npos;
}

/// The piece's number; none when it is not one, or more than one.
std::optional<double> number(std::string_view piece) {
  const std::string digits(piece.substr(1));
  if (digits.empty() || std::isspace(static_cast<unsigned char>(digits.front())) != 0) return std::nullopt;
  char* end = nullptr;
  const double v = std::strtod(digits.c_str(), &end);
  if (*end != '\0' || !std::isfinite(v)) return std::nullopt;
  return v;
}

void take(std::string_view piece, ToolTableEntry& e, std::string& fault) {
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(piece.front())));
  const auto v = number(piece);
  if (!v) {
    fault = "\"" + std::string(piece.substr(0, 40)) +
            "\" is not a letter and its number; LinuxCNC leaves out what it cannot read";
    return;
  }
  if (letter == 'T' || letter == 'P') {
    if (*v != std::floor(*v) || *v < 0.0 || piece.find_first_of(".eExX", 1) != std::string_view::npos)
      fault = "\"" + std::string(piece.substr(0, 40)) + "\" is not a whole number";
    (letter == 'T' ? e.tool : e.pocket) = whole(*v);
    (letter == 'T' ? e.has_tool : e.has_pocket) = true;
  } else if (letter == 'Z') {
    if (e.has_length) fault = "two Z in one line";
    e.length_mm = *v;
    e.has_length = true;
  } else if (letter == 'D') {
    if (e.has_diameter) fault = "two D in one line";
    e.diameter_mm = *v;
    e.has_diameter = true;
  } else if (is_other_offset(letter)) {
    if (*v != 0.0) e.others += (e.others.empty() ? "" : " ") + std::string(piece.substr(0, 40));
  } else {
    fault =
        "\"" + std::string(piece.substr(0, 40)) + "\" is none of the table's words; LinuxCNC drops the line";
  }
}

}  // namespace

ToolTable read_tool_table(std::string_view text) {
  constexpr std::size_t kMostEntries = 100000;
  ToolTable out;
  long number = 0;
  while (!text.empty() && out.entries.size() < kMostEntries) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    line = line.substr(0, line.find(';'));
    ToolTableEntry e;
    e.line = number;
    bool any = false;
    std::string fault;
    while (!line.empty()) {
      const std::size_t begin = line.find_first_not_of(" \r");
      if (begin == std::string_view::npos) break;
      line.remove_prefix(begin);
      const std::size_t length = std::min(line.find_first_of(" \r"), line.size());
      any = true;
      if (fault.empty()) take(line.substr(0, length), e, fault);
      line.remove_prefix(length);
    }
    if (!any) continue;
    if (fault.empty() && !e.has_tool) fault = "no T word";
    if (!fault.empty()) out.faults.push_back("line " + std::to_string(number) + ": " + fault);
    if (e.has_tool) out.entries.push_back(std::move(e));
  }
  return out;
}

}  // namespace capstan::verify::linuxcnc
