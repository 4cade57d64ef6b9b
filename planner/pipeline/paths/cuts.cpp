#include "planner/pipeline/paths/cuts.h"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/base/number.h"

namespace capstan::pipeline {
namespace {

using QuestionKey =
    std::tuple<int, double, double, double, double, double, double, double, double, double, double, double,
               double, double, double, double, bool, bool, bool, double, double, double, double>;

QuestionKey key_of(const optimise::CutQuestion& q) {
  constexpr double kUnset = -1.0;
  return {static_cast<int>(q.kind),
          q.vc_start_m_min,
          q.vc_table_m_min,
          q.fz_start_mm,
          q.depth_mm,
          q.width_mm,
          q.pre_hole_mm,
          q.deflection_limit_mm,
          q.ap_mm.value_or(kUnset),
          q.ae_mm.value_or(kUnset),
          q.n_rpm.value_or(kUnset),
          q.feed_mm_min.value_or(kUnset),
          q.fz_mm.value_or(kUnset),
          q.engaged_diameter_mm,
          q.ap_most_mm,
          q.least_feed_ratio,
          q.slot,
          q.override_locked,
          q.feed_by_planning,
          q.surface_ra_um,
          q.wall_error_limit_mm,
          q.peak_force_limit_n,
          q.least_chip_mm};
}

}  // namespace

/// By cutter, whole: one name may stand out differently in two steps.
struct CutsKnown {
  std::map<QuestionKey, std::vector<std::pair<model::Cutter, optimise::CutAnswer>>> answers;
};

Cuts::Cuts(Work& w) : w_(w) {
  if (!w.tries.cuts) w.tries.cuts = std::make_shared<CutsKnown>();
  known_ = w.tries.cuts;
  options_.solver = w.inputs.solver;
  options_.backends = w.inputs.backends;
  options_.starts = 2;
  options_.relative_tolerance = 1e-7;
}

Result<optimise::CutAnswer> Cuts::answer(const optimise::CutQuestion& q) {
  auto& known = known_->answers[key_of(q)];
  for (const auto& [cutter, answer] : known) {
    if (cutter == q.cutter) return answer;
  }
  auto a = optimise::cut(q, options_, w_.job);
  if (a) known.emplace_back(q.cutter, *a);
  return a;
}

Result<optimise::CutAnswer> Cuts::answer(const StepWork& step, optimise::CutQuestion& q,
                                         std::string& let_go) {
  auto out = answer(q);
  if (!out || out->feasible || !step.open_technology || !(step.keep_speed || step.keep_feed)) return out;
  optimise::CutQuestion free = q;
  free.n_rpm.reset();
  free.feed_mm_min.reset();
  free.fz_mm.reset();
  auto other = answer(free);
  if (!other || !other->feasible) return out;
  let_go = "the stated ";
  if (step.keep_speed && q.n_rpm) let_go += "speed of " + trimmed(*q.n_rpm, 3) + " 1/min";
  if (step.keep_speed && step.keep_feed) let_go += " and ";
  if (step.keep_feed && q.feed_mm_min) let_go += "feed of " + trimmed(*q.feed_mm_min, 3) + " mm/min";
  if (step.keep_feed && q.fz_mm) let_go += "feed of " + trimmed(*q.fz_mm, 4) + " mm per tooth";
  let_go += " breaks " + (out->violated.empty() ? std::string("a limit") : out->violated.front()) +
            "; chosen anew, " + trimmed(other->n_rpm, 1) + " 1/min and " + trimmed(other->feed_mm_min, 1) +
            " mm/min";
  q = free;
  return other;
}

}  // namespace capstan::pipeline
