#include <algorithm>
#include <map>
#include <stdexcept>

#include "planner/files/exchange/ap238/tables/mapping.h"

// The language of the tables, see mapping/README.md.

namespace capstan::exchange::ap238 {

using model::TypeId;

namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

std::vector<std::string> split(std::string_view s, char by) {
  std::vector<std::string> out;
  for (std::size_t end = s.find(by); end != std::string_view::npos; end = s.find(by)) {
    out.emplace_back(s.substr(0, end));
    s.remove_prefix(end + 1);
  }
  out.emplace_back(s);
  return out;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

/// Reads the tables; every mistake is ours and throws.
class Parser {
 public:
  explicit Parser(Mapping& out) : out_(out), schema_(express::Dictionary::ap238()) {
    out_.prefixes_.emplace_back();
  }

  void table(const std::string& name, std::string_view text) {
    std::size_t number = 0;
    std::string statement;
    std::size_t began = 0;
    while (!text.empty()) {
      const auto end = text.find('\n');
      std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++number;
      if (const auto comment = comment_at(line); comment != std::string_view::npos)
        line = line.substr(0, comment);
      line = trimmed(line);
      if (statement.empty()) began = number;
      const bool more = !line.empty() && line.back() == '\\';
      if (more) line.remove_suffix(1);
      statement += line;
      if (more) {
        statement += ' ';
        continue;
      }
      place_ = name + ":" + std::to_string(began);
      if (!trimmed(statement).empty()) read(trimmed(statement));
      statement.clear();
    }
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    throw std::logic_error("mapping table " + place_ + ": " + what);
  }

  // A `#` that is neither in a text nor an ordinal begins a comment.
  static std::size_t comment_at(std::string_view s) {
    bool quoted = false;
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s[i] == '\'') quoted = !quoted;
      if (s[i] == '#' && !quoted && (i == 0 || s[i - 1] != '=')) return i;
    }
    return std::string_view::npos;
  }

  static std::string_view word(std::string_view& s) {
    s = trimmed(s);
    std::size_t n = 0;
    while (n < s.size() && s[n] != ' ') ++n;
    const auto out = s.substr(0, n);
    s.remove_prefix(n);
    s = trimmed(s);
    return out;
  }

  void read(std::string_view s) {
    const auto kind = word(s);
    if (kind == "macro") return macro(s);
    if (kind == "shared") return shared(s);
    if (kind == "object") return object(s);
    if (kind == "row" || kind == "read") return row(s, kind == "row");
    if (kind == "fixed" || kind == "mark") return fixed(s, kind == "fixed");
    wrong("no statement begins with '" + std::string(kind) + "'");
  }

  static void expect_equals(std::string_view& s, const Parser& p) {
    s = trimmed(s);
    if (s.empty() || s.front() != '=') p.wrong("'=' expected");
    s.remove_prefix(1);
    s = trimmed(s);
  }

  // --- macros: text with arguments ---

  struct Macro {
    std::vector<std::string> names;
    std::string body;
  };

