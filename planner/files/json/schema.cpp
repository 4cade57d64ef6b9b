#include <algorithm>
#include <map>
#include <set>

#include "planner/files/json/fields.h"
#include "planner/files/json/ids.h"
#include "planner/files/json/json.h"
#include "planner/files/json/meaning.h"
#include "planner/files/json/printer.h"
#include "planner/model/nouns/arena/stand_in.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/workpiece.h"

namespace capstan::json {
namespace {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

/// Prints the schema of what the writer writes, from the same two descriptions.
class SchemaWriter {
 public:
  std::string run() {
    out_.open('{', true);
    text("$schema", "http://json-schema.org/draft-07/schema#");
    text("title", "Capstan plan, version " + std::to_string(kPlanJsonVersion));
    text("type", "object");
    text("description",
         "Ids such as round_hole:3 name the third object of a kind. Lengths mm, angles rad, feeds "
         "mm/min, speeds 1/min, times s, ratios as fractions of one.");
    out_.key("properties");
    out_.open('{', true);
    version();
    out_.key("summary");
    free_object(
        "derived: what the steps add up to (cutting_s with dwells, rapid_s), what lies between them (link_s, "
        "tool_change_s, spindle_s), and the total_s; times in s");
    const model::Plan plan;
    FieldSchemas top{*this};
    fields(top, plan);
    objects();
    list("reasons", [this] { of(model::Reason{}); });
    list("decisions", [this] { decision(); });
    list("paths", [this] { of(model::CutterPath{}); });
    list("schedules", [this] { of(model::FeedSchedule{}); });
    list("sections", [this] { of(model::SectionSeries{}); });
    out_.key("target_mesh");
    of(geometry::Mesh{});
    out_.key("seals");
    free_object("a hash of each part, so that a reader knows what was edited since");
    out_.close();
    Names names;
    fields(names, plan);
    names.required.insert(names.required.begin(), "capstan_plan");
    names.required.insert(names.required.end(),
                          {"objects", "reasons", "decisions", "paths", "schedules", "sections", "seals"});
    required(names.required);
    definitions();
    out_.close();
    return out_.take();
  }

 private:
  struct FieldSchemas {
    SchemaWriter& writer;
    template <class T>
    void operator()(const char* name, const T& x) {
      field(name, meaning_of(name), x);
    }
    template <class Row, class T>
    void row(const Row& of, const T& x) {
      field(of.name, meaning_of(of), x);
    }
    template <class T>
    void field(const char* name, std::string_view own, const T& x) {
      writer.out_.key(name);
      if (std::string_view(name) == kHashField)
        return writer.pattern("^[0-9a-f]{16}$", "hash of the value spoken of");
      // Of a point its coordinates are in the unit that its own name says.
      const std::string_view before = writer.unit_;
      if (!own.empty()) writer.unit_ = own;
      writer.of(x);
      writer.unit_ = before;
    }
  };
  struct Names {
    std::vector<std::string> required;
    template <class T>
    void operator()(const char* name, const T&) {
      if (!kIsOptional<T>) required.emplace_back(name);
    }
  };

  void text(std::string_view key, std::string_view value) {
    out_.key(key);
    out_.text(value);
  }
  void type(std::string_view name) {
    out_.open('{', false);
    text("type", name);
    out_.close();
  }
  void pattern(std::string_view regex, std::string_view description = {}) {
    out_.open('{', false);
    text("type", "string");
    text("pattern", regex);
    if (!description.empty()) text("description", description);
    out_.close();
  }
  void described(std::string_view type, std::string_view description) {
    out_.open('{', false);
    text("type", type);
    if (!description.empty()) text("description", description);
    out_.close();
  }
  void free_object(std::string_view description) { described("object", description); }
  void reference(std::string_view definition) {
    out_.open('{', false);
    text("$ref", "#/definitions/" + std::string(definition));
    out_.close();
  }
  void required(const std::vector<std::string>& names) {
    out_.key("required");
    out_.open('[', false);
    for (const std::string& n : names) out_.text(n);
    out_.close();
    out_.key("additionalProperties");
    out_.boolean(false);
  }
  template <class Names>
  void one_of(const Names& values) {
    out_.open('{', false);
    out_.key("enum");
    out_.open('[', false);
    for (const auto& v : values) out_.text(v);
    out_.close();
    out_.close();
  }
  template <class F>
  void array(F&& items) {
    out_.open('{', false);
    text("type", "array");
    out_.key("items");
    items();
    out_.close();
  }
  template <class F>
  void list(const char* name, F&& items) {
    out_.key(name);
    array(items);
  }
  void version() {
    out_.key("capstan_plan");
    out_.open('{', false);
    out_.key("const");
    out_.integer(kPlanJsonVersion);
    out_.close();
  }

