#include "planner/model/plan/decision/edited.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/fresh_edits.h"

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

/// The decisions as they were read, by number in the order of their keys, and who was decided from whom. Each
/// walk passes a decision once, whatever the number of edits.
class Decided {
 public:
  explicit Decided(const std::map<DecisionKey, Decision>& entries) {
    for (const auto& [key, d] : entries) {
      number_.emplace(&key, keys_.size());
      keys_.push_back(&key);
      was_.push_back(&d);
    }
    needs_.resize(keys_.size());
    needed_by_.resize(keys_.size());
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      for (const DecisionKey& k : was_[i]->depends_on) {
        const auto it = number_.find(&k);
        if (it == number_.end()) continue;
        needs_[i].push_back(it->second);
        needed_by_[it->second].push_back(i);
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] std::size_t number(const DecisionKey& key) const { return number_.at(&key); }
  [[nodiscard]] const DecisionKey& key(std::size_t i) const { return *keys_[i]; }
  [[nodiscard]] const Decision& was(std::size_t i) const { return *was_[i]; }
  [[nodiscard]] const std::vector<std::size_t>& needs(std::size_t i) const { return needs_[i]; }
  [[nodiscard]] const std::vector<std::size_t>& needed_by(std::size_t i) const { return needed_by_[i]; }

 private:
  struct ByKey {
    bool operator()(const DecisionKey* a, const DecisionKey* b) const { return *a < *b; }
  };
  std::map<const DecisionKey*, std::size_t, ByKey> number_;
  std::vector<const DecisionKey*> keys_;
  std::vector<const Decision*> was_;
  std::vector<std::vector<std::size_t>> needs_, needed_by_;
};

/// Goes from `start` along `next` through what `enter` lets in; `passed` has what no walk enters again.
template <class Next, class Enter>
void walk(std::size_t start, std::vector<bool>& passed, Next&& next, Enter&& enter) {
  std::vector<std::size_t> pending = {start};
  while (!pending.empty()) {
    const std::size_t at = pending.back();
    pending.pop_back();
    for (const std::size_t i : next(at)) {
      if (passed[i] || !enter(i)) continue;
      passed[i] = true;
      pending.push_back(i);
    }
  }
}

}  // namespace

std::vector<Edited> take_edits(const Model& model, Ledger& ledger) {
  std::vector<Edited> out;
  for (const auto& [key, d] : ledger.entries()) {
    if (d.value_hash == 0) continue;
    const std::uint64_t now = hash_attribute(model, key.object, key.attribute);
    const bool open = d.state == DecisionState::kOpen;
    if (now == d.value_hash || (open && !has_value_now(model, key))) continue;
    out.push_back({key, open, d.binder, {}});
  }
  if (out.empty()) return out;
  const std::map<DecisionKey, Decision> entries = ledger.entries();
  const Decided before(entries);
  std::vector<bool> edited(before.size());
  for (const Edited& e : out) edited[before.number(e.key)] = true;
  // One answer's decisions depend on each other directly, so the walk stays among those of one reason.
  std::vector<bool> told(before.size());
  for (const Edited& e : out) {
    const std::size_t number = before.number(e.key);
    const Decision& was = before.was(number);
    if (e.was_open || (was.binder != Binder::kOptimiser && was.binder != Binder::kCase)) continue;
    walk(
        number, told, [&](std::size_t at) -> auto& { return before.needs(at); },
        [&](std::size_t i) {
          if (before.was(i).reason != was.reason) return false;
          if (!edited[i]) {
            const DecisionKey& k = before.key(i);
            ledger.find(k.object, k.attribute)->reason = ledger.reason(
                {std::string(kKept), "as it was planned, before " + e.key.attribute + " was edited",
                 "the plan that was read"});
          }
          return true;
        });
  }
  std::vector<bool> opened(before.size());
  for (Edited& e : out) {
    const std::size_t number = before.number(e.key);
    walk(
        number, opened, [&](std::size_t at) -> auto& { return before.needed_by(at); },
        [&](std::size_t i) {
          const Decision& d = before.was(i);
          const DecisionKey& key = before.key(i);
          if (d.pinned || edited[i] || !chosen_again(key, d)) return false;
          if (d.state == DecisionState::kBound) e.opened.push_back(key);
          ledger.find(key.object, key.attribute)->state = DecisionState::kOpen;
          return true;
        });
    std::sort(e.opened.begin(), e.opened.end());
    const Decision& was = before.was(number);
    Decision now;
    now.pinned = was.pinned;
    now.binder = was.pinned ? Binder::kOperator : Binder::kGiven;
    if (!has_value_now(model, e.key)) now.state = DecisionState::kOpen;
    const std::string by =
        e.was_open ? "it was left open" : "planning chose it (" + binder_words(e.was) + ")";
    now.reason = ledger.reason({std::string(kEditedReason), "edited in the file since " + by, "the file"});
    now.value_hash = 0;  // of an edit since it was written: `fresh_edits`
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

ReportedEdit reported_edit_of(const Diagnostic& d) {
  if (d.code == kDisagreesCode) return ReportedEdit::kDisagrees;
  if (d.code != kEditedCode && d.code != kEditedJsonCode) return ReportedEdit::kNothing;
  return d.severity == Severity::kNote ? ReportedEdit::kValue : ReportedEdit::kPart;
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
              "take all of it as it is"};
}

}  // namespace capstan::model
