#include "planner/proof/verify/told/phrases.h"

#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::verify {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool small(char c) { return c >= 'a' && c <= 'z'; }
bool letter(char c) { return small(c) || (c >= 'A' && c <= 'Z'); }

/// How FANUC's programs write a percent sign.
constexpr std::string_view kPercent = "PERCENT";

}  // namespace

std::vector<Phrase> phrases_of(std::string_view text) {
  std::vector<Phrase> out;
  char before = ' ', sign = ' ';
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i] == '~' ? '-' : text[i];  // as a TNC and Grbl have it
    std::size_t end = i + 1;
    if (letter(c)) {
      std::string word;
      for (end = i; end < text.size() && letter(text[end]); ++end)
        word += small(text[end]) ? static_cast<char>(text[end] - 'a' + 'A') : text[end];
      if (sign != ' ') out.push_back({std::string(1, sign)});
      if (word != kPercent) out.push_back({std::move(word)});
    } else if (digit(c)) {
      while (end < text.size() && digit(text[end])) ++end;
      if (end + 1 < text.size() && text[end] == '.' && digit(text[end + 1])) {
        for (++end; end < text.size() && digit(text[end]);) ++end;
      }
      const double value = parse_double(text.substr(i, end - i)).value_or(0.0);
      out.push_back({{}, sign == '-' ? -value : value});
    } else if (c == ':') {
      out.push_back({":"});
    }
    // A hyphen within a word is none; behind an axis it is a sign: set-up, Z-30.
    const bool signs = (c == '+' || c == '-') && end < text.size() &&
                       (digit(text[end]) || (letter(text[end]) && !letter(before) && !digit(before)));
    sign = signs ? c : ' ';
    before = text[end - 1];
    i = end;
  }
  return out;
}

bool stands_at(const std::vector<Phrase>& part, const std::vector<Phrase>& whole, std::size_t from,
               double unit) {
  if (from > whole.size() || part.size() > whole.size() - from) return false;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Phrase &a = part[i], &b = whole[from + i];
    if (a.word != b.word) return false;
    if (a.word.empty() && !(std::abs(a.number - b.number) <= unit)) return false;
  }
  return true;
}

}  // namespace capstan::verify
