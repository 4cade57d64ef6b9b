#include "planner/files/exchange/iso14649/beyond.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "planner/files/exchange/records/instance_hashes.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/edited.h"

namespace capstan::exchange {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;
using p21::Kind;
using p21::Value;

namespace {

constexpr std::string_view kType = "!CAPSTAN_TYPE";
constexpr std::string_view kObject = "!CAPSTAN_OBJECT";
constexpr std::string_view kValue = "!CAPSTAN_VALUE";

using p21::quoted;

template <class List, class Show>
std::string listed(const List& items, const Show& show) {
  std::string out = "(";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i == 0 ? "" : ",") + show(items[i]);
  return out + ")";
}

std::string select_text(const model::SelectValue& v, const NameOf& name_of) {
  return "(" + quoted(v.ref.set() ? name_of(v.ref) : std::string()) + "," + quoted(v.type) + "," +
         (v.real ? part21_real(*v.real) : std::string("$")) + "," + quoted(v.text) + ")";
}

/// Nothing where it has no form here.
std::optional<std::string> value_text(const Attribute& a, const void* data, const NameOf& name_of) {
  const auto ref = [&](AnyRef r) { return quoted(name_of(r)); };
  switch (a.storage) {
    case Storage::kReal:
      return part21_real(*model::value_of<model::Real>(a, data));
    case Storage::kInteger:
      return std::to_string(*model::value_of<model::Integer>(a, data));
    case Storage::kBoolean:
      return *model::value_of<model::Boolean>(a, data) ? ".T." : ".F.";
    case Storage::kText:
      return quoted(*model::value_of<model::Text>(a, data));
    case Storage::kEnum:
      return quoted(a.enumerators[static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code)]);
    case Storage::kRef: {
      const std::string name = name_of(model::value_of<AnyRef>(a, data));
      return name.empty() ? std::nullopt : std::optional(quoted(name));
    }
    case Storage::kRefList: {
      const auto& items = model::value_of<model::AnyRefList>(a, data).items;
      const bool all = std::all_of(items.begin(), items.end(), [&](AnyRef r) { return !name_of(r).empty(); });
      return all ? std::optional(listed(items, ref)) : std::nullopt;
    }
    case Storage::kSelect: {
      const auto& v = model::value_of<model::SelectValue>(a, data);
      if (v.ref.set() && name_of(v.ref).empty()) return std::nullopt;
      return select_text(v, name_of);
    }
    case Storage::kRealList:
      return listed(model::value_of<model::RealList>(a, data).items, [](double v) { return part21_real(v); });
    case Storage::kIntegerList:
      return listed(model::value_of<model::IntegerList>(a, data).items,
                    [](std::int64_t v) { return std::to_string(v); });
    case Storage::kTextList:
      return listed(model::value_of<model::TextList>(a, data).items,
                    [](const std::string& s) { return quoted(s); });
    case Storage::kRefTable:
    case Storage::kRealTable:
    case Storage::kSelectList:
    case Storage::kPath:
      return std::nullopt;
  }
  return std::nullopt;
}

std::string text_of(const Value& v) {
  if (!v.is(Kind::kString)) throw MalformedRecord{};
  return v.as_text();
}

double real_of(const Value& v) {
  if (!v.is_number() || !std::isfinite(v.as_real())) throw MalformedRecord{};
  return v.as_real();
}

std::int64_t integer_of(const Value& v) {
  if (!v.is(Kind::kInteger)) throw MalformedRecord{};
  return v.as_integer();
}

Value list_of(const Value& v) {
  if (!v.is(Kind::kList)) throw MalformedRecord{};
  return v;
}

std::uint64_t number_in(std::string_view name, char sign) {
  std::uint64_t out = 0;
  if (name.size() < 2 || name.front() != sign) throw MalformedRecord{};
  const auto [end, ec] = std::from_chars(name.data() + 1, name.data() + name.size(), out);
  if (ec != std::errc() || end != name.data() + name.size()) throw MalformedRecord{};
  return out;
}

/// The instances that an entity names, each with whether it still says what it said.
struct Named {
  std::uint64_t number = 0;
  bool same = false;
};
std::vector<std::pair<std::uint64_t, std::string>> listed_in(const Value& v) {
  std::vector<std::pair<std::uint64_t, std::string>> out;
  const Value all = list_of(v);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Value one = list_of(all[i]);
    if (one.size() != 2) throw MalformedRecord{};
    out.emplace_back(number_in(text_of(one[0]), '#'), text_of(one[1]));
  }
  return out;
}

using Hashes = std::map<std::uint64_t, std::string>;

