#include "planner/proof/verify/program/heidenhain/words.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

// Lines as a TNC reads them: the block's number, words with blanks between, a comment behind ; to the line's
// end. A ~ that ends a line, its comment included, makes the next line part of the same block.

namespace capstan::verify::heidenhain {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kMostDigits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The first ; that is not within quotes; the end where there is none.
std::size_t comment_at(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (!quoted && text[i] == ';') return i;
  }
  return text.size();
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

void take_number(std::string_view& text, Line& out) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  if (n == 0) return;
  if (n > kMostDigits || (n < text.size() && kBlanks.find(text[n]) == std::string_view::npos)) {
    out.fault = "the block's number is followed by no blank, or has more than " +
                std::to_string(kMostDigits) + " digits";
    return;
  }
  out.number = std::stol(std::string(text.substr(0, n)));
  text = without_blanks(text.substr(n));
}

void take_words(std::string_view text, Line& out) {
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    std::size_t end = 0;
    bool quoted = false;
    for (; end < text.size() && (quoted || kBlanks.find(text[end]) == std::string_view::npos); ++end)
      quoted = quoted != (text[end] == '"');
    if (quoted) {
      out.fault = "a name between quotes is not closed";
      return;
    }
    out.words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

}  // namespace

void add_line(std::string_view text, Line& out) {
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  text = without_blanks(text);
  const bool first = !out.goes_on;
  out.goes_on = false;
  if (first) {
    take_number(text, out);
    if (!text.empty() && text.front() == '/') {
      out.skipped = true;
      text = without_blanks(text.substr(1));
      if (!out.number) take_number(text, out);
    }
  }
  std::size_t end = comment_at(text);
  const bool only_comment = end == 0 && !text.empty();
  if (!only_comment && text.ends_with('~')) {
    out.goes_on = true;
    text = without_blanks(text.substr(0, text.size() - 1));
    end = std::min(end, text.size());
  }
  if (end < text.size()) out.comments.emplace_back(without_blanks(text.substr(end + 1)));
  text = without_blanks(text.substr(0, end));
  out.length = std::max(out.length, text.size());
  if (first && text.starts_with('*')) {
    out.structure = true;
    return;
  }
  if (out.fault.empty()) take_words(text, out);
}

std::optional<double> number_behind(std::string_view word, std::string_view letters) {
  if (!word.starts_with(letters)) return std::nullopt;
  std::string digits(word.substr(letters.size()));
  if (digits.empty() || digits.find_first_not_of("+-.0123456789") != std::string::npos) return std::nullopt;
  const bool has_sign = digits.front() == '+';
  if (has_sign) digits.erase(0, 1);
  if (digits.empty() || (has_sign && (digits.front() == '+' || digits.front() == '-'))) return std::nullopt;
  if (digits.back() == '.') digits += '0';
  const auto value = parse_double(digits);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace capstan::verify::heidenhain
