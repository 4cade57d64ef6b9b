#include "planner/making/given/steps/open_values.h"

#include "planner/making/step/path/job_of.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::given {
namespace {

using draft::StepDraft;
using model::AnyRef;

/// Removes open depths and widths, which were chosen for another cut; they are chosen again.
void drop_open_depths(model::Plan& plan, const StepDraft& step) {
  model::Model& m = plan.model;
  const model::Ledger& ledger = plan.ledger;
  const auto drop = [&](AnyRef object, const char* attribute, model::Real& value) {
    if (ledger.is_open(object, attribute)) value.reset();
  };
  const auto both = [&](auto* o) {
    if (o == nullptr) return;
    drop(step.operation, "axial_cutting_depth", o->axial_cutting_depth);
    if constexpr (requires { o->radial_cutting_depth; })
      drop(step.operation, "radial_cutting_depth", o->radial_cutting_depth);
  };
  both(m.get<model::PlaneMilling>(step.operation));
  both(m.get<model::SideMilling>(step.operation));
  both(m.get<model::BottomAndSideMilling>(step.operation));
  const auto* o = m.get<model::Two5dMillingOperation>(step.operation);
  const AnyRef strategy = o == nullptr ? AnyRef{} : AnyRef(o->its_machining_strategy);
  if (auto* s = m.get<model::Two5dMillingStrategy>(strategy)) drop(strategy, "overlap", s->overlap);
}

}  // namespace

void mark_open(model::Plan& plan, Reopen reopen, StepDraft& step) {
  const model::Model& m = plan.model;
  const auto* op = m.get<model::MachiningOperation>(step.operation);
  if (op == nullptr) return;
  model::Ledger& ledger = plan.ledger;
  const auto pinned = [&](AnyRef object, const char* attribute) {
    const auto* d = object.set() ? ledger.find(object, attribute) : nullptr;
    return d != nullptr && d->pinned;
  };
  if (step::has_given_path(plan, step)) {
    // A path of the file fixes its cutter; feeds may still be chosen. One that planning computed is computed
    // again.
    step.open_tool = !m.holds<model::MachiningTool>(op->its_tool);
  } else {
    step.open_tool = reopen >= Reopen::kTools || !m.holds<model::MachiningTool>(op->its_tool) ||
                     ledger.is_open(step.operation, "its_tool") || tooling::is_requirement(m, op->its_tool);
    if (pinned(step.operation, "its_tool") && m.holds<model::MachiningTool>(op->its_tool))
      step.open_tool = false;
    // When a tool goes, the values chosen for it go too.
    if (step.open_tool) ledger.reopen({step.operation, "its_tool"});
    drop_open_depths(plan, step);
  }
  const auto* tech = m.get<model::MillingTechnology>(op->its_technology);
  const bool no_feed = tech == nullptr || (!tech->feedrate && !tech->feedrate_per_tooth) ||
                       tech->feedrate.value_or(1.0) <= 0.0;
  const bool no_speed = tech == nullptr || (!tech->spindle && !tech->cutspeed);
  step.open_technology = step.open_tool || reopen >= Reopen::kTechnology || no_feed || no_speed ||
                         (op->its_technology.set() && (ledger.is_open(op->its_technology, "feedrate") ||
                                                       ledger.is_open(op->its_technology, "spindle")));
  if (pinned(op->its_technology, "feedrate") && pinned(op->its_technology, "spindle"))
    step.open_technology = false;
  // In a technology that is open in part, values that somebody stated stay; values that planning chose go.
  const auto stays = [&](bool absent, const char* attribute, const char* other) {
    if (!step.open_technology || absent) return false;
    if (pinned(op->its_technology, attribute) || pinned(op->its_technology, other)) return true;
    if (reopen >= Reopen::kTechnology) return false;
    for (const char* name : {attribute, other}) {
      const auto* d = ledger.find(op->its_technology, name);
      if (d == nullptr) continue;
      if (d->state != model::DecisionState::kBound) return false;
      if (model::by_planning(d)) return false;
    }
    return true;
  };
  step.keep_speed = stays(no_speed, "spindle", "cutspeed");
  step.keep_feed = stays(no_feed, "feedrate", "feedrate_per_tooth");
}

}  // namespace capstan::given
