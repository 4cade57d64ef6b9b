#include "planner/making/given/listed_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/making/draft/setup_nouns.h"
#include "planner/making/given/placed_setups.h"
#include "planner/making/piece/piece.h"
#include "planner/making/step/path/job_of.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "rules/rules.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::given {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using model::AnyRef;
using model::Ref;
using model::TypeId;

/// Walks program structure in order of execution, without recursion.
class Walker {
 public:
  Walker(const model::Plan& plan, const std::map<AnyRef, std::string>& unreadable, Listed& out, Job& job)
      : plan_(plan), unreadable_(unreadable), out_(out), job_(job) {}

  /// From the project's workplan on.
  void walk() {
    const auto* project = plan_.model.get<model::Project>(plan_.project);
    AnyRef root = project != nullptr ? AnyRef(project->main_workplan) : AnyRef{};
    if (!root.set()) {
      const auto plans = plan_.model.all(TypeId::kWorkplan);
      if (!plans.empty()) root = plans.front();
    }
    push({root, {}});
    while (!pending_.empty()) {
      const Item at = pending_.back();
      pending_.pop_back();
      visit(at);
    }
  }
  /// What is not understood, by its feature.
  [[nodiscard]] const std::vector<model::Unplanned>& not_done() const { return not_done_; }

 private:
  struct Item {
    AnyRef executable;
    Ref<model::Setup> setup;
  };

  void push(Item i) { pending_.push_back(i); }
  template <class List>
  void push_all(const List& list, Ref<model::Setup> setup) {
    for (std::size_t i = list.size(); i-- > 0;) push({list[i], setup});
  }

  void visit(Item at) {
    const model::Model& m = plan_.model;
    if (const auto* plan = m.get<model::Workplan>(at.executable)) {
      if (!entered_.insert(at.executable).second) {
        return say("PIP-CYCLE", at.executable, "is nested in itself or executed twice; done once");
      }
      push_all(plan->its_elements, plan->its_setup.set() ? plan->its_setup : at.setup);
    } else if (const auto* p = m.get<model::Parallel>(at.executable)) {
      say("PIP-PARALLEL", at.executable, "has parallel branches; one machine does them one after the other");
      push_all(p->branches, at.setup);
    } else if (const auto* n = m.get<model::NonSequential>(at.executable)) {
      push_all(n->its_elements, at.setup);
    } else if (const auto* s = m.get<model::Selective>(at.executable)) {
      choose(*s, at);
    } else if (m.holds<model::IfStatement>(at.executable) || m.holds<model::WhileStatement>(at.executable) ||
               m.holds<model::Assignment>(at.executable)) {
      say("PIP-CONDITION", at.executable,
          "depends on variables that only the control knows; it is kept in the plan and not planned");
    } else if (m.holds<model::MachiningWorkingstep>(at.executable) ||
               m.holds<model::RapidMovement>(at.executable)) {
      step(at);
    } else if (m.holds<model::NcFunction>(at.executable)) {
      say("PIP-NC-FUNCTION", at.executable, "is kept in the plan; programs leave it out");
    } else if (m.holds<model::TouchProbing>(at.executable)) {
      say("PIP-PROBING", at.executable, "is a probing step; it is kept in the plan and not planned");
    } else if (at.executable.set()) {
      refuse(at.executable, at.executable, at.executable);
    }
  }

  void choose(const model::Selective& s, Item at) {
    for (std::size_t i = 0; i < s.its_elements.size(); ++i) {
      const auto* e = plan_.model.get<model::Executable>(s.its_elements[i]);
      if (e != nullptr && e->enabled.value_or(true)) return push({s.its_elements[i], at.setup});
    }
    say("PIP-SELECTIVE", at.executable, "has no enabled element to choose");
  }

