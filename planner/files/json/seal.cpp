#include "planner/files/json/seal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "planner/files/json/fields.h"
#include "planner/files/json/ids.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/arena/kept.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::json {
namespace {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

/// Words for people: what they say decides nothing. A decision's hash is computed when it is written.
bool only_words(std::string_view field) {
  static constexpr std::array<std::string_view, 10> kWords = {"description", "source",  "sources", "names",
                                                              "pickup_text", "text",    "why",     "name",
                                                              "lexeme",      kHashField};
  return std::find(kWords.begin(), kWords.end(), field) != kWords.end();
}

class Hash {
 public:
  void number(std::uint64_t bits) {
    // As FNV-1a, eight bytes at a time, and folded: paths are long.
    h_ = (h_ ^ bits) * 0x9e3779b97f4a7c15U;
    h_ ^= h_ >> 29U;
  }
  void real(double v) { number(std::bit_cast<std::uint64_t>(v == 0.0 ? 0.0 : v)); }
  void text(std::string_view s) { number(fnv1a(s)); }
  void ref(AnyRef r) {
    number(r.set() ? std::uint64_t{static_cast<std::uint16_t>(r.type)} << 32U | r.index : ~std::uint64_t{0});
  }
  [[nodiscard]] std::uint64_t value() const { return h_; }

 private:
  std::uint64_t h_ = 14695981039346656037U;
};

class Sealer {
 public:
  explicit Sealer(const model::Plan& plan) : plan_(plan) {}

  std::map<std::string, std::uint64_t> run() {
    put("the project", plan_.project);
    put("the machine", plan_.machine);
    put("the material", plan_.material);
    put("the raw piece", plan_.stock);
    for (const model::Cutter& c : plan_.cutters) put("tool '" + c.id + "'", c);
    for (std::size_t i = 0; i < plan_.setups.size(); ++i)
      put("set-up " + std::to_string(i + 1), plan_.setups[i]);
    const std::vector<std::string> ids = step_ids(plan_);
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) put(part_of_step(ids[i]), plan_.steps[i]);
    put("the order of the steps", ids);
    for (const model::Unplanned& u : plan_.unplanned) {
      Hash h;
      of(h, u.feature);
      of(h, u.needed_by);
      add("what is not planned", h);
    }
    put("what is kept", plan_.kept);
    if (plan_.target_mesh) put("the target mesh", *plan_.target_mesh);
    for (std::size_t t = 1; t < model::kTypeCount; ++t) objects(static_cast<TypeId>(t));
    // Their ids decide, in this order; their words do not.
    for (const model::Reason& r : plan_.ledger.reasons()) {
      Hash h;
      h.text(r.id);
      add("the reasons", h);
    }
    for (const auto& [key, decision] : plan_.ledger.entries()) {
      tick();
      if (!model::is_written(plan_.ledger, decision)) continue;
      Hash h;
      of(h, key);
      of(h, decision);
      add("the decisions", h);
    }
    return std::move(out_);
  }

 private:
  struct Visitor {
    Sealer& sealer;
    Hash& hash;
    template <class T>
    void operator()(const char* name, const T& x) {
      if (!only_words(name)) sealer.of(hash, x);
    }
  };

  void add(const std::string& name, const Hash& h) {
    const auto [it, fresh] = out_.emplace(name, h.value());
    if (fresh) return;
    Hash both;
    both.number(it->second);
    both.number(h.value());
    it->second = both.value();
  }
  template <class T>
  void put(const std::string& name, const T& x) {
    Hash h;
    of(h, x);
    add(name, h);
  }

