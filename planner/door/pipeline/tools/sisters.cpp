#include "planner/door/pipeline/tools/sisters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/making/draft/draft.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/order/step_ids.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::pipeline {
namespace {

using model::Cutter;
using model::StepResult;

constexpr double kRoomMm = 0.01;  // of lengths: rounding of what is written

const Cutter* named(const std::vector<Cutter>& all, const std::string& id) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Cutter& c) { return c.id == id; });
  return at == all.end() ? nullptr : &*at;
}

double used(const Cutter& c) { return c.life_min > 0.0 ? c.life_used_min / c.life_min : 0.0; }

/// What a step takes of its tool's life; 0: not known.
double share(const StepResult& step, const Cutter& c) {
  const double life = c.life_min > 0.0 ? c.life_min : step.loads.tool_life_min;
  return life > 0.0 ? step.cutting_s / 60.0 / life : 0.0;
}

/// The loaded sisters of a tool that the plan does not use, by rising number.
std::vector<const Cutter*> sisters_of(const Cutter& tool, const model::Plan& plan,
                                      const std::vector<Cutter>& library) {
  std::vector<const Cutter*> out;
  const Cutter* own = named(library, tool.id);
  if (own == nullptr) return out;
  for (const Cutter& c : library) {
    const bool in_plan = std::any_of(plan.cutters.begin(), plan.cutters.end(),
                                     [&](const Cutter& p) { return p.id == c.id || p.pocket == c.pocket; });
    if (!in_plan && is_sister(c, *own)) out.push_back(&c);
  }
  std::sort(out.begin(), out.end(), [](const Cutter* a, const Cutter* b) { return a->pocket < b->pocket; });
  return out;
}

/// The tool as planned, as another piece of it: what is measured and counted is that one's.
Cutter instead_of(const Cutter& tool, const Cutter& sister) {
  Cutter out = tool;
  out.id = sister.id;
  out.description = sister.description;
  out.pocket = sister.pocket;
  out.carousel = sister.carousel;
  out.loaded = true;
  out.cutting_diameter_mm = sister.cutting_diameter_mm;
  out.functional_length_mm = sister.functional_length_mm;
  out.table_line = sister.table_line;
  out.product_id = sister.product_id;
  out.library_reference = sister.library_reference;
  out.library_source = sister.library_source;
  out.in_stock = sister.in_stock;
  out.life_min = sister.life_min;
  out.life_used_min = sister.life_used_min;
  out.sources = sister.sources;
  out.sisters = {{tool.id, tool.pocket, 0.0}};  // it has none to give
  return out;
}

/// Whether planning chose the tool of this step.
bool chosen(const model::Plan& plan, const StepResult& step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  return ws != nullptr && plan.model.get<model::MachiningOperation>(ws->its_operation) != nullptr &&
         model::by_planning(plan.ledger.find(ws->its_operation, "its_tool"));
}

/// Whether nothing keeps the step off the tool.
bool allowed(const model::Plan& plan, const StepResult& step, const Cutter& tool,
             const std::vector<model::Edit>& restrictions) {
  if (restrictions.empty()) return true;
  draft::StepDraft s;
  s.step = step.step;
  if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step)) {
    s.feature = ws->its_feature;
    s.operation = ws->its_operation;
  }
  return !model::barred(restrictions, draft::edit_names(plan.model, s), tool);
}

void give(model::Plan& plan, StepResult& step, const Cutter& sister, const Cutter& tool, double minutes) {
  const auto operation = plan.model.get<model::MachiningWorkingstep>(step.step)->its_operation;
  step.cutter_id = sister.id;
  const auto noun = tooling::tool_noun(plan.model, sister);
  if (auto* usage = plan.model.get<model::ToolUsage>(plan.model.get<model::MachiningTool>(noun)->its_usage))
    usage->its_position = std::to_string(sister.pocket);
  plan.model.get<model::MachiningOperation>(operation)->its_tool = noun;
  plan.ledger.bind(operation, "its_tool", model::Binder::kToolSelection,
                   {"tooling.sister",
                    "takes the place of T" + std::to_string(tool.pocket) + " '" + tool.id +
                        "', whose life would end in this step, at " + trimmed(minutes, 1) +
                        " min of cutting: a sister of the same sizes is loaded",
                    "tool table"},
                   {{step.step, "its_operation"}}, {{tool.id, "its life is used up"}});
}

}  // namespace

