#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "casebase/planned.h"
#include "casebase/recall/advice.h"
#include "casebase/tune/start.h"
#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/proposal.h"

// What was cut near a step before: where its speed and feed start from, and which cutters did well.

namespace capstan::step {

/// What near cases said of a step's cut, and where it would start from without them.
struct FromCases {
  casebase::Advice advice;
  double table_vc_m_min = 0.0, table_fz_mm = 0.0;
  double table_ap_most_mm = 0.0;                      ///< CutQuestion::ap_most_mm before
  std::string why_unasked;                            ///< why the base could not be asked; empty: it was
  std::optional<casebase::tune::ProvenStart> proven;  ///< tuned values; `advice.start` is then theirs

  /// Whether the cut starts from them: from good ones, or below failed ones.
  [[nodiscard]] bool bind() const { return advice.leads || advice.lowered; }
};

/// Lets near cases say where speed and feed start from and how deep the cut may be; both are upper bounds,
/// too, and every limit of the mechanics still holds. Nothing where there is no case base. A faster setting
/// that repeats have proven (casebase/tune/start.h) goes before the middle of the good cuts, where no failed
/// cut lowers the start and it is as likely to go well as a start must be.
/// Cases are compared at the table's terms: the feed of a narrow cut by its largest chip, the speed of a
/// short arc of contact by that of a long one, that of a deep slot by that of a shallow one, that of a cutter
/// in with its tip by the diameter that cuts. Good cases raise a mill's chip, and never lower it: what is
/// known of them is their feed at the nominal width, and the path had thicker chips in its corners.
[[nodiscard]] std::optional<FromCases> start_from_cases(const PlanSoFar& p, const draft::StepDraft& step,
                                                        const model::FeatureShape& shape,
                                                        optimise::CutQuestion& q);

/// Why a cut starts where it does: the cases by name, distance and outcome. Of one that binds.
[[nodiscard]] model::Reason reason_of(const FromCases& from);

/// The question as it would be asked without cases.
[[nodiscard]] optimise::CutQuestion without_cases(const FromCases& from, optimise::CutQuestion q);

/// What near cases say of values that the step has, whoever chose them: the probability that they go well.
/// Nothing where there is no case base, or no case near.
[[nodiscard]] std::optional<casebase::Advice> judged_by_cases(const PlanSoFar& p,
                                                              const draft::StepDraft& step,
                                                              const model::FeatureShape& shape,
                                                              const optimise::CutQuestion& q,
                                                              const optimise::CutAnswer& a);

/// What cutting with this cutter at its start values came to, near this step. Simulated cases do not count.
struct Experience {
  int good = 0, bad = 0;  ///< cuts, each counted once
  double success = 0.0;   ///< probability, of the start values
  /// By what its estimated time is to be taken: longer where failed cuts lower its values, and by the cuts
  /// that are made in vain, 1 / success, against those of a cutter of which nothing is known.
  double time_factor = 1.0;
  std::string words;  ///< for people; empty: no case near
};
[[nodiscard]] Experience experience_with(const casebase::CaseBase& cases, const model::Plan& plan,
                                         const casebase::OfStep& of, const model::FeatureShape& shape,
                                         const model::Candidate& candidate);

/// Ranks cutters by what was cut with them, too; says so in their reasons. Where cases put the first behind
/// another it is among the rejected, too; one that failed by kFirstFailed. `cases` may be null.
void weigh_by_cases(const casebase::CaseBase* cases, const model::Plan& plan, const casebase::OfStep& of,
                    const model::FeatureShape& shape, model::Selection& selection);

/// How the reason against a cutter or a chain begins that would be taken if it had not failed before.
inline constexpr std::string_view kFirstFailed = "would be first, but failed before: ";

/// What the question of a step of the plan takes from its nouns.
[[nodiscard]] casebase::OfStep of_step(const model::Model& m, const draft::StepDraft& step);

}  // namespace capstan::step
