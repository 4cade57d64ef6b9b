#pragma once

#include <string>
#include <utility>
#include <vector>

namespace capstan::model {

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
  friend bool operator==(const WorkMaterial&, const WorkMaterial&) = default;
};

}  // namespace capstan::model