bool is_sister(const Cutter& other, const Cutter& tool) {
  const auto near = [](double a, double b, double by) { return std::abs(a - b) <= by; };
  const auto length = [&](double Cutter::*f) { return near(other.*f, tool.*f, kRoomMm); };
  const bool worn = other.life_min > 0.0 && other.life_used_min >= other.life_min;
  return other.id != tool.id && other.loaded && tool.loaded && other.pocket > 0 &&
         other.pocket != tool.pocket && !worn && model::offset_fault(other).empty() &&
         other.cutter_class == tool.cutter_class && other.substrate == tool.substrate &&
         other.hand == tool.hand && other.teeth == tool.teeth &&
         other.centre_cutting == tool.centre_cutting && other.coolant_through == tool.coolant_through &&
         near(other.cutting_diameter_mm, tool.cutting_diameter_mm, model::kSameDiameterMm) &&
         near(other.corner_radius_mm, tool.corner_radius_mm, model::kSameDiameterMm) &&
         near(other.tip_diameter_mm, tool.tip_diameter_mm, model::kSameDiameterMm) &&
         near(other.point_angle_rad, tool.point_angle_rad, 1e-6) &&
         near(other.taper_angle_rad, tool.taper_angle_rad, 1e-6) &&
         near(other.lead_angle_rad, tool.lead_angle_rad, 1e-6) &&
         near(other.helix_rad, tool.helix_rad, 1e-6) &&
         near(other.thread_pitch_mm, tool.thread_pitch_mm, 1e-6) &&
         near(other.maximum_ramp_angle_rad, tool.maximum_ramp_angle_rad, 1e-6) &&
         near(other.maximum_speed_rpm, tool.maximum_speed_rpm, kRoomMm) && other.holder == tool.holder &&
         length(&Cutter::maximum_depth_of_cut_mm) && length(&Cutter::usable_length_mm) &&
         length(&Cutter::stick_out_mm) && length(&Cutter::shank_diameter_mm) &&
         length(&Cutter::holder_diameter_mm) && length(&Cutter::neck_diameter_mm) &&
         length(&Cutter::neck_length_mm) && length(&Cutter::cutting_width_mm) &&
         tool.adjustable_to_mm == 0.0 && other.adjustable_to_mm == 0.0;
}

void share_among_sisters(model::Plan& plan, const std::vector<Cutter>& library,
                         const std::vector<model::Edit>& restrictions, Job& job) {
  constexpr double kSlack = 1e-9;
  const std::vector<std::string> ids = model::step_ids(plan);
  const std::vector<Cutter> tools = plan.cutters;
  for (const Cutter& tool : tools) {
    const bool shared = std::any_of(tool.sisters.begin(), tool.sisters.end(),
                                    [&](const auto& s) { return model::find_cutter(plan, s.id) != nullptr; });
    if (!tool.loaded || tool.pocket <= 0 || shared) continue;
    std::vector<const Cutter*> free = sisters_of(tool, plan, library);
    if (free.empty()) continue;
    Cutter now = tool;
    double worn = used(now), minutes = 0.0;
    bool cuts = false;  // it has a step already
    const auto next_sister = [&](const StepResult& step, double worn_now, bool has_cut) {
      const auto may = [&](const Cutter* c) {
        return allowed(plan, step, instead_of(tool, *c), restrictions);
      };
      const auto lasts = std::find_if(free.begin(), free.end(), [&](const Cutter* c) {
        return may(c) && used(*c) + share(step, instead_of(tool, *c)) <= 1.0 + kSlack;
      });
      if (lasts != free.end() || !has_cut) return lasts;
      return std::find_if(free.begin(), free.end(),
                          [&](const Cutter* c) { return may(c) && used(*c) < worn_now; });
    };
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      StepResult& step = plan.steps[i];
      if (step.cutter_id != tool.id) continue;
      const bool ends = (cuts || worn > 0.0) && worn + share(step, now) > 1.0 + kSlack;
      const auto next = ends && chosen(plan, step) ? next_sister(step, worn, cuts) : free.end();
      if (next != free.end()) {
        const double used_min = now.life_min > 0.0 ? now.life_used_min : 0.0;
        const double whole = used_min + minutes + step.cutting_s / 60.0;
        const Cutter before = now;
        now = instead_of(tool, **next);
        free.erase(next);
        plan.cutters.push_back(now);
        job.note("PIP-SISTER", "step '" + ids[i] + "' calls T" + std::to_string(now.pocket) + " '" + now.id +
                                   "' in place of T" + std::to_string(before.pocket) + " '" + before.id +
                                   "', which would have cut " + trimmed(whole, 1) +
                                   " min by its end, longer than its edges last");
        worn = used(now);
        minutes = 0.0;
      }
      if (now.id != tool.id) {
        if (!chosen(plan, step) || !allowed(plan, step, now, restrictions)) continue;
        give(plan, step, now, tool, minutes);
      }
      worn += share(step, now);
      minutes += step.cutting_s / 60.0;
      cuts = true;
    }
  }
  std::stable_sort(plan.cutters.begin(), plan.cutters.end(),
                   [](const Cutter& a, const Cutter& b) { return a.pocket < b.pocket; });
}

}  // namespace capstan::pipeline
