#include "casebase/tune/card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "casebase/planned.h"
#include "casebase/record/failing.h"
#include "casebase/tune/advise.h"
#include "casebase/tune/applied/named.h"
#include "casebase/tune/evidence.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/specific_force.h"

namespace capstan::casebase::tune {
namespace {

bool positive(double v) { return std::isfinite(v) && v > 0.0; }
bool measured(const std::optional<Figure>& f) {
  return f && f->origin == Origin::kMeasured && positive(f->value);
}

/// What the cases of one substrate observed, edges as numbers; ids beside the samples.
struct Observations {
  std::vector<ForceSample> forces;
  std::vector<LifeSample> lives;
  std::vector<std::string> forces_of, lives_of, cut_short;
  std::vector<ForceSample> far_forces;  // at least as large at the planned feed or above
  std::vector<std::string> far_forces_of;
  std::size_t unfed = 0, far = 0;  // forces
  std::size_t unfed_lives = 0;
};

class Collector {
 public:
  explicit Collector(const model::WorkMaterial& card) : card_(card), group_(material_group_of(card)) {}

  void hear(const Case& c) {
    if (c.origin != Origin::kMeasured || c.asked.material_group != group_) return;
    const auto substrate = model::substrate_from_text(
        std::string_view(c.asked.tool_class).substr(0, c.asked.tool_class.find('/')));
    if (!substrate) return;
    Observations& to = of_[*substrate];
    // What a tool bore until it broke is no figure, but a reason not to ask more of others.
    if (cut_short(c.observed)) {
      to.cut_short.push_back(c.id);
      return;
    }
    const std::string edge = edge_of(c.from);
    if (edge.empty()) return;
    const std::size_t number = edges_.emplace(edge, edges_.size()).first->second;
    hear_force(c, *substrate, number, to);
    hear_life(c, number, to);
  }
  [[nodiscard]] const std::map<model::Substrate, Observations>& of() const { return of_; }

 private:
  /// A life is of the speed and feed that were executed.
  static void hear_life(const Case& c, std::size_t edge, Observations& to) {
    if (c.observed.wear_series_mm.origin != Origin::kMeasured) return;
    const auto life = life_of(readings_of(c.observed.wear_series_mm), kWornMm);
    if (!life) return;
    const auto &speed = c.observed.executed_vc_m_min, &fed = c.observed.executed_fz_mm;
    if (!measured(speed) || !measured(fed)) {
      ++to.unfed_lives;
      return;
    }
    to.lives.push_back({speed->value, fed->value, c.bound.ap_mm, *life, edge});
    to.lives_of.push_back(c.id);
  }

  /// A force is of the feed that was executed. Chips are as much thinner as the feed was less.
  void hear_force(const Case& c, model::Substrate substrate, std::size_t edge, Observations& to) {
    const Predicted& p = c.predicted;
    const Bound& b = c.bound;
    const auto &force = c.observed.peak_force_n, &fed = c.observed.executed_fz_mm;
    if (!measured(force) || !positive(p.peak_force_n) || !(p.force_margin >= 1.0) ||
        !positive(p.specific_force_n_mm2) || !positive(b.mean_chip_mm) || !positive(b.fz_mm))
      return;
    if (!measured(fed) || !positive(p.held_fz_mm)) {
      ++to.unfed;
      return;
    }
    const double share = fed->value / p.held_fz_mm;
    constexpr double kRounding = 1e-9;
    const bool far = !(share >= kLeastFeedShare - kRounding && share <= kMostFeedShare + kRounding);
    if (far) ++to.far;
    if (!heard_.emplace(force->value, p.peak_force_n, b.vc_m_min, b.fz_mm, fed->value, far).second) return;
    const double at = far ? std::max(share, 1.0) : share;  // a far force: no less than at the planned feed
    const double kc = p.specific_force_n_mm2 * force->value * p.force_margin / p.peak_force_n / at;
    (far ? to.far_forces : to.forces)
        .push_back({at * b.mean_chip_mm, kc / rake_share(substrate, c.asked.tool_class), edge});
    (far ? to.far_forces_of : to.forces_of).push_back(c.id);
  }

