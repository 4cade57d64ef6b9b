#include "planner/making/step/record/worn_edges.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/tune/edges.h"
#include "planner/ground/base/number.h"

namespace capstan::step {
namespace {

namespace tune = casebase::tune;

/// The share of an edge's life that the plan's steps with each cutter take, by cutter.
std::map<std::string, double> shares_of(const model::Plan& plan) {
  std::map<std::string, double> out;
  for (const model::StepResult& r : plan.steps) {
    if (r.cutter_id.empty()) continue;
    double& share = out[r.cutter_id];
    if (r.loads.tool_life_min > 0.0) share += r.cutting_s / 60.0 / r.loads.tool_life_min;
  }
  return out;
}

bool is_of(const std::string& instance, const model::Cutter& cutter) {
  return instance == cutter.id || std::any_of(cutter.sisters.begin(), cutter.sisters.end(),
                                              [&](const model::SisterTool& s) { return s.id == instance; });
}

std::string percent(double p) { return trimmed(100.0 * p, 0) + " %"; }

}  // namespace

void tell_edges(const model::Plan& plan, const casebase::CaseBase* cases, Job& job) {
  if (cases == nullptr) return;
  std::map<std::string, std::vector<casebase::Case>> of_class;
  for (const auto& [id, share] : shares_of(plan)) {
    const model::Cutter* cutter = find_cutter(plan, id);
    if (cutter == nullptr) continue;
    const std::string tool = casebase::tool_class_of(*cutter);
    const auto [at, fresh] = of_class.try_emplace(tool);
    if (fresh) at->second = cases->cut_with(tool);
    std::vector<casebase::Case> theirs;
    std::copy_if(at->second.begin(), at->second.end(), std::back_inserter(theirs),
                 [&](const casebase::Case& c) { return is_of(c.from.tool_instance, *cutter); });
    for (const tune::EdgeUse& e : tune::edges_of(theirs)) {
      const double then = e.worn_out(share);
      if (e.broken || then < tune::kNearItsEnd) continue;
      job.report({.code = "CASE-EDGE",
                  .severity = then > 0.5 ? Severity::kWarning : Severity::kNote,
                  .message = "edge '" + e.edge + "' of tool '" + id + "' has cut " + trimmed(e.cut_min, 1) +
                             " min, " + percent(e.used) + " of the life expected: " + percent(e.worn_out()) +
                             " likely worn out, " + percent(then) + " after this plan",
                  .file = plan.file_name,
                  .hint = "look at the edge, or change it (capstan cases report says what is left)"});
    }
  }
}

}  // namespace capstan::step
