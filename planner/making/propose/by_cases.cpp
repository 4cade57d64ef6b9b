#include "planner/making/propose/by_cases.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "casebase/recall/advice.h"
#include "planner/ground/base/number.h"
#include "planner/making/propose/coaxial_steps.h"
#include "planner/making/propose/operation_nouns.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/making/step/cut/strategies.h"
#include "tooling/selection/select.h"

namespace capstan::propose {
namespace {

enum class Known { kProven, kNothing, kFailed };

/// A chain with what is known of it.
struct KnownChain {
  std::vector<model::ProposedStep> chain;
  Known known = Known::kNothing;
  std::string words;
};

KnownChain judge(const Choice& choice, std::vector<model::ProposedStep> chain, model::AnyRef feature,
                 const model::FeatureShape& shape) {
  KnownChain out{std::move(chain), Known::kNothing, {}};
  const model::Plan& plan = choice.piece.plan;
  std::vector<model::Selection> tools;
  bool proven = true;
  for (std::size_t i = 0; i < out.chain.size(); ++i) {
    const model::ProposedStep step = as_opened(out.chain, i, tools);
    const auto wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
    auto s = tooling::select(step.tool, choice.usable, plan.material, plan.machine, wanted);
    const casebase::OfStep of{step.operation, feature, coolant_of(plan.machine, step)};
    step::weigh_by_cases(choice.cases, plan, of, shape, s);
    tools.push_back(std::move(s));
    if (step.operation == model::TypeId::kWorkpieceProbing) continue;
    if (tools.back().ranked.empty()) return out;
    const auto e = step::experience_with(*choice.cases, plan, of, shape, tools.back().ranked.front());
    if (e.bad >= casebase::kRepeats && e.success < step::kLikelierToFail) {
      out.known = Known::kFailed;
      out.words = step.name + " " + trimmed(100.0 * e.success, 0) + " % likely to go well: " + e.words;
      return out;
    }
    proven = proven && e.good >= casebase::kRepeats && e.success >= casebase::kTrustInTable;
    if (!e.words.empty()) out.words += (out.words.empty() ? "" : "; ") + step.name + ": " + e.words;
  }
  if (proven) out.known = Known::kProven;
  return out;
}

}  // namespace

model::Proposal by_cases(const Choice& choice, model::Proposal proposal, model::AnyRef feature,
                         const model::FeatureShape& shape) {
  if (choice.cases == nullptr || proposal.chains.size() < 2) return proposal;
  std::vector<KnownChain> all;
  for (auto& chain : proposal.chains) all.push_back(judge(choice, std::move(chain), feature, shape));
  const std::string was_first = draft::key_of(all.front().chain);
  std::stable_sort(all.begin(), all.end(),
                   [](const KnownChain& a, const KnownChain& b) { return a.known < b.known; });
  KnownChain& first = all.front();
  if (draft::key_of(first.chain) != was_first && first.known == Known::kProven) {
    for (model::ProposedStep& step : first.chain)
      step.why.text += "; taken before the rules' first choice, for it went well before: " + first.words;
  }
  proposal.chains.clear();
  for (KnownChain& j : all) {
    proposal.failed_before += j.known == Known::kFailed ? 1 : 0;
    const bool fell = &j != &first && draft::key_of(j.chain) == was_first;
    if (j.known == Known::kFailed)
      proposal.rejected.push_back(
          {chain_text(j.chain, shape),
           (fell ? std::string(step::kFirstFailed) : "put last, for it went badly before: ") + j.words});
    proposal.chains.push_back(std::move(j.chain));
  }
  return proposal;
}

}  // namespace capstan::propose