  /// Kienzle's law is the card's for a rake of 0. What a raked mill saves is in its own force: without
  /// it one factor holds for all mills, and is too much for raked ones rather than too little for others.
  [[nodiscard]] double rake_share(model::Substrate substrate, std::string_view tool_class) const {
    const auto kind = model::cutter_class_from_text(tool_class.substr(tool_class.find('/') + 1));
    if (!kind || model::measured_set(card_, substrate) != nullptr) return 1.0;
    model::Cutter cutter;
    cutter.cutter_class = *kind;
    return model::kienzle_share(card_, cutter);
  }

  const model::WorkMaterial& card_;
  std::string group_;
  std::map<std::string, std::size_t> edges_;
  std::map<model::Substrate, Observations> of_;
  std::set<std::tuple<double, double, double, double, double, bool>>
      heard_;  // copies under other names are one
};

/// ln of the factor that is taken of one that cases have; `sign` as of `judge`, `std_dev` of its logarithm.
/// `step`: ln of how far it may go the safe way by kLeastEdges edges.
double bounded(double ln_seen, double sign, double std_dev, std::size_t edges, double step) {
  if (sign * ln_seen >= 0.0) return ln_seen;
  const double freedom = edges > 1 ? static_cast<double>(edges - 1) : 1.0;
  const double by_interval = sign * ln_seen + deviations_90(freedom) * std_dev;
  const double by_count = -step * static_cast<double>(edges / kLeastEdges);
  return sign * std::min(0.0, std::max(by_interval, by_count));
}

/// Says why planning does not take a correction, if it does not. `sign`: 1 where a factor above 1 is the
/// unsafe way, as of forces; -1 where one below it is, as of lives. Against a case that the others do not
/// explain, or that was cut short, nothing is lowered or narrowed; what the others raise holds, with the
/// card's spread at least.
void judge(CardCorrection& c, double sign, double spread_believed, Given given) {
  const double ln_unsafe = sign * std::log(c.seen);  // above 0: more force, or less life, than the card
  const bool lost = given == Given::kSome;
  if (lost && ln_unsafe <= 0.0) {
    c.why_not = "nothing is lowered or narrowed while cases of the base are lost";
  } else if (!lost && c.edges < kLeastEdges) {
    c.why_not =
        fmt::format("measured on {}, and {} are needed", counted(c.edges, "edge", "edges"), kLeastEdges);
  } else if (!c.beyond.empty() && ln_unsafe <= 0.0) {
    c.why_not = "nothing is lowered or narrowed against what the others do not explain";
  } else if (!c.cut_short.empty() && ln_unsafe <= 0.0) {
    c.why_not = "nothing is lowered or narrowed where tools broke or chattered heavily";
  } else if (ln_unsafe < -kBelievedDeviations * std::log(spread_believed)) {
    c.why_not = fmt::format("further from the card than {} standard deviations of its spread",
                            trimmed(kBelievedDeviations, 1));
  }
  if (lost || !c.beyond.empty() || !c.cut_short.empty()) c.spread = std::max(c.spread, c.spread_before);
}

std::vector<std::string> at_places(const std::vector<std::string>& ids,
                                   const std::vector<std::size_t>& places) {
  std::vector<std::string> out;
  for (const std::size_t place : places) out.push_back(ids[place]);
  std::sort(out.begin(), out.end());
  return out;
}
std::vector<std::string> sorted(std::vector<std::string> ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// "0.5 to 1.1 times the planned feed".
std::string within() {
  return fmt::format("{} to {} times the planned feed", trimmed(kLeastFeedShare, 2),
                     trimmed(kMostFeedShare, 2));
}

std::optional<CardCorrection> force_of(const Observations& seen, const model::WorkMaterial& card,
                                       model::Substrate substrate, double spread, Given given) {
  const model::MechanisticSet* set = model::measured_set(card, substrate);
  const auto law = [&](double chip_mm) {
    return set != nullptr ? set->ktc_n_mm2 + set->kte_n_mm / chip_mm
                          : card.kc11_n_mm2 * std::pow(chip_mm, -card.mc);
  };
  CardCorrection out{.model = CardModel::kForce, .substrate = substrate, .law = {}, .why_not = {}};
  out.spread_before = out.spread = spread;
  out.of_what = set != nullptr ? "mills as those of its set" : "mills, as for a rake of 0";
  out.unfed = seen.unfed;
  out.far = seen.far;
  out.cut_short = sorted(seen.cut_short);
  const auto fit = correct_force_factor(seen.forces, law, spread);
  if (!fit) {
    if (seen.unfed == 0 && seen.far == 0) return std::nullopt;
    if (seen.unfed > 0)
      out.why_not =
          "no case says with which feed its force was measured and which its plan held (executed_fz_mm, "
          "predicted_held_fz_mm)";
    if (seen.far > 0)
      out.why_not += (out.why_not.empty() ? "" : "; ") + std::string("no force is left to be heard");
    return out;
  }
  out.cases = fit->cases;
  out.edges = fit->edges;
  out.seen = fit->factor;
  out.factor = std::exp(bounded(std::log(fit->factor), 1.0, fit->ln_std_dev, fit->edges, TuneOptions{}.step));
  out.spread = std::max(kLeastForceSpread, fit->spread);
  out.chip_mm = fit->chip_mm;
  out.ids = sorted(seen.forces_of);
  out.beyond = at_places(seen.forces_of, fit->beyond);
  const double most = out.seen * std::pow(out.spread, kBelievedDeviations);
  for (std::size_t i = 0; i < seen.far_forces.size(); ++i) {
    const ForceSample& far = seen.far_forces[i];
    if (far.kc_n_mm2 > most * law(far.chip_mm)) out.beyond.push_back(seen.far_forces_of[i]);
  }
  std::sort(out.beyond.begin(), out.beyond.end());
  judge(out, 1.0, spread, given);
  return out;
}

/// ln of the fitted life over the card's, where that is least: at the card's reference, or at a speed, feed
/// and depth that an edge was worn with.
struct LeastLife {
  double ln_share = 0.0, ln_std_dev = 0.0, ln_spread = 0.0;
};
LeastLife least_life(const LifeCorrection& fit, const model::ToolLifeLaw& card,
                     const std::vector<LifeSample>& lives) {
  const Regression& r = fit.how.fit;
  const auto by = [](double exponent, double ln) { return exponent > 0.0 ? -ln / exponent : 0.0; };
  const auto at = [&](const std::vector<double>& x) {
    const double of_card = std::log(card.life_min) + by(card.n, x[1]) + by(card.p, x[2]) + by(card.q, x[3]);
    return LeastLife{r.at(x) - of_card, r.std_dev_at(x), r.predictive_std_dev_at(x)};
  };
  LeastLife out = at({1.0, 0.0, 0.0, 0.0});
  for (const LifeSample& s : lives) {
    if (!positive(s.vc_m_min) || !positive(s.feed_mm) || !positive(s.depth_mm) || !positive(s.life_min))
      continue;
    const LeastLife here = at({1.0, std::log(s.vc_m_min / card.v0_m_min), std::log(s.feed_mm / fit.law.h0_mm),
                               std::log(s.depth_mm / fit.law.a0_mm)});
    if (here.ln_share < out.ln_share) out = here;
  }
  return out;
}

std::optional<CardCorrection> life_of(const Observations& seen, const model::WorkMaterial& card,
                                      model::Substrate substrate, Given given) {
  const auto law = std::find_if(card.life.begin(), card.life.end(), [&](const model::ToolLifeLaw& l) {
    return l.substrate == model::to_text(substrate) && l.life_min > 0.0;
  });
  if (law == card.life.end()) return std::nullopt;
  const auto fit = correct_life(seen.lives, *law);
  if (!fit && seen.unfed_lives == 0) return std::nullopt;
  const double scatter = law->scatter > 0.0 ? law->scatter : kLifeScatter;
  CardCorrection out{.model = CardModel::kLife, .substrate = substrate, .law = *law, .why_not = {}};
  out.of_what = "tools";
  out.unfed = seen.unfed_lives;
  out.cut_short = sorted(seen.cut_short);
  if (!fit) {
    out.why_not =
        "no case says at which speed and feed its edge was worn (executed_vc_m_min, executed_fz_mm)";
    return out;
  }
  out.cases = fit->how.cases;
  out.edges = fit->how.groups;
  const LeastLife least = least_life(*fit, *law, seen.lives);
  out.seen = std::exp(least.ln_share);
  out.factor =
      std::exp(bounded(least.ln_share, -1.0, least.ln_std_dev, out.edges, TuneOptions{}.step / law->n));
  out.law.life_min = out.factor * law->life_min;
  out.law.source = fit->law.source;
  out.spread_before = std::exp(std::hypot(kLifeSpread, scatter));
  out.spread = std::exp(least.ln_spread);
  out.ids = sorted(seen.lives_of);
  out.beyond = at_places(seen.lives_of, fit->beyond);
  judge(out, -1.0, out.spread_before, given);
  out.law.scatter = std::log(out.spread);
  return out;
}

}  // namespace

std::string CardCorrection::words() const {
  std::string out = fmt::format("{} of {} {}", model == CardModel::kForce ? "cutting force" : "life",
                                model::to_text(substrate), of_what);
  if (cases > 0)
    out += fmt::format(": cases say {} of the card's{}, spread {} instead of {} ({} on {})", trimmed(seen, 2),
                       trimmed(factor, 2) == trimmed(seen, 2) || !taken()
                           ? std::string()
                           : "; " + trimmed(factor, 2) + " is used",
                       trimmed(spread, 2), trimmed(spread_before, 2), counted(cases, "case", "cases"),
                       counted(edges, "edge", "edges"));
  if (!beyond.empty())
    out += fmt::format("; {} beyond what the others explain, as {}",
                       counted(beyond.size(), "case lies", "cases lie"), short_id(beyond.front()));
  if (!cut_short.empty())
    out += fmt::format("; {} a tool that broke or chattered heavily, as {}",
                       counted(cut_short.size(), "case is of", "cases are of"), short_id(cut_short.front()));
  if (unfed > 0)
    out += model == CardModel::kForce
               ? fmt::format("; {} not heard, for nobody says with which feed, or which the plan held",
                             counted(unfed, "force is", "forces are"))
               : fmt::format("; {} not heard, for nobody says at which speed and feed",
                             counted(unfed, "life is", "lives are"));
  return out;
}

std::string CardCorrection::far_words() const {
  if (far == 0) return {};
  return fmt::format("{} of {} {}", counted(far, "force", "forces"), model::to_text(substrate),
                     (far == 1 ? "mills was measured outside " : "mills were measured outside ") + within() +
                         (far == 1 ? " and is not used" : " and are not used"));
}

std::string CardCorrection::all_words() const { return words() + (far == 0 ? "" : "; " + far_words()); }

std::string CardCorrection::named() const {
  std::vector<std::string> shown;
  for (const std::string& id : ids) shown.push_back(short_id(id));
  return tune::named(shown);
}

std::vector<CardCorrection> card_corrections(std::span<const Case> cases, const model::WorkMaterial& card,
                                             const SpreadOf& spread_of, Given given) {
  Collector all(card);
  for (const Case& c : cases) all.hear(c);
  std::vector<CardCorrection> out;
  for (const auto& [substrate, seen] : all.of()) {
    if (auto force = force_of(seen, card, substrate, spread_of(substrate), given))
      out.push_back(*std::move(force));
    if (auto life = life_of(seen, card, substrate, given)) out.push_back(*std::move(life));
  }
  return out;
}

}  // namespace capstan::casebase::tune
