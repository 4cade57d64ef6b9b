#include <algorithm>
#include <cmath>

#include "planner/files/p21/read/number.h"
#include "planner/files/p21/read/parser.h"
#include "planner/files/p21/read/text.h"

namespace capstan::p21::detail {

bool Parser::simple_value(char first) {
  Node node = 0;
  bool good = false;
  switch (class_of(first)) {
    case Class::kDigit:
      good = number(node);
      break;
    case Class::kQuote:
      good = string(node);
      break;
    case Class::kHash:
      good = reference(node);
      break;
    case Class::kDot:
      good = enumeration(node);
      break;
    case Class::kDoubleQuote:
      good = binary(node);
      break;
    case Class::kDollar:
    case Class::kStar:
      node = make_node(first == '$' ? Tag::kOmitted : Tag::kDerived, offset(at_.p), 1);
      ++at_.p;
      good = true;
      break;
    default:
      if (first == '@') {
        fault({.code = "P21-UNSUPPORTED", .message = "value instances (@) of edition 3 are not supported"});
        return false;
      }
      return unexpected("a parameter");
  }
  if (good) values_.push(node);
  return good;
}

bool Parser::number(Node& out) {
  const char* const start = at_.p;
  const char* p = start;
  if (*p == '+' || *p == '-') ++p;
  const char* const digits = p;
  p = skip_digits(p);
  if (p == digits) {
    at_.p = p;
    return unexpected("a digit behind the sign");
  }
  bool real = false;
  bool wide = false;  // may leave the range of its type
  if (*p == '.') {
    real = true;
    p = skip_digits(p + 1);
    wide = p - start > 256;
  } else {
    wide = p - start > 18;
  }
  if (*p == 'E' || *p == 'e') {
    if (!real) warn("P21-NUMBER", "a number with an exponent has no decimal point; taken as a real");
    if (*p == 'e') warn("P21-NUMBER", "an exponent is marked by a small e");
    real = true;
    ++p;
    if (*p == '+' || *p == '-') ++p;
    const char* const exponent = p;
    p = skip_digits(p);
    if (p == exponent) {
      at_.p = p;
      return unexpected("the digits of an exponent");
    }
    wide = p - exponent > 2 || p - start > 200;
  }
  at_.p = p;
  out = make_node(real ? Tag::kReal : Tag::kInteger, offset(start),
                  static_cast<std::uint64_t>(p - start) & kMaxLength);
  return !wide || check_range(start, real);
}

bool Parser::check_range(const char* start, bool real) {
  const std::string_view lexeme(start, static_cast<std::size_t>(at_.p - start));
  if (lexeme.size() > limits_.number_bytes) {
    fault({.code = "P21-LIMIT", .message = "a number has " + std::to_string(lexeme.size()) + " characters"});
    return false;
  }
  if (real) {
    const double value = to_real(lexeme);
    if (!std::isfinite(value)) {
      fault({.code = "P21-NUMBER",
             .message =
                 std::string(lexeme.substr(0, 40)) + " is beyond the range of a real (1.8E308 either way)"});
      return false;
    }
    const std::string_view mantissa = lexeme.substr(0, lexeme.find_first_of("Ee"));
    if (value == 0.0 && mantissa.find_first_of("123456789") != std::string_view::npos) {
      warn("P21-NUMBER",
           std::string(lexeme.substr(0, 40)) + " is below the range of a real and is read as 0");
    }
    return true;
  }
  std::string_view digits = lexeme;
  const bool negative = digits.front() == '-';
  if (negative || digits.front() == '+') digits.remove_prefix(1);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  const std::string_view most = negative ? "9223372036854775808" : "9223372036854775807";
  if (digits.size() > most.size() || (digits.size() == most.size() && digits > most)) {
    fault(
        {.code = "P21-NUMBER",
         .message =
             std::string(lexeme.substr(0, 40)) +
             " is beyond the range of an integer of 64 bits (-9223372036854775808 to 9223372036854775807)"});
    return false;
  }
  return true;
}

bool Parser::string(Node& out) {
  const Cursor start = at_;
  const char* p = start.p + 1;
  bool pairs = false;
  bool odd = false;  // holds a byte that the decoder must judge
  for (;;) {
    p = find_special(p, end_);
    const char c = *p;
    if (c == '\'') {
      if (p[1] != '\'') break;
      pairs = true;
      p += 2;
      continue;
    }
    if (p >= end_) {
      at_ = {.p = start.p + 1, .line = start.line};
      fault({.code = "P21-STRING", .message = "a string is not closed", .expected = "'"});
      // Another one could only come from reading the same bytes in the other phase.
      if (seen_open_string_) stop_ = true;
      seen_open_string_ = true;
      return false;
    }
    odd = true;
    if (c == '\n' || (c == '\r' && p[1] != '\n')) ++at_.line;
    ++p;
  }
  const auto length = static_cast<std::size_t>(p - start.p) - 1;
  at_.p = p + 1;
  if (length > limits_.string_bytes) {
    fault_at(start.line,
             {.code = "P21-LIMIT", .message = "a string has " + std::to_string(length) + " bytes"});
    return false;
  }
  out = make_node(pairs || odd ? Tag::kEscapedString : Tag::kString, offset(start.p + 1), length);
  return !odd || check_text(start.p + 1, length, start.line);
}

bool Parser::check_text(const char* start, std::size_t length, std::uint32_t line) {
  TextIssues issues;
  std::string decoded;
  const std::string_view raw(start, length);
  decode_text(raw, decoded, issues);
  if (issues.warning.message != nullptr) warn("P21-STRING", issues.warning.message);
  if (issues.error.message == nullptr) return true;
  const auto lines =
      std::count(raw.begin(), raw.begin() + static_cast<long>(std::min(issues.error.offset, length)), '\n');
  fault_at(line + static_cast<std::uint32_t>(lines), {.code = "P21-STRING", .message = issues.error.message});
  return false;
}

bool Parser::enumeration(Node& out) {
  ++at_.p;
  std::uint32_t start = 0;
  std::uint32_t length = 0;
  if (*at_.p == '!' || !keyword(start, length)) {
    if (*at_.p == '!') unexpected("the name of an enumeration value");
    return false;
  }
  if (*at_.p != '.') return unexpected("'.' behind the name of an enumeration value");
  ++at_.p;
  out = make_node(Tag::kEnumeration, start, length);
  return true;
}

bool Parser::binary(Node& out) {
  const char* const start = ++at_.p;
  while (is_digit(*at_.p) || (*at_.p >= 'A' && *at_.p <= 'F')) ++at_.p;
  if (*at_.p != '"') return unexpected("hexadecimal digits in capitals up to '\"'");
  if (at_.p == start || *start > '3') {
    fault({.message = "a binary must begin with a digit 0 to 3, the number of bits to leave out"});
    return false;
  }
  const auto length = static_cast<std::size_t>(at_.p - start);
  if (length > limits_.string_bytes) {
    fault({.code = "P21-LIMIT", .message = "a binary has " + std::to_string(length) + " digits"});
    return false;
  }
  ++at_.p;
  out = make_node(Tag::kBinary, offset(start), length);
  return true;
}

}  // namespace capstan::p21::detail
