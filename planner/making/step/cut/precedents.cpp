#include "planner/making/step/cut/precedents.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/recall.h"
#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/cut/strategies.h"
#include "planner/making/step/record/results.h"
#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/loads/width.h"

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
  if (q.slot && q.kind == optimise::CutKind::kRough && cut.ap_mm > 0.0)
    cut.vc_m_min /= optimise::deep_slot_share(cut.ap_mm, d);
  if (!optimise::is_milling(q.kind) || !(cut.ae_mm > 0.0)) return cut;
  cut.vc_m_min /= optimise::speed_by_arc(q, cut.ae_mm);
  // The largest chip of a cut narrower than the radius: h = 2 fz sqrt(r (1 - r)), r = ae / D.
  const double r = std::min(0.5, cut.ae_mm / d);
  cut.fz_mm *= 2.0 * std::sqrt(r * (1.0 - r));
  return cut;
}

/// Cases at the table's terms. The width of a case is that of its way in general: in corners its path took
/// more, up to the table's chip, where its feed is that large. What went well is counted as having borne that
/// chip; of what failed only the chip of its width is certain.
void to_table_terms(std::vector<Evidence>& near, const optimise::CutQuestion& q, double table_fz_mm) {
  for (Evidence& e : near) {
    const double set_mm = e.cut.fz_mm;
    e.cut = at_table_terms(e.cut, q);
    if (optimise::is_milling(q.kind) && e.verdict == casebase::Verdict::kGood)
      e.cut.fz_mm = std::max(e.cut.fz_mm, std::min(set_mm, table_fz_mm));
  }
}

/// The near cases, and each as evidence at the table's terms.
struct Near {
  casebase::Question question;
  std::vector<casebase::Neighbour> cases;
  std::vector<Evidence> told;  ///< of those, and behind them of what is lost
};

Result<Near> near_of(const PlanSoFar& p, const StepDraft& step, const model::FeatureShape& shape,
                     const optimise::CutQuestion& q, double table_fz_mm) {
  Near out;
  out.question =
      casebase::question_of(p.plan, of_step(p.plan.model, step), step.cutter, casebase::sizes_of(shape));
  auto cases = casebase::cases_near(*p.wishes.cases, out.question);
  if (!cases) return tl::unexpected(cases.error());
  out.told = casebase::evidence_of(*cases, out.question);
  out.cases = std::move(cases->found);
  to_table_terms(out.told, q, table_fz_mm);
  return out;
}

/// As the table's values, with the deepest and the widest cut that may be chosen where depth or width are
/// open: what was proven in a lighter cut is not proven for that one.
Values heaviest(Values table, const optimise::CutQuestion& q) {
  if (!optimise::is_milling(q.kind)) return table;
  const auto least_of = [](double a, double b) { return b > 0.0 ? std::min(a, b) : a; };
  if (!(table.ap_mm > 0.0))
    table.ap_mm = least_of(least_of(q.depth_mm, q.cutter.maximum_depth_of_cut_mm), q.ap_most_mm);
  if (!(table.ae_mm > 0.0)) {
    const double d = q.cutter.cutting_diameter_mm;
    table.ae_mm = q.slot ? d : least_of(mechanics::kRoughWidthRatio * d, q.width_mm);
  }
  return table;
}

/// Starts from tuned values where there are some that are faster and likely enough to go well.
void take_proven(FromCases& out, const Near& near, const Values& table, double least_fz_mm) {
  Advice& a = out.advice;
  if (!a.leads || a.lowered) return;
  const auto tuned = casebase::tune::proven_start(near.cases, near.told, near.question, table, a.start);
  if (!tuned) return;
  Values start = a.start;
  start.vc_m_min = tuned->vc_m_min;
  start.fz_mm = std::max(tuned->fz_mm, least_fz_mm);
  const auto feed_of = [&](double fz_mm) {
    return casebase::tune::Setting{0.0, std::log(fz_mm / table.fz_mm)};
  };
  if (!same_setting(feed_of(start.fz_mm), feed_of(tuned->fz_mm))) return;  // a chip that nobody cut so fast
  const double success = casebase::success_of(near.told, start);
  if (success < casebase::kLeastSuccess) return;
  a.start = start;
  a.success = success;
  out.proven = tuned;
}

}  // namespace

bool OfStrategy::failed() const { return bad >= casebase::kRepeats && success < kLikelierToFail; }

std::vector<OfStrategy> strategies_near(const PlanSoFar& p, const StepDraft& step,
                                        const model::FeatureShape& shape, const optimise::CutQuestion& q) {
  std::vector<OfStrategy> out;
  if (p.wishes.cases == nullptr) return out;
  const auto near = near_of(p, step, shape, q, q.fz_start_mm);
  if (!near) return out;
  std::map<std::string, std::vector<Evidence>> of;
  for (std::size_t i = 0; i < near->cases.size(); ++i) {
    const casebase::Case& c = near->cases[i].found;
    if (!c.bound.strategy.empty() && c.origin != casebase::Origin::kSimulated)
      of[c.bound.strategy].push_back(near->told[i]);
  }
  const Values table{q.vc_start_m_min, q.fz_start_mm, q.ap_mm.value_or(0.0), q.ae_mm.value_or(0.0)};
  for (auto& [strategy, told] : of) {
    const Advice a = casebase::advise(std::move(told), table);
    if (a.good + a.bad > 0) out.push_back({strategy, a.good, a.bad, a.success_asked});
  }
  return out;
}