  void macro(std::string_view s) {
    const auto open = s.find('('), close = s.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos) wrong("macro NAME(arguments) = …");
    Macro m;
    for (const auto& a : split(s.substr(open + 1, close - open - 1), ',')) m.names.emplace_back(trimmed(a));
    const std::string name(trimmed(s.substr(0, open)));
    s.remove_prefix(close + 1);
    expect_equals(s, *this);
    m.body = expanded(s);
    macros_[name] = std::move(m);
  }

  [[nodiscard]] std::string expanded(std::string_view s) const {
    std::string out;
    bool quoted = false;
    for (std::size_t i = 0; i < s.size();) {
      if (s[i] == '\'') quoted = !quoted;
      const bool at_word = !quoted && is_word(s[i]) && (i == 0 || (!is_word(s[i - 1]) && s[i - 1] != '@'));
      if (!at_word) {
        out += s[i++];
        continue;
      }
      std::size_t end = i;
      while (end < s.size() && is_word(s[end])) ++end;
      const std::string_view name = s.substr(i, end - i);
      const bool called = end < s.size() && s[end] == '(';
      const auto it = called ? macros_.find(name) : macros_.end();
      if (it == macros_.end()) {
        out += name;
        i = end;
        continue;
      }
      const auto close = s.find(')', end);
      if (close == std::string_view::npos) wrong("')' expected after " + std::string(name));
      const auto arguments = split(s.substr(end + 1, close - end - 1), ',');
      if (arguments.size() != it->second.names.size())
        wrong("wrong number of arguments of " + std::string(name));
      out += substituted(it->second, arguments);
      i = close + 1;
    }
    return out;
  }

  static std::string substituted(const Macro& m, const std::vector<std::string>& arguments) {
    std::string out;
    for (std::size_t i = 0; i < m.body.size();) {
      bool done = false;
      for (std::size_t k = 0; m.body[i] == '$' && k < m.names.size() && !done; ++k) {
        const auto& n = m.names[k];
        if (n.empty() || m.body.compare(i + 1, n.size(), n) != 0) continue;  // of a macro without arguments
        if (i + 1 + n.size() < m.body.size() && is_word(m.body[i + 1 + n.size()])) continue;
        out += trimmed(arguments[k]);
        i += 1 + n.size();
        done = true;
      }
      if (!done) out += m.body[i++];
    }
    return out;
  }

  // --- statements ---

  [[nodiscard]] TypeId noun(std::string_view keyword) const {
    const auto t = model::find_noun(keyword);
    if (!t) wrong("no noun " + std::string(keyword));
    return *t;
  }

  void shared(std::string_view s) {
    SharedRow out;
    out.name = word(s);
    expect_equals(s, *this);
    const std::string text = expanded(s);
    std::string_view rest = text;
    out.root = root(rest);
    out_.shared_.push_back(std::move(out));
  }

  void object(std::string_view s) {
    ObjectRow out;
    out.place = place_;
    auto w = word(s);
    if (w == "read") {
      out.written = false;
      w = word(s);
    }
    out.noun = noun(w);
    expect_equals(s, *this);
    const std::string text = expanded(s);
    std::string_view rest = text;
    out.root = root(rest);
    rest = trimmed(rest);
    while (!rest.empty()) {
      const auto kind = word(rest);
      if (kind == "where") {
        prefix_.clear();
        while (!rest.empty() && (rest.front() == '<' || rest.front() == '>')) out.guard.push_back(step(rest));
      } else if (kind == "with") {
        while (!rest.empty() && rest.find(':') != std::string_view::npos) {
          const auto item = split(word(rest), ':');
          if (item.size() != 2) wrong("with ATTRIBUTE:NOUN");
          out.with.emplace_back(split(item[0], '.'), noun(item[1]));
        }
      } else if (kind == "if") {
        const auto item = split(word(rest), ':');
        if (item.size() != 2) wrong("if ATTRIBUTE:NOUN");
        out.when.emplace_back(split(item[0], '.'), noun(item[1]));
      } else if (kind == "unless") {
        out.unless = split(word(rest), '.');
      } else {
        wrong("'" + std::string(kind) + "' is not understood");
      }
    }
    out_.objects_.push_back(std::move(out));
  }

  void row(std::string_view s, bool written) {
    Row out;
    out.written = written;
    out.place = place_;
    out.noun = noun(word(s));
    for (const auto& part : split(word(s), '.')) {
      const auto colon = part.find(':');
      const auto equals = part.find('=');
      out.attribute.push_back(part.substr(0, std::min(colon, equals)));
      out.only.push_back(equals == std::string::npos ? TypeId::kNone : noun(part.substr(equals + 1)));
      out.made.push_back(colon == std::string::npos ? TypeId::kNone : noun(part.substr(colon + 1)));
    }
    expect_equals(s, *this);
    const std::string text = expanded(s);
    path(text, out);
    out_.rows_.push_back(std::move(out));
  }

  void fixed(std::string_view s, bool written) {
    Row out;
    out.written = written;
    out.place = place_;
    out.noun = noun(word(s));
    expect_equals(s, *this);
    const std::string text = expanded(s);
    path(text, out);
    out_.rows_.push_back(std::move(out));
  }

  void path(std::string_view s, Row& out) {
    prefix_.clear();
    if (!out.attribute.empty())
      own_ = "!" + std::string(model::noun_type(out.noun).keyword) + "." + joined(out.attribute);
    s = trimmed(s);
    while (!s.empty() && (s.front() == '<' || s.front() == '>')) out.steps.push_back(step(s));
    if (!s.empty() && s.front() == '.') {
      s.remove_prefix(1);
      out.value_of = word(s);
    }
    while (!s.empty()) {
      if (s.front() != '|') wrong("cannot read '" + std::string(s) + "'");
      s.remove_prefix(1);
      const auto kind = word(s);
      if (kind == "texts") {
        while (!s.empty() && s.front() == '\'') {
          const auto end = s.find('\'', 1);
          if (end == std::string_view::npos) wrong("a text without end");
          out.texts.emplace_back(s.substr(1, end - 1));
          s.remove_prefix(end + 1);
          s = trimmed(s);
        }
      } else if (kind == "codec") {
        out.codec = word(s);
      } else if (kind == "when") {
        out.when = word(s);
      } else if (kind == "unless") {
        out.unless = word(s);
      } else {
        wrong("'| " + std::string(kind) + "' is not understood");
      }
    }
  }

  static std::string joined(const std::vector<std::string>& parts) {
    std::string out;
    for (const auto& p : parts) out += (out.empty() ? "" : ".") + p;
    return out;
  }

  // --- steps ---

  [[nodiscard]] EntityId entity(std::string_view name) const {
    const EntityId e = schema_.find(name);
    if (e == express::kNoEntity) wrong("no entity " + std::string(name));
    return e;
  }

  static std::string_view name_of(std::string_view& s) {
    std::size_t n = 0;
    while (n < s.size() && is_word(s[n])) ++n;
    const auto out = s.substr(0, n);
    s.remove_prefix(n);
    return out;
  }

  std::vector<EntityId> entities(std::string_view& s) const {
    std::vector<EntityId> out = {entity(name_of(s))};
    while (!s.empty() && s.front() == '&') {
      s.remove_prefix(1);
      out.push_back(entity(name_of(s)));
    }
    return out;
  }

  void alternatives(std::string_view& s, Step& out) const {
    while (!s.empty() && s.front() == '/') {
      s.remove_prefix(1);
      out.also.push_back(entity(name_of(s)));
    }
  }

  Step root(std::string_view& s) {
    Step out;
    out.exact = !s.empty() && s.front() == '=';
    if (out.exact) s.remove_prefix(1);
    out.entities = entities(s);
    s = trimmed(s);
    constraints(s, out);
    return out;
  }

  Step step(std::string_view& s) {
    const std::string_view before = s;
    Step out;
    out.inverse = s.front() == '<';
    s.remove_prefix(1);
    for (; !s.empty() && (s.front() == '*' || s.front() == '!' || s.front() == '='); s.remove_prefix(1)) {
      (s.front() == '*' ? out.fan : s.front() == '!' ? out.own : out.exact) = true;
    }
    if (out.inverse) {
      out.entities = entities(s);
      alternatives(s, out);
      if (s.empty() || s.front() != '.') wrong("<entity.attribute expected");
      s.remove_prefix(1);
      out.attribute = name_of(s);
      out.owner = express::kNoEntity;
      for (const EntityId e : out.entities) {
        if (out.owner == express::kNoEntity && schema_.position(e, out.attribute))
          out.owner = schema_.owner(e, out.attribute);
      }
      if (out.owner == express::kNoEntity) wrong("no attribute " + out.attribute);
    } else {
      out.attribute = name_of(s);
      if (!s.empty() && s.front() == '[') {
        s.remove_prefix(1);
        for (const char c : name_of(s)) out.index = out.index * 10 + static_cast<std::uint32_t>(c - '0');
        if (out.index == 0 || s.empty() || s.front() != ']') wrong(">attribute[number] expected");
        s.remove_prefix(1);
      }
      if (!s.empty() && s.front() == '^') {
        s.remove_prefix(1);
        for (const char c : name_of(s)) out.wrapper += static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
      }
      if (!s.empty() && s.front() == ':') {
        s.remove_prefix(1);
        out.entities = entities(s);
        alternatives(s, out);
      }
    }
    constraints(s, out);
    prefix_ += before.substr(0, before.size() - s.size());
    if (out.own) prefix_ += own_;
    const auto [it, added] =
        interned_.try_emplace(prefix_, static_cast<std::uint32_t>(out_.prefixes_.size()));
    if (added) out_.prefixes_.push_back(prefix_);
    out.prefix = it->second;
    s = trimmed(s);
    return out;
  }

  void constraints(std::string_view& s, Step& out) {
    if (s.empty() || s.front() != '{') return;
    s.remove_prefix(1);
    while (!s.empty() && s.front() != '}') {
      s = trimmed(s);
      Constraint c;
      c.attribute = name_of(s);
      if (!s.empty() && s.front() == '.') {
        s.remove_prefix(1);
        c.attribute += "." + std::string(name_of(s));
      }
      s = trimmed(s);
      c.negated = s.substr(0, 2) == "!=";
      c.fallback = s.substr(0, 2) == "?=";
      if (c.negated) s.remove_prefix(1);
      c.demanded = !s.empty() && s.front() == '=';
      if (c.fallback) {
        s.remove_prefix(1);
      } else if (!c.demanded) {
        if (s.substr(0, 2) != ":=") wrong("'=' or ':=' expected in {" + c.attribute);
        s.remove_prefix(1);
      }
      s.remove_prefix(1);
      s = trimmed(s);
      value(s, c);
      while (!s.empty() && s.front() == '|') {
        s.remove_prefix(1);
        value(s, c);
      }
      check_attribute(out, c.attribute);
      out.constraints.push_back(std::move(c));
      s = trimmed(s);
      if (!s.empty() && s.front() == ',') s.remove_prefix(1);
    }
    if (s.empty()) wrong("'}' expected");
    s.remove_prefix(1);
  }

  void check_attribute(const Step& s, const std::string& attribute) const {
    const auto dot = attribute.find('.');
    const std::string bare = dot == std::string::npos ? attribute : attribute.substr(dot + 1);
    if (s.entities.empty()) {
      if (bare != "name" && bare != "description") wrong("a step with {" + attribute + "} needs an entity");
      return;
    }
    for (const EntityId e : s.entities) {
      if (schema_.position(e, bare)) return;
    }
    wrong(std::string(schema_.keyword(s.entities.front())) + " has no attribute " + attribute);
  }

  void value(std::string_view& s, Constraint& c) const {
    if (s.empty()) wrong("a value expected");
    if (s.front() == '#') {
      s.remove_prefix(1);
      c.kind = Constraint::Kind::kOrdinal;
    } else if (s.substr(0, 2) == "$d") {
      s.remove_prefix(2);
      c.kind = Constraint::Kind::kDescription;
    } else if (s.front() == '@') {
      s.remove_prefix(1);
      c.kind = Constraint::Kind::kShared;
      c.texts.emplace_back(name_of(s));
    } else {
      std::size_t n = 0, depth = 0;
      bool quoted = false;
      while (n < s.size()) {
        const char ch = s[n];
        if (ch == '\'') quoted = !quoted;
        if (!quoted && ch == '(') ++depth;
        if (!quoted && depth == 0 && (ch == ',' || ch == '}' || ch == '|' || ch == ' ')) break;
        if (!quoted && ch == ')') --depth;
        ++n;
      }
      c.texts.emplace_back(s.substr(0, n));
      s.remove_prefix(n);
    }
  }

  Mapping& out_;
  const express::Dictionary& schema_;
  std::map<std::string, Macro, std::less<>> macros_;
  std::map<std::string, std::uint32_t> interned_;
  std::string place_, prefix_, own_;
};

Mapping::Mapping(std::span<const std::pair<std::string, std::string>> tables) {
  Parser parser(*this);
  for (const auto& [name, text] : tables) parser.table(name, text);
  index();
}

}  // namespace capstan::exchange::ap238
