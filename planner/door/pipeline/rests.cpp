#include <algorithm>
#include <set>

#include "planner/door/pipeline/stages.h"
#include "planner/making/piece/rests.h"

// Leaves out the features that rest on an unplanned feature.

namespace capstan::pipeline {
namespace {

std::string name_of(const model::Model& m, AnyRef f) {
  const auto* named = m.get<model::ManufacturingFeature>(f);
  return named == nullptr ? std::string() : named->its_id.value_or("");
}

std::set<AnyRef> unplanned_of(const model::Plan& plan) {
  std::set<AnyRef> out;
  for (const model::Unplanned& u : plan.unplanned) out.insert(u.feature);
  return out;
}

}  // namespace

Learned leave_what_rests(const model::Plan& plan, const Drafts& drafts) {
  Learned out;
  const std::set<AnyRef> roots = unplanned_of(plan);
  if (roots.empty()) return out;
  std::set<AnyRef> planned;
  for (const draft::StepDraft& s : drafts.steps) {
    if (s.proposed) planned.insert(s.feature);
  }
  const std::vector<piece::RestsOn> all = piece::what_rests(plan.model, drafts.setups);
  const std::set<AnyRef> resting = piece::resting_on(all, roots);
  for (const piece::RestsOn& r : all) {
    if (!resting.contains(r.after) || !(roots.contains(r.before) || resting.contains(r.before))) continue;
    if (!planned.contains(r.after)) continue;
    // Of the root, where it rests on one through others.
    const auto is_why = [&](const model::Unplanned& u) {
      return u.feature == r.before || piece::resting_on(all, {u.feature}).contains(r.before);
    };
    const auto why = std::find_if(plan.unplanned.begin(), plan.unplanned.end(), is_why);
    out.rests.push_back({r.after, r.before, why == plan.unplanned.end() ? std::string() : why->reason});
    out.again = true;
  }
  return out;
}

std::vector<model::Unplanned> with_what_rests(const model::Plan& plan,
                                              const std::vector<draft::SetupDraft>& setups) {
  std::vector<model::Unplanned> out = plan.unplanned;
  if (out.empty()) return out;
  const std::vector<piece::RestsOn> all = piece::what_rests(plan.model, setups);
  std::set<AnyRef> named;
  for (model::Unplanned& u : out) {
    if (!named.insert(u.feature).second) continue;
    for (const AnyRef f : piece::resting_on(all, {u.feature})) u.needed_by.push_back(name_of(plan.model, f));
    std::sort(u.needed_by.begin(), u.needed_by.end());
  }
  return out;
}

}  // namespace capstan::pipeline
