#include "planner/model/plan/decision/contradicted.h"

#include <algorithm>
#include <utility>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/decision/has_reason.h"
#include "planner/model/plan/decision/unreadable.h"

namespace capstan::model {
namespace {

/// The workpiece that the project makes.
AnyRef piece_of(const Plan& plan) {
  const auto* project = plan.model.get<Project>(plan.project);
  if (project != nullptr && !project->its_workpieces.empty()) return project->its_workpieces[0];
  const auto all = plan.model.all(TypeId::kWorkpiece);
  return all.empty() ? AnyRef(plan.project) : all.front();
}

std::string name_of(const Plan& plan, AnyRef at) {
  const auto number = plan.model.origin(at).instance;
  return (number == 0 ? "" : "#" + std::to_string(number) + " ") + std::string(noun_type(at.type).keyword);
}

}  // namespace

std::vector<Contradiction> contradictions(const Plan& plan) {
  std::vector<Contradiction> out;
  if (!has_reason(plan.ledger, kContradicted)) return out;
  for (const auto& [key, decision] : plan.ledger.entries()) {
    const Reason& why = plan.ledger.reason(decision.reason);
    if (why.id == kContradicted) out.push_back({key, why.text});
  }
  return out;
}

void set_contradicted(Plan& plan, AnyRef object, std::string attribute, std::string why) {
  Decision d;
  d.binder = Binder::kGiven;
  d.reason = plan.ledger.reason({std::string(kContradicted), std::move(why), "the file"});
  plan.ledger.set({object, std::move(attribute)}, std::move(d));
}

void named_by_caller(Plan& plan, bool material, bool raw_piece) {
  const auto settle = [&](AnyRef piece, const char* attribute) {
    Decision* known = plan.ledger.find(piece, attribute);
    if (known == nullptr) return;
    const std::string id = plan.ledger.reason(known->reason).id;
    if (id != kContradicted && id != kUnreadable) return;
    known->binder = Binder::kOperator;
    known->reason = plan.ledger.reason({"given.named", "named by the caller", "the caller"});
  };
  for (const AnyRef piece : plan.model.all(TypeId::kWorkpiece)) {
    if (material) settle(piece, "its_material");
    if (raw_piece) settle(piece, "its_rawpiece");
  }
}

void refuse_edited(Plan& plan, const std::set<Listed>& edited, std::string_view called) {
  const AnyRef piece = piece_of(plan);
  if (!piece.set()) return;
  const std::string file(called);
  if (edited.contains(Listed::kMaterial))
    set_contradicted(plan, piece, "its_material",
                     "the material's data were edited in " + file + ", and planning takes those of " +
                         name_of(plan, piece) +
                         ".its_material: put back what was edited and name the material there, or with "
                         "--material");
  const bool named = std::any_of(plan.provenance.begin(), plan.provenance.end(),
                                 [](const Provenance& p) { return p.what == "stock"; });
  if (edited.contains(Listed::kRawPiece) && !named)
    set_contradicted(plan, piece, "its_rawpiece",
                     "the raw piece was edited in " + file + ", and planning takes that of " +
                         name_of(plan, piece) +
                         ".its_rawpiece: put back what was edited and correct the solid there, or name one "
                         "with --stock");
  std::string listed;
  for (const auto& [kind, words] :
       {std::pair{Listed::kCutters, "tools"}, std::pair{Listed::kSetups, "set-ups"},
        std::pair{Listed::kSteps, "steps"}}) {
    if (edited.contains(kind)) listed += (listed.empty() ? "" : ", ") + std::string(words);
  }
  if (!listed.empty() && plan.project.set())
    set_contradicted(plan, plan.project, "main_workplan",
                     "the list of " + listed + " was edited in " + file +
                         ", and planning takes them from the workplan, its operations and their tools: put "
                         "back what was edited and correct it there");
}

bool refuse_edited_path(Plan& plan, AnyRef step, const std::string& where) {
  const auto* ws = plan.model.get<MachiningWorkingstep>(step);
  if (ws == nullptr || !ws->its_operation.set()) return false;
  if (!by_planning(plan.ledger.find(ws->its_operation, "its_toolpath"))) return false;
  set_contradicted(plan, ws->its_operation, "its_toolpath",
                   "the path of step '" + ws->its_id.value_or("") + "' was edited in " + where +
                       ". Planning computes it from the step's operation, and would drop the edit: put back "
                       "what was edited, and change the operation's values");
  return true;
}

}  // namespace capstan::model
