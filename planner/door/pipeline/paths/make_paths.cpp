#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/paths/try_cutter.h"
#include "planner/door/pipeline/stages.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/piece/rests.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/making/step/cut/deviation.h"
#include "planner/making/step/cut/ranking.h"
#include "planner/making/step/cut/shift.h"
#include "planner/making/step/path/attempt.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/path/given_path.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/path/progress.h"
#include "planner/making/step/path/stocks.h"
#include "planner/making/step/path/surface.h"
#include "planner/making/step/path/surface_rest.h"
#include "planner/making/step/record/from_cases.h"
#include "planner/making/step/record/gone.h"
#include "planner/making/step/record/grouped_reasons.h"
#include "planner/making/step/record/record.h"
#include "planner/making/step/record/results.h"
#include "tooling/selection/select.h"

// Step by step in order: depths, path, sections, feeds, with the stock carried on.

namespace capstan::pipeline {
namespace {

using draft::Member;
using draft::StepDraft;
using model::Model;

class PathMaker {
 public:
  PathMaker(model::Plan plan, Drafts drafts, const Required& required, const Asked& asked,
            step::KnownCuts known, Job& job)
      : plan_(std::move(plan)),
        drafts_(std::move(drafts)),
        known_(std::move(known)),
        piece_{plan_, required.shapes, grown_mm(asked.inputs)},
        wishes_(wishes_of(asked)),
        cut_(cut_before(asked, drafts_)),
        p_{plan_, drafts_.setups, drafts_.steps, piece_, required.demands, asked.recorded, wishes_, cut_},
        bans_(asked.bans),
        job_(job),
        stocks_(plan_.stock, drafts_.setups, drafts_.steps, left_out_, asked.smallest, asked.memo),
        progress_(p_),
        cuts_(known_, options_of(asked.inputs), job),
        means_{stocks_, progress_, cuts_, job_, asked.memo},
        cutter_(plan_, p_, bans_, means_) {}
  PathMaker(const PathMaker&) = delete;  // its parts refer to each other
  PathMaker& operator=(const PathMaker&) = delete;

  Result<Made> run() {
    std::size_t done = 0;
    for (StepDraft& step : steps_) {
      job_.progress("paths", static_cast<double>(done++) / static_cast<double>(steps_.size()));
      poll();
      if (done <= cut_) {
        remove(step, p_.recorded.steps[done - 1]);
        continue;
      }
      if (!given_up(step)) {
        if (auto ok = make(step); !ok) return tl::unexpected(ok.error());
      }
      if (roughs_surface(step) && !is_kept(step)) tell_of_last_rough(step);
    }
    auto cells = stocks_.other_cells();
    learned_.again = learned_.again || cells.again;
    learned_.smallest = std::move(cells.cutters);
    if (!learned_.again) step::tell_all_cases(told_, job_);
    return Made{{std::move(plan_), std::move(drafts_), std::move(learned_)}, std::move(known_)};
  }

 private:
  /// What a step took away that is cut, as it was cut.
  void remove(const StepDraft& step, const model::StepResult& cut) {
    stocks_.keep(step.setup);
    if (step.feature.set() || step.operation.set()) stocks_.cut(step.setup, *cut.path, step.cutter);
    if (plan_.model.holds<model::MachiningOperation>(step.operation)) progress_.done(step);
  }

  /// True if a feature that this step needs has failed: then the step is not made either. A proposed step
  /// waits for the next try at its feature; for a step of the file the reason is reported.
  bool given_up(const StepDraft& step) {
    if (step.proposed) return failed_.contains(step.feature) || resting_.contains(step.feature);
    if (lost_.empty() || !plan_.model.holds<model::MachiningOperation>(step.operation)) return false;
    // A path that the file brings is kept; that of a tap is never cut as moves.
    if (step::has_given_path(plan_, step) && !plan_.model.holds<model::Tapping>(step.operation)) return false;
    const std::string* lost = nullptr;
    for (const Member& m : members(step)) {
      if (const auto at = lost_.find(m); at != lost_.end()) lost = &at->second;
    }
    if (lost == nullptr && !resting_.contains(step.feature)) return false;
    step::no_path(plan_, step,
                  lost != nullptr ? "it needs step '" + *lost + "' before it, which has no path"
                                  : "it needs " + needed_by(step) + " before it, which is not planned",
                  job_);
    lose(step);
    return true;
  }