std::vector<Named> named_in(const Hashes& now, const Value& v) {
  std::vector<Named> out;
  for (const auto& [number, hash] : listed_in(v)) {
    const auto at = now.find(number);
    out.push_back({number, at != now.end() && at->second == hash});
  }
  return out;
}

/// The instances of `numbers` that a parameter refers to.

/// Whether all still say what they said; warns of the first that does not.
bool unchanged(Reading& r, const p21::Instance& entity, const std::vector<Named>& all,
               const std::string& what) {
  const auto other = std::find_if(all.begin(), all.end(), [](const Named& n) { return !n.same; });
  if (other == all.end()) return true;
  const auto instance = r.file.find(other->number);
  const std::string is =
      instance ? "is now another " + std::string(instance->is_complex() ? "instance" : instance->keyword())
               : "is gone";
  r.reporter.report({.code = std::string(model::kEditedCode),
                     .severity = Severity::kWarning,
                     .message = "the header keeps " + what + ", but #" + std::to_string(other->number) + " " +
                                is + ": it was edited or renumbered since; the header's " +
                                std::string(entity.keyword()) + " is ignored, state it anew",
                     .line = entity.line(),
                     .instance = other->number});
  return false;
}

template <class Do>
void each(const p21::File& file, std::string_view keyword, const Do& act) {
  for (std::size_t i = 0; i < file.header_count(); ++i) {
    const p21::Instance e = file.header(i);
    if (e.user_defined() && e.keyword() == keyword) act(e);
  }
}

void report_malformed(Reading& r, const p21::Instance& e) {
  r.reporter.report({.code = "EXC-RECORD",
                     .severity = Severity::kWarning,
                     .message = "the header's " + std::string(e.keyword()) + " is malformed; ignored",
                     .line = e.line()});
}

/// Hashes of the present content of the instances that the header's entities of a kind name.
Hashes hashes_now(const p21::File& file, std::string_view keyword, std::size_t place) {
  std::set<std::uint64_t> numbers;
  each(file, keyword, [&](const p21::Instance& e) {
    try {
      const Value p = list_of(e.parameters());
      if (p.size() != place + 1) return;
      for (const auto& [number, hash] : listed_in(p[place])) numbers.insert(number);
    } catch (const MalformedRecord&) {
      return;  // said where it is read
    }
  });
  return hashes_of(file, numbers);
}

class Beyond {
 public:
  explicit Beyond(Reading& r) : r_(r), now_(hashes_now(r.file, kValue, 3)) {}

  void run() {
    each(r_.file, kObject, [&](const p21::Instance& e) { guarded(e, [&](const Value& p) { object(p); }); });
    each(r_.file, kValue, [&](const p21::Instance& e) { guarded(e, [&](const Value& p) { value(e, p); }); });
  }

 private:
  template <class Do>
  void guarded(const p21::Instance& e, const Do& act) {
    try {
      act(list_of(e.parameters()));
    } catch (const MalformedRecord&) {
      report_malformed(r_, e);
    }
  }

  void object(const Value& p) {
    if (p.size() != 2 || number_in(text_of(p[0]), '&') != objects_.size() + 1) throw MalformedRecord{};
    const auto type = model::find_noun(text_of(p[1]));
    const bool sound = type && !model::noun_type(*type).abstract && *type != TypeId::kKeptInstance;
    objects_.push_back(sound ? r_.plan.model.add_object(*type) : AnyRef{});
    if (!sound) throw MalformedRecord{};
  }

  [[nodiscard]] AnyRef named(const Value& v) const {
    const std::string name = text_of(v);
    if (name.empty()) throw MalformedRecord{};
    if (name.front() == '#') {
      const std::uint64_t n = number_in(name, '#');
      const bool hashed =
          std::any_of(vouched_.begin(), vouched_.end(), [&](const Named& i) { return i.number == n; });
      if (!hashed) throw MalformedRecord{};
      return r_.find(n);
    }
    const std::uint64_t n = number_in(name, '&');
    return n >= 1 && n <= objects_.size() ? objects_[n - 1] : AnyRef{};
  }

  [[nodiscard]] AnyRef fitting(const Attribute& a, const Value& v) const {
    const AnyRef at = named(v);
    const bool fits = a.targets.empty() || std::any_of(a.targets.begin(), a.targets.end(),
                                                       [&](TypeId t) { return model::is_a(at.type, t); });
    if (!at.set() || !fits) throw MalformedRecord{};
    return at;
  }

  void value(const p21::Instance& e, const Value& p) {
    if (p.size() != 4) throw MalformedRecord{};
    vouched_ = named_in(now_, p[3]);
    const AnyRef at = named(p[0]);
    if (!at.set()) return;  // gone: so is what it said
    if (!unchanged(r_, e, vouched_, text_of(p[1]) + " of " + text_of(p[0]))) return;
    const Attribute* a = model::find_attribute(at.type, text_of(p[1]));
    const bool object = text_of(p[0]).front() == '&';
    if (a == nullptr || (a->in_iso14649 && !object)) throw MalformedRecord{};
    set(*a, a->at(r_.plan.model.object(at)), p[2]);
  }

