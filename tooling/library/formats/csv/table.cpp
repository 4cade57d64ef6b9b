#include "tooling/library/formats/csv/table.h"

#include <array>

namespace capstan::tooling::csv {
namespace {

constexpr std::size_t kRowsCap = 1'000'000;
constexpr std::size_t kCellsCap = 20'000'000;
constexpr std::size_t kColumnsCap = 10'000;

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

}  // namespace

char separator_of(std::string_view text) {
  text = without_mark(text);
  std::array<std::size_t, 3> count{};
  constexpr std::string_view kAll = ",;\t";
  bool quoted = false, words = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '\n') {
      if (words) break;
      count = {};
    }
    if (const auto i = kAll.find(c); i != std::string_view::npos) ++count[i];
    words = words || (c != '\n' && c != '\r' && c != ' ');
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < count.size(); ++i)
    if (count[i] > count[best]) best = i;
  return count[best] == 0 ? '\0' : kAll[best];
}

Result<std::vector<Row>> parse_rows(std::string_view text, char separator, const std::string& file) {
  const auto fault = [&file](const char* code, std::string message, std::uint64_t line, const char* hint) {
    return fail({.code = code,
                 .message = std::move(message),
                 .file = file,
                 .line = line,
                 .expected = "a table of text in UTF-8",
                 .hint = hint});
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return fault("CSV-SYNTAX", "the text is UTF-16", 1, "save it as UTF-8");
  text = without_mark(text);
  std::vector<Row> out;
  std::size_t at = 0, cells = 0;
  std::uint64_t line = 1;
  while (at < text.size()) {
    Row row;
    row.line = line;
    bool any = false, more = true;
    while (more) {
      std::string one;
      if (at < text.size() && text[at] == '"') {
        const std::uint64_t begin = line;
        bool open = true;
        for (++at; at < text.size() && open; ++at) {
          if (text[at] == '\n') ++line;
          if (text[at] != '"') {
            one.push_back(text[at]);
          } else if (at + 1 < text.size() && text[at + 1] == '"') {
            one.push_back('"');
            ++at;
          } else {
            open = false;
          }
        }
        if (open) return fault("CSV-SYNTAX", "a cell in quotes does not end", begin, "add the quote");
        any = true;
      }
      const std::string_view stops = separator == ',' ? ",\n" : separator == ';' ? ";\n" : "\t\n";
      const auto end = std::min(text.find_first_of(stops, at), text.size());
      std::string_view plain = text.substr(at, end - at);
      if (end == text.size() || text[end] == '\n')
        while (plain.ends_with('\r')) plain.remove_suffix(1);
      if (plain.find('\0') != std::string_view::npos)
        return fault("CSV-SYNTAX", "the text has NUL bytes", line, "save it as UTF-8");
      one.append(plain);
      any = any || !plain.empty();
      at = end;
      more = at < text.size() && text[at] == separator;
      if (at < text.size()) ++at;
      row.cells.push_back(std::move(one));
      if (row.cells.size() > kColumnsCap || ++cells > kCellsCap)
        return fault("FILE-TOO-LARGE", "too many cells", line, "split the table");
    }
    ++line;
    if (!any) continue;
    out.push_back(std::move(row));
    if (out.size() > kRowsCap) return fault("FILE-TOO-LARGE", "too many rows", line, "split the table");
  }
  return out;
}

std::string cell(std::string_view text, char separator) {
  const bool quote = text.find_first_of("\"\r\n") != std::string_view::npos ||
                     text.find(separator) != std::string_view::npos ||
                     (!text.empty() && (text.front() == ' ' || text.back() == ' '));
  if (!quote) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out.push_back('"');
    out.push_back(c);
  }
  return out + "\"";
}

}  // namespace capstan::tooling::csv
