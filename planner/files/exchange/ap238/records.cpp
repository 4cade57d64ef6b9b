#include "planner/files/exchange/ap238/records.h"

#include <algorithm>
#include <charconv>

#include "planner/files/exchange/ap238/tables/addresses.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Unit;
using p21::Kind;
using p21::Value;

namespace {

constexpr std::string_view kPrefix = "capstan ";
constexpr std::string_view kNumber = "number";

std::string upper(std::string_view s) {
  std::string out(s);
  for (char& c : out) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
  return out;
}

/// Fields by name: "depends on[2]", "rejected[1].why", "solid[1].corner[2].x" in lists, counted from 1.
class NamedFields : public RecordFields {
 public:
  void group() override { levels_.emplace_back(); }
  void element(std::size_t i) override {
    levels_.back().prefix = levels_.back().list + "[" + std::to_string(i + 1) + "]";
  }
  void end() override { levels_.pop_back(); }

 protected:
  struct Level {
    std::string list, prefix;
  };
  [[nodiscard]] std::string full(std::string_view name) const {
    for (auto it = levels_.rbegin(); it != levels_.rend(); ++it) {
      if (it->prefix.empty()) continue;
      return name.empty() ? it->prefix : it->prefix + "." + std::string(name);
    }
    return std::string(name);
  }
  std::vector<Level> levels_;
};

// --- writing ---

class PropertyFields final : public NamedFields {
 public:
  PropertyFields(Writer& w, const Addresses& addresses, AnyRef executable, Id representation)
      : w_(w), addresses_(addresses), executable_(executable), representation_(representation) {}

  void text(std::string_view name, std::string& v) override {
    if (!v.empty()) item(w_.description(quoted(name), v));
  }
  void real(std::string_view name, Unit unit, double& v) override {
    item(unit == Unit::kNone ? w_.description(quoted(name), shortest(v))
                             : w_.measure(v, unit, quoted(name), {}));
  }
  void optional_real(std::string_view name, Unit unit, std::optional<double>& v) override {
    if (v) real(name, unit, *v);
  }
  void whole(std::string_view name, int& v) override { item(w_.measure(v, Unit::kNone, quoted(name), {})); }
  void truth(std::string_view name, bool& v) override {
    if (v) item(w_.description(quoted(name), "true"));
  }
  std::string object(std::string_view name, AnyRef& v) override {
    std::string address = addresses_.from(executable_, v);
    text(name, address);
    return address;
  }
  void decision(std::string_view name, model::DecisionKey& v) override {
    const std::string address = addresses_.from(executable_, v.object);
    std::string key = address.empty() ? v.attribute : address + "." + v.attribute;
    text(name, key);
  }
  void reason(model::Reason& v) override {
    if (v == w_.plan().ledger.reason(0)) return;
    text("reason", v.id);
    text("reason text", v.text);
    text("reason source", v.source);
  }
  std::size_t list(std::string_view name, std::size_t n) override {
    levels_.push_back({full(name), ""});
    return n;
  }

 private:
  [[nodiscard]] std::string quoted(std::string_view name) const { return "'" + full(name) + "'"; }
  void item(Id id) { w_.link(representation_, "items", id); }

  Writer& w_;
  const Addresses& addresses_;
  AnyRef executable_;
  Id representation_;
};

// --- reading ---

class ItemFields final : public NamedFields {
 public:
  ItemFields(Reader& r, const Addresses& addresses, AnyRef executable, const std::vector<Node>& items)
      : r_(r), addresses_(addresses), executable_(executable) {
    for (const Node n : items) {
      const Value name = r.graph().get(n, "representation_item.name");
      if (name.is(Kind::kString)) items_.emplace(name.as_text(), n);
    }
  }

