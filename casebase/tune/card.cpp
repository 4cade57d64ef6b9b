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
#include "casebase/tune/from_case.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/specific_force.h"

namespace capstan::casebase::tune {
namespace {

bool positive(double v) { return std::isfinite(v) && v > 0.0; }
bool measured(const std::optional<Figure>& f) {
  return f && f->origin == Origin::kMeasured && positive(f->value);
}

/// What the cases of one substrate observed, edges as numbers.
struct Observations {
  std::vector<ForceSample> forces;
  std::vector<LifeSample> lives;
};

class Collector {
 public:
  explicit Collector(const model::WorkMaterial& card) : card_(card), group_(material_group_of(card)) {}

  void hear(const Case& c) {
    const std::string edge = edge_of(c.from);
    if (c.origin != Origin::kMeasured || c.asked.material_group != group_ || edge.empty()) return;
    const auto substrate = model::substrate_from_text(
        std::string_view(c.asked.tool_class).substr(0, c.asked.tool_class.find('/')));
    if (!substrate) return;
    const std::size_t number = edges_.emplace(edge, edges_.size()).first->second;
    Observations& to = of_[*substrate];
    const Predicted& p = c.predicted;
    const Bound& b = c.bound;
    const auto& force = c.observed.peak_force_n;
    if (measured(force) && positive(p.peak_force_n) && p.force_margin >= 1.0 &&
        positive(p.specific_force_n_mm2) && positive(b.mean_chip_mm) &&
        heard_.emplace(force->value, p.peak_force_n, b.vc_m_min, b.fz_mm).second) {
      const double kc = p.specific_force_n_mm2 * force->value * p.force_margin / p.peak_force_n;
      to.forces.push_back({b.mean_chip_mm, kc / rake_share(*substrate, c.asked.tool_class), number});
    }
    if (c.observed.wear_series_mm.origin != Origin::kMeasured) return;
    if (const auto life = life_of(readings_of(c.observed.wear_series_mm), kWornMm))
      to.lives.push_back({b.vc_m_min, b.fz_mm, b.ap_mm, *life, number});
  }
  [[nodiscard]] const std::map<model::Substrate, Observations>& of() const { return of_; }

 private:
  const model::WorkMaterial& card_;
  /// Kienzle's law is the card's for a rake of 0. What a raked mill saves is in its own force: without
  /// it one factor holds for all mills, and is too much for raked ones rather than too little for others.
  [[nodiscard]] double rake_share(model::Substrate substrate, std::string_view tool_class) const {
    const auto kind = model::cutter_class_from_text(tool_class.substr(tool_class.find('/') + 1));
    if (!kind || model::measured_set(card_, substrate) != nullptr) return 1.0;
    model::Cutter cutter;
    cutter.cutter_class = *kind;
    return model::kienzle_share(card_, cutter);
  }

  std::string group_;
  std::map<std::string, std::size_t> edges_;
  std::map<model::Substrate, Observations> of_;
  std::set<std::tuple<double, double, double, double>> heard_;  // copies under other names are one
};

std::string too_few(std::size_t edges) {
  return fmt::format("measured on {}, and {} are needed", counted(edges, "edge", "edges"), kLeastEdges);
}

/// Why a force so much smaller, or a life so much longer, is not believed; `safe_side`: it is the other way.
std::string beyond_belief(double factor, double spread, bool safe_side) {
  if (safe_side || std::abs(std::log(factor)) <= kBelievedDeviations * std::log(spread)) return {};
  return fmt::format("further from the card than {} standard deviations of its spread",
                     trimmed(kBelievedDeviations, 1));
}

std::optional<CardCorrection> force_of(const Observations& seen, const model::WorkMaterial& card,
                                       model::Substrate substrate, double spread) {
  const model::MechanisticSet* set = model::measured_set(card, substrate);
  const auto law = [&](double chip_mm) {
    return set != nullptr ? set->ktc_n_mm2 + set->kte_n_mm / chip_mm
                          : card.kc11_n_mm2 * std::pow(chip_mm, -card.mc);
  };
  const auto fit = correct_force_factor(seen.forces, law, spread);
  if (!fit) return std::nullopt;
  CardCorrection out{.model = CardModel::kForce,
                     .substrate = substrate,
                     .cases = fit->cases,
                     .edges = fit->edges,
                     .factor = fit->factor,
                     .spread_before = spread,
                     .spread = std::max(kLeastForceSpread, fit->spread),
                     .chip_mm = fit->chip_mm,
                     .law = {},
                     .why_not = {}};
  out.why_not =
      out.edges < kLeastEdges ? too_few(out.edges) : beyond_belief(out.factor, spread, out.factor >= 1.0);
  return out;
}

std::optional<CardCorrection> life_of(const Observations& seen, const model::WorkMaterial& card,
                                      model::Substrate substrate) {
  const auto law = std::find_if(card.life.begin(), card.life.end(), [&](const model::ToolLifeLaw& l) {
    return l.substrate == model::to_text(substrate) && l.life_min > 0.0;
  });
  if (law == card.life.end()) return std::nullopt;
  const auto fit = correct_life(seen.lives, *law);
  if (!fit) return std::nullopt;
  const double scatter = law->scatter > 0.0 ? law->scatter : kLifeScatter;
  CardCorrection out{.model = CardModel::kLife,
                     .substrate = substrate,
                     .cases = fit->how.cases,
                     .edges = fit->how.groups,
                     .factor = fit->law.life_min / law->life_min,
                     .spread_before = std::exp(std::hypot(kLifeSpread, scatter)),
                     .spread = std::exp(fit->law.scatter),
                     .chip_mm = 0.0,
                     .law = fit->law,
                     .why_not = {}};
  out.why_not = out.edges < kLeastEdges ? too_few(out.edges)
                                        : beyond_belief(out.factor, out.spread_before, out.factor <= 1.0);
  return out;
}

}  // namespace

std::string CardCorrection::words() const {
  const bool force = model == CardModel::kForce;
  return fmt::format("{} of {} {}: {} of the card's, spread {} instead of {} ({} on {})",
                     force ? "cutting force" : "life", model::to_text(substrate), force ? "mills" : "tools",
                     trimmed(factor, 2), trimmed(spread, 2), trimmed(spread_before, 2),
                     counted(cases, "case", "cases"), counted(edges, "edge", "edges"));
}

std::vector<CardCorrection> card_corrections(std::span<const Case> cases, const model::WorkMaterial& card,
                                             const SpreadOf& spread_of) {
  Collector all(card);
  for (const Case& c : cases) all.hear(c);
  std::vector<CardCorrection> out;
  for (const auto& [substrate, seen] : all.of()) {
    if (auto force = force_of(seen, card, substrate, spread_of(substrate))) out.push_back(*std::move(force));
    if (auto life = life_of(seen, card, substrate)) out.push_back(*std::move(life));
  }
  return out;
}

}  // namespace capstan::casebase::tune