  template <class T>
  static TypeId target_of(const model::Ref<T>&) {
    return T::kType;
  }

  // Of a type; the value itself does not matter.
  template <class T>
  void of(const T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      type("boolean");
    } else if constexpr (std::is_integral_v<T>) {
      type("integer");
    } else if constexpr (std::is_floating_point_v<T>) {
      described("number", unit_);
    } else if constexpr (IsText<T>) {
      type("string");
    } else if constexpr (std::is_enum_v<T>) {
      one_of(spellings<T>());
    } else if constexpr (std::is_same_v<T, AnyRef>) {
      any_reference();
    } else if constexpr (std::is_base_of_v<AnyRef, T>) {
      const TypeId target = target_of(x);
      reference(reference_to({&target, 1}));
    } else if constexpr (kIsOptional<T>) {
      of(typename T::value_type{});
    } else if constexpr (kIsShared<T>) {
      shared(shared_name<typename std::remove_const_t<typename T::element_type>>());
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveKind>>) {
      letters("a letter per move: R rapid, L line, W arc clockwise, C arc counter-clockwise, D dwell");
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveRole>>) {
      letters("a letter per move: A approach, P plunge, M ramp, C cut, L link, R retract, D drill, T tap");
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      array([this] { of(typename T::value_type{}); });
    } else {
      structure(x);
    }
  }

  void letters(std::string_view description) {
    out_.open('{', false);
    text("type", "string");
    text("description", description);
    out_.close();
  }
  void any_reference() { shared("[a-z0-9_]+"); }
  void shared(std::string_view what) {
    out_.open('{', false);
    out_.key("type");
    out_.open('[', false);
    out_.text("string");
    out_.text("null");
    out_.close();
    text("pattern", "^" + std::string(what) + ":[1-9][0-9]*$");
    out_.close();
  }

  template <class T>
  void structure(const T& x) {
    out_.open('{', false);
    text("type", "object");
    out_.key("properties");
    out_.open('{', false);
    if constexpr (std::is_same_v<T, model::StepResult>) derived_of_step();
    FieldSchemas each{*this};
    fields(each, x);
    out_.close();
    Names names;
    fields(names, x);
    required(names.required);
    out_.close();
  }

  /// Of a step, for readers that follow no reference and add nothing up.
  void derived_of_step() {
    constexpr std::pair<std::string_view, std::string_view> kWords[] = {
        {"id", "derived: its name, told from those of the same name; the same in every planning of the part"},
        {"operation", "derived: the kind of its operation, as a key of objects; a rapid movement has none"},
        {"feature", "derived: the name of its feature"}};
    for (const auto& [name, words] : kWords) {
      out_.key(name);
      described("string", words);
    }
    out_.key("tool_number");
    described("integer", "derived: T, the number that its program calls; 0: none");
    constexpr std::pair<std::string_view, std::string_view> kTimes[] = {
        {"link_s", "derived, s: the way from the step before, with the same tool"},
        {"tool_change_s", "derived, s: the tool change that it begins with"},
        {"spindle_s", "derived, s: its changes of spindle speed, and the stop before it or after the last"}};
    for (const auto& [name, words] : kTimes) {
      out_.key(name);
      described("number", words);
    }
    out_.key("peak");
    free_object("derived: the largest cross section: csa_mm2, mm2; ad_max_mm and rd_max_mm, mm");
  }

  void decision() {
    out_.open('{', false);
    text("type", "object");
    out_.key("properties");
    out_.open('{', false);
    FieldSchemas each{*this};
    const model::DecisionKey key;
    const model::Decision made;
    fields(each, key);
    fields(each, made);
    out_.close();
    Names names;
    fields(names, key);
    fields(names, made);
    required(names.required);
    out_.close();
  }

  void objects() {
    out_.key("objects");
    out_.open('{', true);
    text("type", "object");
    out_.key("properties");
    out_.open('{', true);
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      if (model::noun_type(static_cast<TypeId>(t)).abstract) continue;
      const std::string name = kind_name(static_cast<TypeId>(t));
      list(name.c_str(), [&] { reference(name); });
    }
    out_.close();
    out_.key("additionalProperties");
    out_.boolean(false);
    out_.close();
  }

  static std::vector<TypeId> kinds_for(const Attribute& a) {
    std::vector<TypeId> out(a.targets.begin(), a.targets.end());
    for (std::size_t t = 1; t < model::kTypeCount && !out.empty(); ++t) {
      if (model::may_stand_in(a, static_cast<TypeId>(t))) out.push_back(static_cast<TypeId>(t));
    }
    return out;
  }

