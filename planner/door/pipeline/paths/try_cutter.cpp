#include "planner/door/pipeline/paths/try_cutter.h"

#include <cmath>
#include <utility>

#include "planner/ground/base/earlier_diagnostics.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/cut/ranking.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/record/results.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/motion/time.h"

namespace capstan::pipeline {
namespace {

using draft::StepDraft;

/// Thinner cuts that are tried with one cutter where a limit is exceeded along its path.
constexpr int kMostThinner = 3;
/// A thinner cut aims below the limit by this, for sections along the path are not proportional to it.
constexpr double kThinnerAim = 0.9;      // default, unsourced
constexpr double kThinnerUnknown = 0.5;  // if no formula gives the excess; default, unsourced
constexpr double kThinnerAnew = 0.7;     // each time that the check condemned the cut; default, unsourced
constexpr double kThinnest = 0.02;       // of the cut that keeps the limits off the path; default, unsourced

/// How long it takes, if it keeps the limits.
std::optional<double> kept_seconds(const model::Machine& machine, const StepDraft& step,
                                   const Result<step::MeasuredCut>& t) {
  if (!t || exceeds(step, *t)) return std::nullopt;
  return step::seconds_of(machine, *t->path, t->feeds.schedule);
}

/// A way that was tried, taken out of the stock again.
struct Tried {
  step::Clearing way;
  Result<step::MeasuredCut> cut;
  std::optional<double> seconds;  ///< if it keeps the limits
  std::vector<Diagnostic> said;
  step::Stocks::Undone removed;
};

}  // namespace

/// Depth and width of a cut, for people.
std::string sizes(const optimise::CutAnswer& a) {
  return trimmed(a.ap_mm, 3) + " mm deep, " + trimmed(a.ae_mm, 3) + " mm wide";
}

bool exceeds(const StepDraft& step, const step::MeasuredCut& t) {
  return step.open_technology && t.feeds.worst_excess > step::kTolerableExcess;
}

std::string excess_text(const step::MeasuredCut& t) {
  const std::string thinner = t.made.thicker.empty()
                                  ? std::string()
                                  : ", also where it cuts " + trimmed(t.made.answer.ap_mm, 3) + " mm deep";
  return model::text_of(t.feeds.worst) + ", even at the least feed" + thinner;
}

template <class F>
std::optional<TryCutter::Passed> TryCutter::in_passing(StepDraft& step, std::size_t i, const F& look) {
  auto said = means_.job.take_diagnostics();
  const auto before = means_.stocks.before(step.setup);
  const model::Cutter cutter = step.cutter;
  std::optional<Passed> out;
  auto tried = made_with(step, i);
  why_not_ = tried ? std::string() : tried.error().message;
  if (tried && exceeds(step, *tried)) {
    why_not_ = excess_text(*tried);
  } else if (tried) {
    look(*tried);
    out = Passed{step.step,
                 i < step.candidates.size() ? &step.candidates[i] : nullptr,
                 step.constant_engagement,
                 step.inwards,
                 *std::move(tried),
                 means_.job.take_diagnostics(),
                 means_.stocks.take_out(step.setup, before)};
  }
  step.cutter = cutter;
  means_.stocks.put_back(step.setup, before);
  (void)means_.job.take_diagnostics();
  for (auto& d : said) means_.job.report(std::move(d));
  return out;
}

std::optional<double> TryCutter::seconds_with(StepDraft& step, std::size_t i) {
  std::optional<double> out;
  (void)in_passing(step, i, [&](const step::MeasuredCut& t) {
    out = step::seconds_of(plan_.machine, *t.path, t.feeds.schedule);
  });
  return out;
}

std::optional<step::Roughed> TryCutter::roughed_with(StepDraft& step, std::size_t i,
                                                     const step::SurfaceRest* rest) {
  std::optional<step::Roughed> out;
  last_.reset();
  last_ = in_passing(step, i, [&](const step::MeasuredCut& t) {
    const auto seconds = step::seconds_of(plan_.machine, *t.path, t.feeds.schedule);
    if (!seconds || !t.removed_mm3) return;
    const stock::HeightMap& map = means_.stocks.of(step.setup);
    if (rest != nullptr) {
      out = step::Roughed{*seconds, *t.removed_mm3, step::mm3_above(map, rest->may_stay)};
      return;
    }
    const auto left = step::too_much_for_next(p_, step, map);
    if (left) out = step::Roughed{*seconds, *t.removed_mm3, left->mm3};
  });
  return out;
}

Result<step::MeasuredCut> TryCutter::with_cutter(StepDraft& step, std::size_t i) {
  last_.reset();
  std::optional<Passed> kept = std::exchange(kept_, std::nullopt);
  if (!kept || kept->step != step.step || i >= step.candidates.size() ||
      kept->candidate != &step.candidates[i])
    return made_with(step, i);
  step.cutter = step.candidates[i].cutter;
  step.constant_engagement = kept->constant_engagement;
  step.inwards = kept->inwards;
  means_.stocks.put_in(step.setup, std::move(kept->removed));
  for (Diagnostic& d : kept->said) means_.job.report(std::move(d));
  return std::move(kept->cut);
}

Result<step::MeasuredCut> TryCutter::made_with(StepDraft& step, std::size_t i) {
  step.constant_engagement.reset();
  step.inwards.reset();
  const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
  if (candidate != nullptr) step.cutter = candidate->cutter;
  const auto other = step::constant_cut(p_, step, candidate, means_);
  const bool inwards = step::rings_inwards(p_, step, means_);
  if (!other && !inwards) return with_strategy(step, i);
  const EarlierDiagnostics before(means_.job);
  return quickest_way(step, i, inwards, other);
}

Result<step::MeasuredCut> TryCutter::quickest_way(StepDraft& step, std::size_t i, bool inwards,
                                                  const std::optional<step::ConstantCut>& other) {
  using step::Clearing;
  const auto before = means_.stocks.before(step.setup);
  const auto take = [&](Clearing way) {
    step.constant_engagement = way == Clearing::kConstantEngagement;
    step.inwards = way == Clearing::kInwards;
  };
  const auto tried = [&](Clearing way) {
    take(way);
    auto cut = with_strategy(step, i);
    const auto seconds = kept_seconds(plan_.machine, step, cut);
    return Tried{way, std::move(cut), seconds, means_.job.take_diagnostics(),
                 means_.stocks.take_out(step.setup, before)};
  };
  step::StrategyChoice choice;
  const auto lose = [&](const Tried& t, double best_s) {
    std::string why = t.seconds ? step::slower_text(*t.seconds, best_s)
                      : t.cut   ? excess_text(*t.cut)
                                : t.cut.error().message;
    const optimise::CutAnswer cut = t.cut                                             ? t.cut->made.answer
                                    : other && t.way == Clearing::kConstantEngagement ? other->answer
                                                                                      : optimise::CutAnswer{};
    choice.lost.push_back({step::words_of(t.way, cut), std::move(why)});
  };
  (void)means_.job.take_diagnostics();
  const auto accepted = [&](Tried&& best) {
    take(best.way);
    means_.stocks.put_in(step.setup, std::move(best.removed));
    for (Diagnostic& d : best.said) means_.job.report(std::move(d));
    if (!best.cut) return std::move(best.cut);
    choice.way = best.way;
    if (best.seconds)
      choice.taken =
          step::words_of(best.way, best.cut->made.answer) + ": " + motion::duration_text(*best.seconds);
    best.cut->strategy = std::move(choice);
    return std::move(best.cut);
  };
  const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
  const bool thinner = bans_.thinner(step.member, step.chain, step.in_chain) != nullptr;
  const auto area = thinner ? std::nullopt : step::key_of_area(p_, step, candidate, inwards, other, means_);
  if (const auto* known = area ? areas_.find(*area) : nullptr) {
    Tried again = tried(known->way);
    if (again.seconds && step::EqualAreas::same(*known, *again.cut, again.seconds)) {
      choice.lost = known->lost;
      return accepted(std::move(again));
    }
  }
  Tried best = tried(Clearing::kOutwards);
  const auto challenge = [&](Clearing way) {
    Tried next = tried(way);
    if (next.seconds && (!best.seconds || step::worthwhile(*next.seconds, *best.seconds)))
      std::swap(best, next);
    if (best.seconds) lose(next, *best.seconds);
  };
  if (inwards) challenge(Clearing::kInwards);
  if (other) {
    const double volume = best.seconds ? best.cut->removed_mm3.value_or(0.0) : 0.0;
    const double about = step::estimated_seconds(other->question, other->answer, volume, other->walled);
    if (best.seconds && !step::worthwhile(about, *best.seconds)) {
      choice.lost.push_back({step::words_of(Clearing::kConstantEngagement, other->answer),
                             step::estimate_text(about, *best.seconds)});
    } else {
      challenge(Clearing::kConstantEngagement);
    }
  }
  if (area && best.seconds)
    areas_.keep(*area, {best.way, *best.seconds, step::EqualAreas::key_of_path(*best.cut), choice.lost});
  return accepted(std::move(best));
}

Result<step::MeasuredCut> TryCutter::with_strategy(StepDraft& step, std::size_t i) {
  const model::Candidate* candidate = i < step.candidates.size() ? &step.candidates[i] : nullptr;
  const auto before = means_.stocks.before(step.setup);
  std::vector<model::Rejected> thicker;
  std::optional<double> gentlest;  // share of the first try
  std::optional<step::MeasuredCut> came_of_it;
  std::vector<Diagnostic> said_of_it;
  double of_gentlest = 0.0, share = 1.0;
  if (const draft::Thinner* t =
          step.proposed ? bans_.thinner(step.member, step.chain, step.in_chain) : nullptr) {
    share = std::pow(kThinnerAnew, t->times);
    thicker.push_back({"a cut " + trimmed(1.0 / share, 2) + " times as large", t->why});
  }
  for (int round = 0; round <= kMostThinner; ++round) {
    auto said = means_.job.take_diagnostics();  // diagnostics before this try; those of a try that is not
                                                // kept are dropped
    const auto told = [&](bool kept) {
      auto now = means_.job.take_diagnostics();
      for (auto& d : said) means_.job.report(std::move(d));
      if (!kept) return now;
      for (auto& d : now) means_.job.report(std::move(d));
      now.clear();
      return now;
    };
    auto made = step::path_with_cut(p_, step, candidate, share, means_);
    if (!made) told(!gentlest);
    if (!made && !gentlest) return tl::unexpected(made.error());
    if (!made) break;
    // A pass over a surface is as deep as the material left there, whatever depth was chosen.
    const bool thinner = (made->depth_open || made->width_open) &&
                         (!plan_.model.holds<model::FreeformFinishMilling>(step.operation) ||
                          draft::cuts_levels(plan_.model, step));
    made->thicker = thicker;
    step::MeasuredCut tried = step::measured_cut(plan_, p_, step, *std::move(made), means_);
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
    means_.stocks.put_back(step.setup, before);
    share *= std::isfinite(excess) ? kThinnerAim / (1.0 + excess) : kThinnerUnknown;
    if (share < kThinnest) break;
  }
  if (step.proposed) {  // exceeds a limit and is not taken: nothing is cut, what is known of it will do
    came_of_it->made.thicker = std::move(thicker);
    for (auto& d : said_of_it) means_.job.report(std::move(d));
    return *std::move(came_of_it);
  }
  auto made = step::path_with_cut(p_, step, candidate, *gentlest, means_);
  if (!made) return tl::unexpected(made.error());
  made->thicker = std::move(thicker);
  return step::measured_cut(plan_, p_, step, *std::move(made), means_);
}

}  // namespace capstan::pipeline
