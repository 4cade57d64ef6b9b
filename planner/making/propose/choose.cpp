#include "planner/making/propose/choose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/propose/members.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/nouns/arena/walk.h"
#include "tooling/selection/select.h"

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
    const std::string* why = bans.cutter_banned(member, chain, at, c.cutter.id);
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
  constexpr char kSize = '@';
  for (model::Candidate& c : s.ranked) {
    if (!(c.cutter.adjustable_to_mm > 0.0)) continue;
    const std::string id = c.cutter.id;
    const auto look_at = [&](const model::Cutter& other) {
      if (other.id.substr(0, other.id.find(kSize)) != id) return false;
      const bool same = std::abs(other.cutting_diameter_mm - c.cutter.cutting_diameter_mm) < kSameMm;
      c.cutter.id = same ? other.id : id + kSize + trimmed(c.cutter.cutting_diameter_mm, 4);
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

}  // namespace

Chosen choose(const Choice& choice, const model::Proposal& p, const FeatureShape& shape, const Member& member,
              const std::vector<StepDraft>& steps, const std::vector<std::string>& in_use,
              std::vector<model::Rejected>& rejected, Job& job) {
  const model::Plan& plan = choice.piece.plan;
  for (const auto& chain : p.chains) {
    Chosen out;
    out.key = draft::key_of(chain);
    std::vector<std::string> used = in_use;
    std::string why_not;
    if (const std::string* why = choice.bans.chain_banned(member, out.key)) why_not = *why;
    for (std::size_t i = 0; why_not.empty() && i < chain.size(); ++i) {
      const model::ProposedStep step = as_opened(chain, i, out.tools);
      tooling::Preferences wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
      wanted.used = used;
      auto s = tooling::select(step.tool, choice.usable, plan.material, plan.machine, wanted);
      step::weigh_by_cases(choice.cases, plan, step.operation, shape, s);
      if (step.operation == TypeId::kWorkpieceProbing) {  // can be measured by other means
        out.tools.push_back(std::move(s));
        continue;
      }
      if (s.ranked.empty()) {
        why_not = none_fits(step, s);
        break;
      }
      tell_apart(steps, out.tools, s);
      why_not = keep_untried(choice.bans, member, out.key, i, s);
      if (why_not.empty()) why_not = keep_able(choice, step, s, job);
      if (!why_not.empty()) break;
      tooling::use(used, s.ranked.front().cutter.id);
      out.tools.push_back(std::move(s));
    }
    if (why_not.empty()) {
      out.chain = &chain;
      return out;
    }
    rejected.push_back({chain_text(chain, shape), why_not});
  }
  return {};
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

std::vector<model::Rejected> alternatives(const Choice& choice, const model::Proposal& p,
                                          const FeatureShape& shape, const Chosen& chosen,
                                          const std::vector<std::string>& used) {
  const model::Plan& plan = choice.piece.plan;
  const auto seconds = [](const std::vector<model::Selection>& tools) {
    double out = 0.0;
    for (const model::Selection& s : tools) out += s.ranked.empty() ? 0.0 : s.ranked.front().estimated_s;
    return out;
  };
  std::vector<model::Rejected> out;
  const std::string taken = trimmed(seconds(chosen.tools), 1) + " s";
  for (const auto& chain : p.chains) {
    if (&chain <= chosen.chain || chain.empty()) continue;
    std::vector<model::Selection> tools;
    std::string why;
    for (std::size_t i = 0; why.empty() && i < chain.size(); ++i) {
      const model::ProposedStep step = as_opened(chain, i, tools);
      tooling::Preferences wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
      wanted.used = used;
      tools.push_back(tooling::select(step.tool, choice.usable, plan.material, plan.machine, wanted));
      if (step.operation != TypeId::kWorkpieceProbing && tools.back().ranked.empty())
        why = none_fits(step, tools.back());
    }
    if (why.empty())
      why = "about " + trimmed(seconds(tools), 1) + " s of cutting, the chain taken about " + taken +
            "; the rules prefer the chain taken";
    out.push_back({chain_text(chain, shape), std::move(why)});
  }
  return out;
}

}  // namespace capstan::propose
