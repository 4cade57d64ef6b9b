#include "planner/files/json/summary.h"

#include <algorithm>
#include <cmath>

#include "planner/files/json/ids.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/physics/motion/time.h"

namespace capstan::json {

namespace {

/// Kind of operation and name of feature; of a rapid movement there is neither.
std::vector<std::pair<std::string_view, std::string>> words_of(const model::Plan& plan,
                                                               const model::StepResult& step) {
  std::vector<std::pair<std::string_view, std::string>> out;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  if (ws == nullptr) return out;
  if (ws->its_operation.set()) out.emplace_back("operation", kind_name(ws->its_operation.type));
  if (const auto* f = plan.model.get<model::ManufacturingFeature>(ws->its_feature); f != nullptr && f->its_id)
    out.emplace_back("feature", *f->its_id);
  return out;
}

}  // namespace

Summary summary_of(const model::Plan& plan) {
  Summary out;
  double cutting = 0.0;
  double rapid = 0.0;
  for (const auto& s : plan.steps) {
    cutting += s.cutting_s;
    rapid += s.rapid_s;
  }
  out.totals = {
      {"steps", static_cast<double>(plan.steps.size())}, {"cutting_s", cutting}, {"rapid_s", rapid}};
  // Times between the steps, from their paths; unknown without paths.
  const auto t = motion::time_of(plan);
  const bool timed = t && t->total_s() > 0.0 && std::isfinite(t->total_s());
  if (timed) {
    out.totals.insert(out.totals.end(), {{"link_s", t->link_s},
                                         {"tool_changes", static_cast<double>(t->tool_changes)},
                                         {"tool_change_s", t->tool_change_s},
                                         {"spindle_s", t->spin_up_s},
                                         {"total_s", t->total_s()}});
  }
  std::vector<std::string> ids = step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& step = plan.steps[i];
    const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
    StepSummary& own = out.steps.emplace_back();
    own.id = std::move(ids[i]);
    own.words = words_of(plan, step);
    own.tool_number = cutter == nullptr ? 0 : cutter->pocket;
    if (!timed) continue;
    const motion::StepShare& share = t->steps[i];
    own.times = {
        {"link_s", share.link_s}, {"tool_change_s", share.tool_change_s}, {"spindle_s", share.spindle_s}};
  }
  return out;
}

bool has_magazine(const model::Plan& plan) {
  return std::any_of(plan.cutters.begin(), plan.cutters.end(),
                     [](const model::Cutter& c) { return c.loaded; });
}

std::vector<std::string> to_load(const model::Plan& plan) {
  std::vector<std::string> out;
  if (!has_magazine(plan)) return out;
  for (const model::Cutter& c : plan.cutters) {
    if (!c.loaded) out.push_back(c.id);
  }
  return out;
}

}  // namespace capstan::json
