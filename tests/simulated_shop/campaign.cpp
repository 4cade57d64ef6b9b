#include "tests/simulated_shop/campaign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "casebase/tune/card.h"
#include "casebase/tune/regression.h"
#include "planner/model/plan/resources/specific_force.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::testing {
namespace {

namespace tune = casebase::tune;
using tune::Watched;

constexpr int kPartsADay = 8;

double rpm_of(const PlannedJob& j, double vc) {
  return 1000.0 * vc / (std::numbers::pi * j.question.cutter.cutting_diameter_mm);
}

double planned_cut_s(const PlannedJob& j, double vc, double fz) {
  return 60.0 * j.job.length_mm / (rpm_of(j, vc) * j.question.cutter.teeth * fz);
}

double planned_s(const PlannedJob& j, double vc, double fz) {
  return j.job.other_s + planned_cut_s(j, vc, fz) + 60.0 / j.job.parts_per_edge;
}

/// The step as planning would keep it, for the shipped functions to make a handbook of.
void plan_step(PlannedJob& j, const model::StepLoads& loads) {
  tune::PlannedStep& p = j.planned;
  casebase::Case& c = p.step;
  c.asked.operation = "SIDE_FINISH_MILLING";
  c.asked.material_group = "P/steel";
  c.asked.tool_class = "carbide/endmill";
  c.asked.machine_class = "mill_1";
  c.asked.depth_mm = j.ap_mm;
  c.asked.width_mm = j.ae_mm;
  c.asked.cutter_diameter_mm = j.question.cutter.cutting_diameter_mm;
  c.asked.teeth = j.question.cutter.teeth;
  c.asked.stick_out_mm = j.question.cutter.stick_out_mm;
  c.asked.tolerance_mm = 2.0 * j.job.size_mm;
  c.asked.asked_ra_um = j.job.ra_um;
  c.bound.vc_m_min = j.vc_m_min;
  c.bound.fz_mm = j.fz_mm;
  c.bound.path_length_mm = j.job.length_mm;
  c.predicted.time_s = j.time_s;
  c.predicted.peak_force_n = loads.peak_force_n;
  c.predicted.power_w = loads.power_w;
  c.predicted.tool_life_min = j.tables.life_min;
  c.predicted.force_margin = loads.force_margin;
  c.predicted.held_fz_mm = j.fz_mm;  // a schedule of one feed
  c.bound.aimed_over_mm = casebase::Figure{.value = 0.0, .origin = casebase::Origin::kSimulated};
  c.bound.ae_mm = j.ae_mm;
  // Of the chord: cos(phi) = 1 - 2 ae / D, hm = fz (1 - cos(phi)) / phi.
  const double cosine = 1.0 - 2.0 * j.ae_mm / j.question.cutter.cutting_diameter_mm;
  c.bound.mean_chip_mm = j.fz_mm * (1.0 - cosine) / std::acos(cosine);
  c.predicted.specific_force_n_mm2 =
      model::specific_force_n_mm2(j.question.material, j.question.cutter, c.bound.mean_chip_mm);
  p.force_margin = loads.force_margin;  // the planner's loads carry it
  p.force_spread = mechanics::kForceUncertaintyFactor;
  p.power_limit_w = j.job.power_w;
  p.mc = j.question.material.mc;
  p.taylor_n = mechanics::kTaylorExponentCarbide;
  p.edge_min = j.job.parts_per_edge * planned_cut_s(j, j.vc_m_min, j.fz_mm) / 60.0;
}

/// What the shop's instruments say of a part, as a case holds it.
casebase::Case case_of(const PlannedJob& j, const tune::Setting& at, const CutPart& part,
                       const ShopEdge& edge, const casebase::Series& wear_seen, int number) {
  casebase::Case c = j.planned.step;
  c.id = "part " + std::to_string(number);
  c.origin = casebase::Origin::kMeasured;
  c.bound.vc_m_min *= std::exp(at.ln_vc);
  c.bound.fz_mm *= std::exp(at.ln_fz);
  c.predicted.held_fz_mm = c.bound.fz_mm;
  const auto figure = [](double v) { return casebase::Figure{.value = v}; };
  c.observed.time_s = figure(part.time_s);
  c.observed.peak_force_n = figure(part.seen.force_n);
  c.observed.executed_fz_mm = figure(c.bound.fz_mm);
  c.observed.executed_vc_m_min = figure(c.bound.vc_m_min);
  c.observed.power_w = figure(part.seen.power_w);
  c.observed.size_deviation_mm = figure(part.seen.size_mm);
  c.observed.surface_ra_um = figure(part.seen.ra_um);
  c.observed.wear_mm = figure(part.seen.wear_mm);
  c.observed.wear_series_mm = wear_seen;
  c.observed.chatter = figure(part.chatter_seen ? 1.0 : 0.0);
  c.from.part = std::to_string(number);
  c.from.source = "log";
  c.from.tool_instance = std::to_string(edge.number);
  // ISO 8601: day 1 is the first of January; no campaign is longer than that month.
  const std::string day = std::to_string(101 + number / kPartsADay);
  c.from.time_utc = "2026-01-" + day.substr(1) + "T08:00:00Z";
  return c;
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
  q.material.id = "steel";
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
  plan_step(j, *loads);
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
  planned.planned.hard = [&planned](const tune::Setting& s) { return 1.0 + planner_excess(planned, s); };
  const tune::Handbook handbook = tune::handbook_of(planned.planned);
  HiddenShop shop(seed, planned.tables);
  tune::TuneOptions options;
  options.learner = arm == Arm::kRegression ? tune::Learner::kRegression : tune::Learner::kProcess;
  Campaign out;
  ShopEdge edge = shop.new_edge();
  casebase::Series wear_seen{.samples = {{0.0, 0.0}}};  // of this edge, part by part
  const auto change_edge = [&] {
    edge = shop.new_edge();
    wear_seen.samples = {{0.0, 0.0}};
  };
  for (int i = 0; i < parts; ++i) {
    if (i % kPartsADay == 0) shop.new_day();
    if (edge.parts >= planned.job.parts_per_edge) change_edge();
    tune::Setting at;
    if (arm != Arm::kHandbook) {
      out.last = tune::advise(out.evidence, handbook, options);
      at = out.last.trial.at;
    }
    const Said said = out.last.another_cut    ? Said::kAgainst
                      : at == tune::Setting{} ? Said::kHandbook
                                              : Said::kOwn;
    out.doubted = out.doubted || out.last.lowered;
    const CutPart part = shop.cut(planned.job, planned.vc_m_min * std::exp(at.ln_vc),
                                  planned.fz_mm * std::exp(at.ln_fz), edge);
    out.parts.push_back({.at = at,
                         .said = said,
                         .stated = std::min(1.0, out.last.trial.probability),
                         .time_s = part.time_s,
                         .planner_excess = planner_excess(planned, at),
                         .over_force = part.truth.force_n > planned.job.force_n,
                         .over_power = part.truth.power_w > planned.job.power_w,
                         .over_size = part.truth.size_mm > planned.job.size_mm,
                         .over_finish = part.truth.ra_um > planned.job.ra_um,
                         .over_wear = part.truth.wear_mm > planned.job.wear_mm,
                         .chatter = part.chatter});
    const double cut_s =
        planned_cut_s(planned, planned.vc_m_min * std::exp(at.ln_vc), planned.fz_mm * std::exp(at.ln_fz));
    wear_seen.samples.push_back({wear_seen.samples.back().t_s + cut_s, part.seen.wear_mm});
    out.evidence.push_back(
        tune::evidence_of(case_of(planned, at, part, edge, wear_seen, i), planned.planned));
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

Tally& Tally::operator+=(const Tally& other) {
  parts += other.parts;
  over += other.over;
  stated += other.stated;
  return *this;
}

Tally ShopOutcome::all() const {
  Tally out;
  for (const Tally& t : by) out += t;
  return out;
}

Tally ArmSummary::of(Said said) const {
  Tally out;
  for (const ShopOutcome& shop : shops) out += shop.of(said);
  return out;
}

Tally ArmSummary::all() const {
  Tally out;
  for (const ShopOutcome& shop : shops) out += shop.all();
  return out;
}

std::vector<Tally> ArmSummary::by_shop(Said said) const {
  std::vector<Tally> out;
  for (const ShopOutcome& shop : shops) {
    if (shop.of(said).parts > 0) out.push_back(shop.of(said));
  }
  return out;
}

std::vector<double> ArmSummary::time_ratios(bool undoubted) const {
  std::vector<double> out;
  for (const ShopOutcome& shop : shops) {
    if (!undoubted || !shop.doubted) out.push_back(shop.time_ratio);
  }
  return out;
}

double geometric_mean(const std::vector<double>& ratios) {
  double sum = 0.0;
  for (const double r : ratios) sum += std::log(r);
  return ratios.empty() ? 1.0 : std::exp(sum / static_cast<double>(ratios.size()));
}

Summary run_shops(std::uint64_t first_seed, int shops, int parts) {
  Summary out;
  for (int i = 0; i < shops; ++i) {
    out.seeds.push_back(first_seed + static_cast<std::uint64_t>(i));
    Campaign handbook;
    for (std::size_t a = 0; a < kArmNames.size(); ++a) {
      Campaign run = run_campaign(out.seeds.back(), static_cast<Arm>(a), parts);
      if (a == 0) handbook = run;
      ArmSummary& arm = out.arms[a];
      ShopOutcome& shop = arm.shops.emplace_back();
      shop.time_ratio = run.time_of_last(10) / handbook.time_of_last(10);
      shop.doubted = run.doubted;
      for (std::size_t k = 0; k < run.parts.size(); ++k) {
        const CampaignPart& p = run.parts[k];
        shop.by[static_cast<std::size_t>(p.said)] += {1, p.over() ? 1 : 0, p.stated};
        shop.ratio_by_part.push_back(p.time_s / handbook.parts[k].time_s);
        if (!(p.at == tune::Setting{}))
          arm.worst_planner_excess = std::max(arm.worst_planner_excess, p.planner_excess);
      }
    }
  }
  return out;
}

ForceForecasts forecast_forces(std::uint64_t first_seed, int shops) {
  constexpr int kFirstEdges = 4, kFurtherEdges = 10, kMostParts = 3;
  ForceForecasts out{.shops = shops};
  for (int i = 0; i < shops; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const PlannedJob planned = drawn_job(seed);
    HiddenShop shop(seed, planned.tables);
    const int parts = std::min(kMostParts, planned.job.parts_per_edge);
    std::vector<casebase::Case> cases;
    for (int k = 0; k < kFirstEdges; ++k) {
      ShopEdge edge = shop.new_edge();
      for (int part = 0; part < parts; ++part) {
        // As operators do: turned down, as planned, turned up. What was commanded is the plan's.
        constexpr std::array<double, kMostParts> kOverride = {0.8, 1.0, 1.1};
        const double fz_mm = kOverride.at(static_cast<std::size_t>(part)) * planned.fz_mm;
        const CutPart cut = shop.cut(planned.job, planned.vc_m_min, fz_mm, edge);
        cases.push_back(case_of(planned, {}, cut, edge, {}, k * parts + part));
        cases.back().observed.executed_fz_mm = casebase::Figure{.value = fz_mm};
      }
    }
    const model::WorkMaterial& card = planned.question.material;
    const mechanics::ForceMargin by_card = mechanics::force_margin(card, model::Substrate::kCarbide);
    const auto found = tune::card_corrections(cases, card, [&](model::Substrate) { return by_card.spread; });
    if (found.empty() || !found.front().taken() || !found.front().cut_short.empty()) continue;
    ++out.taken;
    const tune::CardCorrection& by = found.front();
    mechanics::ForceMargin by_cases = by_card;
    by_cases.spread = by.spread;
    const double expected = planned.planned.step.predicted.peak_force_n / planned.planned.force_margin;
    const double seen = expected * by.seen;
    // The set that planning makes of it is Kienzle's law for no rake.
    const double held =
        expected * by.factor / model::kienzle_share(card, planned.question.cutter) * by_cases.factor();
    double truth = 0.0;
    int cuts = 0;
    for (int k = 0; k < kFurtherEdges; ++k) {
      ShopEdge edge = shop.new_edge();
      for (int part = 0; part < parts; ++part) {
        const double force_n = shop.cut(planned.job, planned.vc_m_min, planned.fz_mm, edge).truth.force_n;
        ++cuts;
        truth += std::log(force_n);
        out.over_card += force_n > expected * by_card.factor() ? 1 : 0;
        out.over_cases += force_n > held ? 1 : 0;
        if (part > 0) continue;
        ++out.sharp;
        constexpr double kTwoSided90 = 1.645;
        out.within_90 += std::abs(std::log(force_n / seen)) <= kTwoSided90 * std::log(by.spread) ? 1 : 0;
      }
    }
    out.cuts += cuts;
    out.ln_held_card.push_back(std::log(expected * by_card.factor()) - truth / cuts);
    out.ln_held_cases.push_back(std::log(held) - truth / cuts);
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

double upper_by_shops(const std::vector<Tally>& shops) {
  const auto n = static_cast<double>(shops.size());
  if (n < 2.0) return 1.0;
  Tally all;
  for (const Tally& t : shops) all += t;
  double square = 0.0;
  for (const Tally& t : shops) square += std::pow(t.over - all.share() * t.parts, 2.0);
  const double error = std::sqrt(square * n / (n - 1.0)) / all.parts;
  return all.share() + tune::deviations_90(n - 1.0) * error;  // 90 % between both sides: 95 % below
}

}  // namespace capstan::testing
