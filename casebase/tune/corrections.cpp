#include "casebase/tune/corrections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

/// Each model is made linear and handed to `regress`:
///
///     force   ln kc = ln kc1.1 - mc ln h
///     life    ln T  = ln T0 - 1/n ln(v / v0) - 1/p ln(h / h0) - 1/q ln(a / a0), T0 of each material
///     time    ln(observed / planned) = a + b ln(block / 0.1 s)
///     bores   deviation = a + b (feed / 0.05 mm) (stick-out / 4 D)^3, of one cutter diameter
namespace capstan::casebase::tune {
namespace {

// Kienzle's exponents of steels, cast irons and light metals lie between 0.1 and 0.35 (reference tables of
// Mitsubishi and Roehm, docs/validation.md): about a quarter of that width, two std devs to either side.
constexpr double kMcSpread = 0.06;
// 1 / n of carbide: 2 to 5 (Kalpakjian & Schmid: n 0.2 to 0.5); of feed and depth about 1 and less.
constexpr double kLifeBySpeedSpread = 1.0, kLifeByFeedSpread = 0.7, kLifeByDepthSpread = 0.7;
constexpr double kForceNoise = 0.08;   // std dev of ln kc between cuts of one edge. Default, unsourced
constexpr double kForceEdges = 0.08;   // and between edges. Default, unsourced
constexpr std::size_t kLifeTerms = 4;  // life, speed, feed, depth
// Edges or parts that are left out in turn: fewer tell nothing, more take long. Default, unsourced.
constexpr std::size_t kLeastLeftOut = 3, kMostLeftOut = 300;
constexpr double kBlock0S = 0.1;  // where the time's first term counts
// Std devs of ln(observed / planned), of its slope by ln of the block's time, and of one part. Default,
// unsourced.
constexpr double kTimeSpread = 0.3, kTimeSlope = 0.3, kTimeNoise = 0.03;
// Feed per turn, and stick-out over D, where the second term of bores is one.
constexpr double kFeed0Mm = 0.05, kStickOut0 = 4.0;
// Std devs of a bore's own size, and of one part. Default, unsourced.
constexpr double kBoreSpreadMm = 0.1, kBoreNoiseMm = 0.02;
// Std dev of what bending makes there of a diameter: twice the bending of a carbide cantilever (580,000
// N/mm2, 0.8 D thick) whose two teeth cut steel (2,000 N/mm2) half a diameter deep. D cancels: 0.09 mm.
// Derived.
constexpr double kBoreBendingMm = 0.1;

bool usable(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v > 0.0; });
}

/// `own`: so many rows at the front are what is corrected; those behind them only help to tell the fit.
Corrected told(std::string model, std::vector<CorrectedTerm> terms, std::span<const Row> rows,
               const RegressionOptions& options, Regression fit, bool leave_out = true,
               std::optional<std::size_t> own = std::nullopt) {
  Corrected out;
  out.model = std::move(model);
  out.terms = std::move(terms);
  out.cases = own.value_or(rows.size());
  out.groups = fit.groups;
  if (out.cases < rows.size()) {
    std::set<std::size_t> groups;
    for (const Row& row : rows.first(out.cases)) groups.insert(row.group);
    out.groups = groups.size();
  }
  if (leave_out && out.groups >= kLeastLeftOut && fit.groups <= kMostLeftOut) {
    std::vector<LeftOut> left_out = leave_groups_out(rows, fit.coefficient.size(), options);
    left_out.resize(out.cases);
    out.left_out = {rms(left_out), coverage_90(left_out), left_out};
  }
  const auto end = fit.weight.begin() + static_cast<std::ptrdiff_t>(out.cases);
  out.doubted = static_cast<std::size_t>(
      std::count_if(fit.weight.begin(), end, [](double w) { return w < kDoubtedWeight; }));
  out.fit = std::move(fit);
  return out;
}

/// Rows on the unsafe side (1: above, -1: below) of a fit that hears what is far from all others little,
/// farther than `kBeyondChance` allows.
std::vector<std::size_t> beyond_chance(std::span<const Row> rows, std::size_t terms,
                                       RegressionOptions options, double side) {
  options.hear_above = options.hear_below = false;
  const Regression others = regress(rows, terms, options);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double off = side * (rows[i].y - others.at(rows[i].x)) / others.predictive_std_dev_at(rows[i].x);
    const double chance = 0.5 * std::erfc(off / std::numbers::sqrt2);
    if (chance * static_cast<double>(rows.size()) < kBeyondChance) out.push_back(i);
  }
  return out;
}

