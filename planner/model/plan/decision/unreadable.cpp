#include "planner/model/plan/decision/unreadable.h"

#include <algorithm>
#include <map>
#include <set>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/has_reason.h"

namespace capstan::model {

namespace {

/// The references of one attribute.
template <class Visit>
void references_of(const Attribute& a, const void* data, const Visit& visit) {
  switch (a.storage) {
    case Storage::kRef:
      visit(value_of<AnyRef>(a, data));
      break;
    case Storage::kRefList:
      for (const AnyRef r : value_of<AnyRefList>(a, data).items) visit(r);
      break;
    case Storage::kRefTable:
      for (const auto& row : value_of<RefTable>(a, data).items) {
        for (const AnyRef r : row) visit(r);
      }
      break;
    case Storage::kSelect:
      visit(value_of<SelectValue>(a, data).ref);
      break;
    case Storage::kSelectList:
      for (const auto& v : value_of<SelectList>(a, data).items) visit(v.ref);
      break;
    default:
      break;
  }
}

/// What of a feature is placed by it.
void placed_by(const Model& m, AnyRef feature, std::vector<AnyRef>& out) {
  if (const auto* c = m.get<CompoundFeature>(feature)) {
    for (const AnyRef e : c->elements.items) out.push_back(e);
  }
  if (const auto* r = m.get<ReplicateFeature>(feature)) out.push_back(r->replicate_base_feature);
}

}  // namespace

/// Who refers to whom by which attribute, the other way round.
struct Leads::Referrers {
  struct By {
    AnyRef object;
    std::string_view attribute;
  };
  explicit Referrers(const Model& m) {
    for (std::size_t t = 1; t < kTypeCount; ++t) {
      for (const AnyRef at : m.all(static_cast<TypeId>(t))) {
        if (m.holds<KeptInstance>(at)) {
          for_each_reference(m, at, [&](AnyRef to) { of_[to].push_back({at, {}}); });
          continue;
        }
        for (const Attribute& a : noun_type(at.type).attributes)
          references_of(a, m.object(at), [&](AnyRef to) { of_[to].push_back({at, a.name}); });
      }
    }
  }

  /// Everything that leads to the object, itself included, not by the attributes of those names: the way back
  /// from a feature to what is made of it, and to the piece that it is cut from.
  [[nodiscard]] std::set<AnyRef> leading_to(AnyRef object,
                                            std::initializer_list<std::string_view> but) const {
    std::vector<AnyRef> pending = {object};
    std::set<AnyRef> seen;
    while (!pending.empty()) {
      const AnyRef at = pending.back();
      pending.pop_back();
      if (!seen.insert(at).second) continue;
      const auto by = of_.find(at);
      if (by == of_.end()) continue;
      for (const By& b : by->second) {
        if (std::find(but.begin(), but.end(), b.attribute) == but.end()) pending.push_back(b.object);
      }
    }
    return seen;
  }

 private:
  std::map<AnyRef, std::vector<By>> of_;
};

std::vector<Unreadable> unreadable(const Plan& plan) {
  std::vector<Unreadable> out;
  if (!has_reason(plan.ledger, kUnreadable)) return out;
  for (const auto& [key, decision] : plan.ledger.entries()) {
    const Reason& why = plan.ledger.reason(decision.reason);
    if (why.id != kUnreadable) continue;
    if (decision.value_hash != hash_attribute(plan.model, key.object, key.attribute)) continue;
    out.push_back({key, why.text});
  }
  return out;
}

bool of_whole_plan(const DecisionKey& key) {
  switch (key.object.type) {
    case TypeId::kWorkpiece:
    case TypeId::kSetup:
    case TypeId::kWorkpieceSetup:
      return true;
    default:
      return key.object.type == TypeId::kWorkplan && key.attribute == "its_setup";
  }
}

void set_unreadable(Plan& plan, AnyRef object, std::string attribute, std::string why) {
  Decision d;
  d.binder = Binder::kGiven;
  d.reason = plan.ledger.reason({std::string(kUnreadable), std::move(why), "the file"});
  d.value_hash = hash_attribute(plan.model, object, attribute);
  plan.ledger.set({object, std::move(attribute)}, std::move(d));
}

Leads::Leads(const Model& m) : m_(m), all_(std::make_unique<Referrers>(m)) {}
Leads::~Leads() = default;

Touched Leads::touched_by(AnyRef object) const {
  Touched out;
  const auto add = [&](const std::set<AnyRef>& leading, TypeId kind, std::vector<AnyRef>& to) {
    for (const AnyRef at : leading) {
      if (is_a(at.type, kind)) to.push_back(at);
    }
  };
  add(all_->leading_to(object, {"its_operations", "its_workpiece"}), TypeId::kManufacturingFeature,
      out.features);
  add(all_->leading_to(object, {"its_feature", "its_operations", "its_workpiece"}),
      TypeId::kMachiningWorkingstep, out.steps);
  // An operation that no workingstep carries out: its feature's.
  if (out.features.empty() && out.steps.empty())
    add(all_->leading_to(object, {"its_workpiece"}), TypeId::kManufacturingFeature, out.features);
  for (std::size_t i = 0; i < out.features.size(); ++i) {
    std::vector<AnyRef> placed;
    placed_by(m_, out.features[i], placed);
    for (const AnyRef f : placed) {
      if (f.set() && std::find(out.features.begin(), out.features.end(), f) == out.features.end())
        out.features.push_back(f);
    }
  }
  return out;
}

}  // namespace capstan::model
