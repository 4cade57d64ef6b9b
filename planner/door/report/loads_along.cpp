// Loads of the sections along a path, thinned for a page.
//
// The sections of the plan become samples, and samples loads, by the functions that the feeds were chosen by:
// a chart of other figures than those that bound the feed would explain nothing. More places than a page
// needs are thinned piece by piece: each piece keeps the largest of every load (the smallest of a limit), so
// that a chart is never below the truth.
#include "planner/door/report/loads_along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planner/making/optimise/feeds/cut_loads.h"
#include "planner/making/step/cut_samples.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/edit/step_names.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/holding_constants.h"
#include "planner/physics/mechanics/spindle.h"
#include "planner/physics/motion/time.h"

namespace capstan::report {
namespace {

struct Load {
  double force_n = 0.0, torque_nm = 0.0, power_w = 0.0, deflection_mm = 0.0;
};

/// Expected loads of one step's samples, by the law of milling or as the step has them.
class Loads {
 public:
  Loads(const model::Plan& plan, const model::StepResult& step, const model::Cutter& cutter, bool milled)
      : step_(step), milled_(milled), margin_(std::max(1.0, step.loads.force_margin)) {
    question_.cut.cutter = cutter;
    question_.cut.material = plan.material;
    question_.cut.machine = plan.machine;
    question_.cut.fz_start_mm = step.fz_mm;
    question_.feed_mm_min = step.feed_mm_min;
  }

  [[nodiscard]] Load at(const optimise::CutSample& s, double feed, double rpm) {
    if (!(s.csa_mm2 > 0.0) || !(feed > 0.0) || rpm == 0.0) return {};
    if (!milled_)
      return {step_.loads.peak_force_n / margin_, step_.loads.torque_nm / margin_,
              step_.loads.power_w / margin_, step_.loads.deflection_mm / margin_};
    using model::Limit;
    if (!loads_ || rpm_ != rpm) loads_.emplace(question_.cut, question_.feed_mm_min, rpm_ = rpm);
    const optimise::feed::CutLoads& loads = *loads_;
    Load out;
    const auto take = [&](const std::optional<optimise::feed::State>& state) {
      if (!state) return;
      const auto of = [&](Limit l) { return state->load.of(l) / loads.margin(); };
      out = {std::max(out.force_n, of(Limit::kPeakForce)), std::max(out.torque_nm, of(Limit::kSpindleTorque)),
             std::max(out.power_w, of(Limit::kSpindlePower)),
             std::max(out.deflection_mm, of(Limit::kToolDeflection))};
    };
    if (s.plunge) {
      take(loads.plunging(optimise::feed::plunged_mm2(s), feed));
      return out;
    }
    const optimise::feed::Cuts cuts = optimise::feed::cuts_of(s, question_.cut);
    for (std::size_t i = 0; i < cuts.n; ++i) take(loads.at(cuts.cut.at(i), feed));
    return out;
  }

 private:
  const model::StepResult& step_;
  bool milled_ = true;
  double margin_ = 1.0;
  optimise::FeedQuestion question_;
  std::optional<optimise::feed::CutLoads> loads_;  ///< at rpm_: cutter, law and limits are worked out once
  double rpm_ = 0.0;
};

/// What the spindle gives to the cut at a speed.
class Spindle {
 public:
  explicit Spindle(const model::Machine& machine)
      : share_(mechanics::spindle_efficiency(machine.spindle.efficiency)),
        curve_(mechanics::curve_of(machine.spindle)) {}
  [[nodiscard]] mechanics::SpindleCapacity at(double rpm) const {
    if (!curve_) return {};
    const auto there = curve_->at(std::abs(rpm));
    return there ? mechanics::SpindleCapacity{there->power_w * share_, there->torque_nm * share_}
                 : mechanics::SpindleCapacity{};
  }

