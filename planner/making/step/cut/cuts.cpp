#include "planner/making/step/cut/cuts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/mechanics/loads/width.h"

namespace capstan::step {

const optimise::CutAnswer* KnownCuts::find(const optimise::CutQuestion& q) const {
  const auto [first, last] = answers_.equal_range(shelf_of(q));
  for (auto it = first; it != last; ++it) {
    if (it->second.first == q) return &it->second.second;
  }
  return nullptr;
}

void KnownCuts::keep(const optimise::CutQuestion& q, const optimise::CutAnswer& a) {
  answers_.emplace(shelf_of(q), std::pair(q, a));
}

/// Tells most questions apart; equal questions have equal ones.
KnownCuts::Shelf KnownCuts::shelf_of(const optimise::CutQuestion& q) {
  return {q.cutter.id, q.depth_mm, q.width_mm, q.vc_start_m_min, q.fz_start_mm, q.ae_mm.value_or(-1.0)};
}

Cuts::Cuts(KnownCuts& known, optimise::Options options, Job& job)
    : known_(known), options_(std::move(options)), job_(job) {
  options_.starts = 2;
  options_.relative_tolerance = 1e-7;
}

Result<optimise::CutAnswer> Cuts::answer(const optimise::CutQuestion& q) {
  if (const auto* known = known_.find(q)) return *known;
  auto a = optimise::cut(q, options_, job_);
  if (a) known_.keep(q, *a);
  return a;
}

optimise::CutAnswer Cuts::in_one_pass(const optimise::CutQuestion& q, optimise::CutAnswer several) {
  constexpr double kSlack = 1e-9;
  // Neighbouring passes overlap by the round part of the edge, as in toolpath/region/form/face.cpp.
  const double flat = q.cutter.cutting_diameter_mm - 2.0 * q.cutter.corner_radius_mm;
  const double widest =
      std::min(mechanics::kFaceWidthRatio * q.cutter.cutting_diameter_mm, flat) * (1.0 + kSlack);
  const bool open = !q.ae_mm && q.kind == optimise::CutKind::kRough && several.feasible;
  if (!open || !(several.ae_mm > 0.0) || several.ae_mm >= q.width_mm || q.width_mm > widest) return several;
  optimise::CutQuestion one = q;
  one.ae_mm = q.width_mm;
  const auto a = answer(one);
  if (!a || !a->feasible) return several;
  const double passes = std::ceil(q.width_mm / several.ae_mm - kSlack);
  const bool less = a->levels * several.feed_mm_min < several.levels * passes * a->feed_mm_min;
  return less ? *a : several;
}

Result<optimise::CutAnswer> Cuts::answer(const draft::StepDraft& step, optimise::CutQuestion& q,
                                         std::string& let_go) {
  auto out = answer(q);
  if (!out || out->feasible || !step.open_technology || !(step.keep_speed || step.keep_feed)) return out;
  optimise::CutQuestion free = q;
  free.n_rpm.reset();
  free.feed_mm_min.reset();
  free.fz_mm.reset();
  auto other = answer(free);
  if (!other || !other->feasible) return out;
  let_go = trimmed(other->n_rpm, 1) + " 1/min and " + trimmed(other->feed_mm_min, 1) +
           " mm/min instead of the stated ";
  if (step.keep_speed && q.n_rpm) let_go += "speed of " + trimmed(*q.n_rpm, 3) + " 1/min";
  if (step.keep_speed && step.keep_feed) let_go += " and ";
  if (step.keep_feed && q.feed_mm_min) let_go += "feed of " + trimmed(*q.feed_mm_min, 3) + " mm/min";
  if (step.keep_feed && q.fz_mm) let_go += "feed of " + trimmed(*q.fz_mm, 4) + " mm per tooth";
  let_go += step.keep_speed && step.keep_feed ? ", which break a limit" : ", which breaks a limit";
  if (!out->violated.empty()) let_go += ": " + out->violated.front();
  q = free;
  return other;
}

namespace {

/// One pass under an overhang: the width that it cuts, by how many edges of the head at once.
struct Pass {
  double width_mm = 0.0, edges = 1.0;
};

/// Its loads at a share of the answer's feed.
Result<model::StepLoads> loads_of_pass(const optimise::CutQuestion& q, const optimise::CutAnswer& a,
                                       const Pass& pass, double share) {
  auto l = optimise::loads_of(q, a.ap_mm, pass.width_mm, a.n_rpm, share * a.feed_mm_min);
  if (!l)
    return fail("PIP-INFEASIBLE", "the loads of " + q.cutter.id +
                                      " under the overhang are outside the range of the force formulas; "
                                      "state its teeth and cutting width");
  l->torque_nm *= pass.edges;
  l->power_w *= pass.edges;
  l->mrr_mm3_min *= pass.edges;
  return *l;
}

/// The largest share of the answer's feed, up to `share`, at which the pass keeps the limits.
/// Fails  PIP-INFEASIBLE where that would be less than a fiftieth, or its chips thinner than the cutter's
/// least.
Result<double> largest_share(const optimise::CutQuestion& q, const optimise::CutAnswer& a, const Pass& pass,
                             double share) {
  constexpr double kLeast = 0.02;  // of the feed; default, unsourced
  constexpr int kHalvings = 12;    // to a thousandth of the feed
  const auto holds = [&](double x) {
    const auto l = loads_of_pass(q, a, pass, x);
    return l && optimise::worst_excess(q, *l, a.n_rpm) <= 0.0;
  };
  const auto rubs = [&](double x) {
    const auto l = loads_of_pass(q, a, pass, x);
    return !l || l->chip_thickness_mm < optimise::thinnest_chip_mm(q);
  };
  double lo = share;
  if (!holds(share)) {
    double hi = share;
    lo = kLeast;
    for (int i = 0; i < kHalvings && holds(kLeast); ++i) {
      const double x = 0.5 * (lo + hi);
      (holds(x) ? lo : hi) = x;
    }
  }
  const bool held = holds(lo);
  if (held && !rubs(lo)) return lo;
  const auto l = loads_of_pass(q, a, pass, lo);
  if (!l) return tl::unexpected(l.error());
  const auto worst = optimise::worst_load(q, *l, a.n_rpm);
  const std::string limit =
      model::text_of(model::ExceededLimit{worst.name, worst.value, worst.limit, worst.unit, {}});
  return fail("PIP-INFEASIBLE",
              "under the overhang, over a width of " + trimmed(pass.width_mm, 2) + " mm, " +
                  (held ? "chips would be " + trimmed(l->chip_thickness_mm, 5) + " mm thick, at least " +
                              trimmed(optimise::thinnest_chip_mm(q), 5) + " mm" +
                              (worst.name.empty() ? "" : ", at the feed that " + limit + " allows")
                        : limit + " even at a fiftieth of the feed") +
                  "; use a smaller or a lower head, or a stiffer neck");
}

}  // namespace

Result<model::StepLoads> hold_under_overhang(const optimise::CutQuestion& q, const optimise::CutAnswer& a,
                                             double at_wall_mm, toolpath::PathJob& job) {
  if (q.slot) return a.loads;  // asked as a slot of the whole head
  if (const double last = last_width_under_overhang_mm(job, a.loads.deflection_mm); last > 0.0) {
    optimise::CutQuestion wall = q;
    wall.deflection_limit_mm = at_wall_mm;
    const auto share = largest_share(wall, a, {last, 1.0}, toolpath::kMostQuicker);
    if (!share) return tl::unexpected(share.error());
    job.last_share = *share;
  }
  if (!job.left_on_side_mm) return a.loads;
  // At no angle do the forces of both edges together exceed those of one at its worst (checked for heads of
  // 16 to 40 mm with 6 and 8 teeth, edges a twentieth to a fifth of the diameter wide).
  const Pass middle{a.ae_mm, 2.0};
  const auto both = largest_share(q, a, middle, 1.0);
  if (!both) return tl::unexpected(both.error());
  const auto front = largest_share(q, a, {q.cutter.cutting_diameter_mm, 1.0}, job.front_share);
  if (!front) return tl::unexpected(front.error());
  job.both_edges_share = *both;
  job.front_share = *front;
  return loads_of_pass(q, a, middle, job.both_edges_share);
}

}  // namespace capstan::step
