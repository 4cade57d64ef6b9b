#include "planner/door/app/show/condition.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/door/app/show/node.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Model;
using model::Storage;
using model::value_of;
using service::label;
using Compare = Condition::Compare;

namespace {

constexpr double kEqual =
    1e-9;  // default, unsourced: far above what units cost, far below what a shop measures

template <class T>
bool ordered(Compare how, const T& a, const T& b, bool equal) {
  switch (how) {
    case Compare::kEqual:
      return equal;
    case Compare::kNotEqual:
      return !equal;
    case Compare::kLess:
      return !equal && a < b;
    case Compare::kLessEqual:
      return equal || a < b;
    case Compare::kGreater:
      return !equal && b < a;
    case Compare::kGreaterEqual:
      return equal || b < a;
  }
  return false;
}

class Evaluator {
 public:
  Evaluator(const Model& m, const Query& q) : m_(m), q_(q) {}

  // Bounded by the parser's limit of depth.
  Result<bool> holds(AnyRef at, const Condition& c) {
    switch (c.kind) {
      case Condition::Kind::kOr:
      case Condition::Kind::kAnd: {
        const bool any = c.kind == Condition::Kind::kOr;
        bool out = !any;
        for (const Condition& part : c.parts) {
          const auto one = holds(at, part);  // each is looked at, so that each fault is found
          if (!one) return one;
          out = any ? out || *one : out && *one;
        }
        return out;
      }
      case Condition::Kind::kNot: {
        const auto one = holds(at, c.parts.front());
        if (!one) return one;
        return !*one;
      }
      default:
        break;
    }
    const auto places = operands(at, c);
    if (c.count) return counted(places, c);
    bool out = false;
    for (const Node& n : places) {
      const auto one = test(n, c);
      if (!one) return one;
      out = out || *one;
    }
    return out;
  }

  /// A fault if no object had an attribute that the condition names.
  std::optional<Diagnostic> nowhere() const {
    for (const auto& [position, name] : asked_) {
      if (had_.contains(position)) continue;
      return query_fault(q_.text, position, "no object here has an attribute '" + name + "'").value();
    }
    return std::nullopt;
  }

 private:
  std::vector<Node> operands(AnyRef at, const Condition& c) {
    Node self;
    self.object = at;
    std::vector<Node> nodes = {self};
    for (const OperandStep& step : c.operand) {
      std::vector<Node> next;
      for (const Node& n : nodes) {
        if (step.index) {
          if (*step.index < list_size(m_, n).value_or(0)) next.push_back(item_of(n, *step.index));
          continue;
        }
        for (const Node& item : items(n)) {
          const AnyRef object = object_of(m_, item);
          if (!object.set() || m_.holds<model::KeptInstance>(object)) continue;
          asked_.emplace(step.position, step.attribute);
          const auto* a = model::find_attribute(object.type, step.attribute);
          if (a == nullptr) continue;
          had_.insert(step.position);
          Node out;
          out.object = object;
          out.attribute = a;
          next.push_back(out);
        }
      }
      nodes = std::move(next);
    }
    return nodes;
  }

  // A list is replaced by its items.
  [[nodiscard]] std::vector<Node> items(const Node& n) const {
    const auto size = list_size(m_, n);
    if (!size) return {n};
    std::vector<Node> out;
    for (std::size_t i = 0; i < *size; ++i) {
      for (const Node& inner : items(item_of(n, i))) out.push_back(inner);
    }
    return out;
  }

  Result<bool> counted(const std::vector<Node>& places, const Condition& c) {
    if (c.kind != Condition::Kind::kCompare || !c.number)
      return wrong(c, "#size is compared with a number", "[its_operations#size > 0]");
    for (const Node& n : places) {
      const auto size = static_cast<double>(list_size(m_, n).value_or(0));
      if (ordered(c.compare, size, *c.number, size == *c.number)) return true;
    }
    return false;
  }

  Result<bool> test(const Node& n, const Condition& c) {
    if (c.kind == Condition::Kind::kHas)
      return n.attribute == nullptr || model::has_value(*n.attribute, m_.object(n.object));
    bool out = false;
    for (const Node& item : items(n)) {
      const AnyRef object = object_of(m_, item);
      if (c.kind == Condition::Kind::kIs) {
        out = out || (object.set() && model::is_a(object.type, c.type));
        continue;
      }
      if (object.set()) {
        return wrong(c, label(m_, object) + " is an object and cannot be compared",
                     "one of its attributes, or `is KEYWORD`");
      }
      const auto one = compared(item, c);
      if (!one) return one;
      out = out || *one;
    }
    return out;
  }

