#include <charconv>
#include <optional>
#include <stdexcept>

#include "planner/files/exchange/conformance/rules.h"

namespace capstan::exchange::conformance {
namespace {

using express::EntityId;

[[noreturn]] void malformed(std::string_view line) {
  throw std::logic_error("malformed line in the table of rules: " + std::string(line));
}

// Words and 'quoted texts' of a line.
class Line {
 public:
  Line(std::string_view line, const express::Dictionary& dictionary)
      : dictionary_(dictionary), line_(line), rest_(line) {
    skip();
  }
  bool done() const { return rest_.empty(); }
  bool quoted() const { return !done() && rest_.front() == '\''; }
  std::string_view peek() const { return rest_.substr(0, rest_.find(' ')); }
  std::string_view word() {
    if (done() || quoted()) malformed(line_);
    const auto w = peek();
    rest_.remove_prefix(w.size());
    skip();
    return w;
  }
  bool take(std::string_view w) {
    if (done() || quoted() || peek() != w) return false;
    word();
    return true;
  }
  std::string text() {
    if (!quoted()) malformed(line_);
    const auto end = rest_.find('\'', 1);
    if (end == std::string_view::npos) malformed(line_);
    std::string t(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    skip();
    return t;
  }
  Names texts() {
    Names out;
    while (quoted()) out.push_back(text());
    return out;
  }
  EntityId entity() {
    const EntityId e = dictionary_.find(word());
    if (e == express::kNoEntity) malformed(line_);
    return e;
  }
  // One or more.
  std::vector<EntityId> entities() {
    std::vector<EntityId> out{entity()};
    while (!done() && !quoted() && dictionary_.find(peek()) != express::kNoEntity) out.push_back(entity());
    return out;
  }
  std::string_view line() const { return line_; }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }
  const express::Dictionary& dictionary_;
  std::string_view line_, rest_;
};

std::optional<std::size_t> number(std::string_view s) {
  std::size_t n = 0;
  const auto [end, fault] = std::from_chars(s.data(), s.data() + s.size(), n);
  if (fault != std::errc() || end != s.data() + s.size()) return std::nullopt;
  return n;
}

// "1", "0..1", "1..*"; false when the word is something else.
bool count(std::string_view word, Rule& rule) {
  const auto dots = word.find("..");
  const auto least = number(word.substr(0, dots));
  if (!least) return false;
  rule.least = *least;
  rule.most = *least;
  if (dots == std::string_view::npos) return true;
  const auto most = number(word.substr(dots + 2));
  rule.most = most ? *most : std::numeric_limits<std::size_t>::max();
  return true;
}

class Reader {
 public:
  explicit Reader(const express::Dictionary& dictionary) : dictionary_(dictionary) {}

  std::vector<Rule> run(std::string_view table) {
    std::vector<Rule> out;
    Rule head;
    while (!table.empty()) {
      const std::string_view line = table.substr(0, table.find('\n'));
      table.remove_prefix(std::min(line.size() + 1, table.size()));
      if (line.empty() || line.front() == '#') continue;
      Line l(line, dictionary_);
      if (line.front() != ' ') {
        head = header(l);
        continue;
      }
      out.push_back(rule(l, head));
      if (!l.done()) malformed(line);
    }
    return out;
  }

 private:
  static Rule header(Line& l) {
    Rule head;
    if (!l.take("for")) malformed(l.line());
    head.entity = l.entity();
    if (l.take("if")) {
      do {
        Guard g{std::string(l.word()), {}};
        g.values = l.texts();
        head.guards.push_back(std::move(g));
      } while (l.take("and"));
    }
    if (l.take("unless")) head.unless = l.entities();
    if (!l.done()) malformed(l.line());
    return head;
  }

