#pragma once

#include "casebase/casebase.h"

/// What a step of a plan asks: the same when asking and when retaining.
namespace capstan::casebase {

/// What a question takes from a step, beside its cutter and its sizes.
struct OfStep {
  model::TypeId operation = model::TypeId::kNone;
  model::AnyRef feature = {};
  Coolant coolant = Coolant::kUnknown;
};
/// The question of a step of this plan, with coolant and the roughness that its feature asks for.
[[nodiscard]] Question question_of(const model::Plan& plan, const OfStep& step, const model::Cutter& cutter,
                                   const Sizes& sizes);
/// The keyword of an operation's strategy; empty: it has none.
[[nodiscard]] std::string strategy_of(const model::Plan& plan, model::AnyRef operation);
/// What a step is cut with, by its machine functions.
[[nodiscard]] Coolant coolant_of(const model::StepResult& step);

}  // namespace capstan::casebase
