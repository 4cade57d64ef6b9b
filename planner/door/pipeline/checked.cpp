#include "planner/door/pipeline/checked.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "planner/door/pipeline/trial.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/vec.h"
#include "planner/making/optimise/solver/spent_budget.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/edit/step_names.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/verify.h"

// Plans, checks, and plans again what the check condemns. The check is independent: it gets no information
// about the tries, and its findings on the kept plan are passed on unchanged. An error at a proposed step
// bans its choices, the mildest first: its cutter, twice; then its chain; last, the feature is left out
// together with those that rest on it. Where material is left, no mill as wide, or wider, is tried again: it
// reaches no more. A broken order does not depend on the cutter: the chain is banned at once. A feature
// outside the raw piece is left out at once. A step around a boss that cuts nothing is left out if other
// features' steps cut around the boss: the boss is then made, and not missing. Roughing that cuts nothing,
// for others took the material, is left out before the finish of its feature, and what roughs the rests of a
// surface at once. Of all tries the one with the fewest errors is kept, then the one with the fewest features
// left out, then the first. Steps from the file are never changed. Nothing is tried against features that lie
// farther apart than an axis travels.

namespace capstan::pipeline {
namespace {

using model::AnyRef;
using model::Finding;

constexpr int kMostThinner = 2;                          // cuts of one step, before its cutter is given up
constexpr int kMostCutters = 2;                          // of one step, before its chain is given up
constexpr int kBeforeLeavingOut = kMostReplannings - 2;  // tries after which features are left out

struct Offence {
  MadeStep step;
  const Finding* finding = nullptr;
  std::string orders = {};  ///< of the operator's that name the step, "; wanted is ..." each
};

/// An order that names a step may be what the check finds of it.
std::string orders_of(const model::Plan& plan, AnyRef step, const MadeStep& made,
                      const std::vector<model::Edit>& edits) {
  std::string out;
  const model::StepNames n = model::step_names(plan.model, step, made.member.feature);
  for (const model::Edit& e : edits) {
    if (e.kind == model::EditKind::kOrder && (model::names(e.where, n) || model::names(e.before, n)))
      out += "; wanted is " + model::words_of(e);
  }
  return out;
}

bool is_error(const Finding& f) { return f.severity == Severity::kError; }

std::size_t errors_of(const model::Plan& plan, const std::vector<Finding>& findings) {
  return model::condemned(plan, findings).size();
}

/// The heaviest step, for a finding on the torque or power that the whole plan needs; empty for others.
std::string heaviest(const model::Plan& plan, const Finding& f) {
  const bool torque = f.code == "CHK-MACHINE-TORQUE";
  if (!torque && f.code != "CHK-MACHINE-POWER") return {};
  const model::StepResult* most = nullptr;
  const auto load = [&](const model::StepResult& s) { return torque ? s.loads.torque_nm : s.loads.power_w; };
  for (const auto& s : plan.steps) {
    if (most == nullptr || load(s) > load(*most)) most = &s;
  }
  return most == nullptr ? std::string() : model::step_id(plan, *most);
}

/// The middle of what a path cuts; nothing for one that cuts nothing.
std::optional<geometry::Vec3> middle_of(const model::CutterPath& path) {
  geometry::Box3 box;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] != model::MoveKind::kRapid) box.add(path.point(i));
  }
  if (box.empty()) return std::nullopt;
  return 0.5 * (box.lo + box.hi);
}

/// Whether the other features of the set-up lie farther apart in X or Y than the axis travels, which is what
/// the check found: no other cutter or chain of this step's feature mends that, nor does leaving it out.
bool too_far_apart(const model::Plan& plan, const Finding& f, AnyRef step) {
  const auto feature_of = [&](AnyRef s) {
    const auto* w = plan.model.get<model::MachiningWorkingstep>(s);
    return w == nullptr ? AnyRef{} : AnyRef(w->its_feature);
  };
  const auto found = std::find_if(plan.steps.begin(), plan.steps.end(),
                                  [&](const model::StepResult& s) { return s.step == step; });
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const model::LinearAxis& of = plan.machine.axes[axis];
    if (f.code != "CHK-TRAVEL-" + of.name || found == plan.steps.end()) continue;
    geometry::Box3 middles;
    for (const model::StepResult& s : plan.steps) {
      if (s.setup != found->setup || !s.path || feature_of(s.step) == feature_of(step)) continue;
      if (const auto middle = middle_of(*s.path)) middles.add(*middle);
    }
    if (middles.empty()) return false;
    const geometry::Vec3 size = middles.size();
    return (axis == 0 ? size.x : size.y) > of.travel_max_mm - of.travel_min_mm;
  }
  return false;
}