  void step(Item at) {
    const auto* e = plan_.model.get<model::Executable>(at.executable);
    if (!e->enabled.value_or(true)) return say("PIP-DISABLED", at.executable, "is disabled; not executed");
    StepDraft work;
    work.step = Ref<model::Executable>(at.executable);
    work.setup = setup_index(at.setup);
    if (const auto* ws = plan_.model.get<model::MachiningWorkingstep>(at.executable)) {
      const AnyRef feature = ws->its_feature.set() ? AnyRef(ws->its_feature) : at.executable;
      if (plan_.model.holds<model::KeptInstance>(ws->its_operation) ||
          plan_.model.holds<model::ExtendedOperation>(ws->its_operation)) {
        return refuse(at.executable, ws->its_operation, feature);
      }
      work.feature = ws->its_feature;
      work.operation = ws->its_operation;
      for (const AnyRef of : {at.executable, AnyRef(ws->its_feature)}) {
        const auto wrong = of.set() ? unreadable_.find(of) : unreadable_.end();
        if (wrong != unreadable_.end() && work.unreadable.empty()) work.unreadable = wrong->second;
      }
    }
    out_.steps.push_back(std::move(work));
  }

  // Keeps entities without a noun as they are: turning (ISO 14649-12, and its forms in AP238), additive,
  // vendors'.
  void refuse(AnyRef executable, AnyRef kept, AnyRef feature) {
    const auto* k = plan_.model.get<model::KeptInstance>(kept);
    const std::string keyword = k == nullptr ? std::string(model::noun_type(kept.type).keyword) : k->keyword;
    const std::string why = (is_turning(k) ? "is turning (" + keyword + "), which is not planned"
                                           : "has " + keyword + ", which is not understood") +
                            "; it is kept in the plan and not executed";
    say("PIP-UNHANDLED", executable, why);
    not_done_.push_back({feature, why});
  }

  static bool is_turning(const model::KeptInstance* k) {
    static constexpr std::array<std::string_view, 14> kOperations = {
        "FACING",          "FACING_ROUGH",     "FACING_FINISH", "GROOVING",         "GROOVING_ROUGH",
        "GROOVING_FINISH", "CUTTING_IN",       "CONTOURING",    "CONTOURING_ROUGH", "CONTOURING_FINISH",
        "THREADING_ROUGH", "THREADING_FINISH", "THREADING",     "KNURLING"};  // ISO 14649-12
    if (k == nullptr) return false;
    if (k->keyword.find("TURNING") != std::string::npos) return true;
    for (const auto& piece : k->pieces) {
      const auto* text = std::get_if<std::string>(&piece);
      if (text != nullptr && text->find("'turning'") != std::string::npos) return true;
    }
    return std::find(kOperations.begin(), kOperations.end(), k->keyword) != kOperations.end();
  }

  std::size_t setup_index(Ref<model::Setup> setup) {
    for (std::size_t i = 0; i < out_.setups.size(); ++i) {
      if (out_.setups[i].setup == setup) return i;
    }
    SetupDraft work;
    work.setup = setup;
    out_.setups.push_back(work);
    return out_.setups.size() - 1;
  }

  void say(const char* code, AnyRef what, const std::string& message) {
    const auto* e = plan_.model.get<model::Executable>(what);
    const std::string name = e != nullptr ? e->its_id.value_or("") : "";
    job_.report({.code = code,
                 .severity = Severity::kWarning,
                 .message = std::string(model::noun_type(what.type).keyword) + " '" + name + "' " + message,
                 .file = plan_.file_name,
                 .line = plan_.model.origin(what).line,
                 .instance = plan_.model.origin(what).instance});
  }

  const model::Plan& plan_;
  const std::map<AnyRef, std::string>& unreadable_;
  std::vector<model::Unplanned> not_done_;
  Listed& out_;
  Job& job_;
  std::vector<Item> pending_;
  std::set<AnyRef> entered_;
};

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

/// A tool cannot be withdrawn at no feed: such a value is taken as not stated, for this operation only.
void overrule_retract(model::Plan& plan, const StepDraft& step, Job& job) {
  auto* op = plan.model.get<model::DrillingTypeOperation>(step.operation);
  if (op == nullptr || !op->feed_on_retract || *op->feed_on_retract > 0.0) return;
  const std::string value = trimmed(*op->feed_on_retract, 4);
  op->feed_on_retract.reset();
  job.report({.code = "PIP-CHANGED",
              .severity = Severity::kWarning,
              .message = "operation '" + op->its_id.value_or("") + "': feed_on_retract is " + value +
                         ", at which the tool never leaves its hole; taken as not stated",
              .file = plan.file_name,
              .line = plan.model.origin(step.operation).line,
              .instance = plan.model.origin(step.operation).instance});
}

