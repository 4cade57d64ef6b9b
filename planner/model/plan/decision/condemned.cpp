#include "planner/model/plan/decision/condemned.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/edit/held.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::model {
namespace {

constexpr std::string_view kOfUnreadable = "PIP-UNREADABLE", kOfContradicted = "PIP-CONTRADICTED";

/// Decimals of about three digits that count.
int decimals_of(double v) {
  const double a = std::abs(v);
  return a >= 100.0 ? 0 : a >= 10.0 ? 1 : a >= 0.1 ? 2 : 4;
}

/// The number with about three digits that count, with more where it would read as `other` does.
std::string number(double v, double other) {
  constexpr int kMostDecimals = 6;
  if (!std::isfinite(v)) return "no number";
  int n = decimals_of(v);
  const bool told =
      v == other || !std::isfinite(other) || trimmed(v, n) != trimmed(other, decimals_of(other));
  if (!told) {
    n = std::max(n, decimals_of(other));
    while (n < kMostDecimals && trimmed(v, n) == trimmed(other, n)) ++n;
  }
  return trimmed(v, n);
}

const std::string& feature_name(const Plan& plan, const StepResult& step) {
  static const std::string kNone;
  const auto* ws = plan.model.get<MachiningWorkingstep>(step.step);
  const auto* feature = ws == nullptr ? nullptr : plan.model.get<ManufacturingFeature>(ws->its_feature);
  return feature == nullptr || !feature->its_id ? kNone : *feature->its_id;
}

/// Gathers reasons by the place of their step; 0 is the whole plan.
class Reasons {
 public:
  explicit Reasons(const Plan& plan) : ids_(step_ids(plan)), of_step_(plan.steps.size() + 1) {}

  void add(const std::string& step, const std::string& code, const std::string& text) {
    const auto at = std::find(ids_.begin(), ids_.end(), step);
    const bool whole = step.empty() || at == ids_.end();
    add_at(whole ? 0 : static_cast<std::size_t>(at - ids_.begin()) + 1, code, text);
  }
  /// `place`: 0, or the number of the step.
  void add_at(std::size_t place, const std::string& code, const std::string& text) {
    Condemnation c{place == 0 ? std::string() : ids_[place - 1], code, text};
    auto& there = of_step_[place];
    if (std::find(there.begin(), there.end(), c) == there.end()) there.push_back(std::move(c));
  }
  [[nodiscard]] std::vector<Condemnation> take() {
    std::vector<Condemnation> out;
    for (auto& there : of_step_) std::move(there.begin(), there.end(), std::back_inserter(out));
    return out;
  }

 private:
  std::vector<std::string> ids_;
  std::vector<std::vector<Condemnation>> of_step_;
};

}  // namespace

std::string limit_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string text_of(const ExceededLimit& l) {
  constexpr std::string_view kLeast = "_least";
  const std::string unit = l.unit.empty() ? std::string() : " " + l.unit;
  const std::string value = number(l.value, l.limit), limit = number(l.limit, l.value);
  std::string out = limit_words(l.name);
  if (l.value == 0.0 && l.limit == 0.0) {
    out += " outside the range of every formula";
  } else if (l.name.ends_with(kLeast)) {
    out.resize(out.size() - kLeast.size());
    out += " " + limit + unit + ", at least " + value + unit;
  } else {
    out += " " + value + " of " + limit + unit;
  }
  if (l.at_mm) out += " at X" + trimmed(l.at_mm->x, 1) + " Y" + trimmed(l.at_mm->y, 1);
  return out;
}

std::string text_of(const Plan& plan, const Condemnation& reason) {
  if (reason.step.empty()) return reason.text;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (step_id(plan, plan.steps[i]) == reason.step)
      return "step " + std::to_string(i + 1) + " " + reason.step + ": " + reason.text;
  }
  return "step " + reason.step + ": " + reason.text;
}

namespace {
/// Says that nobody knows what the plan is.
bool of_unknown(const Condemnation& c) { return c.code == kOfUnreadable || c.code == kOfContradicted; }
}  // namespace

const Condemnation& foremost(const std::vector<Condemnation>& reasons) {
  const auto unknown = std::find_if(reasons.begin(), reasons.end(), of_unknown);
  if (unknown != reasons.end()) return *unknown;
  const auto of_step =
      std::find_if(reasons.begin(), reasons.end(), [](const Condemnation& c) { return !c.step.empty(); });
  return of_step == reasons.end() ? reasons.front() : *of_step;
}

std::string text_of(const Plan& plan, const std::vector<Condemnation>& reasons) {
  std::string out = text_of(plan, foremost(reasons));
  if (reasons.size() > 1) out += " (and " + std::to_string(reasons.size() - 1) + " more)";
  return out;
}

bool never_written(const std::vector<Condemnation>& reasons) {
  return std::any_of(reasons.begin(), reasons.end(), of_unknown);
}

std::vector<Condemnation> condemned(const Plan& plan, const std::vector<Finding>& findings) {
  Reasons reasons(plan);
  for (const Finding& f : findings) {
    if (f.severity == Severity::kError) reasons.add(f.step, f.code, f.message);
  }
  for (const Unreadable& u : unreadable(plan)) {
    if (of_whole_plan(u.key)) reasons.add_at(0, std::string(kOfUnreadable), u.why);
  }
  for (const Contradiction& c : contradictions(plan)) reasons.add_at(0, std::string(kOfContradicted), c.why);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (plan.steps[i].exceeded.empty()) continue;
    const std::string held = edits_of_step(plan, plan.steps[i].step);
    for (const ExceededLimit& l : plan.steps[i].exceeded)
      reasons.add_at(i + 1, "PIP-EXCESS",
                     text_of(l) + (held.empty() ? "; use a smaller tool or depth" : "; held by " + held));
  }
  const auto name_of = [&](AnyRef f) {
    const auto* feature = plan.model.get<ManufacturingFeature>(f);
    return feature == nullptr ? std::string() : feature->its_id.value_or("");
  };
  std::set<std::string> unplanned;
  for (const Unplanned& u : plan.unplanned) unplanned.insert(name_of(u.feature));
  for (const Unplanned& u : plan.unplanned) {
    if (u.needed_by.empty()) continue;
    const std::string name = name_of(u.feature);
    const std::string text = "feature '" + name + "' is not planned, and this rests on it: " + u.reason;
    bool found = false;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const std::string& on = feature_name(plan, plan.steps[i]);
      if (on.empty() || std::find(u.needed_by.begin(), u.needed_by.end(), on) == u.needed_by.end()) continue;
      reasons.add_at(i + 1, "PIP-NEEDED", text);
      found = true;
    }
    if (!found) {
      std::string names;  // of those that are not left out with it
      for (const std::string& n : u.needed_by) {
        if (!unplanned.contains(n)) names += (names.empty() ? "'" : ", '") + n + "'";
      }
      if (names.empty()) continue;
      reasons.add_at(0, "PIP-NEEDED",
                     "feature '" + name + "' is not planned, and " + names + " rests on it: " + u.reason);
    }
  }
  return reasons.take();
}

}  // namespace capstan::model