 private:
  double share_ = 1.0;
  Result<mechanics::SpindleCurve> curve_;
};

/// A section as a sample of its own. Between two sections the feed schedule counts the larger; a chart shows
/// each where it is.
optimise::CutSample sample_at(const model::SectionSeries& s, std::size_t i, const model::CutterPath& path,
                              const model::Cutter& cutter) {
  const model::SectionSeries one{.move = {s.move[i]},
                                 .at_mm = {s.at_mm[i]},
                                 .ad_max_mm = {s.ad_max_mm[i]},
                                 .rd_max_mm = {s.rd_max_mm[i]},
                                 .x_max_ofs_mm = {s.x_max_ofs_mm[i]},
                                 .y_max_ofs_mm = {s.y_max_ofs_mm[i]},
                                 .csa_mm2 = {s.csa_mm2[i]},
                                 .x_cg_ofs_mm = {s.x_cg_ofs_mm[i]},
                                 .y_cg_ofs_mm = {s.y_cg_ofs_mm[i]},
                                 .removed_mm3 = {}};
  const auto samples = step::samples_of(one, path, cutter);
  return samples.empty() ? optimise::CutSample{.move = s.move[i], .at_mm = s.at_mm[i]} : samples.front();
}

using Column = std::vector<double> LoadsAlong::*;
constexpr std::array<Column, 7> kColumns = {
    &LoadsAlong::feed_mm_min, &LoadsAlong::depth_mm, &LoadsAlong::width_mm,     &LoadsAlong::force_n,
    &LoadsAlong::torque_nm,   &LoadsAlong::power_w,  &LoadsAlong::deflection_mm};
constexpr std::array<Column, 3> kLimits = {&LoadsAlong::torque_limit_nm, &LoadsAlong::power_limit_w,
                                           &LoadsAlong::feed_limit_mm_min};

LoadsAlong thinned(LoadsAlong all) {
  if (all.move.size() <= kMostPlaces) return all;
  const std::size_t piece = (all.move.size() + kMostPlaces - 1) / kMostPlaces;
  std::size_t to = 0;
  for (std::size_t from = 0; from < all.move.size(); from += piece, ++to) {
    const std::size_t end = std::min(from + piece, all.move.size());
    all.move[to] = all.move[end - 1];
    all.at_mm[to] = all.at_mm[end - 1];
    for (const Column c : kColumns) {
      auto& column = all.*c;
      column[to] = *std::max_element(column.begin() + static_cast<std::ptrdiff_t>(from),
                                     column.begin() + static_cast<std::ptrdiff_t>(end));
    }
    for (const Column c : kLimits) {
      auto& column = all.*c;
      column[to] = *std::min_element(column.begin() + static_cast<std::ptrdiff_t>(from),
                                     column.begin() + static_cast<std::ptrdiff_t>(end));
    }
  }
  all.move.resize(to);
  all.at_mm.resize(to);
  for (const Column c : kColumns) (all.*c).resize(to);
  for (const Column c : kLimits) (all.*c).resize(to);
  return all;
}

}  // namespace

LoadsAlong loads_along(const model::Plan& plan, const model::StepResult& step) {
  LoadsAlong out;
  const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
  if (cutter == nullptr || step.path == nullptr || step.sections == nullptr) return out;
  out.margin = std::max(1.0, step.loads.force_margin);
  if (step.setup < plan.setups.size())
    out.force_limit_n = plan.setups[step.setup].holding.holding_force_n / mechanics::kHoldingForceSafety;
  if (const auto bend = mechanics::enduring_bend_mm(*cutter)) out.deflection_limit_mm = *bend;
  const model::CutterPath& path = *step.path;
  const model::FeedSchedule schedule = motion::schedule_of(step);
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  Loads loads(plan, step, *cutter, ws == nullptr || mechanics::is_milled(ws->its_operation.type, *cutter));
  const Spindle spindle(plan.machine);
  const auto reach = motion::reach_along(path, plan.machine);
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const auto names = model::step_names(plan.model, step.step,
                                       ws == nullptr ? model::AnyRef() : model::AnyRef(ws->its_feature));
  const double allowed = model::limits_of(model::edits_of(plan), names).feed_mm_min.value_or(kAny);
  std::vector<double> before(path.size() + 1, 0.0);  // length of path before each move
  for (std::size_t i = 0; i < path.size(); ++i) before[i + 1] = before[i] + model::move_length(path, i);
  for (std::size_t i = 0; i < step.sections->size(); ++i) {
    const optimise::CutSample s = sample_at(*step.sections, i, path, *cutter);
    const std::size_t m = s.move;
    if (m == 0 || m >= path.size() || m >= schedule.feed_mm_min.size()) continue;
    const double feed = schedule.feed_mm_min[m];
    const Load load = loads.at(s, feed, schedule.spindle_rpm[m]);
    const mechanics::SpindleCapacity most = spindle.at(schedule.spindle_rpm[m]);
    out.move.push_back(s.move);
    out.at_mm.push_back(before[m] + s.at_mm);
    out.feed_mm_min.push_back(feed);
    out.depth_mm.push_back(s.ap_mm);
    out.width_mm.push_back(s.ae_mm);
    out.force_n.push_back(load.force_n);
    out.torque_nm.push_back(load.torque_nm);
    out.power_w.push_back(load.power_w);
    out.deflection_mm.push_back(load.deflection_mm);
    out.torque_limit_nm.push_back(most.torque_nm);
    out.power_limit_w.push_back(most.power_w);
    const double by_axes = reach ? (*reach)[m].most_mm_min : 0.0;
    out.feed_limit_mm_min.push_back(by_axes > 0.0    ? std::min(by_axes, allowed)
                                    : allowed < kAny ? allowed
                                                     : 0.0);
  }
  return thinned(std::move(out));
}

}  // namespace capstan::report
