#include "planner/making/propose/missing_tools.h"

#include <optional>
#include <utility>

#include "planner/making/propose/coaxial_steps.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/model/nouns/all.h"
#include "tooling/selection/least_cutter.h"
#include "tooling/selection/select.h"

namespace capstan::propose {
namespace {

/// What a chain lacks; nothing where a tool would not help. A tool that is lacking is taken as if it were
/// there: what the next steps ask for follows from it.
std::optional<std::vector<model::NeededTool>> lacked_by(const Choice& choice,
                                                        const std::vector<model::ProposedStep>& chain,
                                                        const model::FeatureShape& shape,
                                                        const draft::Member& member,
                                                        std::vector<std::string> used) {
  const model::Plan& plan = choice.piece.plan;
  std::vector<model::NeededTool> lacked;
  std::vector<model::Selection> tools;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const model::ProposedStep step = as_opened(chain, i, tools);
    tooling::Preferences wanted = step::preferences_of(choice.piece, choice.batch, step, shape);
    wanted.used = used;
    auto s = tooling::select(step.tool, choice.usable, plan.material, plan.machine, wanted);
    if (s.ranked.empty() && step.operation != model::TypeId::kWorkpieceProbing) {
      auto needed = tooling::needed_cutter(step.tool, plan.material, plan.machine, wanted);
      if (!needed) return std::nullopt;
      lacked.push_back({member.feature, shape.name, needed->cutter, model::words_of(step.tool)});
      s.ranked.push_back(*std::move(needed));
    }
    if (!s.ranked.empty()) tooling::use(used, s.ranked.front().cutter.id);
    tools.push_back(std::move(s));
  }
  return lacked;
}

}  // namespace

std::vector<model::NeededTool> needed_tools(const Choice& choice, const model::Proposal& p,
                                            const model::FeatureShape& shape, const draft::Member& member,
                                            const std::vector<std::string>& used) {
  std::optional<std::vector<model::NeededTool>> best;
  for (const auto& chain : p.chains) {
    if (choice.bans.chain_banned(member, draft::key_of(chain)) != nullptr) continue;
    auto lacked = lacked_by(choice, chain, shape, member, used);
    // A chain that lacks nothing has failed for another reason.
    if (!lacked || lacked->empty()) continue;
    if (!best || lacked->size() < best->size()) best = std::move(lacked);
  }
  return best.value_or(std::vector<model::NeededTool>{});
}

}  // namespace capstan::propose
