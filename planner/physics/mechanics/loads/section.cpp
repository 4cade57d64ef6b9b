#include "planner/physics/mechanics/loads/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"
#include "planner/physics/mechanics/loads/edge_loads.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr double kSteepestHelixRad = 1.3962634015954636;  // 80 degrees: tan stays moderate
constexpr double kMostTeeth = 1000.0;                     // so that no sum over teeth is endless
constexpr double kMostLagRad = 1000.0;                    // 160 turns of an edge: no cutter
constexpr double kMostInCut = 10'000.0;                   // teeth and turns of their edges: memory has an end
constexpr double kFlattestLeadRad = 1.5;                  // 86 degrees

bool is_plunge(const ImmersionArc& arc) { return arc.exit_rad - arc.entry_rad >= 2.0 * kPi - 1e-6; }

SectionLoads plunge_loads(const Section& s, const Tooth& t, const ForceLaw& law, double fz, double n) {
  SectionLoads out;
  const double d = t.cutting_diameter_mm;
  const double disc = 0.25 * kPi * d * d;
  const double area = s.csa_mm2 > 0.0 ? std::min(s.csa_mm2, disc) : disc;
  const double kc = law.mechanistic ? law.mechanistic->ktc_n_mm2 + law.mechanistic->kte_n_mm / fz
                                    : specific_force_n_mm2(law.kienzle, fz);
  out.h_max_mm = out.h_mean_mm = fz;
  out.power_w = cutting_power_w(area * fz * t.teeth * n, kc);
  out.torque_nm = spindle_torque_nm(out.power_w, n);
  out.peak_torque_nm = out.torque_nm;
  out.mean.fz_n = out.peak.fz_n = -kDrillThrustFactor * kc * fz * t.teeth * 0.5 * d;
  const double one_tooth = kc * fz * 0.5 * d;
  out.peak_force_n = one_tooth * std::hypot(1.0, kRadialToTangentialRatio);
  out.peak.fx_n = out.peak.fy_n = out.peak_force_n;
  return out;
}

/// The feed at which an even cutter has the thickest chip of one that runs out.
double widened_feed(double fz, double runout_mm, int teeth, double front_sin) {
  if (!(runout_mm > 0.0) || !(front_sin > 0.0)) return fz;
  const double shift = runout_mm * std::sin(kPi / teeth);
  return std::min(fz + shift / front_sin, fz * teeth);
}

ForceVector scaled(const ForceVector& f, double k) { return {f.fx_n * k, f.fy_n * k, f.fz_n * k}; }

Status check_feed(double fz, double n) { return check_positive({{"fz_mm", fz}, {"n_rpm", n}}); }

}  // namespace

