#include "planner/mechanics/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/mechanics/constants.h"
#include "planner/mechanics/domain.h"

namespace capstan::mechanics {

Result<SectionLoads> section_loads(const Section& section, const Tooth& tooth, const ForceLaw& law,
                                   double fz_mm, double n_rpm) {
  if (auto ok = check_positive({{"fz", fz_mm},
                                {"n", n_rpm},
                                {"cutting_diameter", tooth.cutting_diameter_mm},
                                {"teeth", static_cast<double>(tooth.teeth)}});
      !ok)
    return tl::unexpected(ok.error());
  const double swept = section.arc.exit_rad - section.arc.entry_rad;
  if (auto ok = check_range({"arc", swept}, 0.0, 2.0 * std::numbers::pi + 1e-9); !ok)
    return tl::unexpected(ok.error());
  SectionLoads out;
  if (!(section.ap_mm > 0.0) || swept <= 0.0) return out;
  const double d = tooth.cutting_diameter_mm;
  const double width = 0.5 * d * (std::cos(section.arc.entry_rad) - std::cos(section.arc.exit_rad));
  const double area = section.csa_mm2 > 0.0 ? section.csa_mm2 : section.ap_mm * width;
  const double from = section.arc.entry_rad;
  const double to = section.arc.exit_rad;
  const bool front = from <= 0.5 * std::numbers::pi && to >= 0.5 * std::numbers::pi;
  out.h_max_mm = fz_mm * (front ? 1.0 : std::max(std::sin(from), std::sin(to)));
  out.h_mean_mm = fz_mm * (std::cos(from) - std::cos(to)) / swept;
  if (!(out.h_mean_mm > 0.0)) return out;
  const double kc = specific_force_n_mm2(law.kienzle, out.h_mean_mm);
  const double ktc = law.mechanistic ? law.mechanistic->ktc_n_mm2 : kc;
  const CuttingCoefficients k =
      law.mechanistic ? *law.mechanistic
                      : CuttingCoefficients{.ktc_n_mm2 = kc, .krc_n_mm2 = kRadialToTangentialRatio * kc};
  out.mean = mean_milling_force(k, tooth.teeth, section.ap_mm, fz_mm, section.arc);
  out.peak_force_n =
      law.mechanistic
          ? peak_milling_force_n(k, tooth.teeth, section.ap_mm, fz_mm, d, tooth.helix_rad, section.arc)
          : peak_kienzle_force_n(law.kienzle, kRadialToTangentialRatio, tooth.teeth, section.ap_mm, fz_mm, d,
                                 tooth.helix_rad, 1.0, section.arc);
  out.peak = out.mean;
  const double feed = fz_mm * tooth.teeth * n_rpm;
  out.power_w = cutting_power_w(area * feed, ktc);
  out.torque_nm = spindle_torque_nm(out.power_w, n_rpm);
  out.peak_torque_nm = out.torque_nm;
  return out;
}

}  // namespace capstan::mechanics
