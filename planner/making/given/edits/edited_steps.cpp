#include "planner/making/given/edits/edited_steps.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planner/making/given/listed_steps.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/edit/restrictions.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::given {

using draft::StepDraft;
using model::AnyRef;
using model::Cutter;
using model::Model;

namespace {

template <class M>
auto depth_in(M& m, AnyRef operation)
    -> decltype(&m.template get<model::PlaneMilling>(operation)->axial_cutting_depth) {
  if (auto* o = m.template get<model::PlaneMilling>(operation)) return &o->axial_cutting_depth;
  if (auto* o = m.template get<model::SideMilling>(operation)) return &o->axial_cutting_depth;
  if (auto* o = m.template get<model::BottomAndSideMilling>(operation)) return &o->axial_cutting_depth;
  return nullptr;
}

}  // namespace

std::vector<StepDraft> edited_steps(const model::Plan& plan, std::size_t cut) {
  std::vector<StepDraft> out;
  const std::vector<AnyRef> executed = steps_in_order(plan);
  for (std::size_t i = std::min(cut, executed.size()); i < executed.size(); ++i) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(executed[i]);
    if (ws == nullptr || !plan.model.holds<model::MachiningOperation>(ws->its_operation)) continue;
    StepDraft s;
    s.step = model::Ref<model::Executable>(executed[i]);
    s.feature = ws->its_feature;
    s.operation = ws->its_operation;
    out.push_back(std::move(s));
  }
  return out;
}

model::Real* depth_of(Model& m, AnyRef operation) { return depth_in(m, operation); }
const model::Real* depth_of(const Model& m, AnyRef operation) { return depth_in(m, operation); }

std::string_view strategy_word(const Model& m, AnyRef operation) {
  const auto* o = m.get<model::Two5dMillingOperation>(operation);
  if (o == nullptr || !o->its_machining_strategy.set()) return {};
  const AnyRef s = o->its_machining_strategy;
  if (m.holds<model::ExplicitStrategy>(s)) return model::kConstantEngagementWord;
  static constexpr std::pair<model::TypeId, model::StrategyKind> kKinds[] = {
      {model::TypeId::kBidirectionalMilling, model::StrategyKind::kBidirectional},
      {model::TypeId::kUnidirectionalMilling, model::StrategyKind::kUnidirectional},
      {model::TypeId::kContourParallel, model::StrategyKind::kContourParallel},
      {model::TypeId::kContourSpiral, model::StrategyKind::kContourSpiral},
      {model::TypeId::kContourBidirectional, model::StrategyKind::kContourBidirectional},
      {model::TypeId::kCenterMilling, model::StrategyKind::kCenterMilling}};
  for (const auto& [type, kind] : kKinds) {
    if (s.type == type) return model::word_of(kind);
  }
  return {};
}

AnyRef technology_of(const Model& m, AnyRef operation) {
  const auto* op = m.get<model::MachiningOperation>(operation);
  return op == nullptr ? AnyRef{} : AnyRef(op->its_technology);
}

std::string called(const Model& m, const StepDraft& s) { return "step '" + draft::name_of(m, s) + "'"; }

Diagnostic conflict(const model::Plan& plan, const std::string& what) {
  return {
      .code = "EDIT-CONFLICT", .message = what, .file = plan.file_name, .hint = "take one of the two back"};
}

std::optional<Cutter> cutter_of(const model::Plan& plan, AnyRef operation,
                                const std::vector<Cutter>& library) {
  const auto* op = plan.model.get<model::MachiningOperation>(operation);
  if (op == nullptr || !op->its_tool.set() || plan.ledger.is_open(operation, kToolAttribute) ||
      !plan.model.holds<model::MachiningTool>(op->its_tool) ||
      tooling::is_requirement(plan.model, op->its_tool))
    return std::nullopt;
  Job silent;  // what is to be said of the tool is said when it is used
  auto cutter = tooling::cutter_from_nouns(plan.model, op->its_tool, silent, library);
  if (!cutter) return std::nullopt;
  return *std::move(cutter);
}

}  // namespace capstan::given
