#include "casebase/tune/from_case.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "casebase/key/normalisation.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"

namespace capstan::casebase::tune {
namespace {

// How loads depend on speed, feed and wear before anything was cut, beside what the models say: means and std
// devs of the exponents of a load; spreads, noise and edges are std devs of ln load. All of them default,
// unsourced, unless a line says more.
constexpr double kForceExponentSpread = 0.15;                // of speed and feed
constexpr double kWornForce = 1.3, kWornForceSpread = 0.15;  // mean: Dietrich & Tschaetsch, K_ver
constexpr double kUsualShare = 0.5, kUsualSpread = 0.6;      // of size and surface in what is asked
constexpr double kSizeBySpeedSpread = 0.4, kSizeByFeedSpread = 0.3, kSizeByWearSpread = 0.2;
constexpr double kSizeNoise = 0.2, kSizeEdges = 0.15;
// Feed marks by geometry grow with f^2; what the edge tears and its floor do not.
constexpr double kRaByFeed = 1.2, kRaByFeedSpread = 0.5;
constexpr double kRaBySpeedSpread = 0.2, kRaByWear = 0.2, kRaByWearSpread = 0.2;
constexpr double kRaNoise = 0.12, kRaEdges = 0.2;
constexpr double kWearSpread = 0.4, kWearBySpeedSpread = 0.8, kWearByFeedSpread = 0.4;
constexpr double kLifeByFeed = 0.6;         // exponent of the feed in the life
constexpr double kWearByWearSpread = 0.05;  // when the edge is changed is in the load already
constexpr double kWearNoise = 0.12, kWearEdges = 0.3;
constexpr double kLeastShare = 0.02;  // of a limit: less is below what can be measured

bool evidence(const std::optional<Figure>& f) { return f && f->origin != Origin::kSimulated; }

bool positive(double v) { return std::isfinite(v) && v > 0.0; }

double limit_of(const PlannedStep& p, Watched w) {
  // A rough step leaves an allowance: size and surface are asked of the step that takes it off.
  const bool rough = p.step.asked.operation.find("ROUGH") != std::string::npos;
  if (rough && (w == Watched::kSize || w == Watched::kFinish)) return 0.0;
  switch (w) {
    case Watched::kForce:
      return p.step.predicted.peak_force_n;
    case Watched::kPower:
      return p.power_limit_w;
    case Watched::kSize:
      return 0.5 * p.step.asked.tolerance_mm;
    case Watched::kFinish:
      return p.step.asked.asked_ra_um;
    case Watched::kWear:
      return kWornMm;
  }
  return 0.0;
}

/// The wear at the end of the cut, mm; 0: not known.
double worn_after_mm(const Observed& o) {
  const std::vector<WearReading> all = readings_of(o.wear_series_mm);
  return all.empty() ? 0.0 : all.back().wear_mm;
}

/// After how much cutting at the planned values an edge is changed, min; 0: not known.
double edge_min(const PlannedStep& p) {
  return positive(p.edge_min) ? p.edge_min : kLifeUsed * p.step.predicted.tool_life_min;
}

/// The wear of a case's edge when this step's edge is changed, mm; nothing where nobody can tell.
std::optional<double> wear_at_change_mm(const Observed& o, const Setting& at, const PlannedStep& p) {
  const std::vector<WearReading> all = readings_of(o.wear_series_mm);
  // A series that begins worn has another clock than its edge.
  const bool of_edge = !all.empty() && !(all.front().time_min <= 0.0 && all.front().wear_mm > 0.0);
  const double until = edge_min(p) * std::exp(-at.ln_vc - at.ln_fz);  // the same parts take longer or less
  if (of_edge && positive(until)) {
    if (const auto wear = wear_after(all, until)) return wear;
  }
  if (evidence(o.wear_mm) && o.wear_mm->value > kWornMm) return o.wear_mm->value;
  return std::nullopt;
}

/// The edge that a case was cut with; where it is not known, an edge of its part.
std::string edge_name(const From& f) {
  const std::string edge = edge_of(f);
  return edge.empty() ? "?" + f.part + f.source : edge;
}

/// The part that a case is of; where it is not known, what its source and its time tell apart.
std::string part_name(const From& f) { return f.part.empty() ? "?" + f.source + f.time_utc : f.part; }

/// Names as numbers, in the order in which they come.
class Groups {
 public:
  std::size_t of(std::string name) {
    return numbers_.emplace(std::move(name), numbers_.size()).first->second;
  }