  // A definition per set of kinds that references may point to; kept instances are allowed everywhere.
  std::string reference_to(std::span<const TypeId> targets) {
    std::string name = "reference_to";
    for (const TypeId t : targets) name += "_" + kind_name(t);
    if (targets.empty()) name += "_any";
    if (references_.contains(name)) return name;
    std::string regex = "^(";
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      const auto kind = static_cast<TypeId>(t);
      if (model::noun_type(kind).abstract || kind == TypeId::kKeptInstance) continue;
      if (std::any_of(targets.begin(), targets.end(), [&](TypeId a) { return model::is_a(kind, a); })) {
        regex += kind_name(kind) + "|";
      }
    }
    regex += targets.empty() ? "[a-z0-9_]+" : "kept_instance";
    references_.emplace(name, regex + "):[1-9][0-9]*$");
    return name;
  }

  void select(const Attribute& a) {
    out_.open('{', false);
    text("type", "object");
    out_.key("properties");
    out_.open('{', false);
    out_.key("ref");
    reference(reference_to(kinds_for(a)));
    out_.key("type");
    type("string");
    out_.key("real");
    described("number", meaning_of("real"));
    out_.key("text");
    type("string");
    out_.close();
    required({});
    out_.close();
  }

  /// Most whole numbers are counts: only those with a unit are described.
  void number(TypeId owner, const Attribute& a, std::string_view type) {
    const bool is_told = type == "number" || a.unit != model::Unit::kNone;
    described(type, is_told ? meaning_of(owner, a) : "");
  }

  void attribute(TypeId owner, const Attribute& a) {
    const auto ref = [&] { reference(reference_to(kinds_for(a))); };
    switch (a.storage) {
      case Storage::kReal:
        return number(owner, a, "number");
      case Storage::kInteger:
        return number(owner, a, "integer");
      case Storage::kBoolean:
        return type("boolean");
      case Storage::kText:
        return type("string");
      case Storage::kEnum:
        return one_of(a.enumerators);
      case Storage::kRef:
        return ref();
      case Storage::kRefList:
        return array(ref);
      case Storage::kRefTable:
        return array([&] { array(ref); });
      case Storage::kSelect:
        return select(a);
      case Storage::kSelectList:
        return array([&] { select(a); });
      case Storage::kRealList:
        return array([&] { number(owner, a, "number"); });
      case Storage::kIntegerList:
        return array([&] { number(owner, a, "integer"); });
      case Storage::kTextList:
        return array([&] { type("string"); });
      case Storage::kRealTable:
        return array([&] { array([&] { number(owner, a, "number"); }); });
      case Storage::kPath:
        return shared("path");
    }
  }

  void definitions() {
    out_.key("definitions");
    out_.open('{', true);
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      const auto kind = static_cast<TypeId>(t);
      if (model::noun_type(kind).abstract) continue;
      out_.key(kind_name(kind));
      noun(kind);
    }
    for (const auto& [name, regex] : references_) {
      out_.key(name);
      out_.open('{', false);
      out_.key("type");
      out_.open('[', false);
      out_.text("string");
      out_.text("null");
      out_.close();
      text("pattern", regex);
      out_.close();
    }
    out_.close();
  }

  void noun(TypeId kind) {
    out_.open('{', true);
    text("type", "object");
    out_.key("properties");
    out_.open('{', true);
    out_.key("@id");
    pattern("^" + kind_name(kind) + ":[1-9][0-9]*$");
    out_.key("@instance");
    type("integer");
    out_.key("@line");
    type("integer");
    std::vector<std::string> needed = {"@id"};
    if (kind == TypeId::kKeptInstance) {
      out_.key("keyword");
      type("string");
      out_.key("schema");
      type("string");
      out_.key("section");
      type("string");
      out_.key("pieces");
      array([this] {
        out_.open('{', false);
        out_.key("type");
        out_.open('[', false);
        out_.text("string");
        out_.text("object");
        out_.close();
        out_.close();
      });
      needed.insert(needed.end(), {"keyword", "pieces"});
    }
    for (const Attribute& a : model::noun_type(kind).attributes) {
      out_.key(a.name);
      attribute(kind, a);
    }
    out_.close();
    required(needed);
    out_.close();
  }

  Printer out_;
  std::string_view unit_;  ///< of the numbers of the field that is described
  std::map<std::string, std::string> references_;
};

}  // namespace

std::string json_schema() { return SchemaWriter().run(); }

}  // namespace capstan::json