  /// The features that this step's rests on and that failed, by name.
  std::string needed_by(const StepDraft& step) const {
    const auto all = piece::what_rests(plan_.model, p_.setups);
    std::string out;
    for (const AnyRef f : failed_) {
      if (!piece::resting_on(all, {f}).contains(step.feature)) continue;
      const auto* named = plan_.model.get<model::ManufacturingFeature>(f);
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

  /// Records that this step of the file does not prepare its feature for the steps after it.
  void lose(const StepDraft& step) {
    if (!step.feature.set() || !leaves_what_others_need(step)) return;
    for (const Member& m : members(step)) lost_.emplace(m, draft::name_of(plan_.model, step));
    failed_.insert(step.feature);
    resting_ = piece::resting_on(piece::what_rests(plan_.model, p_.setups), failed_);
  }

  /// A step that cannot be made. If rules proposed it, its chain is given up, and with it for now what rests
  /// on its feature; the plan is made again with the next chain. A step of the file is reported.
  void give_up(const StepDraft& step, const std::string& why) {
    if (!step.proposed) {
      step::no_path(plan_, step, why, job_);
      lose(step);
      return;
    }
    const std::string text = "step '" + draft::name_of(plan_.model, step) + "' has no path: " + why;
    learned_.given_up.push_back({step.member, step.chain, text});
    learned_.said.push_back(text + "; its feature is planned anew");
    learned_.again = true;
    failed_.insert(step.feature);
    resting_ = piece::resting_on(piece::what_rests(plan_.model, p_.setups), failed_);
  }

  /// Whether the step could be left out, for it cuts nothing.
  bool left_out(const StepDraft& step, const std::string& why) {
    if (!step::leave_out(plan_, p_, step, why, job_)) return false;
    left_out_.insert(step.step);
    return true;
  }

  /// A mark for the drill, a finished wall or a broken edge is missed by no other step of its feature.
  bool leaves_what_others_need(const StepDraft& step) const {
    const Model& m = plan_.model;
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
    if (step::has_given_path(plan_, step) && !step::rigid_tap(plan_, step, job_)) return explicit_path(step);
    if (!plan_.model.holds<model::MachiningOperation>(step.operation)) return {};
    if (step.shapes.empty()) {
      give_up(step,
              "the shape of its feature is not known" + (step.no_shape.empty() ? "" : ": " + step.no_shape));
      return {};
    }
    if (step.cutter.cutting_diameter_mm <= 0.0) {  // no cutter was found; said already
      lose(step);
      return {};
    }
    if (step.open_technology && step.candidates.empty()) {  // a tool of the file, not chosen by planning
      const auto start = tooling::start_values(step.cutter, plan_.material, plan_.machine);
      if (const auto why = tooling::not_cut_with(step.cutter, start, plan_.material)) {
        give_up(step, "tool " + step.cutter.id + ": " + *why);
        return {};
      }
    }
    if (used_.size() + further_.size() >=
        static_cast<std::size_t>(std::max(0, plan_.machine.magazine_pockets)))
      step::keep_in_magazine(plan_.machine, steps_, step);
    step::rank_by_time(plan_, p_, steps_, step, used_, stocks_, progress_, cuts_);
    step::rank_by_path(plan_, steps_, step, used_,
                       [&](std::size_t i) { return cutter_.seconds_with(step, i); });
    if (step.proposed && plan_.target_mesh &&
        plan_.model.holds<model::FreeformRoughMilling>(step.operation) && step::left_by_next_mm(p_, step)) {
      if (roughs_again(step)) {
        if (!take_for_rest(step)) return {};
      } else if (step.candidates.size() > 1) {
        (void)step::rank_by_rest(
            plan_, steps_, step, used_, false, [&](std::size_t i) { return cutter_.roughed_with(step, i); },
            [&] { cutter_.keep_last(); });
      }
    }
    const std::size_t tries = std::max<std::size_t>(1, step.candidates.size());
    step::GroupedReasons why_not;
    const bool of_rest =
        step::roughed_before(p_, step) != nullptr && step::left_by_next_mm(p_, step).has_value();
    bool gone = step.proposed || of_rest;                 // true: every cutter finds no material to cut
    std::optional<std::pair<std::size_t, double>> least;  // of those that exceed a limit: which, by how much
    std::optional<double> bent;  // mm/N: of the cutters that bend too much, the stiffest one's
    for (std::size_t i = 0; i < tries; ++i) {
      if (const auto why = step::surely_bends(plan_.model, step, i, bent)) {
        why_not.add(step.candidates[i].cutter.id, *why);
        step.rejected_tools.push_back({step.candidates[i].cutter.id, *why});
        gone = false;
        continue;
      }
      const auto before = stocks_.before(step.setup);
      auto tried = cutter_.with_cutter(step, i);
      const auto shifts = tried ? longer_than_a_shift(step, *tried) : std::nullopt;
      if (tried && !shifts && !exceeds(step, *tried)) return accept(step, *std::move(tried), i);
      gone = gone && !tried && tried.error().code == toolpath::kNothingToCut;
      const std::string why = shifts ? *shifts : tried ? excess_text(*tried) : tried.error().message;
      if (tried) {
        if (!shifts && (!least || tried->feeds.worst_excess < least->second))
          least = {i, tried->feeds.worst_excess};
        stocks_.put_back(step.setup, before);
      }
      if (const auto b = step::bent_too_much(step.cutter, why)) bent = std::min(*b, bent.value_or(*b));
      why_not.add(step.cutter.id, why);
      step.rejected_tools.push_back({step.cutter.id, why});
    }
    // A step of the file is cut as gently as possible; the plan then says which limit is exceeded.
    if (least && !step.proposed) {
      auto tried = cutter_.with_cutter(step, least->first);
      if (tried) return accept(step, *std::move(tried), least->first);
    }
    if (gone && left_out(step, why_not.text())) return {};
    if (of_rest || roughs_again(step)) {
      leave_rest(step, why_not.text());
      return {};
    }
    give_up(step,
            why_not.text() + (least ? "; a smaller or shorter cutter or a stronger spindle would do" : ""));
    return {};
  }

  [[nodiscard]] bool roughs_surface(const StepDraft& step) const {
    return plan_.model.holds<model::FreeformRoughMilling>(step.operation);
  }
  [[nodiscard]] bool is_kept(const StepDraft& step) const {
    return std::any_of(plan_.steps.begin(), plan_.steps.end(),
                       [&](const model::StepResult& r) { return r.step == step.step; });
  }
  /// Whether a step roughs the same surface as another; where that was proposed, in the same chain.
  [[nodiscard]] bool roughs_with(const StepDraft& s, const StepDraft& step) const {
    return roughs_surface(s) &&
           (step.proposed ? s.proposed && s.member == step.member && s.chain == step.chain
                          : s.feature == step.feature);
  }
  [[nodiscard]] bool roughs_again(const StepDraft& step) const {
    return step.proposed && roughs_surface(step) &&
           std::any_of(steps_.begin(), steps_.end(), [&](const StepDraft& s) {
             return roughs_with(s, step) && s.in_chain < step.in_chain;
           });
  }
  [[nodiscard]] bool roughed_later(const StepDraft& step) const {
    const auto at =
        std::find_if(steps_.begin(), steps_.end(), [&](const StepDraft& s) { return s.step == step.step; });
    return std::any_of(at, steps_.end(),
                       [&](const StepDraft& s) { return roughs_with(s, step) && s.step != step.step; });
  }

  /// Ranks mills narrower than the one before for what that left too much of. False: there is too little of
  /// it, or none takes most of it, which is said, and the step is left out.
  bool take_for_rest(StepDraft& step) {
    constexpr double kMostStays = 0.75;  // of the rest, for a mill to be worth its change; default, unsourced
    // Of the diameter before: narrower mills take long to compare and to cut. Default, unsourced.
    constexpr double kNarrowest = 0.45;
    constexpr double kSame = 1e-6;
    // The check condemned it (checked.cpp): the surface is made without it.
    if (bans_.cuts_nothing(step.member, step.chain, step.in_chain) != nullptr) {
      leave_rest(step, {});
      return false;
    }
    const model::Cutter* before = step::roughed_before(p_, step);
    const auto rest = before != nullptr ? step::surface_rest(p_, step, stocks_.of(step.setup)) : std::nullopt;
    if (rest && rest->mm3 > 0.0) {
      const auto dropped = step.candidates.drop_if([&](const model::Candidate& c) {
        const double d = c.cutter.cutting_diameter_mm, most = before->cutting_diameter_mm;
        return d > most - kSame || d < kNarrowest * most;
      });
      const std::string most = trimmed(before->cutting_diameter_mm, 3) + " mm";
      for (const auto& c : dropped) {
        const double d = c->cutter.cutting_diameter_mm;
        const bool narrow = d < kNarrowest * before->cutting_diameter_mm;
        step.rejected_tools.push_back(
            {c->cutter.id,
             trimmed(d, 3) + " mm wide, " +
                 (narrow ? "less than " + trimmed(kNarrowest, 2) + " of the " + most + " of " + before->id +
                               " before it: it takes long"
                         : "no narrower than the " + most + " of " + before->id + ", which left this")});
      }
      if (!step.candidates.empty()) {
        step.cutter = step.candidates.front().cutter;
        step::take_cutter(plan_, steps_, step, step.candidates.front());
      }
      step::GroupedReasons why_not;
      const auto worth = [&](std::size_t i) {
        auto t = cutter_.roughed_with(step, i, &*rest);
        const std::string& id = step.candidates[i].cutter.id;
        if (!t) {
          why_not.add(id, cutter_.why_not().empty() ? "nothing is known of its cut" : cutter_.why_not());
        } else if (t->too_much_mm3 > kMostStays * rest->mm3) {
          why_not.add(id, "leaves more than " + trimmed(kMostStays, 2) + " of it");
          t.reset();
        }
        return t;
      };
      if (step::rank_by_rest(plan_, steps_, step, used_, true, worth, [&] { cutter_.keep_last(); }))
        return true;
      const std::string none = why_not.text();
      leave_rest(step, trimmed(rest->mm3, 0) + " mm3, up to " + trimmed(rest->deepest_mm, 2) +
                           " mm along the axis, stay where the next step bites too deep; " +
                           (none.empty() ? "no mill that fits has " + trimmed(kNarrowest, 2) +
                                               " to 1 of the " + most + " of " + before->id + " before it"
                                         : none));
      return false;
    }
    leave_rest(step, {});
    return false;
  }

  /// The surface is finished without it. `why`: said, unless there was nothing to rough.
  void leave_rest(const StepDraft& step, const std::string& why) {
    step::take_out(plan_.model, step);
    left_out_.insert(step.step);
    if (!why.empty())
      job_.note("PIP-REST", "step '" + draft::name_of(plan_.model, step) + "' is left out: " + why);
  }

  /// After a step that roughs a surface and is not made: nothing was said yet of what the last one before it
  /// left that was. Of a feature that is planned anew nothing is.
  void tell_of_last_rough(const StepDraft& step) {
    if (roughed_later(step) || (step.proposed && failed_.contains(step.feature))) return;
    const StepDraft* last = nullptr;
    for (const StepDraft& s : steps_) {
      if (s.step == step.step) break;
      if (roughs_with(s, step) && is_kept(s)) last = &s;
    }
    if (last != nullptr) tell_too_much(*last);
  }

  /// Why nobody would run the step: a proposed cut of one prismatic feature that lasts longer than a shift.
  /// Surfaces may.
  [[nodiscard]] std::optional<std::string> longer_than_a_shift(const StepDraft& step,
                                                               const step::MeasuredCut& t) const {
    if (!step.proposed || plan_.model.holds<model::FreeformOperation>(step.operation)) return std::nullopt;
    const auto seconds = step::seconds_of(plan_.machine, *t.path, t.feeds.schedule);
    if (!seconds || *seconds <= step::kShiftS) return std::nullopt;
    return step::longer_than_a_shift_text(trimmed(*seconds / 3600.0, 1) + " h");
  }

  /// Takes a try: into nouns, ledger and plan.
  Status accept(StepDraft& step, step::MeasuredCut tried, std::size_t candidate) {
    if (tried.removed_mm3 && step::in_air(p_, step, *tried.removed_mm3) &&
        left_out(step, "it meets no material"))
      return {};
    const std::string* nothing =
        step.proposed ? bans_.cuts_nothing(step.member, step.chain, step.in_chain) : nullptr;
    if (nothing != nullptr && step::may_cut_nothing(p_, step) && left_out(step, *nothing)) return {};
    if (candidate > 0 && candidate < step.candidates.size())
      step::take_cutter(plan_, steps_, step, step.candidates[candidate]);
    if (std::find(used_.begin(), used_.end(), step.cutter.id) == used_.end()) further_.insert(step.cutter.id);
    const step::PathWithCut& made = tried.made;
    step::tell_rapids(plan_.model, step, tried.rapid_removed_mm3, job_);
    step::let_go(plan_.model, step, made.let_go, job_);
    step::turn_with_the_cutter(plan_, step, job_);
    if (tried.strategy) step::record_strategy(plan_, step, *tried.strategy);
    step::record_cut(plan_, steps_, step, made.answer, made.depth_open, made.width_open, made.cases);
    tell_thicker(step, made);
    progress_.done(step);
    if (!roughed_later(step)) tell_too_much(step);
    const auto& feeds = tried.feeds;
    model::StepResult& r = tried.result;
    if (tried.asked.adapt || step.open_technology) step::keep_excess(plan_.model, step, feeds, r, job_);
    r.schedule = std::make_shared<const model::FeedSchedule>(feeds.schedule);
    r.loads = made.under && !tried.removed_mm3 ? *made.under : feeds.peak;
    if (!(r.loads.tool_life_min > 0.0)) r.loads.tool_life_min = made.answer.life_min;
    r.held_by = feeds.held_by;
    r.path = tried.path;
    const step::Deviation deviation =
        step::deviation_of(p_, step, step::job_of(p_, step, step.shapes.front()));
    r.path_deviation_mm = r.contour_tolerance_mm = deviation.mm;
    step::record_path(plan_, steps_, step, tried.path, deviation.why);
    step::keep(plan_, p_.recorded, step, std::move(r), tried.asked, job_);
    step::tell_cases(plan_, p_, step, made, tried.asked, cuts_, told_, job_);
    return {};
  }

  /// A surface of which a step leaves so much that the next bites deeper than twice what it was given.
  void tell_too_much(const StepDraft& step) {
    constexpr double kShare = 0.01;  // of the surface; the rest are creases; default, unsourced
    if (!plan_.target_mesh || !plan_.model.holds<model::FreeformOperation>(step.operation)) return;
    const auto much = step::too_much_for_next(p_, step, stocks_.of(step.setup));
    if (!much || !(much->most_mm > 0.0) || much->share <= kShare) return;
    job_.warn("PIP-BITE", "step '" + draft::name_of(plan_.model, step) +
                              "' leaves so much that the next over this surface bites up to " +
                              trimmed(much->deepest_mm, 2) + " mm deep, square to it, and on " +
                              trimmed(100.0 * much->share, 1) + " % of it more than " +
                              trimmed(much->most_mm, 2) +
                              " mm, twice what is left for it; a smaller mill before it would bite less");
  }

  /// Depths that exceeded a limit along the path: an alternative that was tried, and why not.
  void tell_thicker(const StepDraft& step, const step::PathWithCut& made) {
    if (made.thicker.empty()) return;
    // `bind_checked` reports what the check asked for.
    const bool asked = step.proposed && bans_.thinner(step.member, step.chain, step.in_chain) != nullptr;
    if (made.thicker.size() > 1 || !asked) {
      job_.note("PIP-ANEW", "step '" + draft::name_of(plan_.model, step) + "': " + sizes(made.answer) +
                                " instead of " + made.thicker.front().what + ", because " +
                                made.thicker.front().why);
    }
    const char* what = made.depth_open ? "axial_cutting_depth" : "radial_cutting_depth";
    auto* d = plan_.ledger.find(step.operation, what);
    if (d == nullptr) return;
    for (const model::Rejected& r : made.thicker) d->rejected.push_back(r);
  }

  /// A path that the file brings is cut as it is; its feed may be open.
  Status explicit_path(StepDraft& step) {
    step::turn_with_the_cutter(plan_, step, job_);
    auto made = step::given_path(plan_, p_, step, stocks_, progress_, cuts_, job_);
    if (!made) {
      give_up(step, made.error().message);
    } else if (*made) {
      step::keep(plan_, p_.recorded, step, std::move((*made)->result), (*made)->feeds, job_);
    }
    return {};
  }

  model::Plan plan_;
  Drafts drafts_;
  std::vector<StepDraft>& steps_ = drafts_.steps;
  const std::vector<std::string>& used_ = drafts_.used;
  step::KnownCuts known_;
  const piece::Piece piece_;
  const step::Wishes wishes_;
  const std::size_t cut_;  ///< of the steps, the first that are cut
  const step::PlanSoFar p_;
  const draft::Bans& bans_;
  Job& job_;
  std::set<AnyRef> left_out_;  ///< steps that are taken out, for they cut nothing or no mill is worth it
  step::Stocks stocks_;
  step::Progress progress_;
  step::Cuts cuts_;
  step::Means means_;
  TryCutter cutter_;
  Learned learned_;
  step::CaseTally told_;
  std::set<std::string> further_;  ///< cutters that were taken in place of those in `used_`
  std::set<AnyRef> failed_;        ///< features with a step that failed in this try
  std::set<AnyRef> resting_;       ///< features that rest on those
  std::map<Member, std::string>
      lost_;  ///< what steps of the file would have made that have no path: the first
};

}  // namespace

Result<Made> make_paths(model::Plan plan, Drafts drafts, const Required& required, const Asked& asked,
                        step::KnownCuts cuts, Job& job) {
  return PathMaker(std::move(plan), std::move(drafts), required, asked, std::move(cuts), job).run();
}

}  // namespace capstan::pipeline
