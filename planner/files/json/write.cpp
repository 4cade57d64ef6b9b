#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "planner/files/json/fields.h"
#include "planner/files/json/ids.h"
#include "planner/files/json/json.h"
#include "planner/files/json/printer.h"
#include "planner/files/json/seal.h"
#include "planner/files/json/summary.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/fresh_edits.h"

namespace capstan::json {
namespace {

using model::AnyRef;
using model::Attribute;
using model::Plan;
using model::Storage;
using model::TypeId;

/// Columns by address: each is written once, numbered as met.
template <class T>
class NumberedColumns {
 public:
  std::size_t index_of(const std::shared_ptr<const T>& p) {
    const auto [it, fresh] = index_.emplace(p.get(), items_.size());
    if (fresh) items_.push_back(p.get());
    return it->second;
  }
  [[nodiscard]] const std::vector<const T*>& items() const { return items_; }

 private:
  std::map<const T*, std::size_t> index_;
  std::vector<const T*> items_;
};

// Worth a line per field; others stand in one line.
template <class T>
inline constexpr bool kInLines =
    std::is_same_v<T, model::CutterPath> || std::is_same_v<T, model::StepResult> ||
    std::is_same_v<T, model::Machine> || std::is_same_v<T, model::FeedSchedule> ||
    std::is_same_v<T, model::SectionSeries>;

class Writer {
 public:
  /// `whole`: as the plan, and with the sections that a step's peak is of.
  Writer(const Plan& plan, const Plan& whole) : plan_(plan), whole_(whole), summary_(summary_of(plan)) {}

  std::string run() {
    out_.open('{', true);
    out_.key("capstan_plan");
    out_.integer(kPlanJsonVersion);
    summary();
    FieldWriter top{*this};
    fields(top, plan_);
    objects();
    ledger();
    columns("paths", paths_);
    columns("schedules", schedules_);
    columns("sections", sections_);
    if (plan_.target_mesh) {
      out_.key("target_mesh");
      put(*plan_.target_mesh);
    }
    seals();
    out_.close();
    return out_.take();
  }

 private:
  struct FieldWriter {
    Writer& writer;
    template <class T>
    void operator()(const char* name, const T& x) {
      if constexpr (kIsOptional<T>) {
        if (!x) return;
      }
      writer.out_.key(name);
      if constexpr (std::is_same_v<T, std::uint64_t>) {
        // 64 bits do not survive readers that hold every number as a double.
        if (std::string_view(name) == kHashField) return writer.out_.text(hex64(x));
      }
      writer.put(x);
    }
  };

  void seals() {
    out_.key("seals");
    out_.open('{', true);
    for (const auto& [name, hash] : seals_of(plan_)) {
      out_.key(name);
      out_.text(hex64(hash));
    }
    out_.close();
  }

  // Derived, for readers that only look: what the steps add up to.
  void summary() {
    out_.key("summary");
    out_.open('{', false);
    for (const auto& [name, value] : summary_.totals) {
      out_.key(name);
      // Counts are whole, times are not.
      if (name.ends_with("_s"))
        out_.number(value);
      else
        out_.natural(static_cast<std::uint64_t>(value));
    }
    if (has_magazine(plan_)) {
      out_.key("to_load");
      out_.open('[', false);
      for (const std::string& id : to_load(plan_)) out_.text(id);
      out_.close();
    }
    out_.close();
  }

  template <class T>
  void put(const T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      out_.boolean(x);
    } else if constexpr (std::is_unsigned_v<T>) {
      out_.natural(x);
    } else if constexpr (std::is_integral_v<T>) {
      out_.integer(x);
    } else if constexpr (std::is_floating_point_v<T>) {
      out_.number(x);
    } else if constexpr (std::is_same_v<T, SharedText>) {
      out_.text(x.text());
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      out_.text(x);
    } else if constexpr (std::is_enum_v<T>) {
      out_.text(spellings<T>().at(static_cast<std::size_t>(x)));
    } else if constexpr (std::is_base_of_v<AnyRef, T>) {
      ref(x);
    } else if constexpr (kIsOptional<T>) {
      put(*x);
    } else if constexpr (kIsShared<T>) {
      shared(x);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveKind>>) {
      letters(x, kMoveKinds);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveRole>>) {
      letters(x, kMoveRoles);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      out_.numbers(x);
    } else if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>) {
      out_.naturals(x);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      out_.open('[', Described<const typename T::value_type>);
      for (const auto& item : x) put(item);
      out_.close();
    } else {
      static_assert(Described<const T>);
      structure(x);
    }
  }