CorrectedTerm term(const char* name, const char* unit, const PriorTerm& before, const Regression& fit,
                   std::size_t i) {
  return {name, unit, before.mean, before.std_dev, fit.coefficient[i], fit.std_dev(i)};
}

}  // namespace

std::optional<ForceCorrection> correct_force(std::span<const ForceSample> samples,
                                             const ForceHandbook& handbook) {
  std::vector<Row> rows;
  double ln_h = 0.0;
  for (const ForceSample& s : samples) {
    if (!usable({s.chip_mm, s.kc_n_mm2})) continue;
    rows.push_back({{1.0, -std::log(s.chip_mm)}, std::log(s.kc_n_mm2), 1.0, s.group});
    ln_h += std::log(s.chip_mm);
  }
  if (rows.empty() || !usable({handbook.kc11_n_mm2, handbook.spread})) return std::nullopt;
  ln_h /= static_cast<double>(rows.size());
  // The handbook's spread is that of the force of usual chips; at h = 1 mm the exponent's adds to it.
  // Centred on the chips observed the two priors are independent.
  for (Row& row : rows) row.x[1] += ln_h;
  const RegressionOptions options{
      .prior = {{std::log(handbook.kc11_n_mm2) - handbook.mc * ln_h, std::log(handbook.spread)},
                {handbook.mc, kMcSpread}},
      .noise = kForceNoise,
      .between = kForceEdges};
  const Regression fit = regress(rows, 2, options);
  ForceCorrection out;
  out.mc = fit.coefficient[1];
  out.kc11_n_mm2 = std::exp(fit.coefficient[0] + out.mc * ln_h);
  const std::vector<double> here = {1.0, 0.0};
  out.spread = std::exp(fit.predictive_std_dev_at(here));
  const std::string at = fmt::format("ln kc at h = {:.3g} mm", std::exp(ln_h));
  out.how =
      told("cutting force",
           {term(at.c_str(), "ln N/mm2", options.prior[0], fit, 0), term("mc", "", options.prior[1], fit, 1)},
           rows, options, fit);
  return out;
}

std::optional<FactorCorrection> correct_force_factor(std::span<const ForceSample> samples,
                                                     const std::function<double(double)>& law,
                                                     double spread) {
  std::vector<Row> rows;
  std::vector<std::size_t> place;  // of each row in the samples
  double ln_h = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ForceSample& s = samples[i];
    const double expected = usable({s.chip_mm}) ? law(s.chip_mm) : 0.0;
    if (!usable({s.kc_n_mm2, expected})) continue;
    rows.push_back({{1.0}, std::log(s.kc_n_mm2 / expected), 1.0, s.group});
    place.push_back(i);
    ln_h += std::log(s.chip_mm);
  }
  if (rows.empty() || !(spread > 1.0)) return std::nullopt;
  const RegressionOptions options{
      .prior = {{0.0, std::log(spread)}}, .noise = kForceNoise, .between = kForceEdges, .hear_above = true};
  const Regression fit = regress(rows, 1, options);
  const std::vector<double> here = {1.0};
  FactorCorrection out{.factor = std::exp(fit.coefficient[0]),
                       .spread = std::exp(fit.predictive_std_dev_at(here)),
                       .ln_std_dev = fit.std_dev(0),
                       .chip_mm = std::exp(ln_h / static_cast<double>(rows.size())),
                       .cases = rows.size(),
                       .edges = fit.groups};
  for (const std::size_t row : beyond_chance(rows, 1, options, 1.0)) out.beyond.push_back(place[row]);
  return out;
}

namespace {

/// ln VB = ln c + b ln t through the readings that can be used.
struct WearCurve {
  std::size_t readings = 0;
  double most_mm = 0.0;
  Regression fit;
};
WearCurve wear_curve(std::span<const WearReading> readings) {
  std::vector<Row> rows;
  WearCurve out;
  for (const WearReading& r : readings) {
    if (!usable({r.time_min, r.wear_mm}) || r.wear_mm < kLeastReadingMm) continue;
    rows.push_back({{1.0, std::log(r.time_min)}, std::log(r.wear_mm), 1.0, rows.size()});
    out.most_mm = std::max(out.most_mm, r.wear_mm);
  }
  out.readings = rows.size();
  if (!rows.empty())
    out.fit = regress(rows, 2, {.prior = {{}, {kWearByTime, kWearByTimeSpread}}, .noise = kReadingNoise});
  return out;
}

}  // namespace

std::optional<double> life_of(std::span<const WearReading> readings, double allowed_mm) {
  const WearCurve c = wear_curve(readings);
  if (c.readings < 2 || c.most_mm < allowed_mm || !usable({allowed_mm})) return std::nullopt;
  if (c.fit.coefficient[1] <= 0.0) return std::nullopt;
  return std::exp((std::log(allowed_mm) - c.fit.coefficient[0]) / c.fit.coefficient[1]);
}

