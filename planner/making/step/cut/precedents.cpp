#include "planner/making/step/cut/precedents.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/recall.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/plan/borne_feed.h"

namespace capstan::step {
namespace {

using casebase::Advice;
using casebase::Evidence;
using casebase::Values;
using casebase::words_of;
using draft::StepDraft;

constexpr std::size_t kNamed = 5;  // cases in one line

/// A cut as one at the table's terms.
Values at_table_terms(Values cut, const optimise::CutQuestion& q) {
  const double d = q.cutter.cutting_diameter_mm;
  if (!(d > 0.0)) return cut;
  cut.vc_m_min *= optimise::speed_diameter_mm(q) / d;  // cases count it at the whole diameter
  if (!mills(q) || !(cut.ae_mm > 0.0)) return cut;
  cut.vc_m_min /= optimise::speed_by_arc(q, cut.ae_mm);
  // The largest chip of a cut narrower than the radius: h = 2 fz sqrt(r (1 - r)), r = ae / D.
  const double r = std::min(0.5, cut.ae_mm / d);
  cut.fz_mm *= 2.0 * std::sqrt(r * (1.0 - r));
  return cut;
}

/// The near cases, and each as evidence at the table's terms.
struct Near {
  casebase::Question question;
  std::vector<casebase::Neighbour> cases;
  std::vector<Evidence> told;
};

Near near_of(const PlanSoFar& p, const StepDraft& step, const model::FeatureShape& shape,
             const optimise::CutQuestion& q) {
  Near out;
  out.question = casebase::question_of(step.operation.type, p.plan.material, step.cutter, p.plan.machine,
                                       casebase::sizes_of(shape));
  out.cases = casebase::cases_near(*p.wishes.cases, out.question);
  out.told = casebase::evidence_of(out.cases, out.question);
  for (Evidence& e : out.told) e.cut = at_table_terms(e.cut, q);
  return out;
}

/// Starts from tuned values where there are some that are faster and likely enough to go well.
void take_proven(FromCases& out, const Near& near, const Values& table) {
  Advice& a = out.advice;
  if (!a.leads || a.lowered) return;
  const auto tuned = casebase::tune::proven_start(near.cases, near.told, near.question, table, a.start);
  if (!tuned) return;
  Values start = a.start;
  start.vc_m_min = tuned->vc_m_min;
  start.fz_mm = tuned->fz_mm;
  const double success = casebase::success_of(near.told, start);
  if (success < casebase::kLeastSuccess) return;
  a.start = start;
  a.success = success;
  out.proven = tuned;
}

}  // namespace

std::optional<FromCases> start_from_cases(const PlanSoFar& p, const StepDraft& step,
                                          const model::FeatureShape& shape, optimise::CutQuestion& q) {
  if (p.wishes.cases == nullptr) return std::nullopt;
  FromCases out;
  out.table_vc_m_min = q.vc_start_m_min;
  out.table_fz_mm = q.fz_start_mm;
  out.table_ap_most_mm = q.ap_most_mm;
  const Values table{q.vc_start_m_min, q.fz_start_mm, q.ap_mm.value_or(0.0), q.ae_mm.value_or(0.0)};
  const Near near = near_of(p, step, shape, q);
  out.advice = casebase::advise(near.told, table);
  take_proven(out, near, table);
  if (!out.bind()) return out;
  Values& start = out.advice.start;
  if (const double borne = model::borne_feed_mm(q.cutter, q.material); borne > 0.0)
    start.fz_mm = std::min(start.fz_mm, borne);
  q.vc_start_m_min = start.vc_m_min;
  q.fz_start_mm = start.fz_mm;
  if (start.vc_m_min < out.table_vc_m_min) q.vc_table_m_min = std::min(q.vc_table_m_min, start.vc_m_min);
  if (out.advice.lowered && start.ap_mm > 0.0 && !q.ap_mm)
    q.ap_most_mm = q.ap_most_mm > 0.0 ? std::min(q.ap_most_mm, start.ap_mm) : start.ap_mm;
  return out;
}

optimise::CutQuestion without_cases(const FromCases& from, optimise::CutQuestion q) {
  if (q.vc_table_m_min == q.vc_start_m_min) q.vc_table_m_min = from.table_vc_m_min;
  q.vc_start_m_min = from.table_vc_m_min;
  q.fz_start_mm = from.table_fz_mm;
  q.ap_most_mm = from.table_ap_most_mm;
  return q;
}

std::optional<Advice> judged_by_cases(const PlanSoFar& p, const StepDraft& step,
                                      const model::FeatureShape& shape, const optimise::CutQuestion& q,
                                      const optimise::CutAnswer& a) {
  if (p.wishes.cases == nullptr) return std::nullopt;
  const double d = q.cutter.cutting_diameter_mm;
  const int teeth = std::max(1, q.cutter.teeth);
  if (!(d > 0.0) || !(a.n_rpm > 0.0)) return std::nullopt;
  const Values cut{std::numbers::pi * d * a.n_rpm / 1000.0, a.feed_mm_min / (a.n_rpm * teeth), a.ap_mm,
                   a.ae_mm};
  Advice out = casebase::advise(near_of(p, step, shape, q).told, at_table_terms(cut, q));
  if (!out.any()) return std::nullopt;
  return out;
}

model::Reason reason_of(const FromCases& from) {
  const casebase::Advice& a = from.advice;
  std::string text;
  if (from.proven) {
    const casebase::tune::ProvenStart& t = *from.proven;
    text = "starts from tuned values, proven by " + counted(t.repeats.good, "good part", "good parts") +
           " on " + counted(t.repeats.edges, "edge", "edges") + ": " +
           words_of({t.vc_m_min, t.fz_mm, 0.0, 0.0}) + ", " + trimmed(100.0 * t.probability, 1) +
           " % of parts expected beyond a limit; the middle of the cuts "
           "that went well is " +
           words_of({a.centre.vc_m_min, a.centre.fz_mm, 0.0, 0.0});
  } else if (a.leads) {
    text = "starts from the middle of " + std::string(to_text(a.origin)) +
           " cuts that went well: " + words_of({a.centre.vc_m_min, a.centre.fz_mm, 0.0, 0.0});
    if (a.held_back)
      text += ", held at what the table bears (" + trimmed(casebase::kCaseReach, 2) +
              " times its values after " + std::to_string(casebase::kRepeats) + " repeats, before that once)";
  }
  if (a.lowered) {
    text += (text.empty() ? "" : "; ") + std::string("below cuts that failed: ") + words_of(a.start) + ", " +
            trimmed(100.0 * a.success, 0) + " %" + " likely to go well" +
            (a.at_bottom ? ", the least that is tried" : "");
  }
  text += "; " + a.why + ": " + casebase::words_of(a.cases, kNamed);
  const std::string first = a.cases.empty() ? "none" : a.cases.front().id;
  return {"case." + first, std::move(text), "case base"};
}

Experience experience_with(const casebase::CaseBase& cases, const model::Plan& plan, model::TypeId operation,
                           const model::FeatureShape& shape, const model::Candidate& candidate) {
  Experience out;
  const auto asked = casebase::question_of(operation, plan.material, candidate.cutter, plan.machine,
                                           casebase::sizes_of(shape));
  auto near = casebase::evidence_near(cases, asked);
  std::erase_if(near, [](const Evidence& e) { return e.origin == casebase::Origin::kSimulated; });
  optimise::CutQuestion q;
  q.cutter = candidate.cutter;
  q.kind = model::is_a(operation, model::TypeId::kDrillingTypeOperation) ? optimise::CutKind::kDrill
                                                                         : optimise::CutKind::kRough;
  for (Evidence& e : near) e.cut = at_table_terms(e.cut, q);
  if (near.empty() || !(candidate.vc_m_min > 0.0) || !(candidate.fz_mm > 0.0)) return out;
  const Advice advice = casebase::advise(std::move(near), {candidate.vc_m_min, candidate.fz_mm, 0.0, 0.0});
  out.good = advice.good;
  out.bad = advice.bad;
  out.success = advice.success_asked;
  if (out.good + out.bad == 0) return out;
  const Values& start = advice.start;
  const double slower = advice.lowered && start.vc_m_min > 0.0 && start.fz_mm > 0.0
                            ? candidate.vc_m_min * candidate.fz_mm / (start.vc_m_min * start.fz_mm)
                            : 1.0;
  out.time_factor = std::max(1.0, slower) * casebase::kTrustInTable / advice.success;
  out.words = advice.why + ": " + casebase::words_of(advice.cases, 3);
  return out;
}

void weigh_by_cases(const casebase::CaseBase* cases, const model::Plan& plan, model::TypeId operation,
                    const model::FeatureShape& shape, model::Selection& selection) {
  if (cases == nullptr) return;
  bool any = false;
  for (model::Candidate& c : selection.ranked) {
    const Experience e = experience_with(*cases, plan, operation, shape, c);
    if (e.words.empty()) continue;
    any = true;
    c.score += (e.time_factor - 1.0) * c.estimated_s;
    c.estimated_s *= e.time_factor;
    c.why.text += "; by cases " + trimmed(100.0 * e.success, 0) +
                  " % likely to go well, its time taken times " + trimmed(e.time_factor, 2) + " (" + e.words +
                  ")";
  }
  if (!any) return;
  std::stable_sort(selection.ranked.begin(), selection.ranked.end(),
                   [](const model::Candidate& a, const model::Candidate& b) { return a.score < b.score; });
}

}  // namespace capstan::step
