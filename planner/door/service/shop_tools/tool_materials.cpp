#include "planner/door/service/shop_tools/tool_materials.h"

#include <algorithm>
#include <string>

#include "planner/model/plan/order/step_ids.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/words/comment_words.h"

namespace capstan::service {
namespace {

using model::Cutter;
using model::Substrate;

constexpr int kToolMaterial = 16;  ///< number of the property, as in planner/proof/verify/plan/tools.cpp

bool states_material(const Cutter& loaded) {
  const std::string* source = tooling::source_of(loaded, "substrate");
  return source != nullptr && (source->starts_with("stated") || source->ends_with(tooling::kOfComment));
}

bool assumed(const Cutter& planned) {
  const std::string* source = tooling::source_of(planned, "substrate");
  return source != nullptr && source->starts_with("default");
}

const Cutter* loaded_as(const std::vector<Cutter>& loaded, const Cutter& planned) {
  const auto at = std::find_if(loaded.begin(), loaded.end(), [&](const Cutter& c) {
    return planned.pocket > 0 && c.pocket > 0 ? c.pocket == planned.pocket : c.id == planned.id;
  });
  return at == loaded.end() ? nullptr : &*at;
}

}  // namespace

std::vector<model::Finding> other_tool_materials(const model::Plan& plan, const std::vector<Cutter>& loaded) {
  std::vector<model::Finding> out;
  for (const Cutter& planned : plan.cutters) {
    if (planned.cutter_class == model::CutterClass::kTouchProbe) continue;
    const Cutter* is = loaded_as(loaded, planned);
    if (is == nullptr || !states_material(*is) || is->substrate == planned.substrate) continue;
    const bool burns = is->substrate == Substrate::kHss;
    if (!burns && assumed(planned)) continue;
    model::Finding f;
    f.property = kToolMaterial;
    f.code = "CHK-TOOL-MATERIAL";
    f.severity = burns ? Severity::kError : Severity::kWarning;
    const auto used = std::find_if(plan.steps.begin(), plan.steps.end(),
                                   [&](const model::StepResult& s) { return s.cutter_id == planned.id; });
    if (used != plan.steps.end()) f.step = model::step_id(plan, *used);
    const std::string name = planned.pocket > 0
                                 ? "T" + std::to_string(planned.pocket) + " ('" + planned.id + "')"
                                 : "'" + planned.id + "'";
    f.message = name + " is of " + std::string(model::to_text(is->substrate)) + " in the shop's tools ('" +
                is->description + "'); the plan's speeds, feeds and stiffness are of " +
                std::string(model::to_text(planned.substrate)) +
                ": load the tool that is planned, or plan again";
    out.push_back(std::move(f));
  }
  return out;
}

}  // namespace capstan::service