 private:
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

std::string edge_of(const From& f) {
  return f.tool_edge.empty() ? f.tool_instance : f.tool_instance + '/' + f.tool_edge;
}

std::vector<WearReading> readings_of(const Series& wear) {
  std::vector<WearReading> out;
  if (wear.origin == Origin::kSimulated) return out;
  for (const Sample& s : wear.samples) out.push_back({s.t_s / 60.0, s.value});
  return out;
}

std::optional<long> day_of(const std::string& time_utc) {
  int year = 0;
  unsigned month = 0, day = 0;
  const char* text = time_utc.c_str();
  if (time_utc.size() < 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const auto all = [](const char* first, const char* last, auto& into) {
    return std::from_chars(first, last, into).ptr == last;
  };
  if (!all(text, text + 4, year) || !all(text + 5, text + 7, month) || !all(text + 8, text + 10, day)) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{month},
                                         std::chrono::day{day}};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days{date}.time_since_epoch().count();
}

Handbook handbook_of(const PlannedStep& p) {
  Handbook h;
  h.machine = p.step.asked.machine_class;
  h.hard = p.hard;
  const Predicted& expected = p.step.predicted;
  const double margin = std::max(1.0, p.force_margin);
  const PriorTerm worn{std::log(kWornForce), kWornForceSpread}, by_fz{1.0 - p.mc, kForceExponentSpread};
  const auto watch = [&](Watched w, double load, double spread) -> LoadPrior& {
    LoadPrior& l = h.loads[static_cast<std::size_t>(w)];
    const double limit = limit_of(p, w);
    l.watched = positive(limit) && positive(load);
    if (l.watched) l.ln_load = {std::log(load / limit), spread};
    return l;
  };
  LoadPrior& force = watch(Watched::kForce, expected.peak_force_n / margin, std::log(p.force_spread));
  force.by_vc = {0.0, kForceExponentSpread};
  force.by_fz = by_fz;
  force.by_wear = worn;
  LoadPrior& power = watch(Watched::kPower, expected.power_w / margin, std::log(p.force_spread));
  power.by_vc = {1.0, kForceExponentSpread};
  power.by_fz = by_fz;
  power.by_wear = worn;
  LoadPrior& size = watch(Watched::kSize, kUsualShare * limit_of(p, Watched::kSize), kUsualSpread);
  size.by_vc = {0.0, kSizeBySpeedSpread};
  size.by_fz = {1.0 - p.mc, kSizeByFeedSpread};
  size.by_wear = {worn.mean, kSizeByWearSpread};
  size.noise = kSizeNoise;
  size.edges = kSizeEdges;
  LoadPrior& finish = watch(Watched::kFinish, kUsualShare * limit_of(p, Watched::kFinish), kUsualSpread);
  finish.by_vc = {0.0, kRaBySpeedSpread};
  finish.by_fz = {kRaByFeed, kRaByFeedSpread};
  finish.by_wear = {kRaByWear, kRaByWearSpread};
  finish.noise = kRaNoise;
  finish.edges = kRaEdges;
  const double used =
      positive(expected.tool_life_min) ? edge_min(p) / expected.tool_life_min : 0.0;  // of a life
  LoadPrior& wear = watch(Watched::kWear, kWornMm * std::pow(used, kWearByTime), kWearSpread);
  // As many parts at another speed: wear goes as (t / T)^b, time as 1 / (v f), life as v^(-1/n) and
  // f^-kLifeByFeed.
  wear.by_vc = {kWearByTime * (1.0 / p.taylor_n - 1.0), kWearBySpeedSpread};
  wear.by_fz = {kWearByTime * (kLifeByFeed - 1.0), kWearByFeedSpread};
  wear.by_wear = {0.0, kWearByWearSpread};
  wear.noise = kWearNoise;
  wear.needs_evidence = !positive(p.edge_min);
  wear.edges = kWearEdges;
  return h;
}

bool cut_short(const Observed& o) {
  return (evidence(o.chatter) && o.chatter->value >= kHeavyChatter) ||
         (evidence(o.breakage) && o.breakage->value >= kBroken);
}

Evidence evidence_of(const Case& c, const PlannedStep& p) {
  Evidence e;
  e.id = c.id;
  const Key theirs = key_of(c.asked), ours = key_of(p.step.asked);
  const Point a = point_of(theirs), b = point_of(ours);
  const unsigned both = theirs.known & ours.known;
  for (std::size_t i = 0; i < kDimensions; ++i)
    e.question.push_back((both >> i & 1U) != 0 ? a[i] - b[i] : 0.0);
  const double wider = positive(c.asked.cutter_diameter_mm) && positive(p.step.asked.cutter_diameter_mm)
                           ? c.asked.cutter_diameter_mm / p.step.asked.cutter_diameter_mm
                           : 1.0;
  e.at = {std::log(c.bound.vc_m_min / p.step.bound.vc_m_min),
          std::log(c.bound.fz_mm / p.step.bound.fz_mm / wider)};
  const Observed& o = c.observed;
  e.worn = std::max(0.0, worn_after_mm(o)) / kWornMm;
  const bool same_step = c.from.plan_hash == p.step.from.plan_hash &&
                         c.from.workingstep == p.step.from.workingstep && !c.from.workingstep.empty();
  if (evidence(o.time_s) && positive(o.time_s->value) && positive(p.step.predicted.time_s)) {
    const bool lengths = positive(c.bound.path_length_mm) && positive(p.step.bound.path_length_mm);
    const double longer = lengths ? c.bound.path_length_mm / p.step.bound.path_length_mm : 1.0;
    // A case without a predicted time is none of one pass over the step: the time is an edge's.
    if (lengths || (same_step && positive(c.predicted.time_s)))
      e.ln_time = std::log(o.time_s->value / longer / p.step.predicted.time_s);
  }
  const auto load = [&](Watched w, const std::optional<Figure>& f) {
    const double limit = limit_of(p, w);
    if (!evidence(f) || !positive(limit) || !std::isfinite(f->value)) return;
    // A deviation of nothing is one below what can be measured.
    e.ln_load[static_cast<std::size_t>(w)] = std::log(std::max(std::abs(f->value) / limit, kLeastShare));
  };
  load(Watched::kForce, o.peak_force_n);
  load(Watched::kPower, o.power_w);
  // Half the zone lies to either side of its middle, which the path aims at: of 20 H7 that is 20.0105 mm.
  // Where nobody says what it aims at, nobody knows how far a size is off.
  if (o.size_deviation_mm && c.bound.aimed_over_mm) {
    Figure size = *o.size_deviation_mm;
    size.value -= c.bound.aimed_over_mm->value;
    load(Watched::kSize, size);
  }
  load(Watched::kFinish, o.surface_ra_um);
  if (const auto wear = wear_at_change_mm(o, e.at, p)) load(Watched::kWear, Figure{.value = *wear});
  e.failed = o.verdict == Verdict::kBad || cut_short(o);
  e.judged = o.verdict != Verdict::kUnknown || evidence(o.chatter) || evidence(o.breakage);
  e.measured = c.origin == Origin::kMeasured;
  for (const std::string& one :
       {c.from.source, c.from.part, c.from.workingstep, c.from.time_utc, edge_of(c.from)}) {
    e.source += (e.source.empty() ? "'" : ", '") + one + "'";
  }
  e.machine = c.asked.machine_class;
  e.edge = edge_of(c.from);
  e.day = day_of(c.from.time_utc);
  return e;
}

bool mills_bore(const Question& q) {
  const bool round = positive(q.diameter_mm) && !positive(q.width_mm);
  return round && q.operation.ends_with("MILLING") && q.feature.find("THREAD") == std::string::npos;
}

bool finishes_bore(const Case& step) {
  const bool finishes =
      step.asked.operation.find("FINISH") != std::string::npos || !(step.bound.allowance_side_mm > 0.0);
  return finishes && mills_bore(step.asked);
}

std::vector<TimeSample> times_of(std::span<const Case> cases) {
  std::vector<TimeSample> out;
  Groups parts;
  for (const Case& c : cases) {
    tick();
    if (c.origin != Origin::kMeasured || c.observed.verdict == Verdict::kBad || cut_short(c.observed))
      continue;
    const auto& time = c.observed.time_s;
    if (!evidence(time) || !positive(c.predicted.time_s) || c.bound.path_blocks <= 0) continue;
    out.push_back({c.predicted.time_s, time->value, c.predicted.time_s / c.bound.path_blocks,
                   parts.of(part_name(c.from))});
  }
  return out;
}

namespace {

std::optional<BoreSample> bore_of(const Case& c, Groups& parts) {
  const auto& size = c.observed.size_deviation_mm;
  if (cut_short(c.observed)) return std::nullopt;
  if (c.origin != Origin::kMeasured || !mills_bore(c.asked) || !evidence(size)) return std::nullopt;
  if (!positive(c.asked.cutter_diameter_mm) || !c.bound.aimed_over_mm) return std::nullopt;
  return BoreSample{size->value - c.bound.aimed_over_mm->value, c.bound.fz_mm * std::max(1, c.asked.teeth),
                    c.asked.stick_out_mm / c.asked.cutter_diameter_mm, parts.of(part_name(c.from))};
}

}  // namespace

std::vector<BoreSample> bores_of(std::span<const Case> cases) {
  std::vector<BoreSample> out;
  Groups parts;
  for (const Case& c : cases) {
    tick();
    if (const auto bore = bore_of(c, parts)) out.push_back(*bore);
  }
  return out;
}

bool same_cutter(const Question& a, const Question& b) {
  const auto [least, most] = std::minmax(a.cutter_diameter_mm, b.cutter_diameter_mm);
  return most <= (1.0 + kSameDiameter) * least;
}

std::map<double, std::vector<BoreSample>> bores_by_cutter(std::span<const Case> cases) {
  std::vector<std::pair<const Question*, BoreSample>> bores;
  Groups parts;
  for (const Case& c : cases) {
    tick();
    if (const auto bore = bore_of(c, parts)) bores.emplace_back(&c.asked, *bore);
  }
  std::stable_sort(bores.begin(), bores.end(), [](const auto& a, const auto& b) {
    return a.first->cutter_diameter_mm < b.first->cutter_diameter_mm;
  });
  std::map<double, std::vector<BoreSample>> out;
  const Question* smallest = nullptr;
  for (const auto& [asked, bore] : bores) {
    if (smallest == nullptr || !same_cutter(*smallest, *asked)) smallest = asked;
    out[smallest->cutter_diameter_mm].push_back(bore);
  }
  return out;
}

Corrections corrections_of(std::span<const Case> cases, const CorrectionHandbook& handbook,
                           std::span<const Case> others) {
  std::vector<ForceSample> forces;
  std::vector<LifeSample> lives;
  Groups edges;
  for (const Case& c : cases) {
    if (c.origin != Origin::kMeasured) continue;
    const std::size_t edge = edges.of(edge_name(c.from));
    const Observed& o = c.observed;
    const Bound& b = c.bound;
    if (evidence(o.peak_force_n) && positive(c.predicted.peak_force_n) && positive(b.mean_chip_mm)) {
      // A case of an older record does not say what its plan's forces were computed with.
      const Predicted& p = c.predicted;
      const bool told = p.force_margin >= 1.0 && positive(p.specific_force_n_mm2);
      const double expected = p.peak_force_n / (told ? p.force_margin : handbook.force_margin);
      const double kc = told ? p.specific_force_n_mm2
                             : handbook.force.kc11_n_mm2 * std::pow(b.mean_chip_mm, -handbook.force.mc);
      forces.push_back({b.mean_chip_mm, kc * o.peak_force_n->value / expected, edge});
    }
    if (const auto life = life_of(readings_of(o.wear_series_mm), kWornMm))
      lives.push_back({b.vc_m_min, b.fz_mm, b.ap_mm, *life, edge});
  }
  Groups materials;
  for (const Case& c : others) {
    if (c.origin != Origin::kMeasured) continue;
    if (const auto life = life_of(readings_of(c.observed.wear_series_mm), kWornMm))
      lives.push_back({c.bound.vc_m_min, c.bound.fz_mm, c.bound.ap_mm, *life, edges.of(edge_name(c.from)),
                       1 + materials.of(c.asked.material_group)});
  }
  Corrections out{correct_force(forces, handbook.force),
                  correct_life(lives, handbook.life),
                  correct_time(times_of(cases)),
                  {}};
  for (const auto& [cutter, samples] : bores_by_cutter(cases)) {
    auto bores = correct_bores(samples);
    if (!bores) continue;
    bores->how.model += " by a cutter of " + trimmed(cutter, 3) + " mm";
    out.bores.emplace(cutter, *std::move(bores));
  }
  return out;
}

}  // namespace capstan::casebase::tune
