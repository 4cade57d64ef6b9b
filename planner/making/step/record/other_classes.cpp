#include "planner/making/step/record/other_classes.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "casebase/casebase.h"
#include "planner/ground/base/number.h"

namespace capstan::step {

void tell_other_classes(const model::Plan& plan, const casebase::CaseBase* cases, Job& job) {
  if (cases == nullptr) return;
  const std::string material = casebase::material_group_of(plan.material);
  const auto uses = [&](const std::string& tool_class) {
    return std::any_of(plan.cutters.begin(), plan.cutters.end(),
                       [&](const model::Cutter& c) { return casebase::tool_class_of(c) == tool_class; });
  };
  std::size_t machines = 0, materials = 0, tools = 0;
  for (const casebase::CaseBase::Categories& c : cases->categories()) {
    if (c.machine_class != plan.machine.id) {
      machines += c.cases;
    } else if (c.material_group != material) {
      materials += c.cases;
    } else if (!uses(c.tool_class)) {
      tools += c.cases;
    }
  }
  const std::size_t all = machines + materials + tools;
  if (all == 0) return;
  std::string text = std::to_string(all) + " of " + counted(cases->size(), "case", "cases") +
                     (all == 1 ? " says" : " say") + " nothing of this plan";
  const char* before = ": ";
  for (const auto& [n, what] : {std::pair(machines, "of another machine than '" + plan.machine.id + "'"),
                                std::pair(materials, "of another material than '" + material + "'"),
                                std::pair(tools, std::string("of classes of tools that it does not use"))}) {
    if (n == 0) continue;
    text += std::exchange(before, ", ") + std::to_string(n) + " " + what;
  }
  job.note("CASE-OTHER", std::move(text));
}

}  // namespace capstan::step
