#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

using casebase::Case;

int run_cases_list(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  std::vector<Case> cases = base->cases();
  report_faults(s, *base);
  std::erase_if(cases, [&](const Case& c) { return !wanted(c, s.options.words); });
  s.summary = std::to_string(cases.size()) + " of " + counted(base->size(), "case", "cases");
  if (s.options.json) return print(cases_json(cases)) ? kDone : kImpossible;
  std::vector<std::vector<std::string>> rows = {{"case", "operation", "material", "tool", "D", "cutter",
                                                 "vc m/min", "fz mm", "time s", "verdict", "origin",
                                                 "source"}};
  for (const Case& c : cases) {
    rows.push_back({c.id.substr(0, 12), c.asked.operation, c.asked.material_group, c.asked.tool_class,
                    number_text(c.asked.diameter_mm), number_text(c.asked.cutter_diameter_mm),
                    number_text(c.bound.vc_m_min), number_text(c.bound.fz_mm), figure_text(c.observed.time_s),
                    std::string(to_text(c.observed.verdict)), std::string(to_text(c.origin)), c.from.source});
  }
  return print(cases.empty() ? std::string("no case\n") : service::table(rows, "")) ? kDone : kImpossible;
}

}  // namespace capstan::app
