#include <algorithm>
#include <cmath>

#include "planner/files/exchange/ap238/codecs/codecs.h"
#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/common/text.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;
using p21::Kind;
using p21::Value;

namespace {

Value bare(const Value& v) { return v.is(Kind::kTyped) ? v[0] : v; }

// A kept instance that is found because it refers to us is written with its own way here.
bool says_itself(const Row& row, AnyRef to) {
  return to.type == TypeId::kKeptInstance && !row.steps.empty() && row.steps.back().inverse;
}

bool same(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::string Reader::description(Node n) const {
  Value v = g_.get(n, "description");
  if (!v.is(Kind::kString)) v = g_.get(n, "name");
  return v.is(Kind::kString) ? v.as_text() : std::string();
}

std::optional<double> Reader::measure(Node n, model::Unit unit, const Scale& scale) {
  const Value v = bare(g_.get(n, "value_component"));
  if (v.is(Kind::kOmitted)) return std::nullopt;
  const auto wrong = [&](const std::string& what, const std::string& expected) -> std::optional<double> {
    about(n, {.code = "EXC-VALUE",
              .severity = Severity::kWarning,
              .message = "the measure " + what + "; left unset",
              .expected = expected});
    return std::nullopt;
  };
  if (!v.is_number()) return wrong("is not a number: " + spelling(v), "a number");
  double factor = 1.0;
  const Value u = g_.get(n, "unit_component");
  if (u.is(Kind::kReference)) {
    const Node at = g_.find(u.reference());
    const auto of = at == kNoNode ? std::nullopt : units_.unit(at);
    const auto f = of ? Units::factor(*of, unit) : std::nullopt;
    if (!f) {
      return wrong("has a unit (#" + std::to_string(u.reference()) + ") that does not measure what it should",
                   "a unit that can be turned into " + std::string(model::symbol(unit)));
    }
    factor = *f;
  } else if (unit == model::Unit::kLength) {
    factor = scale.length;
  } else if (unit == model::Unit::kAngle) {
    factor = scale.angle;
  } else if (unit != model::Unit::kNone && unit != model::Unit::kRatio) {
    about(n, {.code = "EXC-UNIT",
              .severity = Severity::kWarning,
              .message =
                  "the measure " + spelling(v) + " has no unit; taken as " + std::string(model::symbol(unit)),
              .expected = "a unit that can be turned into " + std::string(model::symbol(unit))});
  }
  return finite(n, v.as_real(), factor, "the measure");
}

std::optional<double> Reader::finite(Node n, double value, double factor, std::string_view what) const {
  const double x = value * factor;
  if (std::isfinite(x)) return x;
  about(n, {.code = "EXC-VALUE",
            .severity = Severity::kWarning,
            .message = std::string(what) + " is not finite in the unit of the plan; left unset",
            .expected = "a finite number"});
  return std::nullopt;
}

std::optional<std::int64_t> Reader::integer(Node n, double value, std::string_view what) const {
  if (std::abs(value) <= kExactWhole) return std::llround(value);
  about(n, {.code = "EXC-VALUE",
            .severity = Severity::kWarning,
            .message = std::string(what) + " cannot be " + shortest(value) + "; left unset",
            .expected = "an integer"});
  return std::nullopt;
}

bool Reader::assign(const Row& row, AnyRef at, const Attribute& a, std::vector<Terminal>& found) {
  if (!row.codec.empty()) {
    const Codec* codec = find_codec(row.codec);
    if (codec == nullptr) throw std::logic_error(row.place + ": no codec " + row.codec);
    if (!codec->read(*this, row, at, a, found)) return false;
    for (const Terminal& t : found) mark(t, at);
    return true;
  }
  switch (a.storage) {
    case Storage::kRefList:
    case Storage::kRealList:
    case Storage::kIntegerList:
    case Storage::kTextList:
    case Storage::kSelectList:
      list(row, at, a, found);
      return true;
    default:
      for (const Terminal& t : found) {
        if (!scalar(row, at, a, t)) continue;
        if (a.storage != Storage::kRef ||
            !says_itself(row, *static_cast<AnyRef*>(a.at(plan_.model.object(at)))))
          mark(t, at);
        say_twice(at, a, t, found);
        return true;
      }
      // A measure without a value is there and says nothing.
      for (const Terminal& t : found) {
        if (a.storage == Storage::kReal && bare(g_.get(t.node, "value_component")).is(Kind::kOmitted))
          mark(t, at);
      }
      return false;
  }
}

// Two that contradict each other are a fault of the file; which is meant cannot be known.
void Reader::say_twice(AnyRef at, const Attribute& a, const Terminal& taken,
                       const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    if (t.node == taken.node || g_.entity(t.node) != g_.entity(taken.node)) continue;
    if (spelling_of(t.node) == spelling_of(taken.node) && a.storage != Storage::kRef) continue;
    if (spelling_of(t.node).substr(0, spelling_of(t.node).find('(', 1)) !=
        spelling_of(taken.node).substr(0, spelling_of(taken.node).find('(', 1)))
      continue;  // complex instances of other kinds
    about(taken.node, {.code = "EXC-TWICE",
                       .severity = Severity::kWarning,
                       .message = attribute_name(at, a.name) + " is given more than once, here and as #" +
                                  std::to_string(g_.instance(t.node).id()) + "; this one is taken"});
    return;
  }
}

std::string Reader::spelling_of(Node n) const {
  std::string out;
  const auto i = g_.instance(n);
  for (std::size_t k = 0; k < i.part_count(); ++k)
    out += std::string(i.part(k).keyword) + spelling(i.part(k).parameters);
  return out;
}

bool Reader::scalar(const Row& row, AnyRef at, const Attribute& a, const Terminal& t) {
  const auto slot = [&]<class T>(T value) {
    *static_cast<T*>(a.at(plan_.model.object(at))) = std::move(value);
    return true;
  };
  const bool text = !row.value_of.empty();
  switch (a.storage) {
    case Storage::kReal: {
      if (text && !bare(t.text).is_number()) return false;
      const auto x = text ? finite(t.node, bare(t.text).as_real(), 1.0, attribute_name(at, a.name))
                          : measure(t.node, a.unit, t.scale);
      return x && slot(model::Real(*x));
    }
    case Storage::kInteger: {
      if (text && !bare(t.text).is_number()) return false;
      const auto x =
          text ? std::optional(bare(t.text).as_real()) : measure(t.node, model::Unit::kNone, t.scale);
      const auto whole = x ? integer(t.node, *x, attribute_name(at, a.name)) : std::nullopt;
      return whole && slot(model::Integer(*whole));
    }
    case Storage::kText:
      if (text) return t.text.is(Kind::kString) && slot(model::Text(t.text.as_text()));
      return slot(model::Text(description(t.node)));
    case Storage::kBoolean:
    case Storage::kEnum: {
      if (text && t.text.is(Kind::kEnumeration) && a.storage == Storage::kBoolean) {
        return slot(model::Boolean(t.text.enumeration() == "T"));
      }
      const std::string s = !text                           ? description(t.node)
                            : t.text.is(Kind::kString)      ? t.text.as_text()
                            : t.text.is(Kind::kEnumeration) ? "." + std::string(t.text.enumeration()) + "."
                                                            : "";
      if (text && s.empty()) return false;
      for (std::size_t i = 0; i < row.texts.size(); ++i) {
        if (!same(row.texts[i], s)) continue;
        if (a.storage == Storage::kBoolean) return slot(model::Boolean(i == 0));
        return slot(model::AnyEnum{static_cast<std::int8_t>(i)});
      }
      const bool run = a.name == "enabled";  // what is not surely enabled must not run
      about(t.node, {.code = "EXC-VALUE",
                     .severity = Severity::kWarning,
                     .message = attribute_name(at, a.name) + " cannot be '" + s + "'; " +
                                (run ? "taken as disabled" : "left unset")});
      return run && slot(model::Boolean(false));
    }
    case Storage::kRef: {
      const AnyRef to = object_at(t.node, a.targets, t.scale);
      return to.set() && slot(to);
    }
    case Storage::kSelect: {
      model::SelectValue v;
      select(row, a, t, v);
      return v.set() && slot(v);
    }
    default:
      throw std::logic_error(row.place + ": needs a codec");
  }
}

void Reader::select(const Row& row, const Attribute& a, const Terminal& t, model::SelectValue& out) {
  if (g_.get(t.node, "value_component").is(Kind::kTyped) ||
      g_.get(t.node, "unit_component").is(Kind::kReference)) {
    if (const auto x =
            measure(t.node, a.unit == model::Unit::kNone ? model::Unit::kRatio : a.unit, t.scale)) {
      out.real = *x;
      out.type =
          row.texts.empty() ? std::string(g_.get(t.node, "value_component").keyword()) : row.texts.front();
    }
  } else if (g_.is(t.node, g_.schema().find("DESCRIPTIVE_REPRESENTATION_ITEM"))) {
    std::string s = description(t.node);
    for (char& c : s) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
    // An enumerator of a select is written without quotes: it must be a name.
    const bool name = std::all_of(s.begin(), s.end(), [](char c) {
      return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (name && !s.empty()) {
      out.text = s;
    } else {
      about(t.node,
            {.code = "EXC-VALUE",
             .severity = Severity::kWarning,
             .message = std::string(a.name) + " cannot be '" + description(t.node) + "'; left unset"});
    }
  } else {
    out.ref = object_at(t.node, a.targets, t.scale);
  }
}

void Reader::list(const Row& row, AnyRef at, const Attribute& a, const std::vector<Terminal>& found) {
  void* slot = a.at(plan_.model.object(at));
  for (const Terminal& t : found) {
    bool done = false;
    switch (a.storage) {
      case Storage::kRefList: {
        const AnyRef to = object_at(t.node, a.targets, t.scale);
        slot = a.at(plan_.model.object(at));
        auto& out = *static_cast<model::AnyRefList*>(slot);
        out.given = true;
        out.items.push_back(to);
        done = !says_itself(row, to);
        break;
      }
      case Storage::kRealList:
        if (const auto x = measure(t.node, a.unit, t.scale)) {
          auto& out = *static_cast<model::RealList*>(slot);
          out.given = true;
          out.items.push_back(*x);
          done = true;
        }
        break;
      case Storage::kIntegerList:
        if (const auto x = measure(t.node, model::Unit::kNone, t.scale)) {
          const auto whole = integer(t.node, *x, attribute_name(at, a.name));
          if (!whole) break;
          auto& out = *static_cast<model::IntegerList*>(slot);
          out.given = true;
          out.items.push_back(*whole);
          done = true;
        }
        break;
      case Storage::kTextList: {
        auto& out = *static_cast<model::TextList*>(slot);
        out.given = true;
        out.items.push_back(row.value_of.empty() ? description(t.node)
                                                 : (t.text.is(Kind::kString) ? t.text.as_text() : ""));
        done = true;
        break;
      }
      case Storage::kSelectList: {
        model::SelectValue v;
        select(row, a, t, v);
        auto& out = *static_cast<model::SelectList*>(a.at(plan_.model.object(at)));
        out.given = true;
        out.items.push_back(std::move(v));
        done = true;
        break;
      }
      default:
        break;
    }
    if (done) mark(t, at);
  }
}

}  // namespace capstan::exchange::ap238