/// The first error of each proposed step that another way to make its feature may mend.
std::vector<Offence> offences_of(const model::Plan& plan, const std::vector<Finding>& findings,
                                 const Tries& tries, const std::vector<model::Edit>& edits) {
  std::map<std::string, AnyRef> step_of;
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < ids.size(); ++i) step_of.emplace(ids[i], plan.steps[i].step);
  std::vector<Offence> out;
  std::set<AnyRef> seen;
  for (const Finding& f : findings) {
    if (!is_error(f)) continue;
    const auto step = f.step.empty() ? step_of.find(heaviest(plan, f)) : step_of.find(f.step);
    if (step == step_of.end()) continue;
    const auto made = tries.made.find(step->second);
    if (made == tries.made.end() || too_far_apart(plan, f, step->second)) continue;
    if (seen.insert(step->second).second)
      out.push_back({made->second, &f, orders_of(plan, step->second, made->second, edits)});
  }
  return out;
}

/// Bans by what the check finds.
class BansByCheck {
 public:
  explicit BansByCheck(Tries& tries) : tries_(tries) {}

  /// Bans the choices of these steps; returns what was banned, to be reported when the replacement is known.
  std::vector<std::pair<MadeStep, std::string>> condemn(const std::vector<Offence>& offences, int tried) {
    std::vector<std::pair<MadeStep, std::string>> out;
    for (const Offence& o : offences) {
      const std::string found = "the check found " + o.finding->code + ": " + o.finding->message + o.orders;
      const MadeStep& s = o.step;
      const bool of_order = o.finding->property == 28;
      // Material outside the raw piece, or a feature read in two ways, remains so with every cutter and
      // chain.
      const bool of_drawing = o.finding->code == "CHK-OUTSIDE" || o.finding->code == "CHK-MEANING";
      int& hits = hits_[{s.member, s.chain, s.in_chain}];
      // Torque, power, bending: a thinner cut of the same cutter.
      const bool of_load =
          o.finding->property == 17 || o.finding->property == 20 || o.finding->property == 21;
      if (of_load && !s.as_found && tried < kBeforeLeavingOut &&
          thinned_[{s.member, s.chain, s.in_chain}]++ < kMostThinner) {
        tries_.bans.cut_thinner(s.member, s.chain, s.in_chain, found);
        out.emplace_back(s, found);
        continue;
      }
      // What others cut away exists without its own step, a boss or what is roughed, and a surface without
      // what roughs its rests: leave the step out before banning anything.
      const bool spare = s.of_rest || (o.finding->code == "CHK-CUTS-NOTHING" && s.may_cut_nothing);
      if (spare && tries_.bans.cuts_nothing(s.member, s.chain, s.in_chain) == nullptr) {
        tries_.bans.cut_nothing(s.member, s.chain, s.in_chain, found);
        out.emplace_back(s, found);
        continue;
      }
      if (tried >= kBeforeLeavingOut || of_drawing) {
        tries_.bans.leave_out(s.member.feature, "step '" + s.name + "' with " + s.cutter + ": " + found);
      } else if (of_order || hits >= kMostCutters) {
        tries_.bans.ban_chain(s.member, s.chain, "step '" + s.name + "': " + found);
      } else if (o.finding->code == "CHK-LEFT" && s.mill) {
        tries_.bans.ask_narrower(s.member, s.chain, s.in_chain, *s.mill, found);
      } else {
        tries_.bans.ban_cutter(s.member, s.chain, s.in_chain, s.cutter, found);
      }
      ++hits;
      out.emplace_back(s, found);
    }
    return out;
  }

 private:
  Tries& tries_;
  std::map<std::tuple<draft::Member, std::string, std::size_t>, int> hits_, thinned_;
};

/// "step 'X': planned anew with em6 instead of em10, because the check found …"
std::string told(const Tries& tries, const MadeStep& before, const std::string& why) {
  const MadeStep* now = nullptr;
  for (const auto& [ref, made] : tries.made) {
    if (made.member == before.member && made.name == before.name) now = &made;
  }
  const bool out = tries.bans.left_out(before.member.feature) != nullptr;
  std::string what = "planned anew in another way";
  if (out) {
    what = "its feature is left out";
  } else if (tries.bans.cuts_nothing(before.member, before.chain, before.in_chain) != nullptr &&
             (now == nullptr || now->cutter == before.cutter)) {
    what = "left out";
  } else if (now != nullptr && now->cutter != before.cutter) {
    what = "planned anew with " + now->cutter + " instead of " + before.cutter;
  } else if (now != nullptr && now->chain == before.chain) {
    what = "planned anew with thinner cuts";
  }
  return "step '" + before.name + "': " + what + ", because " + why;
}

}  // namespace

void tell_tries(const Tries& tries, Job& job) {
  for (const std::string& s : tries.said) job.note("PIP-ANEW", s);
}

Checked checked(model::Plan plan, Job& job, memo::Memo* proofs, const model::CutBefore* before) {
  Checked out;
  const auto began = job.now();
  out.findings = verify::check_plan(plan, job, proofs, before, &out.part);
  out.plan = std::move(plan);
  out.checking = job.now() - began;
  return out;
}

bool is_edited(const Inputs& inputs) {
  return !inputs.edits.empty() || model::edits_are_all(inputs.provenance);
}

