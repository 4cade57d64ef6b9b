#include "planner/door/app/show/query.h"

#include <charconv>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/all.h"

namespace capstan::app {

namespace {

constexpr std::size_t kSegments = 256;  // of one path, and of one condition
constexpr int kDepth = 32;              // of brackets in a condition
constexpr const char* kRoots =
    "project, unhandled, kept, #<instance number>, or a kind of object such as ROUND_HOLE";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

std::optional<model::TypeId> kind_of(std::string_view name) {
  std::string upper(name);
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return model::find_noun(upper);
}

std::optional<std::size_t> whole(std::string_view s) {
  std::size_t v = 0;
  const auto [end, ec] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (ec != std::errc() || end != s.data() + s.size() || s.empty()) return std::nullopt;
  return v;
}

// Throws its own fault, caught in parse_query: the grammar stays readable.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Query run() {
    Query q;
    q.text = text_;
    if (text_.ends_with("#size")) {
      q.count = true;
      end_ = text_.size() - 5;
    } else {
      end_ = text_.size();
    }
    if (!left()) fault("the path is empty", "/project, or #<instance number>");
    if (peek() == '[') fault("a path does not begin with an index", "/project, or #<instance number>");
    if (!starts("//")) q.steps.push_back(root());
    while (left()) {
      if (q.steps.size() > kSegments) fault("the path has more than 256 segments");
      if (peek() == '/' && at_ + 1 == end_ && !q.steps.empty()) break;  // a slash at the end
      q.steps.push_back(step());
    }
    return q;
  }

 private:
  [[noreturn]] void fault(const std::string& message, std::string expected = {}) {
    throw query_fault(text_, at_, message, std::move(expected)).value();
  }
  [[nodiscard]] bool left() const { return at_ < end_; }
  [[nodiscard]] char peek() const { return left() ? text_[at_] : '\0'; }
  [[nodiscard]] bool starts(std::string_view s) const { return text_.substr(at_, end_ - at_).starts_with(s); }
  bool take(std::string_view s) {
    if (!starts(s)) return false;
    at_ += s.size();
    return true;
  }
  void blanks() {
    while (left() && (peek() == ' ' || peek() == '\t')) ++at_;
  }
  std::string_view name() {
    const std::size_t from = at_;
    while (left() && is_name(peek())) ++at_;
    return text_.substr(from, at_ - from);
  }
  // A word by itself: "and", "or", "not", "is".
  bool word(std::string_view w) {
    const std::size_t from = at_;
    if (lower_text(name()) == w) return true;
    at_ = from;
    return false;
  }

  QueryStep root() {
    QueryStep s;
    s.kind = QueryStep::Kind::kRoot;
    take("/");
    s.position = at_;
    const std::size_t from = at_;
    while (left() && peek() != '/' && peek() != '[') ++at_;
    s.name = text_.substr(from, at_ - from);
    if (s.name.empty()) {
      if (left()) fault("a segment has no name");
      fault("the path is empty", "/project, or #<instance number>");
    }
    if (s.name == "project" || s.name == "kept" || s.name == "unhandled") return s;
    at_ = from;
    if (s.name.front() == '#') {
      const auto n = whole(std::string_view(s.name).substr(1));
      if (!n || *n == 0) fault("'" + s.name + "' is not an instance number", "#1, #2, ...");
      s.index = *n;
    } else if (const auto type = kind_of(s.name)) {
      s.type = *type;
    } else {
      fault("there is no '" + s.name + "' at the top", kRoots);
    }
    at_ = from + s.name.size();
    return s;
  }

  QueryStep step() {
    QueryStep s;
    s.position = at_;
    if (take("//")) {
      s.kind = QueryStep::Kind::kBelow;
      s.position = at_;
      s.name = name();
      const auto type = kind_of(s.name);
      if (!type) {
        at_ = s.position;
        fault(s.name.empty() ? "'//' is not followed by a kind of object"
                             : "there is no kind of object '" + s.name + "'",
              "a kind such as ROUND_HOLE, WORKINGSTEP or MACHINING_OPERATION");
      }
      s.type = *type;
      return s;
    }
    if (peek() == '[') return bracket();
    take("/");
    s.position = at_;
    s.name = name();
    if (s.name.empty()) {
      if (left() && peek() != '/' && peek() != '[')
        fault("'" + std::string(1, peek()) + "' has no meaning here", "a name, '/', '//' or '['");
      fault("a segment has no name");
    }
    s.name = lower_text(s.name);
    return s;
  }

  QueryStep bracket() {
    QueryStep s;
    s.position = at_;
    const std::size_t open = at_++;
    blanks();
    const std::size_t from = at_;
    if (take("*")) {
      s.kind = QueryStep::Kind::kAll;
    } else if (const auto digits = name(); !digits.empty() && is_digit(digits.front())) {
      const auto n = whole(digits);
      at_ = from;
      if (!n) fault("'" + std::string(digits) + "' is not an index", "[0], [1], ... or [*]");
      at_ += digits.size();
      s.kind = QueryStep::Kind::kIndex;
      s.index = *n;
    } else {
      at_ = from;
      if (peek() == ']') fault("'[]' is not an index", "[0], [1], [*], or a condition");
      s.kind = QueryStep::Kind::kFilter;
      s.condition = any(0);
    }
    blanks();
    if (!take("]")) {
      if (!left()) at_ = open;
      fault(left() && at_ != open ? "'" + std::string(1, peek()) + "' has no meaning here"
                                  : "a bracket is not closed",
            "']'");
    }
    s.name = text_.substr(open, at_ - open);
    return s;
  }

