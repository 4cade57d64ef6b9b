#include <utility>

#include "casebase/casebase.h"
#include "casebase/recall/recall.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/explain/values.h"
#include "planner/door/service/reading.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::app {

using service::table;

namespace {

std::string n(double v) { return v != 0.0 ? trimmed(v, 4) : std::string("-"); }

/// Cases from a CSV file, or from a plan's steps. A step that makes no case is reported and skipped.
Result<std::vector<casebase::Case>> cases_of(const std::string& path, Job& job) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const service::Content content = service::content_of(*bytes);
  if (content != service::Content::kPlanJson && content != service::Content::kPart)
    return casebase::from_csv(*bytes, path);
  const auto plan = service::read_plan(*std::move(bytes), path, job);
  if (!plan) return tl::unexpected(plan.error());
  std::vector<casebase::Case> out;
  for (const auto& step : plan->steps) {
    auto one = casebase::case_of(*plan, step);
    if (one) {
      out.push_back(*std::move(one));
    } else {
      Diagnostic d = one.error();
      d.severity = Severity::kNote;
      job.report(std::move(d));
    }
  }
  return out;
}

}  // namespace

int run_cases_add(Session& s) {
  std::vector<casebase::Case> cases;
  for (const std::string& path : s.options.files) {
    auto more = cases_of(path, s.job);
    if (!more) return s.end(more.error(), kUnreadable);
    cases.insert(cases.end(), more->begin(), more->end());
  }
  auto base = casebase::CaseBase::open_or_create(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::size_t before = base->size();
  if (auto ok = base->add(cases); !ok) return s.end(ok.error(), kImpossible);
  s.summary = "read " + counted(cases.size(), "case", "cases") + ", " +
              std::to_string(base->size() - before) + " of them new; the base holds " +
              counted(base->size(), "case", "cases");
  return kDone;
}

int run_cases_nearest(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const auto materials = tooling::shipped_materials();
  if (!materials) return s.end(materials.error(), kUnreadable);
  const CaseQuestion& q = s.options.question;
  const auto material = tooling::find_material({q.material}, *materials, s.job, tooling::Families::kRefused);
  if (!material) return s.end(material.error(), kUsage);
  const auto question =
      casebase::question_of(q.operation, casebase::material_group_of(*material), q.tool_class,
                            s.options.inputs.machine.value_or(std::string(tooling::kDefaultMachine)),
                            {.diameter_mm = q.diameter_mm,
                             .depth_mm = q.depth_mm,
                             .width_mm = q.width_mm,
                             .tolerance_mm = q.tolerance_mm});
  const auto near = base->nearest(question, q.count);
  if (!near) return s.end(near.error(), kUsage);
  std::vector<std::vector<std::string>> rows = {{"case", "distance", "D", "depth", "width", "tolerance",
                                                 "vc m/min", "fz mm", "verdict", "provenance", "source"}};
  for (const auto& [c, distance] : *near) {
    rows.push_back({c.id.substr(0, 12), trimmed(distance, 4), n(c.asked.diameter_mm), n(c.asked.depth_mm),
                    n(c.asked.width_mm), n(c.asked.tolerance_mm), n(c.vc_m_min), n(c.fz_mm), c.verdict,
                    c.provenance, c.source});
  }
  std::string out = near->empty() ? "no case shares these categories\n" : table(rows, "");
  const auto advice = casebase::advise(casebase::evidence_near(*base, question, 0.0), {});
  if (advice.leads) {
    out += "precedent (" + std::string(to_text(advice.origin)) + "): " + words_of(advice.start) + ", " +
           trimmed(100.0 * advice.success, 0) + " % likely to go well; " + advice.why + "\n";
  } else {
    out += "no precedent: " + advice.why + "\n";
  }
  return print(out) ? kDone : kImpossible;
}

}  // namespace capstan::app
