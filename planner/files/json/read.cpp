#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>

#include "planner/files/json/fields.h"
#include "planner/files/json/ids.h"
#include "planner/files/json/json.h"
#include "planner/files/json/printer.h"
#include "planner/files/json/seal.h"
#include "planner/files/json/summary.h"
#include "planner/ground/base/file.h"
#include "planner/model/nouns/arena/stand_in.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/contradicted.h"
#include "planner/model/plan/edited.h"
#include "planner/model/plan/step_ids.h"
#include "planner/model/plan/workplan_order.h"

namespace capstan::json {
namespace json {
namespace {

using model::AnyRef;
using model::Attribute;
using model::Plan;
using model::Storage;
using model::TypeId;
using Tree = nlohmann::json;

constexpr int kDeepest = 32;

// Where in the document; printed only when something is wrong there.
struct Place {
  const Place* up = nullptr;
  std::string_view name = {};
  std::size_t index = 0;
  [[nodiscard]] std::string text() const {
    if (up == nullptr) return {};
    return up->text() + "/" + (name.empty() ? std::to_string(index) : std::string(name));
  }
};

// Thrown and caught in this file only.
struct Fault {
  std::string place, expected;
};

[[noreturn]] void fault(const Place& at, std::string expected) {
  throw Fault{at.text(), std::move(expected)};
}

class Reader {
 public:
  Plan run(const Tree& tree) {
    const Place top;
    need_object(tree, top);
    known_keys(tree, top);
    make_objects(child(tree, "objects", top), {&top, "objects"});
    shared_columns(tree, "paths", paths_, top);
    shared_columns(tree, "schedules", schedules_, top);
    shared_columns(tree, "sections", sections_, top);
    fill_objects(child(tree, "objects", top), {&top, "objects"});
    FieldReader each{*this, tree, top};
    fields(each, plan_);
    ledger(tree, top);
    if (const auto it = tree.find("target_mesh"); it != tree.end()) {
      auto mesh = std::make_shared<geometry::Mesh>();
      get(*it, *mesh, {&top, "target_mesh"});
      plan_.target_mesh = std::move(mesh);
    }
    compare_seals(child(tree, "seals", top), {&top, "seals"});
    compare_derived(tree);
    return std::move(plan_);
  }

  /// What somebody edited since the file was written, part by part.
  [[nodiscard]] const std::vector<std::string>& edited() const { return edited_; }

 private:
  struct FieldReader {
    Reader& reader;
    const Tree& tree;
    const Place& at;
    template <class T>
    void operator()(const char* name, T& x) {
      const Place here{&at, name};
      const auto it = tree.find(name);
      if (it == tree.end()) {
        if constexpr (kIsOptional<T>) return;
        fault(here, "this field");
      }
      if constexpr (std::is_same_v<T, std::uint64_t>) {
        if (here.name == kHashField) return reader.hash(*it, x, here);
      }
      reader.get(*it, x, here);
    }
  };
  struct Names {
    std::vector<std::string_view> names;
    template <class T>
    void operator()(const char* name, const T&) {
      names.emplace_back(name);
    }
  };

  static void need_object(const Tree& t, const Place& at) {
    if (!t.is_object()) fault(at, "an object");
  }
  static void need_array(const Tree& t, const Place& at) {
    if (!t.is_array()) fault(at, "an array");
  }
  static const Tree& child(const Tree& t, std::string_view name, const Place& at) {
    const auto it = t.find(name);
    if (it == t.end()) fault({&at, name}, "this field");
    return *it;
  }
  static void only(const Tree& t, const std::vector<std::string_view>& names, const Place& at) {
    for (const auto& item : t.items()) {
      if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
        fault({&at, item.key()}, "no field of that name");
      }
    }
  }
  static void known_keys(const Tree& tree, const Place& at) {
    Names known;
    const Plan empty;
    fields(known, empty);
    for (const char* name : {"capstan_plan", "summary", "objects", "reasons", "decisions", "paths",
                             "schedules", "sections", "target_mesh", "seals"}) {
      known.names.emplace_back(name);
    }
    only(tree, known.names, at);
  }