std::optional<double> wear_after(std::span<const WearReading> readings, double time_min) {
  const WearCurve c = wear_curve(readings);
  if (c.readings == 0 || !usable({time_min})) return std::nullopt;
  return std::exp(c.fit.coefficient[0] + c.fit.coefficient[1] * std::log(time_min));
}

std::optional<LifeCorrection> correct_life(std::span<const LifeSample> samples,
                                           const model::ToolLifeLaw& handbook) {
  if (!usable({handbook.v0_m_min, handbook.life_min, handbook.n})) return std::nullopt;
  model::ToolLifeLaw law = handbook;
  const auto heard = [](const LifeSample& s) {
    return usable({s.vc_m_min, s.feed_mm, s.depth_mm, s.life_min});
  };
  const auto first = std::find_if(samples.begin(), samples.end(),
                                  [&](const LifeSample& s) { return s.material == 0 && heard(s); });
  if (first == samples.end()) return std::nullopt;
  if (law.h0_mm <= 0.0) law.h0_mm = first->feed_mm;
  if (law.a0_mm <= 0.0) law.a0_mm = first->depth_mm;
  std::map<std::size_t, std::size_t> others;  // materials: their term behind the law's
  for (const LifeSample& s : samples) {
    if (s.material != 0 && heard(s)) others.emplace(s.material, kLifeTerms + others.size());
  }
  const std::size_t terms_in_all = kLifeTerms + others.size();
  std::vector<Row> rows, of_others;
  std::vector<std::size_t> place;  // of each row of the handbook's material in the samples
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const LifeSample& s = samples[i];
    if (!heard(s)) continue;
    std::vector<double> x(terms_in_all, 0.0);
    x[s.material == 0 ? 0 : others.at(s.material)] = 1.0;
    x[1] = std::log(s.vc_m_min / law.v0_m_min);
    x[2] = std::log(s.feed_mm / law.h0_mm);
    x[3] = std::log(s.depth_mm / law.a0_mm);
    (s.material == 0 ? rows : of_others).push_back({std::move(x), std::log(s.life_min), 1.0, s.group});
    if (s.material == 0) place.push_back(i);
  }
  const std::size_t own = rows.size();
  rows.insert(rows.end(), of_others.begin(), of_others.end());
  const auto slope = [](double exponent) { return exponent > 0.0 ? -1.0 / exponent : 0.0; };
  const double scatter = handbook.scatter > 0.0 ? handbook.scatter : kLifeScatter;
  const RegressionOptions options{.prior = {{std::log(handbook.life_min), kLifeSpread},
                                            {slope(handbook.n), kLifeBySpeedSpread},
                                            {slope(handbook.p), kLifeByFeedSpread},
                                            {slope(handbook.q), kLifeByDepthSpread}},
                                  .noise = scatter,
                                  .hear_below = true};
  const Regression fit = regress(rows, terms_in_all, options);
  // Life never grows with speed; what grows with feed or depth is left out of the law.
  const auto exponent = [&](std::size_t i) {
    return fit.coefficient[i] < 0.0 ? -1.0 / fit.coefficient[i] : 0.0;
  };
  law.life_min = std::exp(fit.coefficient[0]);
  law.n = fit.coefficient[1] < 0.0 ? exponent(1) : handbook.n;
  law.p = exponent(2);
  law.q = exponent(3);
  std::vector<double> here(terms_in_all, 0.0);
  here[0] = 1.0;
  law.scatter = fit.predictive_std_dev_at(here);
  std::vector<CorrectedTerm> terms;
  const char* names[] = {"ln life", "exponent of speed", "exponent of feed", "exponent of depth"};
  for (std::size_t i = 0; i < kLifeTerms; ++i)
    terms.push_back(term(names[i], i == 0 ? "ln min" : "", options.prior[i], fit, i));
  LifeCorrection out{std::move(law), told("tool life", std::move(terms), rows, options, fit, true, own)};
  out.law.source = fmt::format("{} cases on {} edges", own, out.how.groups);
  for (const std::size_t row : beyond_chance(rows, terms_in_all, options, -1.0)) {
    if (row < own) out.beyond.push_back(place[row]);
  }
  return out;
}

namespace {

std::vector<double> time_terms(double block_s) { return {1.0, std::log(block_s / kBlock0S)}; }

std::vector<double> bore_terms(double feed_per_turn_mm, double stick_out_ratio) {
  const double slender = stick_out_ratio / kStickOut0;
  return {1.0, feed_per_turn_mm / kFeed0Mm * slender * slender * slender};
}

}  // namespace

