#include "planner/exchange/opening.h"

#include <algorithm>

#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;

namespace {

class Opening {
 public:
  Opening(model::Plan& plan, Reporter& reporter) : plan_(plan), m_(plan.model), reporter_(reporter) {}

  void run(const Marks& reached) {
    std::vector<AnyRef> technologies;
    for (const AnyRef at : objects_in_file_order(m_)) {
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
    plan_.ledger.reopen({at, attribute});
    reporter_.about(m_, at,
                    {.code = "EXC-OPEN",
                     .severity = Severity::kNote,
                     .message = attribute_name(at, attribute) + " " + why + "; open"});
  }

  model::Plan& plan_;
  const model::Model& m_;
  Reporter& reporter_;
};

}  // namespace

void open_what_is_left_out(model::Plan& plan, const Marks& reached, Reporter& reporter) {
  Opening(plan, reporter).run(reached);
}

}  // namespace capstan::exchange