  Result<bool> compared(const Node& n, const Condition& c) {
    if (n.attribute == nullptr) return false;
    const auto& a = *n.attribute;
    const void* data = m_.object(n.object);
    if (!model::has_value(a, data)) return false;
    switch (a.storage) {
      case Storage::kReal:
        return number(*value_of<model::Real>(a, data), c);
      case Storage::kInteger:
        return number(static_cast<double>(*value_of<model::Integer>(a, data)), c);
      case Storage::kRealList:
        return number(value_of<model::RealList>(a, data).items[n.item[0]], c);
      case Storage::kIntegerList:
        return number(static_cast<double>(value_of<model::IntegerList>(a, data).items[n.item[0]]), c);
      case Storage::kRealTable:
        return number(value_of<model::RealTable>(a, data).items[n.item[0]][n.item[1]], c);
      case Storage::kText:
        return text(*value_of<model::Text>(a, data), c);
      case Storage::kTextList:
        return text(value_of<model::TextList>(a, data).items[n.item[0]], c);
      case Storage::kBoolean: {
        const std::string literal = lower_text(c.text);
        if (c.quoted || (literal != "true" && literal != "false"))
          return wrong(c, std::string(a.name) + " is true or false", "true or false");
        const bool same = *value_of<model::Boolean>(a, data) == (literal == "true");
        return equal_only(same, c, a);
      }
      case Storage::kEnum: {
        const std::string literal = lower_text(c.text);
        std::string all;
        bool known = false;
        for (const auto e : a.enumerators) {
          known = known || lower_text(e) == literal;
          all += (all.empty() ? "" : ", ") + lower_text(e);
        }
        if (!known) return wrong(c, std::string(a.name) + " is never '" + c.text + "'", all);
        const auto code = static_cast<std::size_t>(value_of<model::AnyEnum>(a, data).code);
        return equal_only(lower_text(a.enumerators[code]) == literal, c, a);
      }
      case Storage::kSelect:
      case Storage::kSelectList: {
        const auto& v = a.storage == Storage::kSelect ? value_of<model::SelectValue>(a, data)
                                                      : value_of<model::SelectList>(a, data).items[n.item[0]];
        if (v.real) return number(*v.real, c);
        return equal_only(lower_text(v.text) == lower_text(c.text), c, a);
      }
      default:
        return wrong(c, std::string(a.name) + " cannot be compared");
    }
  }

  Result<bool> number(double v, const Condition& c) {
    if (!c.number)
      return wrong(c, "a number is compared with '" + c.text + "'", "a number in the model's unit");
    const double scale = std::max({1.0, std::abs(v), std::abs(*c.number)});
    return ordered(c.compare, v, *c.number, std::abs(v - *c.number) <= kEqual * scale);
  }
  Result<bool> text(const std::string& v, const Condition& c) {
    if (!c.quoted) return wrong(c, "a text is compared with what is no text: " + c.text, "'" + c.text + "'");
    return ordered(c.compare, v, c.text, v == c.text);
  }
  Result<bool> equal_only(bool same, const Condition& c, const model::Attribute& a) {
    if (c.compare == Compare::kEqual) return same;
    if (c.compare == Compare::kNotEqual) return !same;
    return wrong(c, std::string(a.name) + " has no order", "= or !=");
  }

  Result<bool> wrong(const Condition& c, const std::string& message, std::string expected = {}) {
    return query_fault(q_.text, c.position, message, std::move(expected));
  }

  const Model& m_;
  const Query& q_;
  std::set<std::pair<std::size_t, std::string>> asked_;
  std::set<std::size_t> had_;
};

}  // namespace

Result<std::vector<AnyRef>> objects_where(const Model& m, const std::vector<AnyRef>& objects,
                                          const Query& query, const Condition& condition) {
  Evaluator evaluator(m, query);
  std::vector<AnyRef> out;
  for (const AnyRef at : objects) {
    const auto holds = evaluator.holds(at, condition);
    if (!holds) return tl::unexpected(holds.error());
    if (*holds) out.push_back(at);
  }
  if (auto fault = evaluator.nowhere()) return fail(*std::move(fault));
  return out;
}

}  // namespace capstan::app