  Form form(Line& l, const Rule& rule) const {
    Form f;
    if (!l.take("as")) return f;
    while (!l.done()) {
      const std::string_view word = l.word();
      if (!f.text.empty()) f.text += " ";
      f.text += word;
      if (word == "length" || word == "angle" || word == "time" || word == "ratio") {
        const std::string measure =
            (word == "angle" ? "plane_angle" : std::string(word)) + "_measure_with_unit";
        f.item = {dictionary_.find("measure_representation_item"), dictionary_.find(measure)};
      } else if (word == "count") {
        f.value = Form::Value::kCount;
      } else if (word == "number") {
        f.value = Form::Value::kNumber;
      } else if (word == "text") {
        f.value = Form::Value::kText;
        f.texts = l.texts();
        for (const auto& t : f.texts) f.text += " '" + t + "'";
      } else if (word == "item") {
        f.item = l.entities();
        spell(f.item, f.text);
      } else if (word == "representation") {
        f.representation = l.entities();
        spell(f.representation, f.text);
      } else if (word == "named") {
        f.named = l.texts();
        for (const auto& t : f.named) f.text += " '" + t + "'";
      } else if (word == "unit") {
        f.unit = l.word();
        f.text += " " + f.unit;
      } else if (word == "to") {
        f.to = l.entities();
        spell(f.to, f.text);
      } else if (rule.subject == Subject::kAction) {
        f.to = {dictionary_.find(word)};
        if (f.to.front() == express::kNoEntity) malformed(l.line());
      } else {
        malformed(l.line());
      }
    }
    return f;
  }

  void spell(const std::vector<EntityId>& entities, std::string& text) const {
    for (const EntityId e : entities) text.append(" ").append(dictionary_.keyword(e));
  }

  Rule rule(Line& l, const Rule& head) const {
    Rule r = head;
    if (count(l.peek(), r)) l.word();
    const std::string_view word = l.word();
    if (word == "description" || word == "name" || word == "purpose" || word == "consequence") {
      r.attribute = word;
      r.names = l.texts();
    } else if (word == "parameters") {
      r.subject = Subject::kParameters;
      if (l.take("named"))
        r.names = l.texts();
      else if (!count(l.word(), r))
        malformed(l.line());
    } else if (word == "shape") {
      r.subject = Subject::kShape;
      r.type = l.entity();
      r.names = l.texts();
    } else if (word == "method") {
      r.subject = Subject::kMethod;
      r.type = l.entity();
      r.names = l.texts();
    } else if (word == "tools") {
      r.subject = Subject::kTools;
      r.type = dictionary_.find("machining_tool");
    } else if (word == "of" || word == "of_shape") {
      r.subject = word == "of" ? Subject::kOf : Subject::kOfShape;
      r.type = l.entity();
    } else if (word == "unit") {
      r.subject = Subject::kUnit;
      r.form.unit = l.word();
    } else if (word == "aspect") {
      aspect(l, r);
    } else {
      named(word, l, r);
    }
    if (r.subject != Subject::kUnit) r.form = form(l, r);
    return r;
  }

  static void named(std::string_view word, Line& l, Rule& r) {
    static constexpr struct {
      std::string_view word;
      Subject subject;
    } kSubjects[] = {{"property", Subject::kProperty},   {"resource", Subject::kResource},
                     {"tool", Subject::kTool},           {"item", Subject::kItem},
                     {"parameter", Subject::kParameter}, {"action", Subject::kAction}};
    for (const auto& s : kSubjects) {
      if (s.word != word) continue;
      r.subject = s.subject;
      r.names = l.texts();
      return;
    }
    malformed(l.line());
  }

  static void aspect(Line& l, Rule& r) {
    r.subject = Subject::kAspect;
    r.names = l.texts();
    if (!l.take("by")) malformed(l.line());
    r.type = l.entity();
    r.by = l.texts();
    if (l.take("name")) r.as_name = l.texts();
    if (!l.take("from")) malformed(l.line());
    r.from = l.entities();
    if (l.take("description")) r.component_description = l.texts();
  }

  const express::Dictionary& dictionary_;
};

}  // namespace

std::vector<Rule> read_rules(std::string_view table, const express::Dictionary& dictionary) {
  return Reader(dictionary).run(table);
}

}  // namespace capstan::exchange::conformance