  template <class T>
  void get(const Tree& t, T& x, const Place& at) {
    if constexpr (std::is_same_v<T, bool>) {
      if (!t.is_boolean()) fault(at, "true or false");
      x = t.get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      integer(t, x, at);
    } else if constexpr (std::is_floating_point_v<T>) {
      if (!t.is_number()) fault(at, "a number");
      x = t.get<double>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      x = unquoted_bytes(string(t, at));
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(spelled(string(t, at), spellings<T>(), at));
    } else if constexpr (std::is_base_of_v<AnyRef, T>) {
      reference(t, x, at);
      if constexpr (!std::is_same_v<T, AnyRef>) must_be(x, target_of(x), at);
    } else if constexpr (kIsOptional<T>) {
      x.emplace();
      get(t, *x, at);
    } else if constexpr (kIsShared<T>) {
      shared(t, x, at);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveKind>>) {
      letters(t, x, kMoveKinds, at);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveRole>>) {
      letters(t, x, kMoveRoles, at);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      sequence(t, x, at);
    } else {
      structure(t, x, at);
    }
  }

  template <class T>
  static TypeId target_of(const model::Ref<T>&) {
    return T::kType;
  }

  template <class T>
  static void integer(const Tree& t, T& x, const Place& at) {
    bool fits = t.is_number_integer();
    if (fits && t.is_number_unsigned()) {
      fits = t.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    } else if (fits) {
      const auto v = t.get<std::int64_t>();
      fits = std::is_signed_v<T> && v >= static_cast<std::int64_t>(std::numeric_limits<T>::min());
    }
    if (!fits) fault(at, "a whole number in range");
    x = t.get<T>();
  }

  static const std::string& string(const Tree& t, const Place& at) {
    if (!t.is_string()) fault(at, "a text");
    return t.get_ref<const std::string&>();
  }

  template <class Names>
  static std::size_t spelled(const std::string& text, const Names& names, const Place& at) {
    const auto it = std::find(names.begin(), names.end(), text);
    if (it == names.end()) fault(at, "one of the values that the schema lists");
    return static_cast<std::size_t>(it - names.begin());
  }

  static void hash(const Tree& t, std::uint64_t& x, const Place& at) {
    const auto read = model::hash_from_text(string(t, at));
    if (!read) fault(at, "sixteen hexadecimal digits");
    x = *read;
  }

  template <class T>
  void sequence(const Tree& t, T& x, const Place& at) {
    need_array(t, at);
    if constexpr (kIsArray<T>) {
      if (t.size() != x.size()) fault(at, std::to_string(x.size()) + " items");
    } else {
      x.resize(t.size());
    }
    for (std::size_t i = 0; i < t.size(); ++i) get(t[i], x[i], {&at, {}, i});
  }

  template <class E>
  static void letters(const Tree& t, std::vector<E>& x, std::string_view alphabet, const Place& at) {
    for (const char c : string(t, at)) {
      const auto code = alphabet.find(c);
      if (code == std::string_view::npos) fault(at, "letters of " + std::string(alphabet));
      x.push_back(static_cast<E>(code));
    }
  }

  template <class T>
  void structure(const Tree& t, T& x, const Place& at) {
    need_object(t, at);
    FieldReader each{*this, t, at};
    fields(each, x);
    Names known;
    fields(known, x);
    if constexpr (std::is_same_v<T, model::StepResult>) known.names.insert(known.names.end(), {"id", "peak"});
    only(t, known.names, at);
    if constexpr (std::is_same_v<T, model::CutterPath>) {
      const std::size_t n = x.size();
      if (x.y.size() != n || x.z.size() != n || x.cx.size() != n || x.cy.size() != n || x.kind.size() != n ||
          x.role.size() != n) {
        fault(at, "columns of one length");
      }
    }
  }

  template <class T>
  void shared_columns(const Tree& tree, const char* name, std::vector<std::shared_ptr<const T>>& out,
                      const Place& at) {
    const Tree& list = child(tree, name, at);
    const Place here{&at, name};
    need_array(list, here);
    for (std::size_t i = 0; i < list.size(); ++i) {
      auto item = std::make_shared<T>();
      get(list[i], *item, {&here, {}, i});
      out.push_back(std::move(item));
    }
  }
  auto& shared_of(const model::CutterPath*) { return paths_; }
  auto& shared_of(const model::FeedSchedule*) { return schedules_; }
  auto& shared_of(const model::SectionSeries*) { return sections_; }
  template <class T>
  void shared(const Tree& t, std::shared_ptr<const T>& x, const Place& at) {
    if (t.is_null()) return;
    const auto& all = shared_of(static_cast<const T*>(nullptr));
    const auto index = shared_from_id(shared_name<T>(), string(t, at));
    if (!index || *index >= all.size())
      fault(at, "the id of one of the " + std::string(shared_name<T>()) + "s");
    x = all[*index];
  }

