#include "planner/making/propose/choose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/propose/coaxial_steps.h"
#include "planner/making/propose/operation_nouns.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/cutter/sized_name.h"
#include "tooling/selection/select.h"
#include "tooling/selection/selections.h"

namespace capstan::propose {
namespace {

using draft::Member;
using draft::StepDraft;
using model::FeatureShape;
using model::TypeId;

/// Removes drills, reamers and taps that the spindle cannot turn at any useful feed; gives the reason if none
/// is left.
std::string keep_able(const Choice& choice, const model::ProposedStep& step, model::Selection& s, Job& job) {
  if (!model::is_a(step.operation, TypeId::kDrillingTypeOperation) ||
      model::is_a(step.operation, TypeId::kThreadDrilling))
    return {};
  optimise::Options options = choice.options;
  options.starts = 1;
  std::vector<model::Candidate> able;
  std::string why;
  for (const model::Candidate& c : s.ranked) {
    const auto answer = optimise::cut(
        step::hole_question(choice.piece.plan, choice.margin_deviations, step, c), options, job);
    if (answer && answer->feasible) {
      able.push_back(c);
      continue;
    }
    const std::string limit = !answer                    ? answer.error().message
                              : answer->violated.empty() ? ""
                                                         : answer->violated.front();
    s.rejected.push_back({c.cutter.id, "no feed is within the limits: " + limit});
    if (why.empty()) why = step.name + ": " + c.cutter.id + ": no feed is within the limits: " + limit;
  }
  if (able.empty()) return why;
  s.ranked = std::move(able);
  return {};
}

/// Drops cutters that were tried in vain; what would fit is then said with that reason.
std::string keep_untried(const draft::Bans& bans, const Member& member, const std::string& chain,
                         std::size_t at, model::Selection& s) {
  std::string last;
  std::erase_if(s.ranked, [&](const model::Candidate& c) {
    const std::string* why = bans.cutter_banned(member, chain, at, c.cutter);
    if (why == nullptr) return false;
    s.rejected.push_back({c.cutter.id, *why});
    last = c.cutter.id + ": " + *why;
    return true;
  });
  return s.ranked.empty() ? last : std::string();
}

/// A boring tool on a slide is one tool for each size that it is set to: what a plan sets to two sizes has
/// two numbers in the tool table. The first keeps the library's name, the next have their size behind it.
void tell_apart(const std::vector<StepDraft>& steps, const std::vector<model::Selection>& before,
                model::Selection& s) {
  constexpr double kSameMm = 1e-6;
  for (model::Candidate& c : s.ranked) {
    if (!(c.cutter.adjustable_to_mm > 0.0)) continue;
    const std::string id = c.cutter.id;
    const auto look_at = [&](const model::Cutter& other) {
      if (model::name_without_size(other.id) != id) return false;
      const bool same = std::abs(other.cutting_diameter_mm - c.cutter.cutting_diameter_mm) < kSameMm;
      c.cutter.id = same ? other.id : model::name_with_size(id, c.cutter.cutting_diameter_mm);
      return same;
    };
    const bool taken =
        std::any_of(steps.begin(), steps.end(), [&](const StepDraft& step) { return look_at(step.cutter); });
    for (std::size_t i = 0; i < before.size() && !taken; ++i) {
      if (!before[i].ranked.empty() && look_at(before[i].ranked.front().cutter)) break;
    }
  }
}

std::string none_fits(const model::ProposedStep& step, const model::Selection& tools) {
  return step.name + ": no cutter fits; " + tools.would_fit + " would" +
         (step.why.text.empty() ? std::string() : " (" + step.why.text + ")");
}

/// How many times as long as the quickest the first chain has to be estimated. Measured: of 54 chains of
/// pockets and slots in the examples, the corpus and 20 parts drawn to be difficult, in 6061 and C45, the
/// planned time is 0.66 to 1.8 times the estimated one, of 50 of them 0.72 to 1.34; 1.34 / 0.72, rounded up.
constexpr double kDecisive = 2.0;
/// What a chain has to save beside that, s: less is not worth another way than the rules prefer. Default,
/// unsourced.
constexpr double kWorthwhileS = 60.0;

/// Whether the estimates of a shape's chains are good enough to choose by. Those of holes are of single steps
/// (0.7 to 1.7 times as long, tests/door/pipeline/tools/estimate_test.cpp), those of surfaces off by up to 25
/// times.
bool judged_by_time(const FeatureShape& s) {
  return s.kind == model::ShapeKind::kPocket || s.kind == model::ShapeKind::kSlot;
}

/// A finishing pass is as wide as what the step before left.
void take_what_is_left(const model::ProposedStep& before, const model::ProposedStep& step,
                       tooling::Preferences& wanted) {
  const double left = before.allowance_side_mm - step.allowance_side_mm;
  if (!(wanted.width_mm > 0.0) || !(left > 0.0)) return;
  wanted.volume_mm3 *= left / wanted.width_mm;
  wanted.width_mm = left;
}

/// Why the operator's edits rule a step out; empty: they do not.
std::string ruled_out(const Choice& choice, const model::StepNames& names, const model::ProposedStep& step) {
  if (choice.edits == nullptr) return {};
  if (const auto no = model::barred_operation(*choice.edits, names, step.operation))
    return step.name + ": " + no->why;
  if (const auto no = model::barred_strategy(*choice.edits, names, model::word_of(step.strategy)))
    return step.name + ": " + no->why;
  return {};
}

/// What edits rule out of the cutters that would do.
std::string and_barred(const std::vector<model::Rejected>& barred) {
  return barred.empty() ? std::string()
                        : "; ruled out is '" + barred.front().what + "', by " + barred.front().why;
}

/// A chain with a cutter for each step, or why there is none.
struct Equipped {
  Chosen chosen;
  std::string why_not;
  double seconds = 0.0;  ///< cutting, and changing to what is not in use, about
  [[nodiscard]] std::size_t further() const { return chosen.further.size(); }
};

/// Finds cutters for all steps of a chain. `able`: also that drills, reamers and taps can be turned.
Equipped equip(const Choice& choice, const std::vector<model::ProposedStep>& chain, const FeatureShape& shape,
               const Member& member, const std::vector<StepDraft>& steps,
               const std::vector<std::string>& in_use, bool able, Job& job) {
  const model::Plan& plan = choice.piece.plan;
  Equipped out;
  out.chosen.key = draft::key_of(chain);
  out.chosen.chain = &chain;
  std::vector<std::string> used = in_use;
  if (const std::string* why = choice.bans.chain_banned(member, out.chosen.key)) {
    out.why_not = *why;
    return out;
  }
  std::vector<model::Selection>& tools = out.chosen.tools;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const model::ProposedStep step = as_opened(chain, i, tools);
    tooling::Preferences wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
    wanted.used = used;
    if (choice.thrift != Thrift::kNone) wanted.most = choice.usable.size();
    if (i > 0) take_what_is_left(chain[i - 1], step, wanted);
    const model::StepNames names{draft::feature_name(plan.model, member.feature), step.name};
    out.why_not = ruled_out(choice, names, step);
    if (!out.why_not.empty()) return out;
    std::vector<model::Cutter> kept;
    std::vector<model::Rejected> barred;
    const std::vector<model::Cutter>& usable =
        choice.edits == nullptr
            ? choice.usable
            : model::allowed(*choice.edits, names, choice.usable, step.tool.classes, kept, barred);
    const bool asked_of_all = choice.selections != nullptr && &usable == &choice.usable;
    model::Selection s = asked_of_all
                             ? choice.selections->of(step.tool, wanted)
                             : tooling::select(step.tool, usable, plan.material, plan.machine, wanted);
    s.rejected.insert(s.rejected.end(), barred.begin(), barred.end());
    const casebase::OfStep of{step.operation, member.feature, coolant_of(plan.machine, step)};
    step::weigh_by_cases(choice.cases, plan, of, shape, s);
    if (step.operation == TypeId::kWorkpieceProbing) {  // can be measured by other means
      tools.push_back(std::move(s));
      continue;
    }
    if (s.ranked.empty()) {
      out.why_not = none_fits(step, s) + and_barred(barred);
      return out;
    }
    tell_apart(steps, tools, s);
    if (choice.thrift != Thrift::kNone) {
      const double most = s.ranked.front().estimated_s + kMostForFewerS;
      std::stable_partition(s.ranked.begin(), s.ranked.end(), [&](const model::Candidate& c) {
        return c.estimated_s <= most && std::find(used.begin(), used.end(), c.cutter.id) != used.end();
      });
    }
    out.why_not = keep_untried(choice.bans, member, out.chosen.key, i, s);
    if (out.why_not.empty() && able) out.why_not = keep_able(choice, step, s, job);
    if (!out.why_not.empty()) return out;
    const std::string& id = s.ranked.front().cutter.id;
    if (std::find(used.begin(), used.end(), id) == used.end()) {
      out.seconds += plan.machine.tool_change_s + plan.machine.spindle.spin_up_s;
      used.push_back(id);
      out.chosen.further.push_back(id);
    }
    out.seconds += s.ranked.front().estimated_s;
    tools.push_back(std::move(s));
  }
  return out;
}

bool failed_before(const model::Proposal& p, const Equipped& e) {
  return static_cast<std::size_t>(e.chosen.chain - p.chains.data()) >= p.chains.size() - p.failed_before;
}

std::string about(const Equipped& e) { return "about " + trimmed(e.seconds, 1) + " s"; }

}  // namespace