/// A reamer that stops in its hole marks the wall: given so, it is kept only while everything given is kept.
void overrule_stop(model::Plan& plan, const StepDraft& step, Job& job) {
  auto* op = plan.model.get<model::Reaming>(step.operation);
  if (op == nullptr || !step.open_technology || !op->spindle_stop_at_bottom.value_or(false)) return;
  op->spindle_stop_at_bottom = false;
  job.warn("PIP-CHANGED", "operation '" + op->its_id.value_or("") +
                              "': the reamer would be withdrawn with the spindle stopped; it keeps turning");
  plan.ledger.bind(step.operation, "spindle_stop_at_bottom", model::Binder::kRule,
                   {"safety.reamer_turns", "a reamer withdrawn without turning scores the wall and may break",
                    "safety: the spindle turns while the tool is in the material"});
}

/// Replaces coolant that the machine does not have by the next best, and reports it.
void overrule_coolant(model::Plan& plan, const StepDraft& step, Job& job) {
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op == nullptr) return;
  const AnyRef functions = op->its_machine_functions;
  auto* f = plan.model.get<model::MillingMachineFunctions>(functions);
  if (f == nullptr) return;
  const model::Machine& machine = plan.machine;
  const bool through = f->through_spindle_coolant.value_or(false) && !machine.has_through;
  const bool mist = f->mist.value_or(false) && !machine.has_mist;
  const bool flood = f->coolant.value_or(false) && !machine.has_flood;
  if (!through && !mist && !flood) return;
  std::string what;
  for (const auto& [lacks, name] : {std::pair{through, "coolant through the spindle"},
                                    std::pair{mist, "mist"}, std::pair{flood, "flood coolant"}}) {
    if (lacks) what += (what.empty() ? "" : " and ") + std::string(name);
  }
  if (through) f->through_spindle_coolant = false;
  if (mist) f->mist = false;
  if (flood) f->coolant = false;
  const bool on = f->coolant.value_or(false) || f->mist.value_or(false);
  const char* instead = on ? "cut without it" : "cut dry";
  if (!on && machine.has_flood) {
    f->coolant = true;
    instead = "cut with flood";
  } else if (!on && machine.has_mist) {
    f->mist = true;
    instead = "cut with mist";
  }
  const std::string text = "machine '" + machine.id + "' has no " + what + ": " + instead;
  job.warn("PIP-CHANGED", "operation '" + op->its_id.value_or("") + "': " + text);
  for (const char* attribute : {"through_spindle_coolant", "mist", "coolant"}) {
    if ((attribute[0] == 't' && !through) || (attribute[0] == 'm' && !mist) ||
        (attribute[0] == 'c' && !flood))
      continue;
    plan.ledger.bind(functions, attribute, model::Binder::kRule,
                     {"machine.coolant", text, "the machine's own description"});
  }
}

/// A step on a compound or a pattern is for the members that its name begins with ('HOLE[2] drill'), and all
/// that are like them; without such a name, for all.
std::vector<model::FeatureShape> members_meant(std::vector<model::FeatureShape> shapes,
                                               const std::string& name) {
  for (const model::FeatureShape& meant : shapes) {
    if (shapes.size() == 1 || !name.starts_with(meant.name + " ")) continue;
    std::vector<model::FeatureShape> out;
    for (const model::FeatureShape& s : shapes) {
      if (piece::alike(s, meant)) out.push_back(s);
    }
    return out;
  }
  return shapes;
}

/// The shapes that an operation machines. The elements of a compound, or the base of a pattern, may list the
/// operation: then only those. If none lists it: all. The workingstep names the compound, its elements name
/// their operations.
std::vector<model::FeatureShape> elements_meant(const model::Model& m,
                                                std::vector<model::FeatureShape> shapes, AnyRef operation) {
  const auto lists = [&](AnyRef element) {
    const auto* f = m.get<model::ManufacturingFeature>(element);
    if (f == nullptr) return false;
    const auto& items = f->its_operations.items;
    return std::any_of(items.begin(), items.end(), [&](AnyRef o) { return o == operation; });
  };
  std::vector<model::FeatureShape> out;
  for (const model::FeatureShape& s : shapes) {
    if (std::any_of(s.made_of.begin(), s.made_of.end(), lists)) out.push_back(s);
  }
  return out.empty() ? shapes : out;
}

