#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/paths/cuts.h"
#include "planner/door/pipeline/paths/given_path.h"
#include "planner/door/pipeline/paths/gone.h"
#include "planner/door/pipeline/paths/progress.h"
#include "planner/door/pipeline/paths/ranking.h"
#include "planner/door/pipeline/paths/results.h"
#include "planner/door/pipeline/paths/stocks.h"
#include "planner/door/pipeline/paths/surface.h"
#include "planner/door/pipeline/propose/grouped_reasons.h"
#include "planner/door/pipeline/step/steps.h"
#include "planner/door/pipeline/workholding/holding.h"
#include "planner/ground/base/number.h"
#include "planner/making/piece/rests.h"
#include "planner/making/step/cut_samples.h"
#include "planner/making/toolpath/region/form/undercut.h"
#include "planner/model/plan/decision/condemned.h"
#include "tooling/selection/select.h"

// Step by step in order: depths, path, sections, feeds, with the stock carried on.

namespace capstan::pipeline {
namespace {

using model::Model;

/// What one try at a step came to.
struct Made {
  toolpath::GeneratedPath path;
  optimise::CutQuestion question;
  optimise::CutAnswer answer;
  bool depth_open = false, width_open = false;
  std::optional<model::Reason> precedent;  ///< the case that speed and feed started from
  std::string let_go;                      ///< of stated speed and feed, and why; empty: nothing
  std::optional<model::StepLoads> under;   ///< of the middle pass under an overhang, which is not measured
  std::vector<model::Rejected> thicker;    ///< depths or widths that exceeded a limit along the path
};

/// The same, measured against the stock, with its feeds.
struct Tried {
  Made made;
  std::shared_ptr<model::CutterPath> path;
  model::StepResult result;
  optimise::FeedQuestion asked;
  optimise::FeedAnswer feeds;
  std::optional<double> removed_mm3;  ///< unset where nothing was measured
  double rapid_removed_mm3 = 0.0;
};

/// draft::Thinner cuts that are tried with one cutter where a limit is exceeded along its path.
constexpr int kMostThinner = 3;
/// A thinner cut aims below the limit by this, for sections along the path are not proportional to it.
constexpr double kThinnerAim = 0.9;      // default, unsourced
constexpr double kThinnerUnknown = 0.5;  // where no formula tells the excess; default, unsourced
constexpr double kThinnerAnew = 0.7;     // each time that the check condemned the cut; default, unsourced
constexpr double kThinnest = 0.02;       // of the cut that keeps the limits off the path; default, unsourced

class PathMaker {
 public:
  explicit PathMaker(Work& w) : w_(w), stocks_(w), progress_(w), cuts_(w) {}

  Status run() {
    std::size_t done = 0;
    for (StepDraft& step : w_.steps) {
      w_.job.progress("paths", static_cast<double>(done++) / static_cast<double>(w_.steps.size()));
      if (w_.job.stop_requested())
        return fail("PIP-STOPPED", "planning was stopped before every step had its path");
      if (given_up(step)) continue;
      if (auto ok = make(step); !ok) return ok;
    }
    w_.again = w_.again || stocks_.other_cells_asked_for(w_.tries);
    return {};
  }

 private:
  /// Whether what this step needs has failed: then it is not made either. A proposed one waits for the next
  /// try at its feature; of one of the file the reason is said.
  bool given_up(const StepDraft& step) {
    if (step.proposed) return failed_.contains(step.feature) || resting_.contains(step.feature);
    if (lost_.empty() || !w_.plan.model.holds<model::MachiningOperation>(step.operation)) return false;
    // A path that the file brings is kept; that of a tap is never cut as moves.
    if (has_given_path(w_, step) && !w_.plan.model.holds<model::Tapping>(step.operation)) return false;
    const std::string* lost = nullptr;
    for (const Member& m : members(step)) {
      if (const auto at = lost_.find(m); at != lost_.end()) lost = &at->second;
    }
    if (lost == nullptr && !resting_.contains(step.feature)) return false;
    no_path(w_, step,
            lost != nullptr ? "it needs step '" + *lost + "' before it, which has no path"
                            : "it needs " + needed_by(step) + " before it, which is not planned");
    lose(step);
    return true;
  }

