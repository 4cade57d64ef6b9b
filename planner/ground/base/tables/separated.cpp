#include "planner/ground/base/tables/separated.h"

#include <algorithm>
#include <array>

namespace capstan {
namespace {

constexpr std::size_t kRowsCap = 1'000'001;  // a million and their head
constexpr std::size_t kCellsCap = 20'000'000;
constexpr std::size_t kColumnsCap = 10'000;

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

class Reader {
 public:
  Reader(std::string_view text, char separator, StrayQuotes stray)
      : text_(text), separator_(separator), stray_(stray) {}

  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  [[nodiscard]] std::uint64_t line() const { return line_; }

  /// Reads the next row, without a row where the line is blank. Fails with what is wrong in it.
  tl::expected<bool, std::string> next(SeparatedRow& row) {
    row = {line_, {}};
    bool blank = true, more = true;
    while (more) {
      std::string cell;
      const bool quoted = !done() && text_[at_] == '"';
      if (quoted && !read_quoted(cell)) return tl::unexpected<std::string>("a cell in quotes does not end");
      const std::string_view plain = rest_of_cell();
      if (plain.find('\0') != std::string_view::npos)
        return tl::unexpected<std::string>("the text has NUL bytes");
      if (stray_ == StrayQuotes::kRefused && quoted && !plain.empty())
        return tl::unexpected<std::string>("text behind a cell in quotes");
      if (stray_ == StrayQuotes::kRefused && plain.find('"') != std::string_view::npos)
        return tl::unexpected<std::string>("a quote inside a cell that is not in quotes");
      cell.append(plain);
      blank = blank && !quoted && plain.empty();
      more = !done() && text_[at_] == separator_;
      if (!done()) ++at_;
      row.cells.push_back(std::move(cell));
      if (row.cells.size() > kColumnsCap) return tl::unexpected<std::string>("more than 10,000 columns");
    }
    ++line_;
    return !blank || row.cells.size() > 1;
  }

 private:
  /// From the opening quote to behind the closing one.
  bool read_quoted(std::string& into) {
    for (++at_; !done(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        into.push_back(text_[at_]);
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        into.push_back('"');
        ++at_;
      } else {
        ++at_;
        return true;
      }
    }
    return false;
  }

  /// The text without quotes up to the separator or the end of the line, which is not consumed.
  std::string_view rest_of_cell() {
    const std::array<char, 2> stops = {separator_, '\n'};
    const auto end = std::min(text_.find_first_of(std::string_view(stops.data(), 2), at_), text_.size());
    std::string_view out = text_.substr(at_, end - at_);
    if (end == text_.size() || text_[end] == '\n')
      while (out.ends_with('\r')) out.remove_suffix(1);
    at_ = end;
    return out;
  }

  std::string_view text_;
  char separator_;
  StrayQuotes stray_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
};

}  // namespace

Result<std::vector<SeparatedRow>> separated_rows(std::string_view text, char separator,
                                                 const std::string& file, const char* code,
                                                 StrayQuotes stray) {
  const auto fault = [&](const char* what, std::string message, std::uint64_t line, const char* hint) {
    return fail({.code = what,
                 .message = std::move(message),
                 .file = file,
                 .line = line,
                 .expected = "a table of text in UTF-8",
                 .hint = hint});
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return fault(code, "the text is UTF-16", 1, "save it as UTF-8");
  Reader reader(without_mark(text), separator, stray);
  std::vector<SeparatedRow> out;
  std::size_t cells = 0;
  while (!reader.done()) {
    const std::uint64_t line = reader.line();
    SeparatedRow row;
    const auto filled = reader.next(row);
    if (!filled) return fault(code, filled.error(), line, "mend that row, or write the table again");
    cells += row.cells.size();
    if (cells > kCellsCap || out.size() >= kRowsCap)
      return fault("FILE-TOO-LARGE", "more than 1,000,000 rows below the head, or 20,000,000 cells", line,
                   "split the table");
    if (*filled) out.push_back(std::move(row));
  }
  return out;
}

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

std::string separated_cell(std::string_view text, char separator) {
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

}  // namespace capstan