std::optional<FromCases> start_from_cases(const PlanSoFar& p, const StepDraft& step,
                                          const model::FeatureShape& shape, optimise::CutQuestion& q) {
  if (p.wishes.cases == nullptr) return std::nullopt;
  FromCases out;
  out.table_vc_m_min = q.vc_start_m_min;
  out.table_fz_mm = q.fz_start_mm;
  out.table_ap_most_mm = q.ap_most_mm;
  const Values table{q.vc_start_m_min, q.fz_start_mm, q.ap_mm.value_or(0.0), q.ae_mm.value_or(0.0)};
  // Where a mill's feed follows its sections no case tells the largest chip of its path: the table's stands.
  const double least_fz_mm = optimise::is_milling(q.kind) ? table.fz_mm : 0.0;
  const auto near = near_of(p, step, shape, q, table.fz_mm);
  if (!near) out.why_unasked = near.error().message;
  out.advice = casebase::advise(near ? near->told : std::vector<Evidence>{}, table, least_fz_mm);
  if (near) take_proven(out, *near, heaviest(table, q), least_fz_mm);
  if (!out.bind()) return out;
  Values& start = out.advice.start;
  if (const double borne = model::largest_tooth_feed_mm(q.cutter, q.material); borne > 0.0)
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
  auto near = near_of(p, step, shape, q, q.fz_start_mm);
  if (!near) return std::nullopt;
  Advice out = casebase::advise(std::move(near->told), at_table_terms(cut, q));
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
      text += ", held at the largest value of the table (" + trimmed(casebase::kCaseReach, 2) +
              " times its values after " + std::to_string(casebase::kRepeats) + " repeats, before that once)";
    if (a.centre.fz_mm < from.table_fz_mm && !a.lowered && a.start.fz_mm >= from.table_fz_mm)
      text += ", with the table's chip, which their paths may have had in corners";
  }
  if (a.lowered) {
    text += (text.empty() ? "" : "; ") + std::string("below cuts that failed: ") + words_of(a.start) + ", " +
            trimmed(100.0 * a.success, 0) + " %" + " likely to go well" +
            (a.at_bottom ? ", the least that is tried" : "");
  }
  text += "; " + a.why + ": " + casebase::words_of(a.cases, kNamed, a.cuts());
  const std::string first = a.cases.empty() ? "none" : a.cases.front().id;
  return {"case." + first, std::move(text), "case base"};
}

casebase::OfStep of_step(const model::Model& m, const StepDraft& step) {
  return {step.operation.type, step.feature, casebase::coolant_of(result_of(m, step))};
}

Experience experience_with(const casebase::CaseBase& cases, const model::Plan& plan,
                           const casebase::OfStep& of, const model::FeatureShape& shape,
                           const model::Candidate& candidate) {
  Experience out;
  auto found = casebase::evidence_near(
      cases, casebase::question_of(plan, of, candidate.cutter, casebase::sizes_of(shape)));
  if (!found) return out;  // the step itself says so: FromCases::why_unasked
  std::vector<Evidence>& near = *found;
  std::erase_if(near, [](const Evidence& e) { return e.origin == casebase::Origin::kSimulated; });
  optimise::CutQuestion q;
  q.cutter = candidate.cutter;
  q.kind = model::is_a(of.operation, model::TypeId::kDrillingTypeOperation) ? optimise::CutKind::kAxial
                                                                            : optimise::CutKind::kRough;
  to_table_terms(near, q, candidate.fz_mm);
  if (near.empty() || !(candidate.vc_m_min > 0.0) || !(candidate.fz_mm > 0.0)) return out;
  const Advice advice = casebase::advise(std::move(near), {candidate.vc_m_min, candidate.fz_mm, 0.0, 0.0});
  out.good = advice.careful ? 0 : advice.good;
  out.bad = advice.bad;
  out.success = advice.success_asked;
  if (out.good + out.bad == 0) return out;
  const Values& start = advice.start;
  const double slower = advice.lowered && start.vc_m_min > 0.0 && start.fz_mm > 0.0
                            ? candidate.vc_m_min * candidate.fz_mm / (start.vc_m_min * start.fz_mm)
                            : 1.0;
  out.time_factor = std::max(1.0, slower) * casebase::kTrustInTable / advice.success;
  out.words = advice.why + ": " + casebase::words_of(advice.cases, 3, advice.cuts());
  return out;
}

void weigh_by_cases(const casebase::CaseBase* cases, const model::Plan& plan, const casebase::OfStep& of,
                    const model::FeatureShape& shape, model::Selection& selection) {
  if (cases == nullptr || selection.ranked.empty()) return;
  const std::string first = selection.ranked.front().cutter.id;
  std::vector<model::Rejected> failed;
  bool any = false;
  for (model::Candidate& c : selection.ranked) {
    const Experience e = experience_with(*cases, plan, of, shape, c);
    if (e.words.empty()) continue;
    any = true;
    if (e.bad > 0 && e.success < casebase::kLeastSuccess) failed.push_back({c.cutter.id, e.words});
    c.score += (e.time_factor - 1.0) * c.estimated_s;
    c.estimated_s *= e.time_factor;
    c.why.text += "; by cases " + trimmed(100.0 * e.success, 0) +
                  " % likely to go well, its time taken times " + trimmed(e.time_factor, 2) + " (" + e.words +
                  ")";
  }
  if (!any) return;
  std::stable_sort(selection.ranked.begin(), selection.ranked.end(),
                   [](const model::Candidate& a, const model::Candidate& b) { return a.score < b.score; });
  const std::string now = selection.ranked.front().cutter.id;
  if (now == first) return;
  for (model::Rejected& r : failed) {
    if (r.what != first) continue;
    selection.rejected.push_back({first, std::string(kFirstFailed) + r.why});
    return;
  }
  selection.rejected.push_back(
      {first, "would be first by the table; with the times that cases tell, " + now + " comes before it"});
}

}  // namespace capstan::step