Result<Checked> bind_anew(const model::Plan& plan, const Inputs& inputs, const Policy& policy, Job& job,
                          const Anew& anew) {
  auto until = anew.until;
  std::optional<model::CutBefore> before;
  if (policy.window) before.emplace(model::CutBefore{plan, policy.window->first});
  const model::CutBefore* const cut_before = before ? &*before : nullptr;
  Tries tries;
  const std::size_t read = job.diagnostics().size();  // said of the inputs: true of every try
  auto first = bind_within(plan, inputs, policy, tries, job);
  if (!first) return tl::unexpected(first.error());
  if (anew.acceptable) {
    if (auto ok = anew.acceptable(*first); !ok) return tl::unexpected(ok.error());
  }
  Checked best = policy.bind == Bind::kAll ? checked(*std::move(first), job, inputs.proofs.get(), cut_before)
                                           : Checked{*std::move(first), {}, 0, {}};
  std::vector<std::pair<std::string, std::string>> replaced;
  best.needed = tries.needed;
  std::vector<std::string> said = tries.said;
  auto diagnostics = job.take_diagnostics();
  std::size_t least = errors_of(best.plan, best.findings);
  BansByCheck bans(tries);
  std::vector<Offence> offences = offences_of(best.plan, best.findings, tries, inputs.edits);
  std::vector<Finding> findings;  // of the last try, which `offences` point into
  for (int tried = 0; tried < kMostReplannings && least > 0 && !offences.empty(); ++tried) {
    if (policy.bind != Bind::kAll || job.stop_requested()) break;
    const auto condemned = bans.condemn(offences, tried);
    Job trial;
    begin_trial(trial, job);
    if (job.deadline()) until = until ? std::min(*until, *job.deadline()) : *job.deadline();
    if (until) trial.set_deadline(*until);
    if (trial.stop_requested()) break;
    auto again = bind_within(plan, inputs, policy, tries, trial);
    if (!again) break;
    for (const auto& [step, why] : condemned) {
      tries.said.push_back(told(tries, step, why));
      replaced.emplace_back(step.name, why);
    }
    Checked now_checked = checked(*std::move(again), trial, inputs.proofs.get(), cut_before);
    findings = now_checked.findings;
    if (trial.stop_requested()) break;  // not checked to its end: no better than what is there
    offences = offences_of(now_checked.plan, findings, tries, inputs.edits);
    auto now = trial.take_diagnostics();
    const std::size_t errors = errors_of(now_checked.plan, findings);
    const bool better =
        errors < least || (errors == least && now_checked.plan.unplanned.size() < best.plan.unplanned.size());
    if (!better || (anew.acceptable && !anew.acceptable(now_checked.plan))) continue;
    least = errors;
    best = std::move(now_checked);
    best.replanned = tried + 1;
    best.needed = tries.needed;
    best.replaced = replaced;
    said = tries.said;
    diagnostics.resize(read);
    diagnostics.insert(diagnostics.end(), std::make_move_iterator(now.begin()),
                       std::make_move_iterator(now.end()));
  }
  for (auto& d : diagnostics) job.report(std::move(d));
  poll();  // its last check may not have come to its end, and a better plan may have been on its way
  tries.said = std::move(said);
  tell_tries(tries, job);
  return best;
}

Result<Checked> bind_checked(const model::Plan& plan, const Inputs& inputs, const Policy& policy, Job& job,
                             const Anew& anew) {
  const bool edited = is_edited(inputs);
  const optimise::SpentBudgetScope budget;
  auto out = stoppable(
      job,
      [&]() -> Result<Checked> {
        auto made = edited ? bind_edited(plan, inputs, policy, job, anew)
                           : bind_anew(plan, inputs, policy, job, anew);
        if (!made || !anew.tells_needed) return made;
        // Planned and checked once: a feature at which the check finds an error is not planned anew here.
        const auto planned_with = [&](const Inputs& with, Job& trial) -> Result<model::Plan> {
          Tries tries;
          auto again = bind_within(plan, with, policy, tries, trial);
          if (!again) return again;
          Checked found = checked(*std::move(again), trial);
          for (const Offence& o : offences_of(found.plan, found.findings, tries, with.edits))
            found.plan.unplanned.push_back({.feature = o.step.member.feature, .reason = o.finding->message});
          // An error that is not of such a step: not all of the part is planned, though no feature is to
          // blame.
          const auto error = std::find_if(found.findings.begin(), found.findings.end(), &is_error);
          if (found.plan.unplanned.empty() && error != found.findings.end())
            found.plan.unplanned.push_back({.feature = {}, .reason = error->message});
          return std::move(found.plan);
        };
        auto named =
            name_needed(std::move(made->plan), std::move(made->needed), inputs, policy, planned_with, job);
        poll();
        if (!named) return tl::unexpected(named.error());
        made->plan = *std::move(named);
        return made;
      },
      [&]() -> Result<Checked> { return tl::unexpected(stopped_planning(plan)); });
  // What is edited is planned twice, and a plan that is condemned anew.
  if (out) out->budget_spent = budget.spent() || edited || out->replanned > 0;
  tell_altered_cases(inputs, job);
  return out;
}

}  // namespace capstan::pipeline
