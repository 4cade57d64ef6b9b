#include "casebase/retain/program_marks.h"

#include <algorithm>
#include <charconv>

namespace capstan::casebase::retain {
namespace {

constexpr std::string_view kMarker = "CAPSTAN STEP id=\"";
constexpr std::string_view kTool = " tool=", kPlace = " n=";

// The number behind a word of a marker; 0 where it is not there.
template <class Whole>
Whole number_of(std::string_view marker, std::string_view word) {
  Whole out = 0;
  const auto at = marker.find(word);
  if (at == std::string_view::npos) return out;
  const std::string_view digits = marker.substr(at + word.size());
  std::from_chars(digits.data(), digits.data() + digits.size(), out);
  return out;
}

// Markers write characters that a comment cannot hold as %XX.
std::string plain(std::string_view id) {
  std::string out;
  for (std::size_t i = 0; i < id.size(); ++i) {
    unsigned code = 0;
    const char* const end = id.data() + i + 3;
    if (id[i] == '%' && i + 2 < id.size() && std::from_chars(end - 2, end, code, 16).ptr == end) {
      out += static_cast<char>(code);
      i += 2;
    } else {
      out += id[i];
    }
  }
  return out;
}

}  // namespace

const ProgramMark* ProgramMarks::at(long line) const {
  const auto after = std::upper_bound(marks.begin(), marks.end(), line,
                                      [](long l, const ProgramMark& m) { return l < m.line; });
  return after == marks.begin() ? nullptr : &*std::prev(after);
}

long ProgramMarks::last_line(std::size_t i) const {
  return i + 1 < marks.size() ? marks[i + 1].line - 1 : lines;
}

ProgramMarks program_marks(std::string_view program) {
  ProgramMarks out;
  while (!program.empty()) {
    const auto end = program.find('\n');
    const std::string_view line = program.substr(0, end);
    program = end == std::string_view::npos ? std::string_view() : program.substr(end + 1);
    ++out.lines;
    const auto at = line.find(kMarker);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = line.substr(at + kMarker.size());
    const auto quote = rest.find('"');
    if (quote == std::string_view::npos) continue;
    const std::string_view words = rest.substr(quote);
    ProgramMark mark{.line = out.lines,
                     .id = plain(rest.substr(0, quote)),
                     .n = number_of<long>(words, kPlace),
                     .tool = number_of<int>(words, kTool)};
    out.marks.push_back(std::move(mark));
  }
  return out;
}

}  // namespace capstan::casebase::retain
