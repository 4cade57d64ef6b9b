#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/pipeline/grouped.h"
#include "planner/pipeline/holding.h"
#include "planner/pipeline/paths/cuts.h"
#include "planner/pipeline/paths/given_path.h"
#include "planner/pipeline/paths/progress.h"
#include "planner/pipeline/paths/results.h"
#include "planner/pipeline/paths/sections.h"
#include "planner/pipeline/paths/stocks.h"
#include "planner/pipeline/steps.h"

// Step by step in order: depths, path, sections, feeds, with the stock carried on.

namespace capstan::pipeline {
namespace {

using model::Model;

constexpr double kTolerableExcess =
    0.1;  // of a limit, somewhere on a path: sections are known to a cell's width

/// What one try at a step came to.
struct Made {
  toolpath::GeneratedPath path;
  optimise::CutQuestion question;
  optimise::CutAnswer answer;
  bool depth_open = false, width_open = false;
  std::optional<model::Reason> precedent;  ///< the case that speed and feed started from
  std::string let_go;                      ///< of stated speed and feed, and why; empty: nothing
};

void append(toolpath::GeneratedPath& to, const toolpath::GeneratedPath& from) {
  auto& p = to.path;
  const auto& q = from.path;
  for (std::size_t i = 0; i < q.size(); ++i) {
    p.x.push_back(q.x[i]);
    p.y.push_back(q.y[i]);
    p.z.push_back(q.z[i]);
    p.cx.push_back(q.cx[i]);
    p.cy.push_back(q.cy[i]);
    p.kind.push_back(i == 0 ? model::MoveKind::kRapid : q.kind[i]);
    p.role.push_back(i == 0 ? model::MoveRole::kLink : q.role[i]);
    to.feed_factor.push_back(from.feed_factor[i]);
    to.speed_factor.push_back(from.speed_factor[i]);
    to.dwell_s.push_back(from.dwell_s[i]);
  }
}

class PathMaker {
 public:
  explicit PathMaker(Work& w) : w_(w), stocks_(w), progress_(w), cuts_(w) {}

  Status run() {
    std::size_t done = 0;
    for (StepWork& step : w_.steps) {
      w_.job.progress("paths", static_cast<double>(done++) / static_cast<double>(w_.steps.size()));
      if (w_.job.stop_requested())
        return fail("PIP-STOPPED", "planning was stopped before every step had its path");
      if (auto ok = make(step); !ok) return ok;
    }
    return {};
  }

 private:
  Status make(StepWork& step) {
    if (has_given_path(w_, step) && !rigid_tap(step)) return explicit_path(step);
    if (!w_.plan.model.holds<model::MachiningOperation>(step.operation)) return {};
    if (step.shapes.empty()) {
      no_path(w_, step, "the shape of its feature is not known");
      return {};
    }
    if (step.cutter.cutting_diameter_mm <= 0.0) return {};  // no cutter was found; said already
    rank_by_time(step);
    const std::size_t tries = std::max<std::size_t>(1, step.candidates.size());
    GroupedReasons why_not;
    for (std::size_t i = 0; i < tries; ++i) {
      const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
      if (candidate != nullptr) step.cutter = candidate->cutter;
      auto made = attempt(step, candidate);
      if (!made) {
        why_not.add(step.cutter.id, made.error().message);
        step.rejected_tools.push_back({step.cutter.id, made.error().message});
        continue;
      }
      if (i > 0) take_cutter(step, *candidate);
      return finish(step, *std::move(made));
    }
    no_path(w_, step, why_not.text());
    return {};
  }