  void set(const Attribute& a, void* slot, const Value& v) const {
    switch (a.storage) {
      case Storage::kReal:
        *static_cast<model::Real*>(slot) = real_of(v);
        break;
      case Storage::kInteger:
        *static_cast<model::Integer*>(slot) = integer_of(v);
        break;
      case Storage::kBoolean:
        if (!v.is(Kind::kEnumeration) || (v.enumeration() != "T" && v.enumeration() != "F"))
          throw MalformedRecord{};
        *static_cast<model::Boolean*>(slot) = v.enumeration() == "T";
        break;
      case Storage::kText:
        *static_cast<model::Text*>(slot) = text_of(v);
        break;
      case Storage::kEnum: {
        const auto at = std::find(a.enumerators.begin(), a.enumerators.end(), text_of(v));
        if (at == a.enumerators.end()) throw MalformedRecord{};
        static_cast<model::AnyEnum*>(slot)->code = static_cast<std::int8_t>(at - a.enumerators.begin());
        break;
      }
      case Storage::kRef:
        *static_cast<AnyRef*>(slot) = fitting(a, v);
        break;
      case Storage::kRefList:
        list(static_cast<model::AnyRefList*>(slot), v, [&](const Value& x) { return fitting(a, x); });
        break;
      case Storage::kSelect:
        *static_cast<model::SelectValue*>(slot) = select(a, list_of(v));
        break;
      case Storage::kRealList:
        list(static_cast<model::RealList*>(slot), v, real_of);
        break;
      case Storage::kIntegerList:
        list(static_cast<model::IntegerList*>(slot), v, integer_of);
        break;
      case Storage::kTextList:
        list(static_cast<model::TextList*>(slot), v, text_of);
        break;
      default:
        throw MalformedRecord{};
    }
  }

  template <class List, class Read>
  static void list(List* into, const Value& v, const Read& read) {
    const Value items = list_of(v);
    List out;
    out.given = true;
    for (std::size_t i = 0; i < items.size(); ++i) out.items.push_back(read(items[i]));
    *into = std::move(out);
  }

  [[nodiscard]] model::SelectValue select(const Attribute& a, const Value& v) const {
    if (v.size() != 4) throw MalformedRecord{};
    model::SelectValue out;
    if (!text_of(v[0]).empty()) out.ref = fitting(a, v[0]);
    out.type = text_of(v[1]);
    if (!v[2].is(Kind::kOmitted)) out.real = real_of(v[2]);
    out.text = text_of(v[3]);
    return out;
  }

  Reading& r_;
  Hashes now_;
  std::vector<AnyRef> objects_;
  std::vector<Named> vouched_;  // of the value being read
};

}  // namespace

bool can_be_kept(const model::Model& m, AnyRef at, const Attribute& a, const NameOf& name_of) {
  if (a.name == "persistent_id" || a.name == "enabled") return false;  // records say these
  return value_text(a, m.object(at), name_of).has_value();
}

std::string write_value(const model::Model& m, AnyRef at, const Attribute& a, const NameOf& name_of) {
  return std::string(kValue) + "(" + quoted(name_of(at)) + "," + quoted(a.name) + "," +
         value_text(a, m.object(at), name_of).value_or("$");
}

std::map<std::uint64_t, TypeId> kinds_beyond(Reading& r) {
  std::map<std::uint64_t, TypeId> out;
  const Hashes now = hashes_now(r.file, kType, 2);
  each(r.file, kType, [&](const p21::Instance& e) {
    try {
      const Value p = list_of(e.parameters());
      if (p.size() != 3) throw MalformedRecord{};
      const std::uint64_t number = number_in(text_of(p[0]), '#');
      const auto type = model::find_noun(text_of(p[1]));
      const auto all = named_in(now, p[2]);
      const bool hashed = all.size() == 1 && all.front().number == number;
      if (!hashed || !type || model::noun_type(*type).abstract) throw MalformedRecord{};
      if (!r.file.find(number)) return;  // gone: so is what it said
      if (unchanged(r, e, all, "that " + text_of(p[0]) + " is a " + text_of(p[1]))) out[number] = *type;
    } catch (const MalformedRecord&) {
      report_malformed(r, e);
    }
  });
  return out;
}

void read_beyond(Reading& reading) { Beyond(reading).run(); }

bool is_beyond(std::string_view keyword) {
  return keyword == kType || keyword == kObject || keyword == kValue;
}

}  // namespace capstan::exchange