  void text(std::string_view name, std::string& v) override {
    v = find(name) == kNoNode ? "" : said(find(name));
  }
  void real(std::string_view name, Unit unit, double& v) override {
    std::optional<double> x;
    optional_real(name, unit, x);
    if (!x) throw MalformedRecord{};
    v = *x;
  }
  void optional_real(std::string_view name, Unit unit, std::optional<double>& v) override {
    const Node n = find(name);
    if (n == kNoNode) return;
    v = unit == Unit::kNone ? parse_double(said(n)) : r_.measure(n, unit, Scale{});
    if (!v) throw MalformedRecord{};
  }
  void whole(std::string_view name, int& v) override {
    constexpr double kMost = 1e6;
    const Node n = find(name);
    const auto x = n == kNoNode ? std::nullopt : r_.measure(n, Unit::kNone, Scale{});
    if (!x || !(*x >= -kMost && *x <= kMost)) throw MalformedRecord{};
    v = static_cast<int>(*x);
  }
  void truth(std::string_view name, bool& v) override {
    v = find(name) != kNoNode && said(find(name)) == "true";
  }
  std::string object(std::string_view name, AnyRef& v) override {
    std::string address;
    text(name, address);
    v = addresses_.find(executable_, address);
    return address;
  }
  void decision(std::string_view name, model::DecisionKey& v) override {
    std::string key;
    text(name, key);
    const auto dot = key.rfind('.');
    const auto address = dot == std::string::npos ? std::string_view() : std::string_view(key).substr(0, dot);
    v = {addresses_.find(executable_, address), dot == std::string::npos ? key : key.substr(dot + 1)};
  }
  void reason(model::Reason& v) override {
    v = r_.plan().ledger.reason(0);
    if (find("reason") == kNoNode && find("reason text") == kNoNode) return;
    text("reason", v.id);
    text("reason text", v.text);
    text("reason source", v.source);
  }
  std::size_t list(std::string_view name, std::size_t) override {
    levels_.push_back({full(name), ""});
    const std::string begin = levels_.back().list + "[";
    std::size_t n = 0;
    for (auto it = items_.lower_bound(begin); it != items_.end() && it->first.rfind(begin, 0) == 0; ++it) {
      std::size_t k = 0;
      std::from_chars(it->first.data() + begin.size(), it->first.data() + it->first.size(), k);
      n = std::max(n, k);
    }
    if (n > items_.size()) throw MalformedRecord{};
    return n;
  }

 private:
  [[nodiscard]] Node find(std::string_view name) const {
    const auto it = items_.find(full(name));
    return it == items_.end() ? kNoNode : it->second;
  }
  [[nodiscard]] std::string said(Node n) const {
    const Value v = r_.graph().get(n, "description");
    if (!v.is(Kind::kString)) throw MalformedRecord{};
    return v.as_text();
  }

  Reader& r_;
  const Addresses& addresses_;
  AnyRef executable_;
  std::map<std::string, Node> items_;
};

/// An operation that its feature does not list (placement.h). ISO 14649 and JSON have the list itself.
constexpr std::string_view kUnlisted = "UNLISTED_OPERATION";

void describe(RecordFields& f, Unlisted& u) {
  f.object("feature", u.feature);
  f.object("operation", u.operation);
}

bool is_kind(std::string_view kind) {
  static constexpr std::string_view kKinds[] = {"MACHINE",  "MATERIAL", "STOCK",        "CUTTER",
                                                "SETUP",    "STEP",     "UNPLANNED",    "PROVENANCE",
                                                "IDENTITY", "BINDING",  "MACHINE_DATA", kUnlisted};
  return std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
}

// Of what a list of the plan is made, in its order.
bool is_numbered(std::string_view kind) {
  return kind == "CUTTER" || kind == "SETUP" || kind == "STEP" || kind == "UNPLANNED" || kind == "PROVENANCE";
}

}  // namespace

Records::Records(Reader& reader) : reader_(reader) {
  const Graph& g = reader.graph();
  const auto entity = [&](const char* keyword) { return g.schema().find(keyword); };
  for (Node n = 0; n < g.size(); ++n) {
    if (!g.is(n, entity("MACHINING_PROCESS_PROPERTY"))) continue;
    const Value name = g.get(n, "name");
    if (!name.is(Kind::kString) || name.as_text().rfind(kPrefix, 0) != 0) continue;
    Found record{.kind = upper(name.as_text().substr(kPrefix.size())), .property = n, .items = {}};
    if (!is_kind(record.kind))
      continue;  // another program's, or a later version's: a property like any other
    reader.claim(n);
    for (const Node link : g.users(n)) {
      if (!g.is(link, entity("ACTION_PROPERTY_REPRESENTATION"))) continue;
      reader.claim(link);
      std::vector<Node> representations;
      g.references(g.get(link, "representation"), representations);
      for (const Node r : representations) {
        reader.claim(r);
        g.references(g.get(r, "items"), record.items);
        std::vector<Node> context;
        g.references(g.get(r, "context_of_items"), context);
        for (const Node c : context) (void)reader.units().scale(c, Scale{});  // known as such, not kept
      }
    }
    for (const Node item : record.items) {
      reader.claim(item);
      std::vector<Node> units;
      g.references(g.get(item, "unit_component"), units);
      for (const Node u : units) (void)reader.units().unit(u);  // and known as a unit, not kept
      const Value what = g.get(item, "representation_item.name");
      if (!what.is(Kind::kString) || what.as_text() != kNumber) continue;
      record.number = reader.measure(item, Unit::kNone, Scale{}).value_or(0.0);
    }
    found_.push_back(std::move(record));
  }
  std::stable_sort(found_.begin(), found_.end(),
                   [](const auto& a, const auto& b) { return a.number < b.number; });
}