double TimeCorrection::factor(double block_s) const { return std::exp(how.fit.at(time_terms(block_s))); }
double TimeCorrection::ln_std_dev(double block_s) const {
  return how.fit.predictive_std_dev_at(time_terms(block_s));
}

std::optional<TimeCorrection> correct_time(std::span<const TimeSample> samples, bool leave_out) {
  std::vector<Row> rows;
  for (const TimeSample& s : samples) {
    if (!usable({s.planned_s, s.observed_s, s.block_s})) continue;
    rows.push_back({time_terms(s.block_s), std::log(s.observed_s / s.planned_s), 1.0, s.group});
  }
  if (rows.empty()) return std::nullopt;
  const RegressionOptions options{
      .prior = {{0.0, kTimeSpread}, {0.0, kTimeSlope}}, .noise = kTimeNoise, .between = 0.5 * kTimeNoise};
  const Regression fit = regress(rows, 2, options);
  return TimeCorrection{told("time",
                             {term("ln(observed / planned) at blocks of 0.1 s", "", options.prior[0], fit, 0),
                              term("per ln of the block's time", "", options.prior[1], fit, 1)},
                             rows, options, fit, leave_out)};
}

std::size_t slenderness_of(double stick_out_ratio) {
  return static_cast<std::size_t>(std::lround(std::log2(std::max(1.0, stick_out_ratio))));
}

double BoreCorrection::deviation_mm(double feed_per_turn_mm, double stick_out_ratio) const {
  return how.fit.at(bore_terms(feed_per_turn_mm, stick_out_ratio));
}
double BoreCorrection::std_dev_mm(double feed_per_turn_mm, double stick_out_ratio) const {
  return how.fit.predictive_std_dev_at(bore_terms(feed_per_turn_mm, stick_out_ratio),
                                       slenderness_of(stick_out_ratio));
}
double BoreCorrection::half_90_mm(double feed_per_turn_mm, double stick_out_ratio) const {
  const Regression::Kind* kind = how.fit.kind_of(slenderness_of(stick_out_ratio));
  // Bores of one part are no parts of their own: no more than the parts tell, however many bores they have.
  const double of_parts = static_cast<double>(std::max<std::size_t>(2, how.groups) - 1);
  const double freedom = kind != nullptr ? std::min(kind->freedom, of_parts) : of_parts;
  return deviations_90(freedom) * std_dev_mm(feed_per_turn_mm, stick_out_ratio);
}

std::optional<BoreCorrection> correct_bores(std::span<const BoreSample> samples, bool leave_out) {
  std::vector<Row> rows;
  for (const BoreSample& s : samples) {
    if (!usable({s.feed_per_turn_mm, s.stick_out_ratio}) || !std::isfinite(s.deviation_mm)) continue;
    rows.push_back({bore_terms(s.feed_per_turn_mm, s.stick_out_ratio), s.deviation_mm, 1.0, s.group,
                    slenderness_of(s.stick_out_ratio)});
  }
  if (rows.empty()) return std::nullopt;
  const RegressionOptions options{.prior = {{0.0, kBoreSpreadMm}, {0.0, kBoreBendingMm}},
                                  .noise = kBoreNoiseMm,
                                  .between = 0.5 * kBoreNoiseMm};
  const Regression fit = regress(rows, 2, options);
  return BoreCorrection{
      told("size of bores",
           {term("deviation of a cutter that does not bend", "mm", options.prior[0], fit, 0),
            term("bending at 0.05 mm per turn and 4 D", "mm", options.prior[1], fit, 1)},
           rows, options, fit, leave_out)};
}

model::WorkMaterial corrected(model::WorkMaterial material, const Corrections& corrections) {
  if (const auto& f = corrections.force) {
    material.kc11_n_mm2 = f->kc11_n_mm2;
    material.mc = f->mc;
    material.kc_uncertainty = f->spread - 1.0;
    const std::string from = fmt::format("{} cases on {} edges", f->how.cases, f->how.groups);
    std::erase_if(material.sources, [](const auto& s) { return s.first == "kc11_n_mm2" || s.first == "mc"; });
    material.sources.emplace_back("kc11_n_mm2", from);
    material.sources.emplace_back("mc", from);
  }
  if (const auto& l = corrections.life) {
    std::erase_if(material.life,
                  [&](const model::ToolLifeLaw& old) { return old.substrate == l->law.substrate; });
    material.life.insert(material.life.begin(), l->law);
  }
  return material;
}

}  // namespace capstan::casebase::tune
