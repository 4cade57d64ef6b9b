#include "planner/door/app/diff/noun_changes.h"

#include <algorithm>
#include <optional>
#include <set>

#include "planner/door/service/explain/step_view.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Attribute;
using model::Plan;
using model::Storage;
using service::binder_text;
using service::name_of;
using service::value_text;

namespace {

constexpr std::size_t kPairs = 2000;  // of objects compared for one feature, set-up or step

bool is_reference(Storage s) {
  return s == Storage::kRef || s == Storage::kRefList || s == Storage::kRefTable || s == Storage::kSelect ||
         s == Storage::kSelectList;
}

/// Two plans' objects side by side, from a pair of roots, as far as they belong to these alone.
class Pairs {
 public:
  Pairs(const Plan& a, const Plan& b) : a_(a), b_(b) {}

  /// Lines about what differs below the two roots.
  std::vector<std::string> compare(AnyRef a, AnyRef b) {
    pending_ = {{a, b, {}}};
    seen_.clear();
    lines_.clear();
    for (std::size_t i = 0; i < pending_.size() && i < kPairs; ++i) {
      const Pair next = pending_[i];  // the list grows under it
      pair(next);
    }
    return std::move(lines_);
  }

 private:
  struct Pair {
    AnyRef a, b;
    std::string path;
  };

  // Compared under their own heading.
  static bool stands_apart(model::TypeId t) {
    return model::is_a(t, model::TypeId::kExecutable) ||
           model::is_a(t, model::TypeId::kManufacturingFeature) ||
           model::is_a(t, model::TypeId::kWorkpiece) || model::is_a(t, model::TypeId::kToolpathList);
  }

  void pair(const Pair& p) {
    if (p.a.type != p.b.type) {
      lines_.push_back(change(p.path, name_of(a_.model, p.a), name_of(b_.model, p.b)));
      return;
    }
    if (model::is_a(p.a.type, model::TypeId::kKeptInstance)) return;
    for (const Attribute& at : model::noun_type(p.a.type).attributes) {
      const std::string name = p.path.empty() ? std::string(at.name) : p.path + "/" + std::string(at.name);
      if (at.name == "persistent_id") continue;
      // AP238 files call every placement 'orientation'.
      if (at.name == "name" && model::is_a(p.a.type, model::TypeId::kPlacement)) continue;
      // What only one kind of file can hold is no difference when the other says nothing of it.
      if (!at.in_iso14649 &&
          model::has_value(at, a_.model.object(p.a)) != model::has_value(at, b_.model.object(p.b)))
        continue;
      if (is_reference(at.storage)) {
        references(at, p, name);
      } else {
        values(at, p, name);
      }
      decisions(at.name, p, name);
    }
  }

  void values(const Attribute& at, const Pair& p, const std::string& name) {
    if (at.storage == Storage::kPath) return;  // paths are compared as the steps' results
    const std::string x = value_text(a_.model, at, a_.model.object(p.a));
    const std::string y = value_text(b_.model, at, b_.model.object(p.b));
    if (x != y) lines_.push_back(change(name, x, y) + by(p, std::string(at.name)));
  }

  /// " (bound by rule: ...; was given in the file)"
  std::string by(const Pair& p, const std::string& attribute) const {
    const auto* x = a_.ledger.find(p.a, attribute);
    const auto* y = b_.ledger.find(p.b, attribute);
    if (x == nullptr && y == nullptr) return {};
    std::string out = " (" + binder_text(b_, y);
    if (y != nullptr && y->state == model::DecisionState::kBound && !b_.ledger.reason(y->reason).text.empty())
      out += ": " + b_.ledger.reason(y->reason).text;
    const std::string was = binder_text(a_, x);
    if (was != binder_text(b_, y)) out += "; was " + was;
    return out + ")";
  }

