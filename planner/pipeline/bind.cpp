#include <algorithm>
#include <set>
#include <utility>

#include "planner/output/step_ids.h"
#include "planner/pipeline/work.h"
#include "tooling/select/select.h"

namespace capstan::pipeline {
namespace {

/// The cutters that steps use, each once, with their tool numbers; nouns say the same.
void collect_cutters(Work& w) {
  std::set<std::string> seen;
  for (const StepWork& s : w.steps) {
    if (s.cutter.cutting_diameter_mm > 0.0 && seen.insert(s.cutter.id).second)
      w.plan.cutters.push_back(s.cutter);
  }
  tooling::assign_pockets(w.plan.cutters);
  for (const StepWork& s : w.steps) {
    const auto* op = w.plan.model.get<model::MachiningOperation>(s.operation);
    auto* tool = op != nullptr ? w.plan.model.get<model::MachiningTool>(op->its_tool) : nullptr;
    const model::Cutter* c = model::find_cutter(w.plan, s.cutter.id);
    if (tool == nullptr || c == nullptr) continue;
    const auto position = std::to_string(c->pocket);
    if (auto* usage = w.plan.model.get<model::ToolUsage>(tool->its_usage)) {
      usage->its_position = position;
    }
  }
  std::stable_sort(w.plan.cutters.begin(), w.plan.cutters.end(),
                   [](const auto& a, const auto& b) { return a.pocket < b.pocket; });
}

void collect_setups(Work& w) {
  // LinuxCNC has nine work offsets; a plan with more set-ups begins again (and says so).
  constexpr const char* kOffsets[] = {"G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"};
  constexpr std::size_t kCount = std::size(kOffsets);
  for (std::size_t i = 0; i < w.setups.size(); ++i) {
    w.plan.setups.push_back({w.setups[i].setup, kOffsets[i % kCount], w.setups[i].security_z_mm});
  }
  if (w.setups.size() > kCount)
    w.job.warn("PIP-OFFSETS", "there are more set-ups than work offsets; offsets repeat");
}

/// Each executed step gets a name of its own that every file format carries.
void name_steps(Work& w) {
  const std::vector<std::string> ids = output::step_ids(w.plan);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto* e = w.plan.model.get<model::Executable>(w.plan.steps[i].step);
    if (e != nullptr && !e->persistent_id) e->persistent_id = ids[i];
  }
}

}  // namespace

Result<model::Plan> bind(model::Plan plan, const Inputs& inputs, const Policy& policy, Job& job) {
  plan.steps.clear();
  plan.setups.clear();
  plan.cutters.clear();
  plan.unplanned.clear();
  Work w{std::move(plan), inputs, policy, job, {}, {}, {}};
  using Stage = Status (*)(Work&);
  for (const Stage stage : {resolve_workpiece, list_given, propose_missing, select_open_tools, order_steps,
                            carry_tools, make_paths, join_paths}) {
    if (auto ok = stage(w); !ok) return tl::unexpected(ok.error());
  }
  collect_cutters(w);
  collect_setups(w);
  name_steps(w);
  return std::move(w.plan);
}

}  // namespace capstan::pipeline
