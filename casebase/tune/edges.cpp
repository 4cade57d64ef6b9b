#include "casebase/tune/edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "casebase/recall/evidence.h"
#include "casebase/record/failing.h"
#include "casebase/tune/corrections.h"
#include "casebase/tune/from_case.h"
#include "casebase/tune/process.h"
#include "casebase/tune/regression.h"

/// The life that an edge has used is the sum over its cuts of t / T, T the life at the cut's conditions.
///
/// Derived: wear is VB = VB_end (t / T)^b with one b for all conditions. An edge that comes worn to other
/// conditions is as worn as after t' = T' (VB / VB_end)^(1/b) of them, so that t / T goes on where it stood.
/// (The same sum is known as Miner's rule, Journal of Applied Mechanics 12, 1945, A159, for fatigue.)
///
/// T is what the plan expected, times what edges of this tool class and material lived whose wear was
/// followed to its end. Where nobody followed one, the factor is 1 with the spread of a table's law. A
/// reading of the very edge says how much faster or slower it wears than that: both are joined by their
/// precisions, on the logarithm.
namespace capstan::casebase::tune {
namespace {

bool seen(const std::optional<Figure>& f) { return f && f->origin != Origin::kSimulated; }
bool positive(double v) { return std::isfinite(v) && v > 0.0; }

/// Life over what was expected of it: ln, and the std dev for one further edge.
struct Factor {
  double ln = 0.0, std_dev = 0.0;
};

using Kind = std::pair<std::string, std::string>;  // material group and tool class
Kind kind_of(const Case& c) { return {c.asked.material_group, c.asked.tool_class}; }

std::map<Kind, Factor> factors_of(std::span<const Case> cases) {
  std::map<Kind, std::vector<Row>> rows;
  std::map<std::string, std::size_t> edges;
  for (const Case& c : cases) {
    std::vector<Row>& of = rows[kind_of(c)];
    const auto life = life_of(readings_of(c.observed.wear_series_mm), kWornMm);
    if (!life || !positive(c.predicted.tool_life_min)) continue;
    std::string edge = edge_of(c.from);
    if (edge.empty()) edge = "?" + c.id;
    of.push_back({{1.0},
                  std::log(*life / c.predicted.tool_life_min),
                  1.0,
                  edges.emplace(std::move(edge), edges.size()).first->second});
  }
  std::map<Kind, Factor> out;
  const std::vector<double> one = {1.0};
  for (const auto& [kind, of] : rows) {
    const Regression fit = regress(of, 1, {.prior = {{0.0, kLifeSpread}}, .noise = kLifeScatter});
    out[kind] = {fit.at(one), fit.predictive_std_dev_at(one)};
  }
  return out;
}

/// What a reading says of ln(used), and its std dev: VB = VB_end used^b, b and the reading not sure.
Factor by_reading(double wear_mm) {
  const double ln = std::log(wear_mm / kWornMm);
  return {ln / kWearByTime,
          std::hypot(kReadingNoise / kWearByTime, ln * kWearByTimeSpread / (kWearByTime * kWearByTime))};
}

/// The wear that a case read at its end, if any.
std::optional<double> read_at_end(const Observed& o) {
  if (seen(o.wear_mm)) return o.wear_mm->value;
  const auto all = readings_of(o.wear_series_mm);
  if (all.empty()) return std::nullopt;
  return all.back().wear_mm;
}

EdgeUse use_of(const std::vector<const Case*>& cuts, const std::map<Kind, Factor>& factors) {
  EdgeUse out;
  double ln_worn = 0.0;  // how much more of its life this very edge used than expected
  double precision = 0.0;
  for (const Case* c : cuts) {
    const Observed& o = c->observed;
    const Factor& f = factors.at(kind_of(*c));
    const double life = c->predicted.tool_life_min * std::exp(f.ln);
    out.broken = out.broken || (seen(o.breakage) && o.breakage->value >= kBroken);
    const bool timed = seen(o.time_s) && positive(o.time_s->value);
    if (timed) out.cut_min += o.time_s->value / 60.0;
    if (!timed || !positive(life)) {
      ++out.unknown;
    } else {
      out.used += o.time_s->value / 60.0 / life;
      out.life_min = life;
      out.ln_std_dev = std::max(out.ln_std_dev, f.std_dev);
    }
    EdgePoint point{.cut_min = out.cut_min, .used = out.used, .wear_mm = read_at_end(o)};
    if (point.wear_mm && *point.wear_mm >= kLeastReadingMm && out.used > 0.0) {
      // The last reading tells most: those before are in it.
      const Factor read = by_reading(*point.wear_mm);
      const double ours = 1.0 / (out.ln_std_dev * out.ln_std_dev);
      const double theirs = 1.0 / (read.std_dev * read.std_dev);
      ln_worn = (read.ln - std::log(out.used)) * theirs / (ours + theirs);
      precision = ours + theirs;
    }
    out.history.push_back(point);
  }
  for (EdgePoint& p : out.history) p.used *= std::exp(ln_worn);
  out.used *= std::exp(ln_worn);
  out.life_min *= std::exp(-ln_worn);
  if (precision > 0.0) out.ln_std_dev = 1.0 / std::sqrt(precision);
  return out;
}

}  // namespace

double EdgeUse::worn_out(double more) const {
  const double by_then = used + more;
  if (!(by_then > 0.0) || !(ln_std_dev > 0.0)) return 0.0;
  return normal_probability(std::log(by_then) / ln_std_dev);
}

double EdgeUse::left_min(double deviations) const {
  return std::max(0.0, std::exp(deviations * ln_std_dev) - used) * life_min;
}

std::vector<EdgeUse> edges_of(std::span<const Case> cases) {
  const auto factors = factors_of(cases);
  std::map<std::string, std::vector<const Case*>> edges;
  std::set<std::tuple<std::string, std::string, std::string, std::string, std::string>> told;
  for (const Case& c : cases) {
    const std::string edge = edge_of(c.from);
    if (edge.empty() || c.origin == Origin::kSimulated) continue;
    if (!told.emplace(edge, c.from.source, c.from.part, c.from.workingstep, c.from.time_utc).second) continue;
    edges[edge].push_back(&c);
  }
  std::vector<EdgeUse> out;
  for (auto& [name, cuts] : edges) {
    std::stable_sort(cuts.begin(), cuts.end(), [](const Case* a, const Case* b) {
      return std::tie(a->from.time_utc, a->from.part, a->id) <
             std::tie(b->from.time_utc, b->from.part, b->id);
    });
    EdgeUse use = use_of(cuts, factors);
    const Case& last = *cuts.back();
    use.edge = name;
    use.tool = last.asked.tool_class;
    use.diameter_mm = last.asked.cutter_diameter_mm;
    use.material = last.asked.material_group;
    out.push_back(std::move(use));
  }
  return out;
}

}  // namespace capstan::casebase::tune