  void decisions(std::string_view attribute, const Pair& p, const std::string& name) {
    const auto* x = a_.ledger.find(p.a, attribute);
    const auto* y = b_.ledger.find(p.b, attribute);
    const auto said = [](const Plan& plan, const model::Decision* d) {
      std::string out = binder_text(plan, d);
      if (d != nullptr && d->state == model::DecisionState::kBound) {
        const auto& why = plan.ledger.reason(d->reason);
        if (why.id != "given") out += " (" + why.id + ")";
      }
      return out;
    };
    const std::string from = said(a_, x);
    const std::string to = said(b_, y);
    if (from != to) lines_.push_back("why " + change(name, from, to));
  }

  void follow(AnyRef x, AnyRef y, const std::string& name) {
    if (!x.set() && !y.set()) return;
    if (!x.set() || !y.set() || x.type != y.type) {
      lines_.push_back(change(name, name_of(a_.model, x), name_of(b_.model, y)));
      return;
    }
    if (stands_apart(x.type)) {
      if (name_of(a_.model, x) != name_of(b_.model, y))
        lines_.push_back(change(name, name_of(a_.model, x), name_of(b_.model, y)));
      return;
    }
    if (seen_.insert({x, y}).second) pending_.push_back({x, y, name});
  }

  void lists(const std::vector<AnyRef>& x, const std::vector<AnyRef>& y, const std::string& name) {
    if (x.size() != y.size())
      lines_.push_back(
          change(name, std::to_string(x.size()) + " items", std::to_string(y.size()) + " items"));
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
      follow(x[i], y[i], name + "[" + std::to_string(i) + "]");
  }

  static std::vector<AnyRef> refs_of(const Attribute& at, const void* o) {
    std::vector<AnyRef> out;
    switch (at.storage) {
      case Storage::kRef:
        out.push_back(model::value_of<AnyRef>(at, o));
        break;
      case Storage::kRefList:
        out = model::value_of<model::AnyRefList>(at, o).items;
        break;
      case Storage::kRefTable:
        for (const auto& row : model::value_of<model::RefTable>(at, o).items)
          out.insert(out.end(), row.begin(), row.end());
        break;
      default:
        break;
    }
    return out;
  }

  void references(const Attribute& at, const Pair& p, const std::string& name) {
    const void* x = a_.model.object(p.a);
    const void* y = b_.model.object(p.b);
    if (at.storage == Storage::kSelect || at.storage == Storage::kSelectList) {
      selects(at, x, y, name);
    } else if (at.storage == Storage::kRef) {
      follow(model::value_of<AnyRef>(at, x), model::value_of<AnyRef>(at, y), name);
    } else if (at.name != "its_operations") {  // those are the steps' business
      lists(refs_of(at, x), refs_of(at, y), name);
    }
  }

  void selects(const Attribute& at, const void* x, const void* y, const std::string& name) {
    std::vector<model::SelectValue> u, v;
    if (at.storage == Storage::kSelect) {
      u = {model::value_of<model::SelectValue>(at, x)};
      v = {model::value_of<model::SelectValue>(at, y)};
    } else {
      u = model::value_of<model::SelectList>(at, x).items;
      v = model::value_of<model::SelectList>(at, y).items;
    }
    const auto text = [](const model::SelectValue& s) {
      return s.real ? shortest(*s.real) : s.text.empty() ? std::string("absent") : s.text;
    };
    if (u.size() != v.size())
      lines_.push_back(
          change(name, std::to_string(u.size()) + " items", std::to_string(v.size()) + " items"));
    for (std::size_t i = 0; i < std::min(u.size(), v.size()); ++i) {
      if (u[i].ref.set() || v[i].ref.set()) {
        follow(u[i].ref, v[i].ref, name);
      } else if (text(u[i]) != text(v[i])) {
        lines_.push_back(change(name, text(u[i]), text(v[i])));
      }
    }
  }

  const Plan& a_;
  const Plan& b_;
  std::vector<Pair> pending_;
  std::set<std::pair<AnyRef, AnyRef>> seen_;
  std::vector<std::string> lines_;
};

}  // namespace

std::string change(const std::string& what, const std::string& from, const std::string& to) {
  return what + ": " + from + " -> " + to;
}

std::vector<std::string> noun_changes(const Plan& a, const Plan& b, AnyRef x, AnyRef y) {
  return Pairs(a, b).compare(x, y);
}

}  // namespace capstan::app