  /// Roughing: of the cutters that fit, the one that takes the volume away soonest, tool change included.
  void rank_by_time(StepWork& step) {
    if (step.candidates.size() < 2 || step.shapes.empty()) return;
    const Model& m = w_.plan.model;
    if (!m.holds<model::PlaneMilling>(step.operation) && !m.holds<model::SideRoughMilling>(step.operation) &&
        !m.holds<model::BottomAndSideRoughMilling>(step.operation)) {
      return;
    }
    const std::string first = step.candidates.front().cutter.id;
    constexpr std::size_t kCompared = 5;
    const std::size_t n = std::min(kCompared, step.candidates.size());
    std::vector<std::pair<double, std::size_t>> times;
    for (std::size_t i = 0; i < n; ++i) {
      StepWork trial = step;
      trial.cutter = step.candidates[i].cutter;
      auto job = job_of(w_, trial, step.shapes.front());
      progress_.prepare(trial, stocks_.of(trial.setup), job);
      const auto q = question_of(w_, trial, &step.candidates[i], job);
      const auto a = cuts_.answer(q);
      double t = 1e12 * static_cast<double>(i + 1);
      if (a && a->feasible) {
        const double volume = geometry::area(job.shape.area) * q.depth_mm;
        t = volume / (a->ap_mm * a->ae_mm * a->feed_mm_min) * 60.0;
        const bool used = std::find(w_.used_cutters.begin(), w_.used_cutters.end(), trial.cutter.id) !=
                          w_.used_cutters.end();
        if (!used) t += w_.plan.machine.tool_change_s;
      }
      times.emplace_back(t, i);
    }
    const double of_first = times.front().first;
    std::stable_sort(times.begin(), times.end());
    std::vector<model::Candidate> sorted;
    for (const auto& [t, i] : times) sorted.push_back(step.candidates[i]);
    for (std::size_t i = n; i < step.candidates.size(); ++i) sorted.push_back(step.candidates[i]);
    step.candidates = std::move(sorted);
    if (step.candidates.front().cutter.id == first) return;
    step.cutter = step.candidates.front().cutter;
    step.rejected_tools.push_back(
        {first,
         "fits, but takes " +
             (of_first < 1e11 ? trimmed(of_first, 1) + " s" : std::string("too long, or breaks a limit,")) +
             " against " + trimmed(times.front().first, 1) + " s of " + step.cutter.id});
    take_cutter(step, step.candidates.front());
  }

  /// A cutter further down the list does what the first could not.
  void take_cutter(StepWork& step, const model::Candidate& c) {
    std::erase_if(step.rejected_tools, [&](const auto& r) { return r.what == c.cutter.id; });
    w_.plan.model.get<model::MachiningOperation>(step.operation)->its_tool = tool_noun(w_, c.cutter);
    w_.plan.ledger.bind(step.operation, "its_tool", model::Binder::kToolSelection, c.why,
                        {{step.step, "its_operation"}}, step.rejected_tools);
  }

