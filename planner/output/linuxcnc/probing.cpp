#include "planner/output/linuxcnc/probing.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/base/number.h"
#include "planner/model/fit/stated.h"
#include "planner/model/measured.h"
#include "planner/model/nouns/all.h"
#include "planner/model/resolve.h"
#include "planner/model/setup_position.h"

namespace capstan::output {

using model::AnyRef;

std::map<AnyRef, std::vector<AnyRef>> probings_before(const model::Plan& plan) {
  const model::Model& m = plan.model;
  std::map<AnyRef, std::vector<AnyRef>> out;
  const auto* project = m.get<model::Project>(plan.project);
  if (project == nullptr) return out;
  std::set<AnyRef> planned, entered;
  for (const auto& s : plan.steps) planned.insert(s.step);
  std::vector<AnyRef> waiting, pending{project->main_workplan};
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    if (const auto* w = m.get<model::Workplan>(at)) {
      if (!entered.insert(at).second) continue;
      pending.insert(pending.end(), w->its_elements.items.rbegin(), w->its_elements.items.rend());
    } else if (const auto* p = m.get<model::WorkpieceProbing>(at)) {
      if (p->enabled.value_or(true)) waiting.push_back(at);
    } else if (planned.contains(at) && !waiting.empty()) {
      auto& list = out[at];
      list.insert(list.end(), waiting.begin(), waiting.end());
      waiting.clear();
    }
  }
  if (!waiting.empty()) out[AnyRef{}] = std::move(waiting);
  return out;
}

std::vector<std::string> probing_text(const model::Plan& plan, AnyRef probing) {
  const model::Model& m = plan.model;
  const auto& p = m.at<model::WorkpieceProbing>(probing);
  std::string first = "measure " + p.its_id.value_or("");
  const auto* expected = m.get<model::TolerancedLengthMeasure>(p.expected_value);
  if (expected != nullptr && expected->theoretical_size) {
    first += ": touch expected after " + trimmed(*expected->theoretical_size, 4) + " mm";
    const auto* t = m.get<model::PlusMinusValue>(expected->implicit_tolerance);
    const auto limits =
        t == nullptr ? Result<std::optional<model::Deviations>>(std::nullopt) : model::stated(*t);
    if (limits && *limits)
      first += " (" + trimmed((*limits)->lower_mm, 4) + " to " + trimmed((*limits)->upper_mm, 4) + ")";
  }
  std::vector<std::string> out{first};
  const auto start = model::placement(m, p.start_position);
  const auto along = model::direction(m, p.direction);
  const auto text = [](geometry::Vec3 v) {
    return "X" + trimmed(v.x, 4) + " Y" + trimmed(v.y, 4) + " Z" + trimmed(v.z, 4);
  };
  if (start && along)
    out.push_back("from " + text(start->origin) + " along " + text(*along) +
                  " of the workpiece until it touches");
  if (const auto* probe = m.get<model::TouchProbe>(p.its_probe)) {
    const auto* usage = m.get<model::ToolUsage>(probe->its_usage);
    const std::string position = usage == nullptr ? "" : usage->its_position.value_or("");
    out.push_back(position.empty() ? "by hand, in the machine"
                                   : "with " + probe->its_id.value_or("a touch probe") + ", T" + position);
  }
  return out;
}

Remedy remedy_of(const model::Plan& plan, const std::vector<AnyRef>& probings, AnyRef before) {
  const model::Model& m = plan.model;
  const auto next = std::find_if(plan.steps.begin(), plan.steps.end(),
                                 [&](const model::StepResult& s) { return s.step == before; });
  const model::Cutter* cutter =
      next == plan.steps.end() ? nullptr : model::find_cutter(plan, next->cutter_id);
  bool size = false, upright = false;
  for (const AnyRef r : probings) {
    const auto& p = m.at<model::WorkpieceProbing>(r);
    const auto* value = m.get<model::NcVariable>(p.measured_offset);
    if (value == nullptr || !value->its_name.value_or("").starts_with(model::kMeasuredSize)) continue;
    size = true;
    const auto along = model::direction(m, p.direction);
    if (!along || next == plan.steps.end()) continue;
    constexpr double kAlong = 0.999;  // cosine
    const auto z = model::placed_in(plan, next->setup).direction_to_parent(*along).z;
    upright = upright || std::abs(z) > kAlong;
  }
  if (!size || cutter == nullptr) return {"correct the work offset", {}};
  const std::string t = "T" + std::to_string(cutter->pocket);
  if (cutter->cutter_class == model::CutterClass::kBoringTool)
    return {"set the radius of " + t + " by the difference",
            t + ": a touch later than expected means that the wall is out by the difference; set the boring "
                "tool's slide by it, not the work offset"};
  if (upright)
    return {"correct the length offset of " + t + " by the difference",
            t + ": the size is a depth; its length offset is corrected, not the work offset"};
  return {
      "correct the radius of " + t + " by the difference",
      t + ": each touch differs by what the cutter's radius is off: correct its radius [wear], not the work "
          "offset. Paths are of the cutter's centre and no G41 acts here, so that the last step is planned "
          "again with that radius"};
}

}  // namespace capstan::output
