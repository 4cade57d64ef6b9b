#include "planner/files/exchange/common/open_decisions.h"

#include <algorithm>

#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;

namespace {

class OpenDecisions {
 public:
  OpenDecisions(model::Plan& plan, Reporter& reporter) : plan_(plan), m_(plan.model), reporter_(reporter) {}

  void run(const Marks& reached) {
    std::vector<AnyRef> technologies;
    const auto matters = [](model::TypeId t) {
      return model::is_a(t, model::TypeId::kMachiningWorkingstep) ||
             model::is_a(t, model::TypeId::kMachiningOperation);
    };
    for (const AnyRef at : objects_in_file_order(m_, matters)) {
      if (!reached.has(at)) continue;
      if (const auto* step = m_.get<model::MachiningWorkingstep>(at);
          step != nullptr && !step->its_operation) {
        open(at, "its_operation", "is not given");
      }
      const auto* op = m_.get<model::MachiningOperation>(at);
      if (op == nullptr) continue;
      tool(at, *op);
      if (!op->its_technology) open(at, "its_technology", "is not given");
      if (m_.holds<model::MillingTechnology>(op->its_technology)) technologies.push_back(op->its_technology);
    }
    std::sort(technologies.begin(), technologies.end(),
              [&](AnyRef a, AnyRef b) { return m_.origin(a).instance < m_.origin(b).instance; });
    technologies.erase(std::unique(technologies.begin(), technologies.end()), technologies.end());
    for (const AnyRef t : technologies) technology(t);
  }

 private:
  void tool(AnyRef at, const model::MachiningOperation& op) {
    if (!op.its_tool) return open(at, "its_tool", "is not given");
    const auto* tool = m_.get<model::CuttingTool>(op.its_tool);
    if (tool == nullptr) return;  // kept, or a probe
    const auto* body = m_.get<model::MillingToolBody>(tool->its_tool_body);
    const auto* d = body == nullptr ? nullptr : m_.get<model::MillingToolDimension>(body->dimension);
    if (d == nullptr || !d->diameter || !(*d->diameter > 0.0)) {
      open(at, "its_tool", "has no usable dimensions: a requirement and not a tool");
    }
  }

  void technology(AnyRef at) {
    const auto& t = m_.at<model::MillingTechnology>(at);
    if (!t.feedrate && !t.feedrate_per_tooth) open(at, "feedrate", "is not given");
    if (!t.spindle && !t.cutspeed) open(at, "spindle", "is not given");
  }

  void open(AnyRef at, const char* attribute, const std::string& why) {
    // While nothing depends on anything, which is so of a file just read, there is nothing else to open.
    if (dependencies_) {
      plan_.ledger.reopen({at, attribute});
    } else if (model::Decision* known = plan_.ledger.find(at, attribute)) {
      known->state = model::DecisionState::kOpen;
    } else {
      plan_.ledger.set({at, attribute}, opened_);
    }
    reporter_.about(m_, at,
                    {.code = "EXC-OPEN",
                     .severity = Severity::kNote,
                     .message = attribute_name(at, attribute) + " " + why + "; open"});
  }

  model::Plan& plan_;
  const model::Decision opened_ = [] {
    model::Decision d;
    d.state = model::DecisionState::kOpen;
    return d;
  }();
  const bool dependencies_ =
      std::any_of(plan_.ledger.entries().begin(), plan_.ledger.entries().end(),
                  [](const auto& entry) { return !entry.second.depends_on.empty() || entry.second.pinned; });
  const model::Model& m_;
  Reporter& reporter_;
};

}  // namespace

void open_what_is_left_out(model::Plan& plan, const Marks& reached, Reporter& reporter) {
  OpenDecisions(plan, reporter).run(reached);
}

}  // namespace capstan::exchange