Status check_shape(const Section& s, const Tooth& t, const ForceLaw& law) {
  constexpr double kMost = 1e9;
  if (auto ok = check_positive(
          {{"cutting_diameter_mm", t.cutting_diameter_mm}, {"teeth", static_cast<double>(t.teeth)}});
      !ok)
    return ok;
  for (const Named& v : {Named{"ap_mm", s.ap_mm}, Named{"csa_mm2", s.csa_mm2},
                         Named{"from_tip_mm", s.from_tip_mm}, Named{"band_mm", s.band_mm},
                         Named{"corner_radius_mm", t.corner_radius_mm}, Named{"runout_mm", t.runout_mm}})
    if (auto ok = check_range(v, 0.0, kMost); !ok) return ok;
  if (auto ok = check_range({"helix_rad", std::abs(t.helix_rad)}, 0.0, kSteepestHelixRad); !ok) return ok;
  if (auto ok = check_range({"lead_angle_rad", t.lead_angle_rad + t.taper_angle_rad}, 0.0, kFlattestLeadRad);
      !ok)
    return ok;
  if (auto ok = check_range({"entry_rad", s.arc.entry_rad}, -kMost, kMost); !ok) return ok;
  if (auto ok = check_range({"arc", s.arc.exit_rad - s.arc.entry_rad}, 0.0, 2.0 * kPi + 1e-9); !ok) return ok;
  if (auto ok = check_range({"teeth", static_cast<double>(t.teeth)}, 1.0, kMostTeeth); !ok) return ok;
  const double lag = helix_lag_rad(s.ap_mm, t.cutting_diameter_mm, std::abs(t.helix_rad));
  if (auto ok = check_range({"lag of the helix, rad", lag}, 0.0, kMostLagRad); !ok) return ok;
  if (auto ok = check_range({"teeth in the cut", t.teeth * (1.0 + lag / (2.0 * kPi))}, 0.0, kMostInCut); !ok)
    return ok;
  if (law.mechanistic) {
    const CuttingCoefficients& k = *law.mechanistic;
    if (auto ok = check_positive({{"ktc_n_mm2", k.ktc_n_mm2}}); !ok) return ok;
    for (const Named& v :
         {Named{"kte_n_mm", k.kte_n_mm}, Named{"krc_n_mm2", k.krc_n_mm2}, Named{"kre_n_mm", k.kre_n_mm},
          Named{"kac_n_mm2", k.kac_n_mm2}, Named{"kae_n_mm", k.kae_n_mm}})
      if (auto ok = check_range(v, 0.0, kMost); !ok) return ok;
    return {};
  }
  if (auto ok = check_positive({{"kc11_n_mm2", law.kienzle.kc11_n_mm2}}); !ok) return ok;
  return check_range({"mc", law.kienzle.mc}, 0.0, 0.999);
}

namespace {

/// The edge that is in a section.
struct EdgeIn {
  bool plunge = false;
  bool nothing = true;  ///< no engagement: no loads
  Pieces all;
  double ratio = 1.0;  ///< of the area to what the edge sweeps
};

Result<EdgeIn> edge_in(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  if (auto ok = check_shape(section, tooth, law); !ok) return fail(ok.error());
  EdgeIn out;
  if (is_plunge(section.arc)) {
    out.plunge = true;
    out.nothing = !(section.ap_mm > 0.0) && !(section.csa_mm2 > 0.0);
    return out;
  }
  const Contact contact = contact_of(section, tooth.cutting_diameter_mm);
  if (!(contact.ap > 0.0) || !(contact.arc.exit_rad > contact.arc.entry_rad)) return out;
  out.all = met_by(section, contact, tooth);
  if (out.all.count == 0 || !(out.all.area > 0.0)) {
    if (!(section.csa_mm2 > 0.0)) return out;
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = "an area of " + told(section.csa_mm2) + " mm2 at a depth of " +
                                      told(contact.ap) + " mm where no edge is",
                           .path = "csa_mm2",
                           .expected = "an area that the edge can sweep"});
  }
  out.nothing = false;
  out.ratio = section.csa_mm2 > 0.0 ? section.csa_mm2 / out.all.area : 1.0;
  return out;
}

/// The thickest chip of an even cutter over the feed per tooth.
double over_feed(const EdgeIn& edge) { return edge.ratio > 1.0 + kIrregular ? 1.0 : edge.all.max_chip; }

}  // namespace

Result<ThickestChip> ThickestChip::of(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  const auto edge = edge_in(section, tooth, law);
  if (!edge) return fail(edge.error());
  ThickestChip out;
  out.plunge_ = edge->plunge;
  out.nothing_ = edge->nothing;
  out.runout_mm_ = tooth.runout_mm;
  out.teeth_ = tooth.teeth;
  out.front_sin_ = edge->all.front_sin;
  out.over_feed_ = over_feed(*edge);
  return out;
}

double ThickestChip::at_mm(double fz_mm) const {
  if (nothing_) return 0.0;
  return plunge_ ? fz_mm : widened_feed(fz_mm, runout_mm_, teeth_, front_sin_) * over_feed_;
}

