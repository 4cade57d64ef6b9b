#include "tests/simulated_shop/campaign.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/life/life.h"

namespace capstan::testing {
namespace {

namespace tune = casebase::tune;
using tune::Watched;

constexpr int kPartsADay = 8;
constexpr double kFloorRaUm = 0.4;  // of a milled wall, beside its feed marks. Default, unsourced

double rpm_of(const PlannedJob& j, double vc) {
  return 1000.0 * vc / (std::numbers::pi * j.question.cutter.cutting_diameter_mm);
}

double planned_s(const PlannedJob& j, double vc, double fz) {
  const double feed = rpm_of(j, vc) * j.question.cutter.teeth * fz;
  return j.job.other_s + 60.0 * j.job.length_mm / feed + 60.0 / j.job.parts_per_edge;
}

double limit_of(const PlannedJob& j, Watched w) {
  switch (w) {
    case Watched::kForce:
      return j.job.force_n;
    case Watched::kPower:
      return j.job.power_w;
    case Watched::kSize:
      return j.job.size_mm;
    case Watched::kFinish:
      return j.job.ra_um;
    case Watched::kWear:
      return j.job.wear_mm;
  }
  return 1.0;
}

double& load_of(Loads& l, Watched w) {
  switch (w) {
    case Watched::kForce:
      return l.force_n;
    case Watched::kPower:
      return l.power_w;
    case Watched::kSize:
      return l.size_mm;
    case Watched::kFinish:
      return l.ra_um;
    case Watched::kWear:
      break;
  }
  return l.wear_mm;
}

/// What the planner's models expect at its start values, and how the loads change.
void expect(PlannedJob& j, const model::StepLoads& loads) {
  const double sharp = loads.force_margin;  // the planner's loads carry the margin
  const double mc = j.question.material.mc;
  const double spread = std::log(mechanics::kForceUncertaintyFactor);
  const double worn = std::log(mechanics::kWearForceFactor);
  auto& all = j.handbook.loads;
  const auto prior = [&](Watched w, double load, double std_dev) -> tune::LoadPrior& {
    tune::LoadPrior& p = all[static_cast<std::size_t>(w)];
    p.watched = true;
    p.ln_load = {std::log(load / limit_of(j, w)), std_dev};
    return p;
  };
  tune::LoadPrior& force = prior(Watched::kForce, loads.peak_force_n / sharp, spread);
  force.by_vc = {0.0, 0.15};
  force.by_fz = {1.0 - mc, 0.15};
  force.by_wear = {worn, 0.15};
  tune::LoadPrior& power = prior(Watched::kPower, loads.power_w / sharp, spread);
  power = {true, power.ln_load, {1.0, 0.15}, {1.0 - mc, 0.15}, {worn, 0.15}, 0.1, 0.1};
  tune::LoadPrior& size = prior(Watched::kSize, loads.deflection_mm / sharp, 0.6);
  size = {true, size.ln_load, {0.0, 0.4}, {1.0 - mc, 0.3}, {worn, 0.2}, 0.2, 0.15};
  const double ra = kFloorRaUm + 257.0 * optimise::kRoughnessOverGeometry * loads.surface_rz_mm;
  tune::LoadPrior& finish = prior(Watched::kFinish, ra, 0.6);
  finish = {true, finish.ln_load, {0.0, 0.2}, {1.2, 0.5}, {0.2, 0.2}, 0.12, 0.2};
  const double use = j.job.parts_per_edge *
                     (60.0 * j.job.length_mm / (rpm_of(j, j.vc_m_min) * j.question.cutter.teeth * j.fz_mm)) /
                     60.0 / j.tables.life_min;
  tune::LoadPrior& wear = prior(Watched::kWear, use * j.job.wear_mm, 0.4);
  const double n = mechanics::kTaylorExponentCarbide;
  wear = {true, wear.ln_load, {1.0 / n - 1.0, 0.8}, {-0.4, 0.4}, {0.0, 0.05}, 0.12, mechanics::kLifeScatter};
}

/// What the shop's instruments say of a part, as a case would hold it.
tune::Evidence evidence_of(const PlannedJob& j, const tune::Setting& at, const CutPart& part,
                           const ShopEdge& edge, const std::vector<double>& wear_seen, int number) {
  tune::Evidence e;
  e.id = "part " + std::to_string(number);
  e.at = at;
  e.worn = wear_seen.size() > 1 ? wear_seen[wear_seen.size() - 2] / j.job.wear_mm : 0.0;
  e.ln_time = std::log(part.time_s / j.time_s);
  Loads seen = part.seen;
  for (std::size_t i = 0; i < tune::kWatchedCount; ++i) {
    const auto w = static_cast<Watched>(i);
    double load = std::max(1e-6, load_of(seen, w));
    if (w == Watched::kWear) {
      // What the edge's wear will be when its parts are done: evenly on after the first, which runs it in.
      const int left = j.job.parts_per_edge - edge.parts;
      if (left > 0 && edge.parts < 3) continue;
      if (left > 0) load += left * std::max(0.0, load - wear_seen.front()) / (edge.parts - 1);
    }
    e.ln_load[i] = std::log(load / limit_of(j, w));
  }
  e.failed = part.chatter_seen;
  e.source = e.id;
  e.machine = j.handbook.machine;
  e.edge = std::to_string(edge.number);
  e.day = number / kPartsADay;
  return e;
}

}  // namespace

PlannedJob drawn_job(std::uint64_t seed) {
  Draw draw(seed * 7919 + 1);
  PlannedJob j;
  optimise::CutQuestion& q = j.question;
  q.kind = optimise::CutKind::kFinish;
  auto& c = q.cutter;
  c.id = "mill";
  c.cutting_diameter_mm = c.shank_diameter_mm = draw.uniform(8.0, 14.0);
  c.maximum_depth_of_cut_mm = 2.2 * c.cutting_diameter_mm;
  c.stick_out_mm = draw.uniform(2.8, 3.6) * c.cutting_diameter_mm;
  c.teeth = draw.uniform(0.0, 1.0) < 0.5 ? 3 : 4;
  c.helix_rad = 0.52;
  c.runout_mm = 0.01;
  q.material.kc11_n_mm2 = draw.uniform(1500.0, 2200.0);
  q.material.mc = draw.uniform(0.17, 0.25);
  q.material.iso_group = "P";
  q.fz_start_mm = 0.006 * c.cutting_diameter_mm;
  c.fz_max_mm = 1.5 * q.fz_start_mm;  // a maker's range about its start value
  q.vc_start_m_min = draw.uniform(80.0, 140.0);
  auto& m = q.machine;
  m.spindle.rpm_min = 60.0;
  m.spindle.rpm_max = 10000.0;
  m.spindle.curve = {{60.0, 300.0, 47.7}, {1500.0, 7500.0, 47.7}, {10000.0, 7500.0, 0.0}};
  m.spindle.efficiency = 0.85;
  for (auto& a : m.axes) a.feed_max_mm_min = 10000.0;
  j.ap_mm = draw.uniform(0.12, 0.3) * c.cutting_diameter_mm;
  j.ae_mm = draw.uniform(0.05, 0.2) * c.cutting_diameter_mm;
  q.depth_mm = j.ap_mm;
  q.width_mm = j.ae_mm;
  q.ap_mm = j.ap_mm;
  q.ae_mm = j.ae_mm;
  // The handbook's values as the planner takes them: within all of its limits.
  Job quiet;
  const auto answer = optimise::cut(q, {}, quiet);
  if (!answer || !answer->feasible) throw std::logic_error("the drawn job has no cut");
  j.vc_m_min = answer->vc_m_min;
  j.fz_mm = answer->fz_mm;
  j.tables = {q.material.kc11_n_mm2, q.material.mc, mechanics::kLifeAtTableMin, j.vc_m_min, j.fz_mm};

  const double n = rpm_of(j, j.vc_m_min);
  const auto loads = optimise::loads_of(q, j.ap_mm, j.ae_mm, n, n * c.teeth * j.fz_mm);
  // Where a limit lies is a matter of the part: just kept by the planner's own count, or far away.
  j.job.diameter_mm = c.cutting_diameter_mm;
  j.job.helix_rad = c.helix_rad;
  j.job.ap_mm = j.ap_mm;
  j.job.ae_mm = j.ae_mm;
  j.job.teeth = c.teeth;
  j.job.length_mm = draw.uniform(1500.0, 4000.0);
  j.job.other_s = draw.uniform(10.0, 30.0);
  j.job.force_n = loads->peak_force_n * draw.uniform(1.02, 1.8);
  j.job.power_w = loads->power_w * draw.uniform(1.02, 2.0) + 200.0;  // and what the spindle takes idling
  j.job.size_mm = std::max(0.01, loads->deflection_mm * draw.uniform(1.02, 2.0));
  j.job.ra_um =
      std::max(0.8, 257.0 * optimise::kRoughnessOverGeometry * loads->surface_rz_mm * draw.uniform(1.5, 4.0));
  const double cut_min = j.job.length_mm / (n * c.teeth * j.fz_mm);
  j.job.parts_per_edge = std::max(1, static_cast<int>(0.4 * j.tables.life_min / cut_min));
  q.peak_force_limit_n = j.job.force_n;
  q.deflection_limit_mm = j.job.size_mm;
  q.surface_ra_um = j.job.ra_um;
  j.time_s = planned_s(j, j.vc_m_min, j.fz_mm);
  j.handbook.machine = "mill 1";
  j.handbook.most_fz = 1.5;
  expect(j, *loads);
  return j;
}

double planner_excess(const PlannedJob& j, const tune::Setting& at) {
  // The tuned values take the place of the start values: nothing else of the question changes.
  optimise::CutQuestion q = j.question;
  q.vc_start_m_min = j.vc_m_min * std::exp(at.ln_vc);
  q.fz_start_mm = j.fz_mm * std::exp(at.ln_fz);
  const double n = rpm_of(j, q.vc_start_m_min);
  if (n > q.machine.spindle.rpm_max) return n / q.machine.spindle.rpm_max - 1.0;
  const double chip = q.fz_start_mm / q.cutter.fz_max_mm - 1.0;
  const auto loads = optimise::loads_of(q, j.ap_mm, j.ae_mm, n, n * q.cutter.teeth * q.fz_start_mm);
  if (!loads) return 1.0;
  const double power = loads->power_w / j.job.power_w - 1.0;
  return std::max({optimise::worst_excess(q, *loads, n), chip, power});
}

Campaign run_campaign(std::uint64_t seed, Arm arm, int parts) {
  PlannedJob planned = drawn_job(seed);
  planned.handbook.hard = [&planned](const tune::Setting& s) { return 1.0 + planner_excess(planned, s); };
  HiddenShop shop(seed, planned.tables);
  tune::TuneOptions options;
  options.learner = arm == Arm::kRegression ? tune::Learner::kRegression : tune::Learner::kProcess;
  Campaign out;
  ShopEdge edge = shop.new_edge();
  std::vector<double> wear_seen;  // of this edge, part by part
  const auto change_edge = [&] {
    edge = shop.new_edge();
    wear_seen.clear();
  };
  for (int i = 0; i < parts; ++i) {
    if (i % kPartsADay == 0) shop.new_day();
    if (edge.parts >= planned.job.parts_per_edge) change_edge();
    tune::Setting at;
    if (arm != Arm::kHandbook) {
      out.last = tune::advise(out.evidence, planned.handbook, options);
      at = out.last.trial.at;
    }
    const CutPart part = shop.cut(planned.job, planned.vc_m_min * std::exp(at.ln_vc),
                                  planned.fz_mm * std::exp(at.ln_fz), edge);
    out.parts.push_back({.at = at,
                         .time_s = part.time_s,
                         .planner_excess = planner_excess(planned, at),
                         .over_force = part.truth.force_n > planned.job.force_n,
                         .over_power = part.truth.power_w > planned.job.power_w,
                         .over_size = part.truth.size_mm > planned.job.size_mm,
                         .over_finish = part.truth.ra_um > planned.job.ra_um,
                         .over_wear = part.truth.wear_mm > planned.job.wear_mm,
                         .chatter = part.chatter});
    wear_seen.push_back(part.seen.wear_mm);
    out.evidence.push_back(evidence_of(planned, at, part, edge, wear_seen, i));
    // An edge that is measured as worn out is changed.
    if (part.seen.wear_mm > planned.job.wear_mm) change_edge();
  }
  return out;
}

double Campaign::time_of_last(std::size_t count) const {
  double sum = 0.0;
  const std::size_t n = std::min(count, parts.size());
  for (std::size_t i = parts.size() - n; i < parts.size(); ++i) sum += parts[i].time_s;
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

double ArmSummary::mean_ratio() const {
  double sum = 0.0;
  for (const double r : time_ratio) sum += std::log(r);
  return time_ratio.empty() ? 1.0 : std::exp(sum / static_cast<double>(time_ratio.size()));
}

Summary run_shops(std::uint64_t first_seed, int shops, int parts) {
  Summary out{.arms = {}, .shops = shops};
  for (int i = 0; i < shops; ++i) {
    std::array<Campaign, kArmNames.size()> runs;
    for (std::size_t a = 0; a < runs.size(); ++a) {
      runs[a] = run_campaign(first_seed + static_cast<std::uint64_t>(i), static_cast<Arm>(a), parts);
    }
    const auto over = [](const Campaign& c) {
      return static_cast<int>(
          std::count_if(c.parts.begin(), c.parts.end(), [](const CampaignPart& p) { return p.over(); }));
    };
    const bool sound = over(runs[0]) <= 0.05 * parts;
    out.sound += sound ? 1 : 0;
    for (std::size_t a = 0; a < runs.size(); ++a) {
      ArmSummary& arm = out.arms[a];
      for (const CampaignPart& p : runs[a].parts) {
        if (!(p.at == tune::Setting{})) {
          arm.worst_planner_excess = std::max(arm.worst_planner_excess, p.planner_excess);
        }
      }
      const int bad = over(runs[a]);
      (sound ? arm.parts : arm.unsound_parts) += parts;
      (sound ? arm.over : arm.unsound_over) += bad;
      if (!sound) continue;
      arm.shops_over += bad > 0 ? 1 : 0;
      arm.time_ratio.push_back(runs[a].time_of_last(10) / runs[0].time_of_last(10));
      std::vector<double>& by_part = arm.ratio_by_part.emplace_back();
      for (std::size_t k = 0; k < runs[a].parts.size(); ++k) {
        by_part.push_back(runs[a].parts[k].time_s / runs[0].parts[k].time_s);
      }
    }
  }
  return out;
}

double clopper_pearson_upper(int hits, int n, double confidence) {
  if (hits >= n) return 1.0;
  const auto at_most = [&](double p) {  // P(X <= hits)
    double sum = 0.0;
    for (int k = 0; k <= hits; ++k) {
      sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                      k * std::log(p) + (n - k) * std::log1p(-p));
    }
    return sum;
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (at_most(middle) > 1.0 - confidence ? low : high) = middle;
  }
  return high;
}

}  // namespace capstan::testing