  /// The features that this step's rests on and that failed, by name.
  std::string needed_by(const StepDraft& step) const {
    const auto all = piece::what_rests(w_.plan.model, w_.setups);
    std::string out;
    for (const AnyRef f : failed_) {
      if (!piece::resting_on(all, {f}).contains(step.feature)) continue;
      const auto* named = w_.plan.model.get<model::ManufacturingFeature>(f);
      out += (out.empty() ? "'" : ", '") + (named == nullptr ? "" : named->its_id.value_or("")) + "'";
    }
    return out;
  }

  static std::vector<Member> members(const StepDraft& step) {
    std::vector<Member> out;
    for (const auto& s : step.shapes) out.push_back({step.feature, s.feature, s.member});
    if (out.empty()) out.push_back({step.feature, {}, 0});
    return out;
  }

  /// What this step of the file would have left is not there for those after it.
  void lose(const StepDraft& step) {
    if (!step.feature.set() || !leaves_what_others_need(step)) return;
    for (const Member& m : members(step)) lost_.emplace(m, draft::name_of(w_.plan.model, step));
    failed_.insert(step.feature);
    resting_ = piece::resting_on(piece::what_rests(w_.plan.model, w_.setups), failed_);
  }

  /// A step that cannot be made. If rules proposed it, its chain is given up, and with it for now what rests
  /// on its feature; the plan is made again with the next chain. A step of the file is reported.
  void give_up(const StepDraft& step, const std::string& why) {
    if (!step.proposed) {
      no_path(w_, step, why);
      lose(step);
      return;
    }
    const std::string text = "step '" + draft::name_of(w_.plan.model, step) + "' has no path: " + why;
    w_.tries.bans.ban_chain(step.member, step.chain, text);
    w_.tries.said.push_back(text + "; its feature is planned anew");
    w_.again = true;
    failed_.insert(step.feature);
    resting_ = piece::resting_on(piece::what_rests(w_.plan.model, w_.setups), failed_);
  }

  /// A mark for the drill, a finished wall or a broken edge is missed by no other step of its feature.
  bool leaves_what_others_need(const StepDraft& step) const {
    const Model& m = w_.plan.model;
    return !m.holds<model::CenterDrilling>(step.operation) &&
           !m.holds<model::CounterSinking>(step.operation) &&
           !model::has(step.operation.type, model::OperationTrait::kFinishes) &&
           !m.holds<model::Tapping>(step.operation);
  }

  Status make(StepDraft& step) {
    stocks_.keep(step.setup);
    if (!step.unreadable.empty()) {
      give_up(step, step.unreadable);
      return {};
    }
    if (has_given_path(w_, step) && !rigid_tap(w_, step)) return explicit_path(step);
    if (!w_.plan.model.holds<model::MachiningOperation>(step.operation)) return {};
    if (step.shapes.empty()) {
      give_up(step,
              "the shape of its feature is not known" + (step.no_shape.empty() ? "" : ": " + step.no_shape));
      return {};
    }
    if (step.cutter.cutting_diameter_mm <= 0.0) {  // no cutter was found; said already
      lose(step);
      return {};
    }
    if (step.open_technology && step.candidates.empty()) {  // a tool of the file, which nobody chose for it
      const auto start = tooling::start_values(step.cutter, w_.plan.material, w_.plan.machine);
      if (const auto why = tooling::not_cut_with(step.cutter, start, w_.plan.material)) {
        give_up(step, "tool " + step.cutter.id + ": " + *why);
        return {};
      }
    }
    rank_by_time(w_, step, stocks_, progress_, cuts_);
    rank_by_path(w_, step, [&](std::size_t i) { return seconds_with(step, i); });
    const std::size_t tries = std::max<std::size_t>(1, step.candidates.size());
    GroupedReasons why_not;
    bool gone = step.proposed;                            // whichever cutter: nothing stands there to be cut
    std::optional<std::pair<std::size_t, double>> least;  // of those that exceed a limit: which, by how much
    for (std::size_t i = 0; i < tries; ++i) {
      const auto before = stocks_.before(step.setup);
      auto tried = with_cutter(step, i);
      if (tried && !exceeds(step, *tried)) return accept(step, *std::move(tried), i);
      gone = gone && !tried && tried.error().code == toolpath::kNothingToCut;
      const std::string why = tried ? excess_text(*tried) : tried.error().message;
      if (tried) {
        if (!least || tried->feeds.worst_excess < least->second) least = {i, tried->feeds.worst_excess};
        stocks_.put_back(step.setup, before);
      }
      why_not.add(step.cutter.id, why);
      step.rejected_tools.push_back({step.cutter.id, why});
    }
    // What the file asks for is cut as gently as it can be; the plan then says which limit is exceeded.
    if (least && !step.proposed) {
      auto tried = with_cutter(step, least->first);
      if (tried) return accept(step, *std::move(tried), least->first);
    }
    if (gone && leave_out(w_, step, why_not.text())) return {};
    give_up(step,
            why_not.text() + (least ? "; a smaller or shorter cutter or a stronger spindle would do" : ""));
    return {};
  }