/// What is asked of a section at any feed.
struct SectionAtFeeds::Shape {
  struct Plunge {
    Section section;
    Tooth tooth;
    ForceLaw law;
  };
  bool nothing = true;  ///< no engagement: no loads
  std::unique_ptr<const Plunge> plunge;
  int teeth = 0;
  double runout_mm = 0.0, front_sin = 0.0;
  double over_feed = 0.0;             ///< the thickest chip of an even cutter, over the feed per tooth
  double mean_over_feed = 0.0;        ///< the mean chip likewise
  double more = 1.0;                  ///< by which all grows whose area is more than the edge sweeps
  double less = 1.0;                  ///< by which the torque of chips changes with the area
  double kc11_n_mm2 = 0.0, mc = 0.0;  ///< 0: of a law by measured coefficients
  EdgeLoads edge;

  /// The factor of forces that grow with the chip.
  [[nodiscard]] double chips(double fz) const {
    return kc11_n_mm2 > 0.0 ? kc11_n_mm2 * std::pow(fz, 1.0 - mc) : fz;
  }
};

Result<SectionAtFeeds> SectionAtFeeds::of(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  const auto edge = edge_in(section, tooth, law);
  if (!edge) return fail(edge.error());
  auto made = std::make_shared<Shape>();
  Shape& shape = *made;
  SectionAtFeeds out;
  out.shape_ = made;
  shape.nothing = edge->nothing;
  if (edge->nothing) return out;
  if (edge->plunge) {
    shape.plunge = std::make_unique<const Shape::Plunge>(Shape::Plunge{section, tooth, law});
    return out;
  }
  const Pieces& all = edge->all;
  shape.teeth = tooth.teeth;
  shape.runout_mm = tooth.runout_mm;
  shape.front_sin = all.front_sin;
  shape.over_feed = over_feed(*edge);
  shape.more = std::max(edge->ratio, 1.0);
  if (!law.mechanistic) {
    shape.kc11_n_mm2 = law.kienzle.kc11_n_mm2;
    shape.mc = law.kienzle.mc;
  }
  shape.less = edge->ratio < 1.0 ? std::pow(edge->ratio, 1.0 - shape.mc) : edge->ratio;
  double mean_chip = 0.0;
  for (std::size_t i = 0; i < all.count; ++i)
    mean_chip += all.item[i].depth * (std::cos(all.item[i].from) - std::cos(all.item[i].to));
  shape.mean_over_feed = mean_chip / all.edge_arc;
  shape.edge = edge_loads(all, law, tooth);
  return out;
}

Result<SectionLoads> SectionAtFeeds::at(double fz_mm, double n_rpm) const {
  if (auto ok = check_feed(fz_mm, n_rpm); !ok) return fail(ok.error());
  const Shape& s = *shape_;
  SectionLoads out;
  if (s.nothing) return out;
  if (s.plunge) return plunge_loads(s.plunge->section, s.plunge->tooth, s.plunge->law, fz_mm, n_rpm);
  const double chip = s.chips(fz_mm);
  const MomentAtFeeds& mean = s.edge.mean;
  out.mean = scaled(mean.at(chip).force, s.more);
  out.torque_nm = 1e-3 * (s.less * chip * mean.chip.torque_nmm + s.more * mean.edge.torque_nmm);
  out.power_w = out.torque_nm * 2.0 * kPi * n_rpm / 60.0;

  const double widened = widened_feed(fz_mm, s.runout_mm, s.teeth, s.front_sin);
  const Peak peak = s.edge.peak_at(widened != fz_mm ? s.chips(widened) : chip);
  out.peak = scaled(peak.force, s.more);
  out.peak_force_n = s.more * std::sqrt(peak.plane_sq);
  out.peak_torque_nm = std::max(1e-3 * s.more * peak.torque_nmm, out.torque_nm);
  out.h_max_mm = widened * s.over_feed;
  out.h_mean_mm = fz_mm * s.mean_over_feed;
  return out;
}

}  // namespace capstan::mechanics
