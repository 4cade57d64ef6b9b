#include "planner/physics/mechanics/life/life.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace capstan::mechanics {
namespace {

/// (x / x0)^(-1/e); 1 where the law knows no such influence.
double influence(double x, double x0, double e) {
  return e > 0.0 && x0 > 0.0 ? std::pow(x / x0, -1.0 / e) : 1.0;
}

}  // namespace

model::ToolLifeLaw life_law(const model::WorkMaterial& material, const model::Cutter& cutter) {
  const auto it = std::find_if(material.life.begin(), material.life.end(), [&](const auto& law) {
    return law.substrate == model::to_text(cutter.substrate) && law.life_min > 0.0;
  });
  if (it != material.life.end()) return *it;
  const bool carbide = cutter.substrate == model::Substrate::kCarbide;
  model::ToolLifeLaw law;
  law.substrate = model::to_text(cutter.substrate);
  law.v0_m_min = carbide ? material.vc_carbide_m_min : material.vc_hss_m_min;
  law.life_min = cutter.life_min > 0.0 ? cutter.life_min : kLifeAtTableMin;
  law.n = carbide ? kTaylorExponentCarbide : kTaylorExponentHss;
  law.source = cutter.life_min > 0.0 ? "the cutter's stated life at the table's speed, textbook exponent"
                                     : "default, unsourced: 15 min at the table's speed, textbook exponent";
  return law;
}

double median_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm) {
  const bool known = law.life_min > 0.0 && law.v0_m_min > 0.0 && law.n > 0.0 && v_m_min > 0.0 &&
                     (!(law.p > 0.0) || h_mm > 0.0) && (!(law.q > 0.0) || a_mm > 0.0);
  if (!known) return 0.0;
  const double life = law.life_min * influence(v_m_min, law.v0_m_min, law.n) *
                      influence(h_mm, law.h0_mm, law.p) * influence(a_mm, law.a0_mm, law.q);
  return std::isnan(life) ? 0.0 : life;
}

double scatter_of(const model::ToolLifeLaw& law) { return law.scatter > 0.0 ? law.scatter : kLifeScatter; }

double mean_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm) {
  const double s = scatter_of(law);
  return median_life_min(law, v_m_min, h_mm, a_mm) * std::exp(0.5 * s * s);
}

double sure_life_min(const model::ToolLifeLaw& law, double confidence, double v_m_min, double h_mm,
                     double a_mm) {
  if (!(confidence > 0.0 && confidence < 1.0)) return 0.0;
  const double life =
      median_life_min(law, v_m_min, h_mm, a_mm) * std::exp(-normal_quantile(confidence) * scatter_of(law));
  return std::isnan(life) ? 0.0 : life;
}

double normal_quantile(double share) {
  if (!(share > 0.0)) return -std::numeric_limits<double>::infinity();
  if (!(share < 1.0)) return std::numeric_limits<double>::infinity();
  double low = -40.0;
  double high = 40.0;
  constexpr int kHalvings = 100;
  for (int i = 0; i < kHalvings; ++i) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::numbers::sqrt2) < share ? low : high) = z;
  }
  return 0.5 * (low + high);
}

double edge_cost_per_min(const EdgeCost& cost, double life_min) {
  if (!(life_min > 0.0)) return std::numeric_limits<double>::infinity();
  return (cost.edge + cost.machine_per_min * cost.change_min) / life_min;
}

}  // namespace capstan::mechanics
