#pragma once

#include <string>
#include <utility>
#include <vector>

namespace capstan::model {

/// Mechanistic coefficients of one pair of work and tool: per area of chip (c) and per length of edge (e).
struct MechanisticSet {
  std::string substrate;  ///< "carbide", "hss"
  double ktc_n_mm2 = 0.0, kte_n_mm = 0.0, krc_n_mm2 = 0.0, kre_n_mm = 0.0, kac_n_mm2 = 0.0, kae_n_mm = 0.0;
  double uncertainty = 0.0;  ///< relative, of the forces
  std::string source;
  friend bool operator==(const MechanisticSet&, const MechanisticSet&) = default;
};

/// Extended Taylor law of one pair: T = T0 (v / v0)^(-1/n) (h / h0)^(-1/p) (a / a0)^(-1/q), p or q 0: no such
/// influence.
struct ToolLifeLaw {
  std::string substrate;
  double v0_m_min = 0.0, life_min = 0.0;  ///< T0 at v0
  double h0_mm = 0.0, a0_mm = 0.0;
  double n = 0.0, p = 0.0, q = 0.0;
  double scatter = 0.0;  ///< standard deviation of ln T; 0: not known
  std::string source;
  friend bool operator==(const ToolLifeLaw&, const ToolLifeLaw&) = default;
};

/// A work material as cutting knows it. Kienzle: kc = kc1.1 h^-mc, h in mm.
struct WorkMaterial {
  std::string id;                  ///< "mild_steel"
  std::string iso_group;           ///< P, M, K, N, S, H (ISO 513)
  std::vector<std::string> names;  ///< what files call it: "ST-50", "SAE 1020", ...
  double kc11_n_mm2 = 0.0, mc = 0.0;
  double vc_hss_m_min = 0.0, vc_carbide_m_min = 0.0;  ///< roughing start values
  double tensile_strength_n_mm2 = 0.0;                ///< 0 unknown
  double hardness_hb = 0.0;                           ///< Brinell; 0 unknown
  double kc_uncertainty = 0.0;                        ///< relative, e.g. 0.3: widens the limits
  std::vector<std::pair<std::string, std::string>> sources;
  std::vector<MechanisticSet> mechanistic;  ///< measured sets, best first; empty: Kienzle alone
  std::vector<ToolLifeLaw> life;
  friend bool operator==(const WorkMaterial&, const WorkMaterial&) = default;
};

}  // namespace capstan::model
