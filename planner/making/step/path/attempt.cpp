#include "planner/making/step/path/attempt.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/earlier_diagnostics.h"
#include "planner/ground/base/number.h"
#include "planner/ground/memo/remembered.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/cut/shift.h"
#include "planner/making/step/cut/thread_bound.h"
#include "planner/making/step/cut_samples.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/path/given_path.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/path/remembered/pieces.h"
#include "planner/making/step/path/surface.h"
#include "planner/making/step/record/record.h"
#include "planner/making/step/record/results.h"
#include "planner/making/workholding/clear_of_fixtures.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/path/own_frame.h"
#include "planner/model/plan/range/columns_agree.h"
#include "planner/physics/engagement/kept_digits.h"

namespace capstan::step {
namespace {

using draft::StepDraft;

/// The cut again at a share of its depth, or of its width where the depth is not open.
Status make_thinner(PathWithCut& out, double share, Cuts& cuts) {
  auto q = out.question;
  if (out.depth_open) {
    q.ap_most_mm = share * out.answer.ap_mm;
  } else {
    q.ae_mm = share * out.answer.ae_mm;
  }
  auto answer = cuts.answer(q);
  if (!answer) return tl::unexpected(answer.error());
  if (!answer->feasible) return fail("PIP-INFEASIBLE", "no thinner cut is within the limits");
  out.question = q;
  out.answer = *std::move(answer);
  return {};
}

/// A given depth at which no feed keeps the limits is cut in thinner levels; said, never silent.
Status lower_depth(const model::Model& m, const StepDraft& step, PathWithCut& out, const Means& means) {
  auto q = out.question;
  q.ap_most_mm = *q.ap_mm;
  q.ap_mm.reset();
  auto answer = means.cuts.answer(q);
  if (!answer) return tl::unexpected(answer.error());
  if (!answer->feasible) return {};
  means.job.warn("PIP-CHANGED", "step '" + draft::name_of(m, step) + "': levels of " +
                                    trimmed(answer->ap_mm, 3) + " mm instead of the stated " +
                                    trimmed(q.ap_most_mm, 3) +
                                    " mm, which break a limit: " + out.answer.violated.front());
  out.question = q;
  out.answer = *std::move(answer);
  out.depth_open = true;
  return {};
}

/// A path or why there is none, with what was said of it.
struct Generated {
  toolpath::GeneratedPath path;
  std::optional<Diagnostic> why_not;
  std::vector<Diagnostic> said;
};

/// toolpath::generate, asked once for each job.
Result<toolpath::GeneratedPath> generated(const toolpath::PathJob& task, const Means& means) {
  if (means.memo == nullptr) return toolpath::generate(task, means.job);
  const auto make = [&]() -> Result<Generated> {
    Generated out;
    const EarlierDiagnostics before(means.job);
    auto path = toolpath::generate(task, means.job);
    out.said = means.job.take_diagnostics();
    if (path) {
      out.path = *std::move(path);
    } else {
      out.why_not = path.error();
    }
    return out;
  };
  const auto whole = [&](const Generated& g) {
    const toolpath::GeneratedPath& p = g.path;
    return !means.job.stop_requested() && model::columns_agree(p.path) &&
           model::of_one_length(p.path, p.feed_factor, p.speed_factor, p.dwell_s);
  };
  auto known = memo::remembered<Generated>(means.memo, memo::Stage::kPath,
                                           memo::key_of(memo::Stage::kPath, task), make, whole);
  for (auto& d : known->said) means.job.report(std::move(d));
  if (known->why_not) return tl::unexpected(*std::move(known->why_not));
  return std::move(known->path);
}

/// Feeds along a path, with what belongs to its moves as they are split for them.
struct Scheduled {
  optimise::FeedAnswer feeds;
  std::vector<optimise::PieceEnd> pieces;  ///< of a path that was split
  model::SectionSeries sections;
  std::vector<optimise::CutSample> samples;
  std::vector<double> feed_factor, speed_factor, dwell_s;
};

/// Whether it can be one of this path.
bool sound(const Scheduled& s, const model::CutterPath& path, bool split) {
  const model::FeedSchedule& f = s.feeds.schedule;
  const std::size_t moves = split ? s.pieces.size() : path.size();
  return f.feed_mm_min.size() == moves && f.spindle_rpm.size() == moves && f.dwell_s.size() == moves &&
         model::columns_agree(s.sections) &&
         (split ? are_pieces_of(s.pieces, path.size()) : s.pieces.empty()) &&
         std::all_of(s.samples.begin(), s.samples.end(),
                     [&](const optimise::CutSample& one) { return one.move < moves; });
}

/// A place that was found in a path's own frame is told to 1e-9 mm: that frame's grid is hardly finer, and
/// adding its origin leaves the noise of a sum in the digits below.
constexpr double kPlaceStepsPerMm = 1e9;
double told(double mm) { return std::round(mm * kPlaceStepsPerMm) / kPlaceStepsPerMm; }

/// A path in its own frame. What feeds are asked of is taken from it, so that equal paths at other places ask
/// the same and have one answer.
struct OwnPath {
  geometry::Vec2 origin;
  model::CutterPath path;
};
OwnPath own_path(const model::CutterPath& path) {
  const geometry::Vec2 origin = model::own_origin(path);
  return {origin, model::in_own_frame(path, origin)};
}

/// Splits the moves by their sections, where there are some, and schedules the feeds of all.
void schedule(MeasuredCut& cut, model::SectionSeries* sections, OwnPath own, const Means& means) {
  optimise::FeedQuestion& asked = cut.asked;
  const auto key =
      means.memo != nullptr ? memo::key_of(memo::Stage::kFeeds, asked, own.path, sections) : memo::Key{};
  auto answer = memo::remembered<Scheduled>(
      means.memo, memo::Stage::kFeeds, key,
      [&]() -> Result<Scheduled> {
        Scheduled out;
        if (sections != nullptr)
          out.pieces = optimise::split_moves(asked, own.path, sections, &means.cuts.known_feeds());
        out.feeds = optimise::feeds(asked, own.path, &means.cuts.known_feeds());
        out.samples = asked.samples;
        out.feed_factor = asked.feed_factor;
        out.speed_factor = asked.speed_factor;
        out.dwell_s = asked.dwell_s;
        if (sections != nullptr) out.sections = *sections;
        return out;
      },
      [&](const Scheduled& s) { return sound(s, *cut.path, sections != nullptr); });
  Scheduled known = *std::move(answer);
  cut.feeds = std::move(known.feeds);
  if (auto& at = cut.feeds.worst.at_mm) {
    at->x = told(at->x + own.origin.x);
    at->y = told(at->y + own.origin.y);
    at->z = told(at->z);
  }
  if (sections != nullptr) {
    *cut.path = optimise::in_pieces(*cut.path, known.pieces);
    *sections = std::move(known.sections);
  }
  asked.samples = std::move(known.samples);
  asked.feed_factor = std::move(known.feed_factor);
  asked.speed_factor = std::move(known.speed_factor);
  asked.dwell_s = std::move(known.dwell_s);
}

/// Of a thread mill whose ring stands under what its way in leaves: nothing, and a note that a bound judges
/// it.
std::optional<engagement::Measurement> measured_thread(const model::Model& m, const StepDraft& step,
                                                       const model::CutterPath& path, const Means& means) {
  auto out = means.stocks.measure(step.setup, path, step.cutter);
  if (out) return *std::move(out);
  if (out.error().code != "ENG-UNDERCUT") return measured(m, step, path, means.stocks, means.job);
  const ThreadBound bound = thread_bound(step.cutter, step.shapes.front());
  means.job.note("PIP-BOUND", "step '" + draft::name_of(m, step) +
                                  "': its cut under an overhang is not measured but bounded, by " +
                                  trimmed(bound.ap_mm, 3) + " mm of depth and " + trimmed(bound.ae_mm, 3) +
                                  " mm of width all along the thread; forces, power and bending are of that");
  return std::nullopt;
}

}  // namespace

Result<PathWithCut> path_with_cut(const PlanSoFar& p, const StepDraft& step,
                                  const model::Candidate* candidate, double share, const Means& means) {
  const model::Model& m = p.plan.model;
  PathWithCut out;
  bool first = true;
  std::optional<toolpath::GeneratedPath> over_surface;  // of the shape at hand
  const bool freeform = m.holds<model::FreeformOperation>(step.operation);
  const auto make_path = [&](const toolpath::PathJob& j) {
    return freeform ? freeform_path(p, step, j, out.answer, means.stocks.of(step.setup), means.job)
                    : generated(j, means);
  };
  for (const auto& shape : step.shapes) {
    auto job = job_of(p, step, shape);
    means.progress.prepare(step, means.stocks.of(step.setup), job);
    if (first) {
      out.question = question_of(p, step, candidate, job);
      if (step.open_technology && finishes_in_passes(m, step, shape)) {
        auto path = pass_over(p, step, job, means.stocks, out.question, make_path);
        if (!path) return tl::unexpected(path.error());
        over_surface = *std::move(path);
      }
      if (step.open_technology) out.cases = start_from_cases(p, step, shape, out.question);
      auto answer = means.cuts.answer(step, out.question, out.let_go);
      if (!answer) return tl::unexpected(answer.error());
      out.answer = *std::move(answer);
      if (step.open_technology && m.holds<model::PlaneMilling>(step.operation))
        out.answer = means.cuts.in_one_pass(out.question, std::move(out.answer));
      out.depth_open = !out.question.ap_mm.has_value();
      // A finishing pass takes what is left on the wall; across a floor it steps as its path chooses.
      out.width_open = !out.question.ae_mm.has_value() && out.question.kind == optimise::CutKind::kRough;
      if (step.open_technology && !out.answer.feasible && out.question.ap_mm && !step.proposed) {
        if (auto ok = lower_depth(m, step, out, means); !ok) return tl::unexpected(ok.error());
      }
      if (step.open_technology && !out.answer.feasible) {
        std::string limits;
        for (const auto& v : out.answer.violated) limits += (limits.empty() ? "" : ", ") + v;
        return fail("PIP-INFEASIBLE",
                    "no cut is within the limits: " + limits + "; use another tool or machine");
      }
      if (share < 1.0) {
        if (auto ok = make_thinner(out, share, means.cuts); !ok) return tl::unexpected(ok.error());
      }
    }
    if (out.depth_open) job.axial_depth_mm = out.answer.ap_mm;
    if (out.width_open && out.answer.ae_mm > 0.0) job.radial_depth_mm = out.answer.ae_mm;
    if (out.question.ae_mm) job.radial_depth_mm = *out.question.ae_mm;
    if (out.width_open && out.depth_open) {
      if (const auto why =
              surely_longer_than_a_shift(step, job, out.question, out.answer, means.stocks.of(step.setup)))
        return fail("PIP-SHIFT", *why);
    }
    if (cuts_under_overhang(step.cutter)) {
      // A stated feed is lowered where that holds the limits, and otherwise by the teeth that cut.
      auto loads = hold_under_overhang(out.question, out.answer,
                                       bending_of_last_pass_mm(p, step, job, out.question), job);
      if (!loads && step.open_technology) return tl::unexpected(loads.error());
      if (loads) out.under = *loads;
    }
    auto path = over_surface ? Result<toolpath::GeneratedPath>(*std::move(over_surface))
                             : workholding::kept_clear(p.setups[step.setup], step.cutter, job, make_path);
    over_surface.reset();
    if (!path) return tl::unexpected(path.error());
    if (first) {
      out.path = *std::move(path);
    } else {
      append(out.path, *path);
    }
    first = false;
  }
  return out;
}

std::optional<ConstantCut> constant_cut(const PlanSoFar& p, StepDraft step, const model::Candidate* candidate,
                                        const Means& means) {
  if (step.shapes.empty()) return std::nullopt;
  step.constant_engagement = true;
  auto job = job_of(p, step, step.shapes.front());
  means.progress.prepare(step, means.stocks.of(step.setup), job);
  auto q = question_of(p, step, candidate, job);
  const bool walled = model::has(job.shape.kind, model::ShapeTrait::kWalled);
  if (!may_engage_constantly(p, step, job) || !q.constant_engagement || q.slot || q.ap_mm || q.ae_mm)
    return std::nullopt;
  (void)start_from_cases(p, step, step.shapes.front(), q);
  auto answer = means.cuts.answer(q);
  if (!answer || !answer->feasible) return std::nullopt;
  return ConstantCut{std::move(q), *std::move(answer), walled};
}

bool rings_inwards(const PlanSoFar& p, const StepDraft& step, const Means& means) {
  if (step.shapes.empty()) return false;
  auto job = job_of(p, step, step.shapes.front());
  means.progress.prepare(step, means.stocks.of(step.setup), job);
  return may_ring_inwards(p, step, job);
}

MeasuredCut measured_cut(model::Plan& plan, const PlanSoFar& p, const StepDraft& step, PathWithCut made,
                         const Means& means) {
  MeasuredCut out;
  if (!step.open_technology) turn_with_the_cutter(plan, step, means.job);
  const auto given =
      step.open_technology ? GivenTechnology{} : given_technology(plan.model, step.operation, step.cutter);
  const double sense = step.open_technology && step.cutter.hand == model::Hand::kLeft ? -1.0 : 1.0;
  optimise::FeedQuestion& fq = out.asked;
  fq.cut = made.question;
  fq.n_rpm = given.rpm.value_or(sense * made.answer.n_rpm);
  fq.feed_mm_min = given.feed_mm_min.value_or(made.answer.feed_mm_min);
  const bool kept = step.keep_feed && made.let_go.empty();
  fq.adapt = (step.open_technology && !kept) || feed_was_planned(plan, step);
  fq.constant = p.wishes.constant_feeds;
  fq.feed_factor = std::move(made.path.feed_factor);
  fq.speed_factor = std::move(made.path.speed_factor);
  fq.dwell_s = std::move(made.path.dwell_s);
  out.path = std::make_shared<model::CutterPath>(std::move(made.path.path));
  model::StepResult& r = out.result;
  r = result_of(plan.model, step);
  r.axial_depth_mm = made.answer.ap_mm;
  r.radial_depth_mm = made.answer.ae_mm;
  r.active = active_of(made.answer);
  OwnPath own = own_path(*out.path);
  const bool thread = model::mills_threads(step.cutter.cutter_class) && !step.shapes.empty();
  auto m = thread ? measured_thread(plan.model, step, *out.path, means)
                  : measured(plan.model, step, *out.path, means.stocks, means.job);
  if (m) {
    out.removed_mm3 = m->removed_mm3;
    out.rapid_removed_mm3 = m->rapid_removed_mm3;
    fq.samples = samples_of(*m, own.path, step.cutter);
    fq.known_to_mm = m->known_to_mm;
    if (fq.cut.constant_engagement) optimise::enter_as_a_slot(fq, made.answer.ae_mm, own.path);
    const bool own_speed = step.open_technology ? !step.keep_speed : speed_was_planned(plan, step);
    if (own_speed) optimise::slow_in_deep_slots(fq);
    // One pass over a surface, not levels: as deep and as wide as what roughing left there.
    if (fq.cut.as_measured || plan.model.holds<model::FreeformFinishMilling>(step.operation)) {
      for (const optimise::CutSample& sample : fq.samples) {
        if (sample.plunge) continue;
        const double ae = std::min(sample.ae_mm, step.cutter.cutting_diameter_mm);
        r.axial_depth_mm = std::max(r.axial_depth_mm, sample.ap_mm);
        r.radial_depth_mm = std::max(r.radial_depth_mm, ae);
      }
    }
    schedule(out, &m->sections, std::move(own), means);
    engagement::keep_digits(m->sections, m->known_to_mm);
    r.sections = std::make_shared<const model::SectionSeries>(std::move(m->sections));
  } else {
    if (thread) fq.samples = bound_samples(thread_bound(step.cutter, step.shapes.front()), own.path);
    schedule(out, nullptr, std::move(own), means);
  }
  out.made = std::move(made);
  return out;
}

}  // namespace capstan::step