  Result<Made> attempt(const StepWork& step, const model::Candidate* candidate) {
    Made out;
    bool first = true;
    for (const auto& shape : step.shapes) {
      auto job = job_of(w_, step, shape);
      progress_.prepare(step, stocks_.of(step.setup), job);
      if (first) {
        out.question = question_of(w_, step, candidate, job);
        if (step.open_technology) out.precedent = start_from_case(w_, step, shape, out.question);
        auto answer = cuts_.answer(step, out.question, out.let_go);
        if (!answer) return tl::unexpected(answer.error());
        out.answer = *std::move(answer);
        out.depth_open = !out.question.ap_mm.has_value();
        // A finishing pass takes what is left on the wall; across a floor it steps as its path chooses.
        out.width_open = !out.question.ae_mm.has_value() && out.question.kind == optimise::CutKind::kRough;
        if (step.open_technology && !out.answer.feasible && out.question.ap_mm && !step.proposed) {
          if (auto ok = lower_depth(step, out); !ok) return tl::unexpected(ok.error());
        }
        if (step.open_technology && !out.answer.feasible) {
          std::string limits;
          for (const auto& v : out.answer.violated) limits += (limits.empty() ? "" : ", ") + v;
          return fail("PIP-INFEASIBLE", "no cut keeps every limit: " + limits);
        }
      }
      if (out.depth_open) job.axial_depth_mm = out.answer.ap_mm;
      if (out.width_open && out.answer.ae_mm > 0.0) job.radial_depth_mm = out.answer.ae_mm;
      if (out.question.ae_mm) job.radial_depth_mm = *out.question.ae_mm;
      const bool freeform = w_.plan.model.holds<model::FreeformOperation>(step.operation);
      auto path = kept_clear(w_, step, job, [&](const toolpath::PathJob& j) {
        return freeform ? freeform_path(w_, step, j, out.answer, stocks_.of(step.setup))
                        : toolpath::generate(j, w_.job);
      });
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

  /// A given depth at which no feed keeps the limits is cut in thinner levels; said, never silent.
  Status lower_depth(const StepWork& step, Made& out) {
    auto q = out.question;
    q.ap_most_mm = *q.ap_mm;
    q.ap_mm.reset();
    auto answer = cuts_.answer(q);
    if (!answer) return tl::unexpected(answer.error());
    if (!answer->feasible) return {};
    w_.job.warn("PIP-CHANGED", "step '" + name_of(w_, step) + "': the given depth of " +
                                   trimmed(q.ap_most_mm, 3) + " mm per level breaks " +
                                   out.answer.violated.front() + "; cut " + trimmed(answer->ap_mm, 3) +
                                   " mm deep instead");
    out.question = q;
    out.answer = *std::move(answer);
    out.depth_open = true;
    return {};
  }

  Status finish(StepWork& step, Made made) {
    let_go(w_, step, made.let_go);
    turn_with_the_cutter(w_, step);
    record_cut(w_, step, made.answer, made.depth_open, made.width_open, made.precedent);
    progress_.done(step);
    const auto given = given_technology(w_.plan.model, step.operation, step.cutter);
    optimise::FeedQuestion fq;
    fq.cut = made.question;
    fq.n_rpm = given.rpm.value_or(made.answer.n_rpm);
    fq.feed_mm_min = given.feed_mm_min.value_or(made.answer.feed_mm_min);
    fq.adapt = step.open_technology || feed_was_planned(step);
    fq.constant = w_.inputs.constant_feeds;
    fq.feed_factor = std::move(made.path.feed_factor);
    fq.speed_factor = std::move(made.path.speed_factor);
    fq.dwell_s = std::move(made.path.dwell_s);
    auto path = std::make_shared<model::CutterPath>(std::move(made.path.path));
    model::StepResult r = result_of(w_, step);
    r.axial_depth_mm = made.answer.ap_mm;
    r.radial_depth_mm = made.answer.ae_mm;
    r.active = active_of(made.answer);
    if (auto m = measured(w_, step, *path, stocks_)) {
      fq.samples = samples_of(*m);
      // One pass over a surface, not levels: as deep and as wide as what roughing left there.
      if (w_.plan.model.holds<model::FreeformFinishMilling>(step.operation)) {
        for (const optimise::CutSample& sample : fq.samples) {
          if (sample.plunge) continue;
          const double ae = std::min(sample.ae_mm, step.cutter.cutting_diameter_mm);
          r.axial_depth_mm = std::max(r.axial_depth_mm, sample.ap_mm);
          r.radial_depth_mm = std::max(r.radial_depth_mm, ae);
        }
      }
      optimise::split_moves(fq, *path, &m->sections);
      r.sections = std::make_shared<const model::SectionSeries>(std::move(m->sections));
    }
    const auto feeds = optimise::feeds(fq, *path);
    if (step.open_technology && feeds.worst_excess > kTolerableExcess) {
      w_.job.warn("PIP-EXCESS",
                  "step '" + name_of(w_, step) + "': somewhere along the path a limit is exceeded by " +
                      (std::isfinite(feeds.worst_excess) ? trimmed(100.0 * feeds.worst_excess, 1) + " %"
                                                         : std::string("what no formula tells")) +
                      " even at the least feed");
    }
    r.schedule = std::make_shared<const model::FeedSchedule>(feeds.schedule);
    r.loads = feeds.peak;
    if (!(r.loads.tool_life_min > 0.0)) r.loads.tool_life_min = made.answer.life_min;
    r.held_by = feeds.held_by;
    r.path = path;
    const Deviation deviation = deviation_of(w_, step, job_of(w_, step, step.shapes.front()));
    r.path_deviation_mm = r.contour_tolerance_mm = deviation.mm;
    record_path(w_, step, path, deviation.why);
    keep(w_, step, std::move(r), fq);
    return {};
  }

  /// Whether the feed is one that planning bound before: then it is the most, and each move has its own.
  bool feed_was_planned(const StepWork& step) const {
    const auto* op = w_.plan.model.get<model::MachiningOperation>(step.operation);
    if (op == nullptr || !op->its_technology.set()) return false;
    const auto* d = w_.plan.ledger.find(op->its_technology, "feedrate");
    return d != nullptr && !d->pinned && d->binder != model::Binder::kGiven &&
           d->binder != model::Binder::kOperator;
  }

  // A given path is moves at feed; without a compensation chuck that breaks the tap, so the thread is planned
  // as a synchronised cycle.
  bool rigid_tap(const StepWork& step) {
    const auto* tapping = w_.plan.model.get<model::Tapping>(step.operation);
    if (tapping == nullptr || tapping->compensation_chuck.value_or(false)) return false;
    w_.job.warn("PIP-CHANGED",
                "step '" + name_of(w_, step) +
                    "': the given toolpath of the tap is moves without synchronisation; planned as rigid "
                    "tapping instead");
    return true;
  }

  /// A path that the file brings is cut as it is; its feed may be open.
  Status explicit_path(StepWork& step) {
    turn_with_the_cutter(w_, step);
    auto made = given_path(w_, step, stocks_, progress_, cuts_);
    if (!made) {
      no_path(w_, step, made.error().message);
    } else if (*made) {
      keep(w_, step, std::move((*made)->result), (*made)->feeds);
    }
    return {};
  }

  Work& w_;
  Stocks stocks_;
  Progress progress_;
  Cuts cuts_;
};

}  // namespace

Status make_paths(Work& w) { return PathMaker(w).run(); }

}  // namespace capstan::pipeline
