#include "planner/making/step/path/given_path.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/cut_samples.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/record/record.h"
#include "planner/making/step/record/results.h"
#include "planner/making/workholding/clear_of_fixtures.h"
#include "planner/physics/engagement/kept_digits.h"

namespace capstan::step {
namespace {

using draft::StepDraft;

/// Speed and feed are asked for the heaviest cut on the path; elsewhere the schedule says what is borne.
void ask_for_heaviest(const std::vector<optimise::CutSample>& samples, optimise::CutQuestion& q) {
  double most = 0.0;
  for (const auto& s : samples) {
    if (s.plunge || s.ap_mm * s.ae_mm <= most) continue;
    most = s.ap_mm * s.ae_mm;
    q.ap_mm = q.depth_mm = s.ap_mm;
    q.ae_mm = q.width_mm = std::min(s.ae_mm, q.cutter.cutting_diameter_mm);
  }
}

optimise::CutQuestion question_for(const PlanSoFar& p, const StepDraft& step, const Progress& progress,
                                   const stock::HeightMap& map) {
  toolpath::PathJob path;
  if (!step.shapes.empty()) {
    path = job_of(p, step, step.shapes.front());
    progress.prepare(step, map, path);
  }
  path.cutter = step.cutter;
  auto q = question_of(p, step, nullptr, path);
  if (optimise::is_milling(q.kind)) q.slot = false;
  return q;
}

/// The file's sections, where it has any; else the measured ones.
std::vector<optimise::CutSample> samples_for(const model::Model& m, const StepDraft& step,
                                             const model::CutterPath& path,
                                             const model::SectionSeries& stated,
                                             const std::optional<engagement::Measurement>& found, Job& job) {
  const double d = step.cutter.cutting_diameter_mm;
  const auto ours = found ? samples_of(*found, path, step.cutter) : std::vector<optimise::CutSample>{};
  if (stated.size() == 0) return ours;
  if (const auto why = impossible(stated, path, d, step.cutter.maximum_depth_of_cut_mm)) {
    job.warn("PIP-SECTIONS", "step '" + draft::name_of(m, step) + "': the file's cross sections cannot be, " +
                                 *why + "; " + (found ? "the measured ones are used" : "none are used"));
    return ours;
  }
  auto said = samples_of(stated, path, step.cutter);
  if (!found) return said;
  const auto extents = extents_contradict(stated, found->sections, d);
  auto both = compared(said, ours, d);
  if (both.contradictions > 0) {
    job.warn("PIP-SECTIONS", "step '" + draft::name_of(m, step) +
                                 "': the file's cross sections contradict the " + "measured ones at " +
                                 std::to_string(both.contradictions) + " places, most at " + both.worst +
                                 "; the larger ones are used");
  }
  if (extents) {
    job.warn("PIP-SECTIONS", "step '" + draft::name_of(m, step) +
                                 "': the file's cross sections contradict the " + "measured ones, " +
                                 *extents + "; the measured ones count, too");
    both.samples.insert(both.samples.end(), ours.begin(), ours.end());
    std::stable_sort(both.samples.begin(), both.samples.end(), [](const auto& a, const auto& b) {
      return std::pair(a.move, a.at_mm) < std::pair(b.move, b.at_mm);
    });
  }
  return std::move(both.samples);
}

/// The schedule that the toolpaths state, as factors of its greatest feed and speed.
void ask_as_stated(const model::FeedSchedule& s, optimise::FeedQuestion& q) {
  for (std::size_t i = 0; i < s.feed_mm_min.size(); ++i) {
    q.feed_mm_min = std::max(q.feed_mm_min, s.feed_mm_min[i]);
    if (std::abs(s.spindle_rpm[i]) > std::abs(q.n_rpm)) q.n_rpm = s.spindle_rpm[i];
  }
  for (std::size_t i = 0; q.feed_mm_min > 0.0 && i < s.feed_mm_min.size(); ++i)
    q.feed_factor.push_back(s.feed_mm_min[i] / q.feed_mm_min);
}

/// Toolpaths have technologies of their own: where these turn against the cutter, they are turned round. A
/// tap turns back by intent.
void turn_round(const model::Model& m, const StepDraft& step, model::FeedSchedule& s, Job& job) {
  if (!(step.cutter.cutting_diameter_mm > 0.0) || step.cutter.cutter_class == model::CutterClass::kTap)
    return;
  const double sense = step.cutter.hand == model::Hand::kLeft ? -1.0 : 1.0;
  std::size_t turned = 0;
  for (double& rpm : s.spindle_rpm) {
    if (rpm * sense >= 0.0) continue;
    rpm = -rpm;
    ++turned;
  }
  if (turned == 0) return;
  job.warn("PIP-CHANGED", "step '" + draft::name_of(m, step) + "': in " + std::to_string(turned) +
                              " moves of its toolpaths the spindle would turn against " + step.cutter.id +
                              ", which cuts " + (sense > 0.0 ? "right" : "left") + "-hand; it turns " +
                              (sense > 0.0 ? "clockwise" : "counter-clockwise"));
}

/// Speed and feed that the file leaves open. Nothing when no cut keeps the limits.
Result<model::FeedSchedule> chosen(model::Plan& plan, const PlanSoFar& p, StepDraft& step,
                                   const model::CutterPath& path, const model::FeedSchedule& stated,
                                   GivenPath& out, Cuts& cuts, Job& job) {
  auto& q = out.feeds.cut;
  std::string freed;
  auto answer = cuts.answer(step, q, freed);
  if (!answer) return tl::unexpected(answer.error());
  let_go(plan.model, step, freed, job);
  if (!answer->feasible) {
    std::string limits;
    for (const auto& v : answer->violated) limits += (limits.empty() ? "" : ", ") + v;
    return fail("PIP-INFEASIBLE", "no feed keeps the given path within the limits: " + limits +
                                      "; use another tool or machine");
  }
  record_cut(plan, p.steps, step, *answer, false, false, std::nullopt);
  out.feeds.n_rpm = (step.cutter.hand == model::Hand::kLeft ? -1.0 : 1.0) * answer->n_rpm;
  out.feeds.feed_mm_min = answer->feed_mm_min;
  out.feeds.adapt = true;
  out.feeds.constant = p.wishes.constant_feeds;
  out.feeds.dwell_s = stated.dwell_s;
  out.result.axial_depth_mm = answer->ap_mm;
  out.result.radial_depth_mm = answer->ae_mm;
  out.result.active = active_of(*answer);
  const auto feeds = optimise::feeds(out.feeds, path);
  out.result.loads = feeds.peak;
  if (!(out.result.loads.tool_life_min > 0.0)) out.result.loads.tool_life_min = answer->life_min;
  out.result.held_by = feeds.held_by;
  keep_excess(plan.model, step, feeds, out.result, job);
  return feeds.schedule;
}

}  // namespace

std::optional<engagement::Measurement> measured(const model::Model& model, const StepDraft& step,
                                                const model::CutterPath& path, Stocks& stocks, Job& job) {
  auto m = stocks.measure(step.setup, path, step.cutter);
  if (!m) {
    job.warn(m.error().code,
             "step '" + draft::name_of(model, step) + "' is not measured: " + m.error().message);
    return std::nullopt;
  }
  return *std::move(m);
}

void tell_rapids(const model::Model& m, const StepDraft& step, double removed_mm3, Job& job) {
  if (removed_mm3 <= 1e-3) return;
  job.note("PIP-RAPID", "step '" + draft::name_of(m, step) + "': by planning's account rapid moves touch " +
                            trimmed(removed_mm3, 3) +
                            " mm3 of material; whether they do is what the check finds (CHK-RAPID)");
}

bool rigid_tap(const model::Plan& plan, const StepDraft& step, Job& job) {
  const auto* tapping = plan.model.get<model::Tapping>(step.operation);
  if (tapping == nullptr || tapping->compensation_chuck.value_or(false)) return false;
  const auto* made = plan.ledger.find(step.operation, "its_toolpath");
  if (made != nullptr && made->binder == model::Binder::kRule) return true;  // that cycle, written as moves
  job.warn("PIP-CHANGED",
           "step '" + draft::name_of(plan.model, step) +
               "': the given toolpath of the tap is moves without synchronisation; planned as rigid tapping "
               "instead");
  return true;
}

Result<std::optional<GivenPath>> given_path(model::Plan& plan, const PlanSoFar& p, StepDraft& step,
                                            Stocks& stocks, const Progress& progress, Cuts& cuts, Job& job) {
  auto given = exchange::path_of_step(plan, step.step, {}, job, &p.recorded.steps);
  if (!given) {
    job.report(given.error());
    return tl::unexpected(given.error());
  }
  if (given->path.size() == 0) return std::optional<GivenPath>{};
  if (const auto touch = workholding::near_move_of(given->path, step.cutter, p.setups[step.setup].holding))
    return fail("PIP-HOLDING", "the given path is not kept: " + touch->text);
  turn_round(plan.model, step, given->schedule, job);
  GivenPath out;
  out.result = result_of(plan.model, step);
  auto& fq = out.feeds;
  fq.adapt = false;
  const bool cuts_here = step.cutter.cutting_diameter_mm > 0.0;
  const bool asks = cuts_here && plan.model.holds<model::MachiningOperation>(step.operation);
  if (asks) fq.cut = question_for(p, step, progress, stocks.of(step.setup));
  auto path = std::make_shared<const model::CutterPath>(std::move(given->path));
  if (cuts_here) {
    auto found = measured(plan.model, step, *path, stocks, job);
    if (found) tell_rapids(plan.model, step, found->rapid_removed_mm3, job);
    fq.samples = samples_for(plan.model, step, *path, given->sections, found, job);
    if (found) {
      engagement::keep_digits(found->sections, found->known_to_mm);
      out.result.sections = std::make_shared<const model::SectionSeries>(std::move(found->sections));
    } else if (given->sections.size() > 0) {
      out.result.sections = std::make_shared<const model::SectionSeries>(std::move(given->sections));
    }
  }
  if (asks && optimise::is_milling(fq.cut.kind)) ask_for_heaviest(fq.samples, fq.cut);
  out.result.path = path;
  if (asks && step.open_technology) {
    auto schedule = chosen(plan, p, step, *path, given->schedule, out, cuts, job);
    if (!schedule) return tl::unexpected(schedule.error());
    out.result.schedule = std::make_shared<const model::FeedSchedule>(*std::move(schedule));
    state_path(plan.model, step, path);
    return out;
  }
  ask_as_stated(given->schedule, fq);
  if (asks && fq.n_rpm != 0.0 && fq.feed_mm_min > 0.0) {
    fq.cut.feed_mm_min = fq.feed_mm_min;
    // A path and feed that planning made before are judged as then; what a file gives is its maker's.
    const auto feeds = optimise::feeds(fq, *path);
    out.result.loads = feeds.peak;
    out.result.held_by = feeds.held_by;
    if (feed_was_planned(plan, step)) keep_excess(plan.model, step, feeds, out.result, job);
  }
  out.result.schedule = std::make_shared<const model::FeedSchedule>(std::move(given->schedule));
  return out;
}

}  // namespace capstan::step