Chosen choose(const Choice& choice, const model::Proposal& p, const FeatureShape& shape, const Member& member,
              const std::vector<StepDraft>& steps, const std::vector<std::string>& in_use,
              std::vector<model::Rejected>& rejected, Job& job) {
  std::vector<Equipped> fit;           // chains that have all their cutters, in the rules' order
  std::vector<model::Rejected> after;  // the others that come after the first of those
  for (const auto& chain : p.chains) {
    Equipped e = equip(choice, chain, shape, member, steps, in_use,
                       fit.empty() || judged_by_time(shape) || choice.thrift == Thrift::kChains, job);
    if (e.why_not.empty())
      fit.push_back(std::move(e));
    else
      (fit.empty() ? rejected : after).push_back({chain_text(chain, shape), e.why_not});
  }
  if (fit.empty()) return {};
  // A chain that failed before is no quicker way.
  const auto quickest = std::min_element(fit.begin(), fit.end(), [&](const Equipped& a, const Equipped& b) {
    const bool failed_a = failed_before(p, a), failed_b = failed_before(p, b);
    return failed_a != failed_b ? failed_b : a.seconds < b.seconds;
  });
  const Equipped& first = fit.front();
  const bool decisive = judged_by_time(shape) && decisively_quicker(quickest->seconds, first.seconds);
  const auto taken =
      choice.thrift == Thrift::kChains
          ? std::min_element(fit.begin(), fit.end(),
                             [](const Equipped& a, const Equipped& b) { return a.further() < b.further(); })
      : decisive ? quickest
                 : fit.begin();
  const bool fewer = taken->further() < first.further() && choice.thrift == Thrift::kChains;
  for (auto e = fit.begin(); e != fit.end(); ++e) {
    if (e == taken) continue;
    const bool slower = decisive && e->seconds > taken->seconds;
    rejected.push_back({chain_text(*e->chosen.chain, shape),
                        about(*e) + " of cutting and tool changes, the chain taken " + about(*taken) +
                            (fewer ? "; the chain taken needs fewer tools, and the magazine is full"
                             : e == fit.begin() ? "; the rules prefer it, but that is decisively longer"
                             : slower           ? ""
                                      : "; the rules prefer the chain taken, and these estimates are "
                                        "not sure enough to take another")});
  }
  rejected.insert(rejected.end(), after.begin(), after.end());
  taken->chosen.seconds = taken->seconds;
  return std::move(taken->chosen);
}

bool decisively_quicker(double seconds, double than_seconds) {
  return kDecisive * seconds <= than_seconds && seconds + kWorthwhileS <= than_seconds;
}

std::string chain_text(const std::vector<model::ProposedStep>& chain, const FeatureShape& shape) {
  if (chain.empty()) return "chain";
  std::string out;
  for (const model::ProposedStep& step : chain) {
    const bool prefixed = step.name.starts_with(shape.name + " ");
    out += (out.empty() ? "" : " + ") + (prefixed ? step.name.substr(shape.name.size() + 1) : step.name);
  }
  return out + " [" + chain.front().why.id + "]";
}

}  // namespace capstan::propose