  template <class T>
  void of(Hash& h, const T& x) {
    if constexpr (std::is_floating_point_v<T>) {
      h.real(x);
    } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      h.number(static_cast<std::uint64_t>(x));
    } else if constexpr (std::is_same_v<T, SharedText>) {
      h.text(x.text());
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      h.text(x);
    } else if constexpr (std::is_base_of_v<AnyRef, T>) {
      h.ref(x);
    } else if constexpr (kIsOptional<T>) {
      h.number(x ? 1 : 0);
      if (x) of(h, *x);
    } else if constexpr (kIsShared<T>) {
      columns(h, x);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      h.number(x.size());
      for (const auto& item : x) of(h, item);
    } else {
      Visitor each{*this, h};
      fields(each, x);
    }
  }

  /// Columns that several share are hashed once.
  template <class T>
  void columns(Hash& h, const std::shared_ptr<const T>& p) {
    if (!p) return h.number(0);
    auto [it, fresh] = columns_.emplace(p.get(), 0);
    if (fresh) {
      Hash own;
      of(own, *p);
      it->second = own.value();
    }
    h.number(it->second);
  }

  void objects(TypeId type) {
    const std::uint32_t count = plan_.model.count(type);
    if (count == 0) return;
    Hash h;
    for (std::uint32_t i = 0; i < count; ++i) {
      tick();
      object(h, {type, i});
    }
    add(part_of_kind(type), h);
  }
  void object(Hash& h, AnyRef at) {
    if (const auto* kept = plan_.model.get<model::KeptInstance>(at)) {
      h.text(kept->keyword);
      h.number(static_cast<std::uint64_t>(kept->schema));
      h.number(static_cast<std::uint64_t>(kept->section));
      for (const auto& piece : kept->pieces) {
        if (const auto* text = std::get_if<std::string>(&piece)) h.text(*text);
        if (const auto* ref = std::get_if<AnyRef>(&piece)) h.ref(*ref);
      }
      return;
    }
    const void* data = plan_.model.object(at);
    for (const Attribute& a : model::noun_type(at.type).attributes) {
      const bool has = model::has_value(a, data);
      h.number(has ? 1 : 0);
      if (has && !only_words(a.name)) attribute(h, a, data);
    }
  }
  void select(Hash& h, const model::SelectValue& v) {
    h.ref(v.ref);
    h.text(v.type);
    h.number(v.real ? 1 : 0);
    if (v.real) h.real(*v.real);
    h.text(v.text);
  }
  void attribute(Hash& h, const Attribute& a, const void* object) {
    using namespace model;
    switch (a.storage) {
      case Storage::kReal:
        return h.real(*value_of<Real>(a, object));
      case Storage::kInteger:
        return h.number(static_cast<std::uint64_t>(*value_of<Integer>(a, object)));
      case Storage::kBoolean:
        return h.number(*value_of<Boolean>(a, object) ? 1 : 0);
      case Storage::kText:
        return h.text(*value_of<Text>(a, object));
      case Storage::kEnum:
        return h.number(static_cast<std::uint64_t>(value_of<AnyEnum>(a, object).code));
      case Storage::kRef:
        return h.ref(value_of<AnyRef>(a, object));
      case Storage::kRefList:
        return of(h, value_of<AnyRefList>(a, object).items);
      case Storage::kRefTable:
        return of(h, value_of<RefTable>(a, object).items);
      case Storage::kSelect:
        return select(h, value_of<SelectValue>(a, object));
      case Storage::kSelectList:
        for (const SelectValue& v : value_of<SelectList>(a, object).items) select(h, v);
        return;
      case Storage::kRealList:
        return of(h, value_of<RealList>(a, object).items);
      case Storage::kIntegerList:
        return of(h, value_of<IntegerList>(a, object).items);
      case Storage::kTextList:
        return of(h, value_of<TextList>(a, object).items);
      case Storage::kRealTable:
        return of(h, value_of<RealTable>(a, object).items);
      case Storage::kPath:
        return columns(h, value_of<PathHandle>(a, object));
    }
  }

  const model::Plan& plan_;
  std::map<std::string, std::uint64_t> out_;
  std::map<const void*, std::uint64_t> columns_;
};

}  // namespace

std::set<model::Listed> listed_among(const std::vector<std::string>& edited_parts) {
  std::set<model::Listed> out;
  for (const std::string& part : edited_parts) {
    // A step that is new, or gone, has another name: that is its workingstep's.
    const bool named_anew = part.ends_with(" (new)") || part.ends_with(" (gone)");
    if (part == "the material") out.insert(model::Listed::kMaterial);
    if (part == "the raw piece") out.insert(model::Listed::kRawPiece);
    if (part.starts_with("tool '")) out.insert(model::Listed::kCutters);
    if (part.starts_with("set-up ")) out.insert(model::Listed::kSetups);
    if (part.starts_with("step '") && !named_anew) out.insert(model::Listed::kSteps);
  }
  return out;
}

std::string part_of_kind(TypeId kind) { return "objects of kind " + kind_name(kind); }

std::string part_of_step(const std::string& step_id) { return "step '" + step_id + "'"; }

std::map<std::string, std::uint64_t> seals_of(const model::Plan& plan) { return Sealer(plan).run(); }

}  // namespace capstan::json