  void reference(const Tree& t, AnyRef& x, const Place& at) const {
    x = {};
    if (t.is_null()) return;
    const auto r = object_from_id(string(t, at));
    if (!r || r->index >= plan_.model.count(r->type)) fault(at, "the id of an object");
    x = *r;
  }
  static void must_be(AnyRef r, TypeId target, const Place& at) {
    if (r.set() && r.type != TypeId::kKeptInstance && !model::is_a(r.type, target)) {
      fault(at, "the id of a " + kind_name(target));
    }
  }
  void target(const Tree& t, AnyRef& x, const Attribute& a, const Place& at) const {
    reference(t, x, at);
    if (!x.set() || a.targets.empty() || x.type == TypeId::kKeptInstance) return;
    if (model::may_stand_in(a, x.type)) return;
    const bool fits =
        std::any_of(a.targets.begin(), a.targets.end(), [&](TypeId k) { return model::is_a(x.type, k); });
    if (!fits) fault(at, "the id of a " + kind_name(a.targets.front()));
  }

  // All objects first, so that references may point anywhere.
  void make_objects(const Tree& objects, const Place& at) {
    need_object(objects, at);
    for (const auto& kind : objects.items()) {
      const Place here{&at, kind.key()};
      const auto type = kind_from_name(kind.key());
      if (!type || model::noun_type(*type).abstract) fault(here, "the name of a kind of object");
      need_array(kind.value(), here);
      for (std::size_t i = 0; i < kind.value().size(); ++i) plan_.model.add_object(*type);
    }
  }

  void fill_objects(const Tree& objects, const Place& at) {
    for (const auto& kind : objects.items()) {
      const Place here{&at, kind.key()};
      const TypeId type = *kind_from_name(kind.key());
      for (std::uint32_t i = 0; i < kind.value().size(); ++i)
        object({type, i}, kind.value()[i], {&here, {}, i});
    }
  }

  void object(AnyRef r, const Tree& t, const Place& at) {
    need_object(t, at);
    if (string(child(t, "@id", at), {&at, "@id"}) != object_id(r)) fault({&at, "@id"}, object_id(r));
    model::Origin origin;
    if (const auto it = t.find("@instance"); it != t.end()) integer(*it, origin.instance, {&at, "@instance"});
    if (const auto it = t.find("@line"); it != t.end()) integer(*it, origin.line, {&at, "@line"});
    plan_.model.set_origin(r, origin);
    if (auto* kept = plan_.model.get<model::KeptInstance>(r)) return pieces(*kept, t, at);
    void* data = plan_.model.object(r);
    for (const auto& item : t.items()) {
      if (item.key().front() == '@') {
        if (item.key() != "@id" && item.key() != "@instance" && item.key() != "@line") {
          fault({&at, item.key()}, "no field of that name");
        }
        continue;
      }
      const Place here{&at, item.key()};
      const Attribute* a = model::find_attribute(r.type, item.key());
      if (a == nullptr) fault(here, "no field of that name");
      attribute(*a, item.value(), data, here);
    }
  }

  void pieces(model::KeptInstance& kept, const Tree& t, const Place& at) {
    only(t, {"@id", "@instance", "@line", "keyword", "schema", "section", "pieces"}, at);
    get(child(t, "keyword", at), kept.keyword, {&at, "keyword"});
    if (const auto it = t.find("schema"); it != t.end()) {
      const Place here{&at, "schema"};
      if (string(*it, here) != "AP238") fault(here, "AP238, or nothing for ISO 14649");
      kept.schema = model::KeptSchema::kAp238;
    }
    if (const auto it = t.find("section"); it != t.end()) {
      const Place here{&at, "section"};
      const auto& name = string(*it, here);
      if (name != "ANCHOR" && name != "REFERENCE") fault(here, "ANCHOR or REFERENCE");
      kept.section = name == "ANCHOR" ? model::KeptSection::kAnchor : model::KeptSection::kReference;
    }
    const Tree& list = child(t, "pieces", at);
    const Place here{&at, "pieces"};
    need_array(list, here);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Place item{&here, {}, i};
      if (list[i].is_string()) {
        kept.pieces.emplace_back(unquoted_bytes(string(list[i], item)));
      } else {
        need_object(list[i], item);
        only(list[i], {"ref"}, item);
        AnyRef r;
        reference(child(list[i], "ref", item), r, item);
        kept.pieces.emplace_back(r);
      }
    }
  }

  template <class T, class F>
  void list(const Tree& t, std::vector<T>& out, const Place& at, F&& each) {
    need_array(t, at);
    out.resize(t.size());
    for (std::size_t i = 0; i < t.size(); ++i) each(t[i], out[i], Place{&at, {}, i});
  }

