#include "planner/proof/verify/program/siemens/words.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

// Blocks as a SINUMERIK reads them: addresses with numbers, names with =, calls with parentheses; small
// letters are capitals; what stands behind a ; that is not within quotes is a comment.

namespace capstan::verify::siemens {
namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

/// Where the first such character outside of quotes stands; the end where there is none.
std::size_t outside_quotes(std::string_view text, char wanted) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (!quoted && text[i] == wanted) return i;
  }
  return text.size();
}

class Splitter {
 public:
  Splitter(std::string_view rest, Line& out) : rest_(rest), out_(out) {}

  void run() {
    skip_blanks();
    if (!rest_.empty() && rest_.front() == '/') {
      out_.skipped = true;
      rest_.remove_prefix(1);
      if (!rest_.empty() && is_digit(rest_.front())) rest_.remove_prefix(1);
    }
    for (skip_blanks(); !rest_.empty(); skip_blanks()) {
      if (!take()) return;
    }
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  }
  bool wrong(std::string why) {
    out_.fault = std::move(why);
    return false;
  }
  bool unknown(std::string why) {
    out_.unverifiable = true;
    return wrong(std::move(why));
  }

  bool take() {
    if (!is_letter(rest_.front()))
      return rest_.front() == ':' ? unknown("main blocks (:) are not followed")
                                  : wrong(std::string("'") + rest_.front() + "' begins no word");
    std::size_t n = 0;
    while (n < rest_.size() && is_letter(rest_[n])) ++n;
    Item item;
    if (n > 1) {
      while (n < rest_.size() && (is_letter(rest_[n]) || is_digit(rest_[n]))) ++n;
    }
    item.name = capitals(rest_.substr(0, n));
    rest_.remove_prefix(n);
    const bool address = n == 1;
    if (address && !rest_.empty() && rest_.front() != '=' && !is_blank(rest_.front())) {
      if (!number(item)) return false;
      if (!rest_.empty() && rest_.front() == '=')
        return unknown("the address " + item.name + " has an extension, which is not followed");
      out_.items.push_back(std::move(item));
      return true;
    }
    skip_blanks();
    if (!rest_.empty() && rest_.front() == '=') {
      rest_.remove_prefix(1);
      skip_blanks();
      item.assigned = true;
      if (!value(item)) return false;
    } else if (!address && !rest_.empty() && rest_.front() == '(') {
      if (!call(item)) return false;
    } else if (address) {
      return no_number(item);
    }
    out_.items.push_back(std::move(item));
    return true;
  }

  bool no_number(const Item& item) {
    out_.no_number = true;
    return wrong(item.name + " is not followed by a number (\"" + std::string(rest_.substr(0, 12)) + "\")");
  }

  bool number(Item& item) {
    const std::size_t n = std::min(rest_.find_first_not_of("+-.0123456789"), rest_.size());
    std::string digits(rest_.substr(0, n));
    if (!digits.empty() && digits.front() == '+') digits.erase(0, 1);
    if (!digits.empty() && digits.back() == '.') digits += '0';
    const auto v = parse_double(digits);
    if (!v || !std::isfinite(*v)) return no_number(item);
    item.value = *v;
    rest_.remove_prefix(n);
    return true;
  }

  bool value(Item& item) {
    if (!rest_.empty() && rest_.front() == '"') {
      const std::size_t end = rest_.find('"', 1);
      if (end == std::string_view::npos) return wrong("a text is not closed");
      item.text = std::string(rest_.substr(1, end - 1));
      rest_.remove_prefix(end + 1);
      return true;
    }
    if (!rest_.empty() && is_letter(rest_.front()))
      return unknown("variables, expressions and functions (" + item.name + "=...) are not followed");
    if (!number(item)) return false;
    if (!rest_.empty() && std::string_view("*/()").find(rest_.front()) != std::string_view::npos)
      return unknown("expressions (" + item.name + "=...) are not followed");
    return true;
  }

  bool call(Item& item) {
    const std::size_t end = outside_quotes(rest_, ')');
    if (end == rest_.size()) return wrong("the parenthesis of " + item.name + " is not closed");
    item.call = true;
    std::string_view inside = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    for (;;) {
      const std::size_t comma = outside_quotes(inside, ',');
      std::string_view one = inside.substr(0, comma);
      while (!one.empty() && is_blank(one.front())) one.remove_prefix(1);
      while (!one.empty() && is_blank(one.back())) one.remove_suffix(1);
      item.params.emplace_back(one);
      if (comma >= inside.size()) return true;
      inside.remove_prefix(comma + 1);
    }
  }

  std::string_view rest_;
  Line& out_;
};

}  // namespace

void split_line(std::string_view text, Line& out) {
  out.items.clear();
  out.comment.reset();
  out.fault.clear();
  out.skipped = out.percent = out.unverifiable = out.no_number = false;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  const std::size_t end = outside_quotes(text, ';');
  if (end < text.size()) out.comment = std::string(text.substr(end + 1));
  text = text.substr(0, end);
  out.length = text.size();
  const std::size_t first = text.find_first_not_of(" \t");
  if (first != std::string_view::npos && text[first] == '%') {
    out.percent = true;
    return;
  }
  Splitter(text, out).run();
}

}  // namespace capstan::verify::siemens