void Records::restore(bool sealed) {
  if (found_.empty()) return;
  model::Plan& plan = reader_.plan();
  const Graph& g = reader_.graph();
  const Addresses addresses(plan, [&](AnyRef at) { return plan.model.origin(at).instance; });
  std::vector<Unlisted> unlisted;
  for (const Found& record : found_) {
    const std::string label = std::string(kPrefix) + lower_text(record.kind);
    const auto say = [&](Severity s, std::string code, std::string message) {
      reader_.about(record.property, {.code = std::move(code), .severity = s, .message = std::move(message)});
    };
    const Value definition = g.get(record.property, "definition");
    const Node on = definition.is(Kind::kReference) ? g.find(definition.reference()) : kNoNode;
    const AnyRef executable = on == kNoNode ? AnyRef{} : reader_.noun_at(on, model::TypeId::kExecutable);
    try {
      ItemFields fields(reader_, addresses, executable, record.items);
      if (record.kind == kUnlisted) {
        describe(fields, unlisted.emplace_back());
        continue;
      }
      restore_record(record.kind, label, fields, plan, sealed, say);
    } catch (const MalformedRecord&) {
      say(Severity::kWarning, "EXC-RECORD", "'" + label + "' is malformed; ignored");
    }
  }
  settle_edits(plan, reader_.reporter());
  restore_unlisted(unlisted);
}

// The feature or the operation is gone if its address leads nowhere: then nothing has to be left out.
void Records::restore_unlisted(const std::vector<Unlisted>& unlisted) {
  model::Model& m = reader_.plan().model;
  for (const Unlisted& u : unlisted) {
    if (m.get<model::ManufacturingFeature>(u.feature) == nullptr || !u.operation.set()) continue;
    std::erase(m.at<model::ManufacturingFeature>(u.feature).its_operations.items, u.operation);
  }
}

void write_records(Writer& w, const std::vector<Unlisted>& unlisted) {
  const Addresses addresses(w.plan(), [&](AnyRef at) { return w.written(at); });
  std::map<std::string, int, std::less<>> counts;
  RecordSink sink;
  sink.enabled = false;  // an attribute of executables here
  sink.order = [&](AnyRef at) {
    const AnyRef on = addresses.executable(at);
    return on.set() && w.written(on) != kNoId && !w.is_lost(at) ? addresses.order(at) : 0;
  };
  sink.record = [&](std::string_view kind, AnyRef about, const std::function<void(RecordFields&)>& describe) {
    const AnyRef on = addresses.executable(about);
    const Id executable = on.set() ? w.written(on) : kNoId;
    if (executable == kNoId) return w.lose("a record of the plan, without a main workplan,");
    const std::string name = "'" + std::string(kPrefix) + lower_text(kind) + "'";
    const Id property = w.make("machining_process_property");
    w.set(property, "name", name);
    w.link(property, "definition", executable);
    const Id representation = w.make("representation");
    w.set(representation, "name", name);
    w.link(representation, "context_of_items", w.shared("no_units"));
    const Id link = w.make("action_property_representation");
    w.link(link, "property", property);
    w.link(link, "representation", representation);
    PropertyFields fields(w, addresses, on, representation);
    if (is_numbered(kind)) {
      int number = ++counts[std::string(kind)];
      fields.whole(kNumber, number);
    }
    describe(fields);
  };
  write_plan_records(w.plan(), w.model(), sink);
  for (Unlisted u : unlisted) {
    if (sink.order(u.feature) != 0 && sink.order(u.operation) != 0)
      sink.record(kUnlisted, u.feature, [&](RecordFields& f) { describe(f, u); });
  }
}

}  // namespace capstan::exchange::ap238