  void select(const Tree& t, model::SelectValue& v, const Attribute& a, const Place& at) {
    need_object(t, at);
    only(t, {"ref", "type", "real", "text"}, at);
    if (const auto it = t.find("ref"); it != t.end()) target(*it, v.ref, a, {&at, "ref"});
    if (const auto it = t.find("type"); it != t.end()) get(*it, v.type, {&at, "type"});
    if (const auto it = t.find("real"); it != t.end()) get(*it, v.real, {&at, "real"});
    if (const auto it = t.find("text"); it != t.end()) get(*it, v.text, {&at, "text"});
  }

  template <class T>
  static T& storage(const Attribute& a, void* object) {
    return *static_cast<T*>(a.at(object));
  }

  // The storage's type is the one that the descriptor names.
  template <class List>
  void values(const Attribute& a, const Tree& t, void* object, const Place& at) {
    auto& l = storage<List>(a, object);
    l.given = true;
    get(t, l.items, at);
  }

  void attribute(const Attribute& a, const Tree& t, void* object, const Place& at) {
    using namespace model;
    const auto a_ref = [&](const Tree& item, AnyRef& r, const Place& where) { target(item, r, a, where); };
    switch (a.storage) {
      case Storage::kReal:
        return get(t, storage<Real>(a, object), at);
      case Storage::kInteger:
        return get(t, storage<Integer>(a, object), at);
      case Storage::kBoolean:
        return get(t, storage<Boolean>(a, object), at);
      case Storage::kText:
        return get(t, storage<Text>(a, object), at);
      case Storage::kEnum:
        storage<AnyEnum>(a, object).code =
            static_cast<std::int8_t>(spelled(string(t, at), a.enumerators, at));
        return;
      case Storage::kRef:
        return target(t, storage<AnyRef>(a, object), a, at);
      case Storage::kRefList:
        storage<AnyRefList>(a, object).given = true;
        return list(t, storage<AnyRefList>(a, object).items, at, a_ref);
      case Storage::kRefTable:
        storage<RefTable>(a, object).given = true;
        return list(t, storage<RefTable>(a, object).items, at,
                    [&](const Tree& row, std::vector<AnyRef>& out, const Place& where) {
                      list(row, out, where, a_ref);
                    });
      case Storage::kSelect:
        return select(t, storage<SelectValue>(a, object), a, at);
      case Storage::kSelectList:
        storage<SelectList>(a, object).given = true;
        return list(t, storage<SelectList>(a, object).items, at,
                    [&](const Tree& item, SelectValue& v, const Place& where) { select(item, v, a, where); });
      case Storage::kRealList:
        return values<RealList>(a, t, object, at);
      case Storage::kIntegerList:
        return values<IntegerList>(a, t, object, at);
      case Storage::kTextList:
        return values<TextList>(a, t, object, at);
      case Storage::kRealTable:
        return values<RealTable>(a, t, object, at);
      case Storage::kPath:
        return shared(t, storage<PathHandle>(a, object), at);
    }
  }

  void ledger(const Tree& tree, const Place& top) {
    const Place reasons_at{&top, "reasons"};
    std::vector<model::Reason> reasons;
    get(child(tree, "reasons", top), reasons, reasons_at);
    for (std::size_t i = 0; i < reasons.size(); ++i) {
      if (plan_.ledger.reason(std::move(reasons[i])) != i)
        fault({&reasons_at, {}, i}, "each reason once, \"given\" first");
    }
    const Tree& decisions = child(tree, "decisions", top);
    const Place here{&top, "decisions"};
    need_array(decisions, here);
    for (std::size_t i = 0; i < decisions.size(); ++i) {
      const Place at{&here, {}, i};
      need_object(decisions[i], at);
      model::DecisionKey key;
      model::Decision decision;
      FieldReader each{*this, decisions[i], at};
      fields(each, key);
      fields(each, decision);
      Names known;
      fields(known, key);
      fields(known, decision);
      only(decisions[i], known.names, at);
      if (decision.reason >= plan_.ledger.reasons().size()) fault({&at, "reason"}, "the number of a reason");
      plan_.ledger.set(std::move(key), std::move(decision));
    }
  }

  void compare_seals(const Tree& seals, const Place& at) {
    need_object(seals, at);
    std::map<std::string, std::uint64_t> then;
    for (const auto& item : seals.items())
      hash(item.value(), then[unquoted_bytes(item.key())], {&at, item.key()});
    edited_ = model::edited_parts(seals_of(plan_), std::move(then));
  }