  Condition joined(int depth, Condition::Kind kind, std::string_view w) {
    Condition out;
    out.kind = kind;
    out.position = at_;
    do {
      if (++parts_ > kSegments) fault("the condition has more than 256 parts");
      out.parts.push_back(kind == Condition::Kind::kOr ? joined(depth, Condition::Kind::kAnd, "and")
                                                       : one(depth));
      blanks();
    } while (word(w));
    if (out.parts.size() == 1) {
      Condition only = std::move(out.parts.front());
      return only;
    }
    return out;
  }
  Condition any(int depth) {
    if (depth > kDepth) fault("the condition is nested too deep");
    return joined(depth, Condition::Kind::kOr, "or");
  }

  Condition one(int depth) {
    blanks();
    const std::size_t from = at_;
    if (word("not")) {
      if (depth > kDepth) fault("the condition is nested too deep");
      Condition out;
      out.kind = Condition::Kind::kNot;
      out.position = from;
      out.parts.push_back(one(depth + 1));
      return out;
    }
    if (take("(")) {
      Condition out = any(depth + 1);
      blanks();
      if (!take(")")) fault("a bracket is not closed", "')'");
      return out;
    }
    return test();
  }

  Condition test() {
    Condition out;
    out.position = at_;
    operand(out);
    blanks();
    using C = Condition::Compare;
    static constexpr std::pair<std::string_view, C> kCompares[] = {
        {"!=", C::kNotEqual}, {"<=", C::kLessEqual}, {">=", C::kGreaterEqual},
        {"=", C::kEqual},     {"<", C::kLess},       {">", C::kGreater}};
    for (const auto& [spelled, compare] : kCompares) {
      if (!take(spelled)) continue;
      out.kind = Condition::Kind::kCompare;
      out.compare = compare;
      literal(out);
      return out;
    }
    if (word("is")) {
      blanks();
      const std::size_t from = at_;
      const auto spelled = name();
      const auto type = kind_of(spelled);
      if (!type) {
        at_ = from;
        fault("there is no kind of object '" + std::string(spelled) + "'");
      }
      out.kind = Condition::Kind::kIs;
      out.type = *type;
    }
    return out;
  }

  void operand(Condition& out) {
    if (take(".")) return;
    while (true) {
      OperandStep s;
      s.position = at_;
      s.attribute = lower_text(name());
      if (s.attribute.empty() || is_digit(s.attribute.front())) {
        at_ = s.position;
        fault(left() ? "an attribute is missing" : "a bracket is not closed",
              "an attribute such as its_id, or '.' for the object itself");
      }
      out.operand.push_back(std::move(s));
      while (peek() == '[') {
        OperandStep item;
        item.position = at_++;
        const auto n = whole(name());
        if (!n || !take("]")) fault("an index is missing", "[0], [1], ...");
        item.index = n;
        out.operand.push_back(std::move(item));
      }
      if (out.operand.size() > kSegments) fault("the condition has more than 256 parts");
      if (!take(".") && !take("/")) break;
    }
    out.count = take("#size");
  }

  void literal(Condition& out) {
    blanks();
    const std::size_t from = at_;
    if (take("'")) {
      const auto close = text_.substr(0, end_).find('\'', at_);
      if (close == std::string_view::npos) {
        at_ = from;
        fault("a text is not closed", "'");
      }
      out.text = text_.substr(at_, close - at_);
      out.quoted = true;
      at_ = close + 1;
      return;
    }
    while (left() && (is_name(peek()) || peek() == '.' || peek() == '-' || peek() == '+')) ++at_;
    out.text = text_.substr(from, at_ - from);
    if (out.text.empty())
      fault("there is nothing to compare with", "a number, 'text', true, false or an enumerator");
    if (is_digit(out.text.front()) || out.text.front() == '-' || out.text.front() == '+' ||
        out.text.front() == '.') {
      out.number = parse_double(out.text.front() == '+' ? out.text.substr(1) : out.text);
      if (!out.number) {
        at_ = from;
        fault("'" + out.text + "' is not a number");
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0, end_ = 0, parts_ = 0;
};

}  // namespace

tl::unexpected<Diagnostic> query_fault(std::string_view path, std::size_t position,
                                       const std::string& message, std::string expected) {
  return fail({.code = "INS-PATH",
               .message = message + " (character " + std::to_string(position + 1) + ")",
               .path = std::string(path),
               .expected = std::move(expected)});
}

Result<Query> parse_query(std::string_view path) {
  try {
    return Parser(path).run();
  } catch (Diagnostic& d) {
    return fail(std::move(d));
  }
}

}  // namespace capstan::app
