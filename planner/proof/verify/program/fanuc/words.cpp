#include "planner/proof/verify/program/fanuc/words.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

// Blocks as a FANUC reads them: letters and numbers, blanks anywhere, comments in parentheses, no exponents.

namespace capstan::verify::fanuc {
namespace {

/// Takes comments out and blanks away; false when a parenthesis stays open.
bool strip(std::string_view text, std::string& code, Line& out) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') {
      const std::size_t end = text.find(')', i);
      if (end == std::string_view::npos) return false;
      out.comments.emplace_back(text.substr(i + 1, end - i - 1));
      if (out.comments.back().find_first_of("%(") != std::string::npos)
        out.fault = "a comment with % or ( in it: % ends the tape wherever it is";
      i = end;
      continue;
    }
    if (text[i] != '\r') ++out.length;
    if (text[i] != ' ' && text[i] != '\t' && text[i] != '\r') {
      code.push_back(text[i]);
    }
  }
  return true;
}

/// Takes one word off `rest`; false when it is none, told in `out`.
bool take(std::string_view& rest, Line& out) {
  const char letter = rest.front();
  if (letter == '#' || letter == '[' || (rest.size() > 1 && (rest[1] == '#' || rest[1] == '['))) {
    out.unverifiable = true;
    out.fault = "variables and expressions (#, [) are not followed";
    return false;
  }
  if (letter < 'A' || letter > 'Z') {
    out.fault = std::string("'") + letter + "' begins no word; a control without small letters stops there";
    return false;
  }
  rest.remove_prefix(1);
  const std::size_t n = std::min(rest.find_first_not_of("+-.0123456789"), rest.size());
  std::string_view digits = rest.substr(0, n);
  const bool point = digits.find('.') != std::string_view::npos;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  std::string number(digits);
  if (!number.empty() && number.back() == '.') number += '0';
  const auto value = parse_double(number);
  if (!value || !std::isfinite(*value)) {
    out.no_number = true;
    out.fault =
        std::string(1, letter) + " is not followed by a number (\"" + std::string(rest.substr(0, 12)) + "\")";
    return false;
  }
  out.words.push_back({letter, *value, point});
  rest.remove_prefix(n);
  return true;
}

}  // namespace

void split_line(std::string_view text, Line& out) {
  out.words.clear();
  out.comments.clear();
  out.fault.clear();
  out.length = 0;
  out.percent = out.skipped = out.unverifiable = out.no_number = false;
  std::string code;
  if (!strip(text, code, out)) {
    out.fault = "a comment is not closed";
    return;
  }
  if (!out.fault.empty()) return;
  std::string_view rest = code;
  if (rest.find('%') != std::string_view::npos) {
    out.percent = true;
    if (rest.size() > 1) out.fault = "text beside %";
    return;
  }
  if (rest.starts_with('/')) {
    out.skipped = true;
    rest.remove_prefix(1);
  }
  if (rest.ends_with(';')) rest.remove_suffix(1);  // the end of the block as screens show it
  while (!rest.empty() && take(rest, out)) {
  }
}

}  // namespace capstan::verify::fanuc