  template <class T>
  void structure(const T& x) {
    out_.open('{', kInLines<T>);
    if constexpr (std::is_same_v<T, model::StepResult>) derived(x);
    FieldWriter each{*this};
    fields(each, x);
    out_.close();
  }

  void derived(const model::StepResult& step) {
    const auto at = static_cast<std::size_t>(&step - plan_.steps.data());
    const StepSummary& look = summary_.steps.at(at);
    out_.key("id");
    out_.text(look.id);
    out_.key("tool_number");
    out_.integer(look.tool_number);
    for (const auto& [name, text] : look.words) {
      out_.key(name);
      out_.text(text);
    }
    for (const auto& [name, seconds] : look.times) {
      out_.key(name);
      out_.number(seconds);
    }
    const auto& sections = whole_.steps.at(at).sections;
    if (!sections || sections->size() == 0) return;
    const auto peak = [&](const char* name, const std::vector<double>& column) {
      out_.key(name);
      out_.number(column.empty() ? 0.0 : *std::max_element(column.begin(), column.end()));
    };
    out_.key("peak");
    out_.open('{', false);
    peak("csa_mm2", sections->csa_mm2);
    peak("ad_max_mm", sections->ad_max_mm);
    peak("rd_max_mm", sections->rd_max_mm);
    out_.close();
  }

  template <class E>
  void letters(const std::vector<E>& codes, std::string_view alphabet) {
    std::string text;
    text.reserve(codes.size());
    for (const E c : codes) text += alphabet.at(static_cast<std::size_t>(c));
    out_.text(text);
  }

  void ref(AnyRef r) {
    if (!r.set()) return out_.null();
    out_.text(object_id(r));
  }

  void shared(const std::shared_ptr<const model::CutterPath>& p) { shared(p, paths_); }
  void shared(const std::shared_ptr<const model::SectionSeries>& p) { shared(p, sections_); }
  void shared(const std::shared_ptr<const model::FeedSchedule>& p) { shared(p, schedules_); }
  template <class T>
  void shared(const std::shared_ptr<const T>& p, NumberedColumns<T>& all) {
    if (!p) return out_.null();
    out_.text(shared_id(shared_name<T>(), all.index_of(p)));
  }

  template <class T>
  void columns(const char* name, const NumberedColumns<T>& all) {
    out_.key(name);
    out_.open('[', true);
    for (const T* item : all.items()) put(*item);
    out_.close();
  }