  [[nodiscard]] static bool exceeds(const StepDraft& step, const Tried& t) {
    return step.open_technology && t.feeds.worst_excess > kTolerableExcess;
  }

  static std::string excess_text(const Tried& t) {
    const std::string thinner = t.made.thicker.empty()
                                    ? std::string()
                                    : ", also where it cuts " + trimmed(t.made.answer.ap_mm, 3) + " mm deep";
    return model::text_of(t.feeds.worst) + ", even at the least feed" + thinner;
  }

  /// How long a candidate's path takes, if it keeps the limits; nothing is kept or said of it.
  std::optional<double> seconds_with(StepDraft& step, std::size_t i) {
    auto said = w_.job.take_diagnostics();
    const auto before = stocks_.before(step.setup);
    const model::Cutter cutter = step.cutter;
    const auto tried = with_cutter(step, i);
    step.cutter = cutter;
    stocks_.put_back(step.setup, before);
    (void)w_.job.take_diagnostics();
    for (auto& d : said) w_.job.report(std::move(d));
    if (!tried || exceeds(step, *tried)) return std::nullopt;
    return seconds_of(w_, *tried->path, tried->feeds.schedule);
  }

  /// A try with one of the candidates: thinner, where a limit is exceeded along its path, up to kMostThinner
  /// times; the gentlest when none keeps the limits. What it cuts is gone from the stock, but for a proposed
  /// step's that keeps no limits.
  Result<Tried> with_cutter(StepDraft& step, std::size_t i) {
    const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
    if (candidate != nullptr) step.cutter = candidate->cutter;
    const auto before = stocks_.before(step.setup);
    std::vector<model::Rejected> thicker;
    std::optional<double> gentlest;  // share of the first try
    std::optional<Tried> came_of_it;
    std::vector<Diagnostic> said_of_it;
    double of_gentlest = 0.0, share = 1.0;
    if (const draft::Thinner* t =
            step.proposed ? w_.tries.bans.thinner(step.member, step.chain, step.in_chain) : nullptr) {
      share = std::pow(kThinnerAnew, t->times);
      thicker.push_back({"a cut " + trimmed(1.0 / share, 2) + " times as large", t->why});
    }
    for (int round = 0; round <= kMostThinner; ++round) {
      auto said = w_.job.take_diagnostics();  // before this try; what a try says that is not kept is not told
      const auto told = [&](bool kept) {
        auto now = w_.job.take_diagnostics();
        for (auto& d : said) w_.job.report(std::move(d));
        if (!kept) return now;
        for (auto& d : now) w_.job.report(std::move(d));
        now.clear();
        return now;
      };
      auto made = attempt(step, candidate, share);
      if (!made) told(!gentlest);
      if (!made && !gentlest) return tl::unexpected(made.error());
      if (!made) break;
      // A pass over a surface is as deep as what was left there, whatever was asked for.
      const bool thinner = (made->depth_open || made->width_open) &&
                           (!w_.plan.model.holds<model::FreeformFinishMilling>(step.operation) ||
                            draft::cuts_levels(w_.plan.model, step));
      made->thicker = thicker;
      Tried tried = cut(step, *std::move(made));
      const double excess = tried.feeds.worst_excess;
      const bool kept = !exceeds(step, tried) || !thinner;
      auto unsaid = told(kept);
      if (kept) return tried;
      thicker.push_back({sizes(tried.made.answer), excess_text(tried)});
      if (!gentlest || excess < of_gentlest) {
        gentlest = share;
        of_gentlest = excess;
        came_of_it = std::move(tried);
        said_of_it = std::move(unsaid);
      }
      stocks_.put_back(step.setup, before);
      share *= std::isfinite(excess) ? kThinnerAim / (1.0 + excess) : kThinnerUnknown;
      if (share < kThinnest) break;
    }
    if (step.proposed) {  // exceeds a limit and is not taken: nothing is cut, what is known of it will do
      came_of_it->made.thicker = std::move(thicker);
      for (auto& d : said_of_it) w_.job.report(std::move(d));
      return *std::move(came_of_it);
    }
    auto made = attempt(step, candidate, *gentlest);
    if (!made) return tl::unexpected(made.error());
    made->thicker = std::move(thicker);
    return cut(step, *std::move(made));
  }

