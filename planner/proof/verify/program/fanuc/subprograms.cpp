#include "planner/proof/verify/program/fanuc/subprograms.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

namespace capstan::verify::fanuc {
namespace {

constexpr std::string_view kDigits = "0123456789", kBlanks = " \t\r";

std::string_view stripped(std::string_view s) {
  const std::size_t first = s.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(kBlanks) + 1 - first);
}

/// Without the number of the block.
std::string_view code_of(std::string_view line) {
  line = stripped(line);
  if (line.size() < 2 || line[0] != 'N' || kDigits.find(line[1]) == std::string_view::npos) return line;
  return stripped(line.substr(std::min(line.find_first_not_of(kDigits, 1), line.size())));
}

/// The digits behind these letters, where nothing else is there.
std::optional<long> number_alone(std::string_view code, std::string_view letters) {
  constexpr std::size_t kMostDigits = 8;
  if (!code.starts_with(letters)) return std::nullopt;
  const std::string_view digits = stripped(code.substr(letters.size()));
  if (digits.empty() || digits.size() > kMostDigits ||
      digits.find_first_not_of(kDigits) != std::string_view::npos)
    return std::nullopt;
  long out = 0;
  for (const char c : digits) out = 10 * out + (c - '0');
  return out;
}

/// The number behind the O of a line, outside of its comments, whatever else is there.
std::optional<long> number_of_program(std::string_view line) {
  bool comment = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '(' || line[i] == ')') comment = line[i] == '(';
    if (comment || line[i] != 'O') continue;
    const std::string_view behind = stripped(line.substr(i + 1));
    return number_alone(behind.substr(0, std::min(behind.find_first_not_of(kDigits), behind.size())), "");
  }
  return std::nullopt;
}

std::optional<long> called(std::string_view code) {
  if (!code.starts_with("M98")) return std::nullopt;
  return number_alone(stripped(code.substr(3)), "P");
}

/// Rows of a subprogram: its blocks, and where its M99 is.
struct Body {
  std::size_t first = 0, end = 0;
  bool sound = true;
};

}  // namespace

std::vector<RunLine> lines_of(std::string_view text) {
  std::vector<RunLine> rows;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    rows.push_back({text.substr(at, end - at), static_cast<long>(rows.size()) + 1});
    at = end + 1;
  }
  return rows;
}

std::vector<RunLine> run_lines(std::string_view text, std::size_t most) {
  const std::vector<RunLine> rows = lines_of(text);
  const auto ended =
      std::find_if(rows.begin(), rows.end(), [](const RunLine& r) { return code_of(r.text) == "M30"; });
  std::map<long, Body> bodies;
  for (auto i = static_cast<std::size_t>(ended - rows.begin()); i < rows.size(); ++i) {
    const auto number = number_alone(code_of(rows[i].text), "O");
    if (!number) continue;
    Body b{i + 1, i + 1, true};
    while (b.end < rows.size() && code_of(rows[b.end].text) != "M99") {
      const std::string_view code = code_of(rows[b.end].text);
      b.sound =
          b.sound && code != "%" && !number_alone(code, "O") && code.find("M98") == std::string_view::npos;
      ++b.end;
    }
    b.sound = b.sound && b.end < rows.size();
    const auto [had, fresh] = bodies.emplace(*number, b);
    if (!fresh) had->second.sound = false;
  }
  if (bodies.empty()) return rows;
  for (auto row = rows.begin(); row != ended; ++row) {
    const auto same = bodies.find(number_of_program(row->text).value_or(-1));
    if (same != bodies.end()) same->second.sound = false;
  }
  std::vector<RunLine> out;
  std::size_t i = 0;
  for (; i < rows.size() && out.size() <= most; ++i) {
    const auto body = bodies.find(called(code_of(rows[i].text)).value_or(-1));
    if (body != bodies.end() && body->second.sound && i < static_cast<std::size_t>(ended - rows.begin())) {
      for (std::size_t k = body->second.first; k < body->second.end; ++k)
        out.push_back({rows[k].text, rows[i].number});
      continue;
    }
    // What is run by calls alone is no text behind the end.
    const auto own = std::find_if(bodies.begin(), bodies.end(), [&](const auto& b) {
      return b.second.sound && i + 1 >= b.second.first && i <= b.second.end;
    });
    out.push_back(own == bodies.end() ? rows[i] : RunLine{{}, rows[i].number});
  }
  return i < rows.size() ? rows : out;
}

}  // namespace capstan::verify::fanuc