  void objects() {
    out_.key("objects");
    out_.open('{', true);
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      const auto type = static_cast<TypeId>(t);
      const std::uint32_t count = plan_.model.count(type);
      if (count == 0) continue;
      out_.key(kind_name(type));
      out_.open('[', true);
      for (std::uint32_t i = 0; i < count; ++i) {
        tick();
        object({type, i});
      }
      out_.close();
    }
    out_.close();
  }

  void object(AnyRef r) {
    out_.open('{', false);
    out_.key("@id");
    out_.text(object_id(r));
    const model::Origin& origin = plan_.model.origin(r);
    if (origin.instance != 0) {
      out_.key("@instance");
      out_.natural(origin.instance);
    }
    if (origin.line != 0) {
      out_.key("@line");
      out_.natural(origin.line);
    }
    if (const auto* kept = plan_.model.get<model::KeptInstance>(r)) {
      pieces(*kept);
    } else {
      const void* data = plan_.model.object(r);
      for (const Attribute& a : model::noun_type(r.type).attributes) {
        if (!model::has_value(a, data)) continue;
        out_.key(a.name);
        attribute(a, data);
      }
    }
    out_.close();
  }

  void pieces(const model::KeptInstance& kept) {
    out_.key("keyword");
    out_.text(kept.keyword);
    if (kept.schema == model::KeptSchema::kAp238) {
      out_.key("schema");
      out_.text("AP238");
    }
    if (kept.section != model::KeptSection::kData) {
      out_.key("section");
      out_.text(kept.section == model::KeptSection::kAnchor ? "ANCHOR" : "REFERENCE");
    }
    out_.key("pieces");
    out_.open('[', false);
    for (const auto& piece : kept.pieces) {
      if (const auto* text = std::get_if<std::string>(&piece)) {
        out_.text(*text);
        continue;
      }
      out_.open('{', false);
      out_.key("ref");
      ref(std::get<AnyRef>(piece));
      out_.close();
    }
    out_.close();
  }

  template <class T, class F>
  void list(const std::vector<T>& items, F&& each) {
    out_.open('[', false);
    for (const auto& item : items) each(item);
    out_.close();
  }

  void select(const model::SelectValue& v) {
    out_.open('{', false);
    if (v.ref.set()) {
      out_.key("ref");
      ref(v.ref);
    }
    if (!v.type.empty()) {
      out_.key("type");
      out_.text(v.type);
    }
    if (v.real) {
      out_.key("real");
      out_.number(*v.real);
    }
    if (!v.text.empty()) {
      out_.key("text");
      out_.text(v.text);
    }
    out_.close();
  }

  void attribute(const Attribute& a, const void* object) {
    using namespace model;
    const auto a_ref = [this](AnyRef r) { ref(r); };
    const auto a_select = [this](const SelectValue& v) { select(v); };
    switch (a.storage) {
      case Storage::kReal:
        return out_.number(*value_of<Real>(a, object));
      case Storage::kInteger:
        return out_.integer(*value_of<Integer>(a, object));
      case Storage::kBoolean:
        return out_.boolean(*value_of<Boolean>(a, object));
      case Storage::kText:
        return out_.text(*value_of<Text>(a, object));
      case Storage::kEnum:
        return out_.text(a.enumerators[static_cast<std::size_t>(value_of<AnyEnum>(a, object).code)]);
      case Storage::kRef:
        return ref(value_of<AnyRef>(a, object));
      case Storage::kRefList:
        return list(value_of<AnyRefList>(a, object).items, a_ref);
      case Storage::kRefTable:
        return list(value_of<RefTable>(a, object).items, [&](const auto& row) { list(row, a_ref); });
      case Storage::kSelect:
        return select(value_of<SelectValue>(a, object));
      case Storage::kSelectList:
        return list(value_of<SelectList>(a, object).items, a_select);
      case Storage::kRealList:
        return put(value_of<RealList>(a, object).items);
      case Storage::kIntegerList:
        return put(value_of<IntegerList>(a, object).items);
      case Storage::kTextList:
        return put(value_of<TextList>(a, object).items);
      case Storage::kRealTable:
        return put(value_of<RealTable>(a, object).items);
      case Storage::kPath:
        return shared(value_of<PathHandle>(a, object));
    }
  }

  void ledger() {
    out_.key("reasons");
    put(plan_.ledger.reasons());
    out_.key("decisions");
    out_.open('[', true);
    for (const auto& [key, known] : plan_.ledger.entries()) {
      tick();
      if (!model::is_written(plan_.ledger, known)) continue;
      // What the value is as it is written, so that a reader sees whether somebody changed it since.
      model::Decision decision = known;
      decision.value_hash = model::written_hash(plan_.model, plan_.ledger, key, known);
      out_.open('{', false);
      FieldWriter each{*this};
      fields(each, key);
      fields(each, decision);
      out_.close();
    }
    out_.close();
  }

  const Plan& plan_;
  const Plan& whole_;
  Summary summary_;
  Printer out_;
  NumberedColumns<model::CutterPath> paths_;
  NumberedColumns<model::SectionSeries> sections_;
  NumberedColumns<model::FeedSchedule> schedules_;
};

}  // namespace

model::Plan without_sections(model::Plan plan) {
  for (model::StepResult& step : plan.steps) step.sections = nullptr;
  return plan;
}

std::string write_json(const model::Plan& plan, const Without& without) {
  if (!without.sections) return Writer(plan, plan).run();
  return Writer(without_sections(plan), plan).run();
}

}  // namespace capstan::json