  static std::string sizes(const optimise::CutAnswer& a) {
    return trimmed(a.ap_mm, 3) + " mm deep, " + trimmed(a.ae_mm, 3) + " mm wide";
  }

  Result<Made> attempt(const StepDraft& step, const model::Candidate* candidate, double share) {
    Made out;
    bool first = true;
    std::optional<toolpath::GeneratedPath> over_surface;  // of the shape at hand
    const bool freeform = w_.plan.model.holds<model::FreeformOperation>(step.operation);
    const bool passes = w_.plan.model.holds<model::FreeformFinishMilling>(step.operation) &&
                        !draft::cuts_levels(w_.plan.model, step);
    for (const auto& shape : step.shapes) {
      auto job = job_of(w_, step, shape);
      progress_.prepare(step, stocks_.of(step.setup), job);
      if (first) {
        out.question = question_of(w_, step, candidate, job);
        if (passes && step.open_technology) {
          auto path = pass_over(w_, step, job, stocks_, out.question);
          if (!path) return tl::unexpected(path.error());
          over_surface = *std::move(path);
        }
        if (step.open_technology) out.precedent = start_from_case(w_, step, shape, out.question);
        auto answer = cuts_.answer(step, out.question, out.let_go);
        if (!answer) return tl::unexpected(answer.error());
        out.answer = *std::move(answer);
        if (step.open_technology && w_.plan.model.holds<model::PlaneMilling>(step.operation))
          out.answer = cuts_.in_one_pass(out.question, std::move(out.answer));
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
        if (share < 1.0) {
          if (auto ok = make_thinner(out, share); !ok) return tl::unexpected(ok.error());
        }
      }
      if (out.depth_open) job.axial_depth_mm = out.answer.ap_mm;
      if (out.width_open && out.answer.ae_mm > 0.0) job.radial_depth_mm = out.answer.ae_mm;
      if (out.question.ae_mm) job.radial_depth_mm = *out.question.ae_mm;
      if (model::has(step.cutter.cutter_class, model::CutterTrait::kSlotForm)) {
        // A stated feed is lowered where that holds the limits, and otherwise by the teeth that cut.
        auto loads = hold_under_overhang(out.question, out.answer, job);
        if (!loads && step.open_technology) return tl::unexpected(loads.error());
        if (loads) out.under = *loads;
      }
      auto path = over_surface ? Result<toolpath::GeneratedPath>(*std::move(over_surface))
                               : kept_clear(w_, step, job, [&](const toolpath::PathJob& j) {
                                   return freeform
                                              ? freeform_path(w_, step, j, out.answer, stocks_.of(step.setup))
                                              : toolpath::generate(j, w_.job);
                                 });
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

  /// The cut again at a share of its depth, or of its width where the depth is not open.
  Status make_thinner(Made& out, double share) {
    auto q = out.question;
    if (out.depth_open) {
      q.ap_most_mm = share * out.answer.ap_mm;
    } else {
      q.ae_mm = share * out.answer.ae_mm;
    }
    auto answer = cuts_.answer(q);
    if (!answer) return tl::unexpected(answer.error());
    if (!answer->feasible) return fail("PIP-INFEASIBLE", "no thinner cut keeps every limit");
    out.question = q;
    out.answer = *std::move(answer);
    return {};
  }

  /// A given depth at which no feed keeps the limits is cut in thinner levels; said, never silent.
  Status lower_depth(const StepDraft& step, Made& out) {
    auto q = out.question;
    q.ap_most_mm = *q.ap_mm;
    q.ap_mm.reset();
    auto answer = cuts_.answer(q);
    if (!answer) return tl::unexpected(answer.error());
    if (!answer->feasible) return {};
    w_.job.warn("PIP-CHANGED", "step '" + draft::name_of(w_.plan.model, step) + "': the given depth of " +
                                   trimmed(q.ap_most_mm, 3) + " mm per level breaks " +
                                   out.answer.violated.front() + "; cut " + trimmed(answer->ap_mm, 3) +
                                   " mm deep instead");
    out.question = q;
    out.answer = *std::move(answer);
    out.depth_open = true;
    return {};
  }

  /// Measures a try against the stock, which is cut by it, and schedules its feeds.
  Tried cut(const StepDraft& step, Made made) {
    Tried out;
    if (!step.open_technology) turn_with_the_cutter(w_, step);
    const auto given = step.open_technology ? GivenTechnology{}
                                            : given_technology(w_.plan.model, step.operation, step.cutter);
    const double sense = step.open_technology && step.cutter.hand == model::Hand::kLeft ? -1.0 : 1.0;
    optimise::FeedQuestion& fq = out.asked;
    fq.cut = made.question;
    fq.n_rpm = given.rpm.value_or(sense * made.answer.n_rpm);
    fq.feed_mm_min = given.feed_mm_min.value_or(made.answer.feed_mm_min);
    const bool kept = step.keep_feed && made.let_go.empty();
    fq.adapt = (step.open_technology && !kept) || feed_was_planned(w_, step);
    fq.constant = w_.inputs.constant_feeds;
    fq.feed_factor = std::move(made.path.feed_factor);
    fq.speed_factor = std::move(made.path.speed_factor);
    fq.dwell_s = std::move(made.path.dwell_s);
    out.path = std::make_shared<model::CutterPath>(std::move(made.path.path));
    model::StepResult& r = out.result;
    r = result_of(w_, step);
    r.axial_depth_mm = made.answer.ap_mm;
    r.radial_depth_mm = made.answer.ae_mm;
    r.active = active_of(made.answer);
    if (auto m = measured(w_, step, *out.path, stocks_)) {
      out.removed_mm3 = m->removed_mm3;
      out.rapid_removed_mm3 = m->rapid_removed_mm3;
      fq.samples = step::samples_of(*m, *out.path, step.cutter);
      fq.known_to_mm = m->known_to_mm;
      // One pass over a surface, not levels: as deep and as wide as what roughing left there.
      if (w_.plan.model.holds<model::FreeformFinishMilling>(step.operation)) {
        for (const optimise::CutSample& sample : fq.samples) {
          if (sample.plunge) continue;
          const double ae = std::min(sample.ae_mm, step.cutter.cutting_diameter_mm);
          r.axial_depth_mm = std::max(r.axial_depth_mm, sample.ap_mm);
          r.radial_depth_mm = std::max(r.radial_depth_mm, ae);
        }
      }
      optimise::split_moves(fq, *out.path, &m->sections);
      r.sections = std::make_shared<const model::SectionSeries>(std::move(m->sections));
    }
    out.feeds = optimise::feeds(fq, *out.path);
    out.made = std::move(made);
    return out;
  }

  /// Takes a try: into nouns, ledger and plan.
  Status accept(StepDraft& step, Tried tried, std::size_t candidate) {
    if (tried.removed_mm3 && in_air(w_, step, *tried.removed_mm3) &&
        leave_out(w_, step, "it meets no material"))
      return {};
    const std::string* nothing =
        step.proposed ? w_.tries.bans.cuts_nothing(step.member, step.chain, step.in_chain) : nullptr;
    if (nothing != nullptr && cut_around(w_, step) && leave_out(w_, step, *nothing)) return {};
    if (candidate > 0 && candidate < step.candidates.size())
      take_cutter(w_, step, step.candidates[candidate]);
    const Made& made = tried.made;
    tell_rapids(w_, step, tried.rapid_removed_mm3);
    let_go(w_, step, made.let_go);
    turn_with_the_cutter(w_, step);
    record_cut(w_, step, made.answer, made.depth_open, made.width_open, made.precedent);
    tell_thicker(step, made);
    progress_.done(step);
    const auto& feeds = tried.feeds;
    model::StepResult& r = tried.result;
    if (tried.asked.adapt || step.open_technology) keep_excess(w_, step, feeds, r);
    r.schedule = std::make_shared<const model::FeedSchedule>(feeds.schedule);
    r.loads = made.under && !tried.removed_mm3 ? *made.under : feeds.peak;
    if (!(r.loads.tool_life_min > 0.0)) r.loads.tool_life_min = made.answer.life_min;
    r.held_by = feeds.held_by;
    r.path = tried.path;
    const Deviation deviation = deviation_of(w_, step, job_of(w_, step, step.shapes.front()));
    r.path_deviation_mm = r.contour_tolerance_mm = deviation.mm;
    record_path(w_, step, tried.path, deviation.why);
    keep(w_, step, std::move(r), tried.asked);
    return {};
  }

  /// Depths that exceeded a limit along the path: an alternative that was tried, and why not.
  void tell_thicker(const StepDraft& step, const Made& made) {
    if (made.thicker.empty()) return;
    // What the check asked for is told by `bind_checked`.
    const bool asked =
        step.proposed && w_.tries.bans.thinner(step.member, step.chain, step.in_chain) != nullptr;
    if (made.thicker.size() > 1 || !asked) {
      w_.job.note("PIP-ANEW", "step '" + draft::name_of(w_.plan.model, step) + "': planned anew " +
                                  sizes(made.answer) + " instead of " + made.thicker.front().what +
                                  ", because " + made.thicker.front().why);
    }
    const char* what = made.depth_open ? "axial_cutting_depth" : "radial_cutting_depth";
    auto* d = w_.plan.ledger.find(step.operation, what);
    if (d == nullptr) return;
    for (const model::Rejected& r : made.thicker) d->rejected.push_back(r);
  }

  /// A path that the file brings is cut as it is; its feed may be open.
  Status explicit_path(StepDraft& step) {
    turn_with_the_cutter(w_, step);
    auto made = given_path(w_, step, stocks_, progress_, cuts_);
    if (!made) {
      give_up(step, made.error().message);
    } else if (*made) {
      keep(w_, step, std::move((*made)->result), (*made)->feeds);
    }
    return {};
  }

  Work& w_;
  Stocks stocks_;
  Progress progress_;
  Cuts cuts_;
  std::set<AnyRef> failed_;   ///< features with a step that failed in this try
  std::set<AnyRef> resting_;  ///< features that rest on those
  std::map<Member, std::string>
      lost_;  ///< what steps of the file would have made that have no path: the first
};

}  // namespace

Status make_paths(Work& w) { return PathMaker(w).run(); }

}  // namespace capstan::pipeline
