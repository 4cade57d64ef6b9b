#include "planner/physics/mechanics/life/life.h"

#include <cmath>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {

double taylor_factor(double x, double x0, double exponent) {
  return exponent > 0.0 && x0 > 0.0 ? std::pow(x / x0, -1.0 / exponent) : 1.0;
}

double taylor_exponent(model::Substrate substrate) {
  return substrate == model::Substrate::kCarbide ? kTaylorExponentCarbide : kTaylorExponentHss;
}

double median_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm) {
  const bool known = law.life_min > 0.0 && law.v0_m_min > 0.0 && law.n > 0.0 && v_m_min > 0.0 &&
                     (!(law.p > 0.0) || h_mm > 0.0) && (!(law.q > 0.0) || a_mm > 0.0);
  if (!known) return 0.0;
  const double life = law.life_min * taylor_factor(v_m_min, law.v0_m_min, law.n) *
                      taylor_factor(h_mm, law.h0_mm, law.p) * taylor_factor(a_mm, law.a0_mm, law.q);
  return std::isnan(life) ? 0.0 : life;
}

double scatter_of(const model::ToolLifeLaw& law) { return law.scatter > 0.0 ? law.scatter : kLifeScatter; }

}  // namespace capstan::mechanics
