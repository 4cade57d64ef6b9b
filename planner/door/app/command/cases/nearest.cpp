#include "casebase/recall/recall.h"
#include "planner/door/app/command/cases/category_words.h"
#include "planner/door/app/command/cases/shared.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::app {

using service::table;

int run_cases_nearest(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const auto materials = tooling::shipped_materials();
  if (!materials) return s.end(materials.error(), kUnreadable);
  const CaseQuestion& q = s.options.question;
  const auto material = tooling::find_material({q.material}, *materials, s.job, tooling::Families::kRefused);
  if (!material) return s.end(material.error(), kUsage);
  auto question =
      casebase::question_of(q.operation, casebase::material_group_of(*material), q.tool_class,
                            s.options.inputs.machine.value_or(std::string(tooling::kDefaultMachine)),
                            {.diameter_mm = q.diameter_mm,
                             .depth_mm = q.depth_mm,
                             .width_mm = q.width_mm,
                             .tolerance_mm = q.tolerance_mm});
  question.cutter_diameter_mm = q.cutter_diameter_mm;
  question.teeth = static_cast<int>(q.teeth);
  question.stick_out_mm = q.stick_out_mm;
  question.hardness_hb = q.hardness_hb;
  question.coolant = casebase::coolant_of(q.coolant).value_or(casebase::Coolant::kUnknown);
  if (auto known = known_categories(question, *base); !known) return s.end(known.error(), kUsage);
  const auto near = base->nearest(question, q.count);
  if (!near) return s.end(near.error(), kUsage);
  std::vector<std::vector<std::string>> rows = {{"case", "distance", "D", "depth", "width", "tolerance",
                                                 "cutter", "teeth", "stick-out", "vc m/min", "fz mm",
                                                 "verdict", "origin", "source"}};
  for (const auto& [c, distance] : *near) {
    rows.push_back({c.id.substr(0, 12), trimmed(distance, 4), number_text(c.asked.diameter_mm),
                    number_text(c.asked.depth_mm), number_text(c.asked.width_mm),
                    number_text(c.asked.tolerance_mm), number_text(c.asked.cutter_diameter_mm),
                    number_text(c.asked.teeth), number_text(c.asked.stick_out_mm),
                    number_text(c.bound.vc_m_min), number_text(c.bound.fz_mm),
                    std::string(to_text(c.observed.verdict)), std::string(to_text(c.origin)), c.from.source});
  }
  std::string out = near->empty() ? no_shared_categories(question, *base) : table(rows, "");
  const auto advice = casebase::advise(
      casebase::evidence_near(*base, question).value_or(std::vector<casebase::Evidence>{}), {});
  if (advice.leads) {
    out += "precedent (" + std::string(to_text(advice.origin)) + "): " + words_of(advice.start) + ", " +
           trimmed(100.0 * advice.success, 0) + " % likely to go well; " + advice.why + "\n";
  } else {
    out += "no precedent: " + advice.why + "\n";
  }
  report_faults(s, *base);
  return print(out) ? kDone : kImpossible;
}

}  // namespace capstan::app
