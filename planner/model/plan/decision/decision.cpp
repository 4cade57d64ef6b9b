#include "planner/model/plan/decision/decision.h"

#include <algorithm>
#include <array>
#include <utility>

namespace capstan::model {
namespace {

constexpr std::array<std::string_view, 8> kBinders = {"given", "rule",     "tool_selection", "optimiser",
                                                      "case",  "operator", "default",        "recognition"};

}  // namespace

std::string_view to_text(Binder b) { return kBinders.at(static_cast<std::size_t>(b)); }

bool binder_from_text(std::string_view text, Binder& out) {
  const auto it = std::find(kBinders.begin(), kBinders.end(), text);
  if (it == kBinders.end()) return false;
  out = static_cast<Binder>(it - kBinders.begin());
  return true;
}

Ledger::Ledger() { reason({"given", "given in the file", "the file"}); }

ReasonId Ledger::reason(Reason r) {
  const auto [it, fresh] = ids_.try_emplace(std::move(r), static_cast<ReasonId>(reasons_.size()));
  if (fresh) reasons_.push_back(it->first);
  return it->second;
}

void Ledger::set(DecisionKey key, Decision d) { entries_[std::move(key)] = std::move(d); }

void Ledger::bind(AnyRef object, std::string attribute, Binder binder, Reason why,
                  std::vector<DecisionKey> depends_on, std::vector<Rejected> rejected) {
  if (const Decision* now = find(object, attribute); now != nullptr && now->pinned)
    return;  // the operator's stays
  Decision d;
  d.binder = binder;
  d.reason = reason(std::move(why));
  d.depends_on = std::move(depends_on);
  d.rejected = std::move(rejected);
  set({object, std::move(attribute)}, std::move(d));
}

std::vector<DecisionKey> Ledger::reopen(const DecisionKey& key) {
  std::vector<DecisionKey> opened;
  std::vector<DecisionKey> pending = {key};
  while (!pending.empty()) {
    const DecisionKey at = std::move(pending.back());
    pending.pop_back();
    auto& entry = entries_[at];
    if (entry.pinned || std::find(opened.begin(), opened.end(), at) != opened.end()) continue;
    entry.state = DecisionState::kOpen;
    opened.push_back(at);
    for (const auto& [other, decision] : entries_) {
      const auto& needs = decision.depends_on;
      if (std::find(needs.begin(), needs.end(), at) != needs.end()) pending.push_back(other);
    }
  }
  std::sort(opened.begin(), opened.end());
  return opened;
}

const Decision* Ledger::find(AnyRef object, std::string_view attribute) const {
  const auto it = entries_.find(DecisionKey{object, std::string(attribute)});
  return it == entries_.end() ? nullptr : &it->second;
}

Decision* Ledger::find(AnyRef object, std::string_view attribute) {
  return const_cast<Decision*>(std::as_const(*this).find(object, attribute));
}

bool Ledger::is_open(AnyRef object, std::string_view attribute) const {
  const Decision* d = find(object, attribute);
  return d != nullptr && d->state == DecisionState::kOpen;
}

}  // namespace capstan::model
