#include "planner/files/p21/read/parser.h"

#include <algorithm>
#include <cstring>

namespace capstan::p21::detail {

Parser::Parser(Store& store, const Limits& limits, Job& job)
    : store_(store),
      limits_(limits),
      job_(job),
      begin_(store.text.data()),
      end_(store.text.data() + store.text.size()),
      at_{.p = begin_} {}

void Parser::skip_spaces() {
  for (;;) {
    const char c = *at_.p;
    if (c == ' ') {
      ++at_.p;
    } else if (c == '\n') {
      ++at_.p;
      ++at_.line;
    } else if (class_of(c) != Class::kSpace || !skip_unusual()) {
      return;
    }
  }
}

bool Parser::skip_unusual() {
  const char* p = at_.p;
  if (*p == '\r') {
    if (p[1] != '\n') {
      ++at_.line;
      if (!warned_bare_cr_) warn("P21-ENCODING", "lines end in a bare carriage return");
      warned_bare_cr_ = true;
    }
    ++at_.p;
    return true;
  }
  if (*p == '\\') {  // \N\ and \F\: new line and form feed of a printout
    if ((p[1] != 'N' && p[1] != 'F') || p[2] != '\\') return false;
    at_.p += 3;
    return true;
  }
  if (*p != '/') {
    ++at_.p;
    return true;
  }
  if (p[1] != '*') return false;
  const std::string_view rest(p + 2, static_cast<std::size_t>(end_ - p - 2));
  const std::size_t length = rest.find("*/");
  if (length == std::string_view::npos) {
    fault({.message = "a comment is not closed", .expected = "*/"});
    stop_ = true;
    at_.p = end_;
    return true;
  }
  at_.line +=
      static_cast<std::uint32_t>(std::count(rest.begin(), rest.begin() + static_cast<long>(length), '\n'));
  at_.p += length + 4;
  return true;
}

bool Parser::unexpected(const char* expected) {
  std::string what = "the file ends here";
  if (!at_end()) {
    what = *at_.p == '\0' ? "a NUL byte" : name_of(*at_.p) + " does not belong here";
  }
  fault({.message = std::move(what), .expected = expected});
  return false;
}

void Parser::resync() {
  const auto* found =
      static_cast<const char*>(std::memchr(at_.p, ';', static_cast<std::size_t>(end_ - at_.p)));
  const char* to = found == nullptr ? end_ : found + 1;
  at_.line += static_cast<std::uint32_t>(std::count(at_.p, to, '\n'));
  at_.p = to;
}

bool Parser::semicolon() {
  skip();
  if (*at_.p != ';') return unexpected("';'");
  ++at_.p;
  return true;
}

bool Parser::keyword(std::uint32_t& start, std::uint32_t& length) {
  const char* p = at_.p;
  const char* const first = p;
  if (*p == '!') ++p;
  if (word_class(*p) == 0 || is_digit(*p)) {
    at_.p = p;
    return unexpected("a keyword");
  }
  unsigned seen = 0;
  if (end_ - p >= 16) p += leading(Sixteen(p).word());
  while (const unsigned c = word_class(*p)) {
    seen |= c;
    ++p;
  }
  start = offset(first);
  length = static_cast<std::uint32_t>(p - first);
  if ((seen & 2U) != 0) {
    for (std::size_t i = start; i < start + length; ++i) {
      const char c = store_.text[i];
      if (c >= 'a' && c <= 'z') store_.text[i] = static_cast<char>(c - 'a' + 'A');
    }
    if (!warned_lower_case_)
      warn("P21-SYNTAX", "keywords and enumerations in lower case are read as upper case");
    warned_lower_case_ = true;
  }
  at_.p = p;
  return true;
}

// ------------------------------------------------------------------------------------ parameters

bool Parser::open(std::uint32_t typed) {
  if (frames_.size() >= limits_.depth) {
    fault({.code = "P21-LIMIT",
           .message = "parameters are nested deeper than " + std::to_string(limits_.depth)});
    return false;
  }
  frames_.push_back({static_cast<std::uint32_t>(values_.size()), typed});
  return true;
}

Node Parser::close() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  const std::size_t count = values_.size() - frame.start;
  const std::size_t start = store_.nodes.size();
  store_.nodes.append(values_.from(frame.start), count);
  values_.shrink(frame.start);
  return make_node(frame.typed != 0 ? Tag::kTyped : Tag::kList, start, count);
}

// The common spellings of simple values, where sixteen bytes tell all. Returns where it ends, or nullptr:
// then simple_value reads it with all checks. Accepts nothing that those would refuse.
inline const char* Parser::quick_value(const char* p, Node& out) const {
  if (end_ - p < 32) return nullptr;
  switch (class_of(*p)) {
    case Class::kDigit: {
      const unsigned sign = *p == '-' || *p == '+' ? 1 : 0;
      const Sixteen bytes(p + sign);
      const unsigned length = leading(bytes.digits() | bytes.points());
      const unsigned points = bytes.points() & ((1U << length) - 1);
      const char next = p[sign + length];
      if (length == 0 || length > 15 || (points & (points - 1)) != 0 || (points & 1U) != 0) return nullptr;
      if (next != ',' && next != ')') return nullptr;  // an exponent perhaps
      out = make_node(points != 0 ? Tag::kReal : Tag::kInteger, offset(p), sign + length);
      return p + sign + length;
    }
    case Class::kHash: {
      const unsigned length = leading(Sixteen(p + 1).digits());
      if (length == 0 || length > 15 || p[1] == '0') return nullptr;
      out = make_node(Tag::kReference, offset(p), length + 1);
      return p + length + 1;
    }
    case Class::kQuote: {
      const char* const close = find_special(p + 1, end_);
      const auto length = static_cast<std::size_t>(close - p) - 1;
      if (*close != '\'' || close[1] == '\'' || length > limits_.string_bytes) return nullptr;
      out = make_node(Tag::kString, offset(p + 1), length);
      return close + 1;
    }
    case Class::kDot: {
      const unsigned length = leading(Sixteen(p + 1).word());
      if (length == 0 || length > 15 || is_digit(p[1]) || p[length + 1] != '.') return nullptr;
      out = make_node(Tag::kEnumeration, offset(p + 1), length);
      return p + length + 2;
    }
    case Class::kDollar:
      out = make_node(Tag::kOmitted, offset(p), 1);
      return p + 1;
    case Class::kStar:
      out = make_node(Tag::kDerived, offset(p), 1);
      return p + 1;
    default:
      return nullptr;
  }
}

