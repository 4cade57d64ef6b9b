#include "planner/model/plan/edited.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/arena/walk.h"

// An edit breaks what was decided from the value, downstream along `depends_on`; upstream only the reasons
// that one answer of the optimiser shares: these name the limits that held with the value as it was.

namespace capstan::model {
namespace {

/// Whether planning chooses such a value again when it is open; rules decide with the operation as a whole.
bool chosen_again(const DecisionKey& key, const Decision& d) {
  return d.binder == Binder::kOptimiser || d.binder == Binder::kCase || d.binder == Binder::kToolSelection ||
         key.attribute == "its_toolpath";
}

bool has_value_now(const Model& model, const DecisionKey& key) {
  const Attribute* a = find_attribute(key.object.type, key.attribute);
  return a != nullptr && has_value(*a, model.object(key.object));
}

std::string binder_words(Binder b) {
  std::string out(to_text(b));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

/// All that `key` was decided from, directly or through others.
std::set<DecisionKey> upstream(const std::map<DecisionKey, Decision>& entries, const DecisionKey& key) {
  std::set<DecisionKey> out;
  std::vector<DecisionKey> pending = {key};
  while (!pending.empty()) {
    const auto it = entries.find(pending.back());
    pending.pop_back();
    if (it == entries.end()) continue;
    for (const DecisionKey& k : it->second.depends_on) {
      if (out.insert(k).second) pending.push_back(k);
    }
  }
  return out;
}

}  // namespace

std::vector<Edited> take_edits(const Model& model, Ledger& ledger) {
  std::vector<Edited> out;
  std::set<DecisionKey> keys;
  for (const auto& [key, d] : ledger.entries()) {
    if (d.value_hash == 0) continue;
    const std::uint64_t now = hash_attribute(model, key.object, key.attribute);
    const bool open = d.state == DecisionState::kOpen;
    if (now == d.value_hash || (open && !has_value_now(model, key))) continue;
    out.push_back({key, open, d.binder, {}});
    keys.insert(key);
  }
  if (out.empty()) return out;
  const std::map<DecisionKey, Decision> before = ledger.entries();
  for (const Edited& e : out) {
    const Decision& was = before.at(e.key);
    const bool chosen = was.binder == Binder::kOptimiser || was.binder == Binder::kCase;
    for (const DecisionKey& k : chosen && !e.was_open ? upstream(before, e.key) : std::set<DecisionKey>{}) {
      Decision* d = ledger.find(k.object, k.attribute);
      if (d == nullptr || d->reason != was.reason || keys.contains(k)) continue;
      d->reason =
          ledger.reason({std::string(kKept), "as it was planned, before " + e.key.attribute + " was edited",
                         "the plan that was read"});
    }
  }
  for (Edited& e : out) {
    std::set<DecisionKey> seen = {e.key};
    std::vector<DecisionKey> pending = {e.key};
    while (!pending.empty()) {
      const DecisionKey at = std::move(pending.back());
      pending.pop_back();
      for (const auto& [key, d] : before) {
        const bool needs = std::find(d.depends_on.begin(), d.depends_on.end(), at) != d.depends_on.end();
        if (!needs || d.pinned || !chosen_again(key, d) || keys.contains(key) || !seen.insert(key).second)
          continue;
        if (d.state == DecisionState::kBound) e.opened.push_back(key);
        ledger.find(key.object, key.attribute)->state = DecisionState::kOpen;
        pending.push_back(key);
      }
    }
    std::sort(e.opened.begin(), e.opened.end());
    const Decision& was = before.at(e.key);
    Decision now;
    now.pinned = was.pinned;
    now.binder = was.pinned ? Binder::kOperator : Binder::kGiven;
    if (!has_value_now(model, e.key)) now.state = DecisionState::kOpen;
    const std::string by =
        e.was_open ? "it was left open" : "planning chose it (" + binder_words(e.was) + ")";
    now.reason = ledger.reason({"given.edited", "edited in the file since " + by, "the file"});
    now.value_hash = hash_attribute(model, e.key.object, e.key.attribute);
    ledger.set(e.key, std::move(now));
  }
  return out;
}

std::string text_of(const Edited& e) {
  std::string out = "was edited since it was ";
  out += e.was_open ? "left open" : "bound by " + binder_words(e.was);
  out += "; it counts as given";
  if (!e.opened.empty())
    out += e.opened.size() == 1
               ? ", and the value chosen from it is open"
               : ", and " + std::to_string(e.opened.size()) + " values chosen from it are open";
  return out;
}

std::optional<std::uint64_t> hash_from_text(std::string_view text) {
  constexpr std::size_t kDigits = 16;
  std::uint64_t out = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
  if (text.size() != kDigits || ec != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

EditTold edit_told_by(const Diagnostic& d) {
  if (d.code == kDisagreesCode) return EditTold::kDisagrees;
  if (d.code != kEditedCode && d.code != kEditedJsonCode) return EditTold::kNothing;
  return d.severity == Severity::kNote ? EditTold::kValue : EditTold::kPart;
}

Diagnostic steps_disagree(const std::string& how, std::string file) {
  return {.code = std::string(kDisagreesCode),
          .severity = Severity::kWarning,
          .message = how + "; the workplan counts",
          .file = std::move(file),
          .hint = "plan it again"};
}

Diagnostic parts_edited(std::string code, const std::vector<std::string>& parts, std::string file) {
  constexpr std::size_t kNamed = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(parts.size(), kNamed); ++i) names += (i == 0 ? "" : ", ") + parts[i];
  if (parts.size() > kNamed) names += " and " + std::to_string(parts.size() - kNamed) + " more";
  return {.code = std::move(code),
          .severity = Severity::kWarning,
          .message = "the file was edited after it was written: " + names,
          .file = std::move(file),
          .hint =
              "`capstan plan` chooses anew what was chosen from the old values; `check` and `explain` "
              "take all of it as it stands"};
}

}  // namespace capstan::model