  /// What a file says for readers that only look, against what it follows from.
  void compare_derived(const Tree& tree) {
    const auto differs = [](const Tree& t, const char* name, double v) {
      const auto it = t.find(name);
      return it == t.end() || !it->is_number() || it->get<double>() != v;
    };
    if (const auto it = tree.find("summary"); it != tree.end() && it->is_object()) {
      const auto expected = summary_of(plan_);
      const bool other = std::any_of(expected.begin(), expected.end(), [&](const auto& part) {
        return differs(*it, part.first.c_str(), part.second);
      });
      const auto waiting = it->find("to_load");
      if (other || (waiting != it->end() && *waiting != Tree(to_load(plan_))))
        edited_.emplace_back("the summary");
    }
    const std::vector<std::string> ids = step_ids(plan_);
    const Tree& steps = *tree.find("steps");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto id = steps[i].find("id");
      if (id != steps[i].end() &&
          (!id->is_string() || unquoted_bytes(id->get_ref<const std::string&>()) != ids[i]))
        edited_.push_back("the id of step '" + ids[i] + "'");
      const auto peak = steps[i].find("peak");
      const auto& sections = plan_.steps[i].sections;
      if (peak == steps[i].end() || !peak->is_object() || !sections) continue;
      const auto most = [](const std::vector<double>& column) {
        return column.empty() ? 0.0 : *std::max_element(column.begin(), column.end());
      };
      if (differs(*peak, "csa_mm2", most(sections->csa_mm2)) ||
          differs(*peak, "ad_max_mm", most(sections->ad_max_mm)) ||
          differs(*peak, "rd_max_mm", most(sections->rd_max_mm)))
        edited_.push_back("the peak of step '" + ids[i] + "'");
    }
  }

  Plan plan_;
  std::vector<std::string> edited_;
  std::vector<std::shared_ptr<const model::CutterPath>> paths_;
  std::vector<std::shared_ptr<const model::FeedSchedule>> schedules_;
  std::vector<std::shared_ptr<const model::SectionSeries>> sections_;
};

// The parser copies and destroys values recursively: depth is bounded before it sees the text.
int deepest(std::string_view text) {
  int depth = 0;
  int most = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      most = std::max(most, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return most;
}

std::uint64_t line_of(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<std::uint64_t>(std::count(text.begin(), end, '\n'));
}

}  // namespace
}  // namespace json

Result<model::Plan> read_json(std::string bytes, std::string file_name, Job& job, std::size_t cap) {
  const auto refuse = [&](const char* code, std::string message, std::uint64_t line = 0) {
    return fail(Diagnostic{.code = code, .message = std::move(message), .file = file_name, .line = line});
  };
  if (bytes.size() > cap)
    return refuse("JSON-SIZE", "the file is larger than " + std::to_string(cap) + " bytes");
  if (json::deepest(bytes) > json::kDeepest) {
    return refuse("JSON-DEPTH", "the file nests deeper than " + std::to_string(json::kDeepest) + " levels");
  }
  json::Tree tree;
  try {
    tree = json::Tree::parse(bytes);
  } catch (const json::Tree::parse_error& e) {
    return refuse("JSON-SYNTAX", "the file is not JSON", json::line_of(bytes, e.byte));
  } catch (const json::Tree::exception&) {
    return refuse("JSON-SYNTAX", "the file holds a number that is out of range");
  }
  const auto version = tree.is_object() ? tree.find("capstan_plan") : tree.end();
  if (!tree.is_object() || version == tree.end())
    return refuse("JSON-VERSION", "the file is not a Capstan plan");
  if (*version != kPlanJsonVersion) {
    return refuse("JSON-VERSION", "the plan is of another version than " + std::to_string(kPlanJsonVersion));
  }
  try {
    json::Reader reader;
    model::Plan plan = reader.run(tree);
    for (const model::Edited& e : model::take_edits(plan.model, plan.ledger)) {
      job.report({.code = std::string(model::kEditedCode),
                  .severity = Severity::kNote,
                  .message = e.key.attribute + " of " + json::object_id(e.key.object) + " " + text_of(e),
                  .file = file_name});
    }
    if (!reader.edited().empty()) {
      job.report(model::parts_edited(std::string(model::kEditedJsonCode), reader.edited(), file_name));
      model::refuse_edited(plan, json::listed_among(reader.edited()), "the plan's JSON");
    }
    if (const std::string how = model::follow_workplan(plan); !how.empty())
      job.report(model::steps_disagree(how, file_name));
    return plan;
  } catch (const json::Fault& f) {
    Diagnostic d{
        .code = "JSON-VALUE", .message = "the plan's JSON is not as its schema says", .file = file_name};
    d.path = f.place;
    d.expected = f.expected;
    if (f.expected == "this field") d.hint = "a plan of an earlier build may lack it: plan the part anew";
    return fail(std::move(d));
  }
}

}  // namespace capstan::json