bool Parser::parameters(Node& out) {
  frames_.clear();
  values_.clear();
  if (!open(0)) return false;
  ++at_.p;
  bool fresh = true;  // right behind a '(', where an empty list may end
  for (;;) {
    skip();
    const char c = *at_.p;
    const Class kind = class_of(c);
    if (kind == Class::kOpen) {
      if (!open(0)) return false;
      ++at_.p;
      fresh = true;
      continue;
    }
    if (kind == Class::kLetter) {
      std::uint32_t start = 0;
      std::uint32_t length = 0;
      if (!keyword(start, length)) return false;
      skip();
      if (*at_.p != '(') return unexpected("'(' behind the keyword of a typed parameter");
      if (!open(1)) return false;
      values_.push(make_node(Tag::kKeyword, start, length));
      ++at_.p;
      fresh = false;
      continue;
    }
    if (!(fresh && c == ')')) {
      Node node = 0;
      if (const char* const behind = quick_value(at_.p, node)) {
        at_.p = behind;
        values_.push(node);
      } else if (!simple_value(c)) {
        return false;
      }
    }
    fresh = false;
    for (;;) {
      skip();
      const char d = *at_.p;
      if (d == ',') {
        if (frames_.back().typed != 0) return unexpected("')', for a typed parameter holds one value");
        if (values_.size() - frames_.back().start >= limits_.list_elements) {
          fault({.code = "P21-LIMIT",
                 .message = "a list has more than " + std::to_string(limits_.list_elements) + " elements"});
          return false;
        }
        ++at_.p;
        break;
      }
      if (d != ')') return unexpected("',' or ')'");
      ++at_.p;
      const Node node = close();
      if (frames_.empty()) {
        out = node;
        return true;
      }
      values_.push(node);
    }
  }
}

// ------------------------------------------------------------------------------------- instances

bool Parser::instance_id(std::uint64_t& id) {
  const char* p = ++at_.p;
  const char* const start = p;
  std::uint64_t value = 0;
  for (; is_digit(*p); ++p) {
    const auto digit = static_cast<std::uint64_t>(*p - '0');
    if (p - start >= 19 && (value > UINT64_MAX / 10 || value * 10 > UINT64_MAX - digit)) {
      at_.p = skip_digits(p);
      fault({.code = "P21-ID", .message = "an instance number is beyond 64 bits"});
      return false;
    }
    value = value * 10 + digit;
  }
  at_.p = p;
  if (p == start) {
    if (class_of(*p) == Class::kLetter) {
      fault({.code = "P21-UNSUPPORTED", .message = "constants (#NAME) of edition 3 are not supported"});
      return false;
    }
    return unexpected("digits behind '#'");
  }
  if (value == 0) {
    fault({.code = "P21-ID", .message = "0 is no instance number", .expected = "a number above 0"});
    return false;
  }
  if (p - start > 64) {  // zeros in front, which are legal but not without end
    fault({.code = "P21-LIMIT", .message = "an instance number has more than 64 digits"});
    return false;
  }
  id = value;
  return true;
}

bool Parser::reference(Node& out) {
  const char* const start = at_.p;
  std::uint64_t id = 0;
  if (!instance_id(id)) return false;
  out = make_node(Tag::kReference, offset(start), static_cast<std::uint64_t>(at_.p - start));
  return true;
}

bool Parser::record() {
  Part part;
  if (class_of(*at_.p) != Class::kLetter) return unexpected("a keyword");
  if (!keyword(part.keyword_start, part.keyword_length)) return false;
  skip();
  if (*at_.p != '(') return unexpected("'(' behind the keyword");
  if (!parameters(part.parameters)) return false;
  store_.parts.push_back(part);
  return true;
}

bool Parser::instance() {
  Entity entity{.line = at_.line};
  entity.part = static_cast<std::uint32_t>(store_.parts.size()) & 0x7FFFFFFFU;
  id_ = 0;
  if (!instance_id(entity.id)) return false;
  id_ = entity.id;
  skip();
  if (*at_.p != '=') return unexpected("'=' behind the instance number");
  ++at_.p;
  skip();
  if (*at_.p == '(') {
    entity.complex = 1;
    ++at_.p;
    skip();
    do {
      if (!record()) return false;
      skip();
    } while (*at_.p != ')');
    ++at_.p;
  } else if (*at_.p == '&') {
    fault({.code = "P21-UNSUPPORTED", .message = "scopes (&SCOPE) of edition 1 are not supported"});
    return false;
  } else if (!record()) {
    return false;
  }
  if (!semicolon()) return false;
  store_.entities.push_back(entity);
  return true;
}

}  // namespace capstan::p21::detail
