#include "planner/making/given/listed_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "planner/making/draft/setup_nouns.h"
#include "planner/making/given/placed_setups.h"
#include "planner/making/given/steps/open_values.h"
#include "planner/making/given/steps/safety_changes.h"
#include "planner/making/piece/piece.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "rules/rules.h"

namespace capstan::given {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using model::AnyRef;
using model::Ref;
using model::TypeId;

/// A step that is executed. A draft of it, which has a cutter's sizes, is made where it is worked on.
struct FoundStep {
  AnyRef step;
  std::size_t setup = 0;  ///< index into Found::setups
  AnyRef feature, operation;
};

/// Set-ups and steps, as the walk finds them.
struct Found {
  std::vector<SetupDraft> setups;
  std::vector<FoundStep> steps;
};

/// Walks program structure in order of execution, without recursion.
class Walker {
 public:
  Walker(const model::Plan& plan, Found& out, Job& job) : plan_(plan), out_(out), job_(job) {}

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
    FoundStep found{at.executable, setup_index(at.setup), {}, {}};
    if (const auto* ws = plan_.model.get<model::MachiningWorkingstep>(at.executable)) {
      const AnyRef feature = ws->its_feature.set() ? AnyRef(ws->its_feature) : at.executable;
      if (plan_.model.holds<model::KeptInstance>(ws->its_operation) ||
          plan_.model.holds<model::ExtendedOperation>(ws->its_operation)) {
        return refuse(at.executable, ws->its_operation, feature);
      }
      found.feature = ws->its_feature;
      found.operation = ws->its_operation;
    }
    out_.steps.push_back(found);
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
  std::vector<model::Unplanned> not_done_;
  Found& out_;
  Job& job_;
  std::vector<Item> pending_;
  std::set<AnyRef> entered_;
};

/// The draft of a step, with what its file states wrongly of it or its feature.
StepDraft draft_of(const FoundStep& found, const std::map<AnyRef, std::string>& unreadable) {
  StepDraft out;
  out.step = Ref<model::Executable>(found.step);
  out.feature = found.feature;
  out.operation = found.operation;
  out.setup = found.setup;
  if (!model::is_a(found.step.type, TypeId::kMachiningWorkingstep)) return out;
  for (const AnyRef of : {found.step, found.feature}) {
    const auto wrong = of.set() ? unreadable.find(of) : unreadable.end();
    if (wrong != unreadable.end() && out.unreadable.empty()) out.unreadable = wrong->second;
  }
  return out;
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

Result<Listed> list_steps(model::Plan plan, Reopen reopen, const std::map<AnyRef, std::string>& unreadable,
                          double grown_mm, Job& job, std::size_t most) {
  Found out;
  Walker walker(plan, out, job);
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
               "the file has no set-up: one is made in which the workpiece lies as it is drawn; look at it "
               "before clamping");
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
  for (const FoundStep& found : out.steps) {
    StepDraft step = draft_of(found, unreadable);
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
    change_for_safety(plan, step, job);
    kept.push_back(std::move(step));
  }
  say_assumptions(plan, kept, job);
  return Listed{std::move(plan), std::move(out.setups), std::move(kept)};
}

std::vector<AnyRef> steps_in_order(const model::Plan& plan) {
  Found listed;
  Job silent;
  Walker(plan, listed, silent).walk();
  std::vector<AnyRef> out;
  for (const FoundStep& s : listed.steps) out.push_back(s.step);
  return out;
}

}  // namespace capstan::given