/// How the shapes of given steps were read, where that was assumed: once for each feature.
void say_assumptions(const model::Plan& plan, const std::vector<StepDraft>& steps, Job& job) {
  std::set<std::pair<AnyRef, std::string>> said;
  const auto say = [&](const StepDraft& step, const model::FeatureShape& s, Severity severity,
                       const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      if (!said.insert({step.feature, text}).second) continue;
      job.report({.code = "PIP-ASSUMED",
                  .severity = severity,
                  .message = "feature '" + s.name + "': " + text,
                  .file = plan.file_name,
                  .line = plan.model.origin(step.feature).line,
                  .instance = plan.model.origin(step.feature).instance});
    }
  };
  for (const StepDraft& step : steps) {
    for (const model::FeatureShape& s : step.shapes) {
      say(step, s, Severity::kWarning, s.assumptions);
      say(step, s, Severity::kNote, s.remarks);
    }
  }
}

}  // namespace

Result<Listed> list_steps(model::Plan& plan, Reopen reopen, const std::map<AnyRef, std::string>& unreadable,
                          double grown_mm, Job& job, std::size_t most) {
  Listed out;
  Walker walker(plan, unreadable, out, job);
  walker.walk();
  if (out.steps.size() > most) out.steps.resize(most);
  plan.unplanned.insert(plan.unplanned.end(), walker.not_done().begin(), walker.not_done().end());
  if (out.setups.empty()) {
    SetupDraft s;
    const auto setups = plan.model.all(TypeId::kSetup);
    s.setup = setups.empty() ? draft::add_setup(plan.model, 1, plan.stock.box, {})
                             : Ref<model::Setup>(setups.front());
    if (setups.empty()) {
      job.warn("PIP-SETUP",
               "the file has no set-up; one is made in which the workpiece stands as it is drawn");
    }
    out.setups.push_back(s);
  }
  if (reopen >= Reopen::kOperations) {
    // The set-ups stay; what is done in them is proposed anew.
    out.steps.clear();
  }
  for (SetupDraft& s : out.setups) {
    if (auto ok = place_setup(plan, s, job); !ok) return tl::unexpected(ok.error());
  }
  const piece::Shapes none;  // shapes are known when the requirements are
  const piece::Piece piece{plan, none, grown_mm};
  std::vector<StepDraft> kept;
  for (StepDraft& step : out.steps) {
    if (step.feature.set() && plan.model.holds<model::ManufacturingFeature>(step.feature)) {
      auto shapes = piece::shapes_in_piece(piece, step.feature);
      if (shapes) {
        const std::string name = plan.model.get<model::Executable>(step.step)->its_id.value_or("");
        step.shapes = members_meant(
            elements_meant(plan.model, rules::from_the_top(*std::move(shapes)), step.operation), name);
      } else {
        step.no_shape = shapes.error().message;
      }
      // An operation with its own path needs no shape; others say later why they cannot be done.
    }
    if (step.unreadable.empty()) step.unreadable = leans_in_setup(plan, out.setups[step.setup], step);
    if (plan.model.holds<model::MachiningWorkingstep>(step.step) &&
        !plan.model.holds<model::MachiningOperation>(step.operation)) {
      continue;  // open: rules propose for its feature
    }
    mark_open(plan, reopen, step);
    overrule_stop(plan, step, job);
    overrule_retract(plan, step, job);
    overrule_coolant(plan, step, job);
    kept.push_back(std::move(step));
  }
  out.steps = std::move(kept);
  say_assumptions(plan, out.steps, job);
  return out;
}

std::vector<AnyRef> steps_in_order(const model::Plan& plan) {
  Listed listed;
  Job silent;
  Walker(plan, {}, listed, silent).walk();
  std::vector<AnyRef> out;
  for (const StepDraft& s : listed.steps) out.push_back(s.step);
  return out;
}

}  // namespace capstan::given
