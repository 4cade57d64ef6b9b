#include "planner/physics/mechanics/bending/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

double stiffness_nmm2(const BeamSegment& s) {
  const double d2 = s.diameter_mm * s.diameter_mm;
  return s.youngs_modulus_n_mm2 * kPi * d2 * d2 / 64.0;
}

/// Adds what of from..to lies above what there is.
void add(ToolBeam& beam, double& top, double to, double diameter, double modulus) {
  if (!(to > top) || !(diameter > 0.0)) return;
  beam.segments.push_back({to - top, diameter, modulus});
  top = to;
}

double modulus_of(model::Substrate s) {
  return s == model::Substrate::kCarbide ? kCarbideYoungsModulusNMm2 : kHssYoungsModulusNMm2;
}

}  // namespace

Result<ToolBeam> beam_of(const model::Cutter& c) {
  if (auto ok = check_positive({{"cutting_diameter_mm", c.cutting_diameter_mm}}); !ok)
    return fail(ok.error());
  ToolBeam beam;
  const double modulus = modulus_of(c.substrate);
  const double d = c.cutting_diameter_mm;
  const double out = c.stick_out_mm > 0.0 ? c.stick_out_mm : std::max(c.usable_length_mm, 3.0 * d);
  const double shank = c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : d;
  const double flutes = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, out) : out;
  double top = 0.0;
  // A taper's middle: thinner below, where little bends, thicker above.
  const double lean = flutes * std::tan(model::flank_lean_rad(c));
  add(beam, top, flutes, kFluteEquivalentDiameterRatio * (d + lean), modulus);
  if (c.neck_diameter_mm > 0.0) add(beam, top, std::min(c.neck_length_mm, out), c.neck_diameter_mm, modulus);
  add(beam, top, out, shank, modulus);
  for (const model::HolderSegment& h : c.holder) {
    const double diameter = std::min(h.lower_diameter_mm, h.upper_diameter_mm);
    if (h.height_mm > 0.0 && diameter > 0.0)
      beam.segments.push_back({h.height_mm, diameter, kHolderYoungsModulusNMm2});
  }
  return beam;
}

Result<double> tip_compliance_mm_n(const model::Cutter& cutter) {
  return beam_of(cutter).map([](const ToolBeam& beam) { return bending_mm_n(beam, 0.0, 0.0); });
}

Result<double> enduring_bend_mm(const model::Cutter& cutter, double force_mm) {
  const double out =
      cutter.stick_out_mm > 0.0 ? cutter.stick_out_mm : std::numeric_limits<double>::infinity();
  const double endurance =
      cutter.substrate == model::Substrate::kCarbide ? kCarbideEnduranceNMm2 : kHssEnduranceNMm2;
  return beam_of(cutter).map([&](const ToolBeam& beam) {
    double stress_per_n = 0.0;
    double top = 0.0;
    // The first segment is that of the flutes.
    double fibre = 0.5 / kFluteEquivalentDiameterRatio;
    for (std::size_t i = 0; i + cutter.holder.size() < beam.segments.size(); ++i) {
      const BeamSegment& s = beam.segments[i];
      top += s.length_mm;
      if (top > out + 1e-9) break;
      const double moment = std::max(0.0, top - force_mm) * fibre * s.diameter_mm;
      stress_per_n = std::max(stress_per_n, moment * s.youngs_modulus_n_mm2 / stiffness_nmm2(s));
      fibre = 0.5;
    }
    const double compliance = bending_mm_n(beam, force_mm, 0.0);
    return stress_per_n > 0.0 ? endurance * compliance / stress_per_n
                              : std::numeric_limits<double>::infinity();
  });
}

double bending_mm_n(const ToolBeam& beam, double force_mm, double seen_mm) {
  const double low = std::max({force_mm, seen_mm, 0.0});
  double from = 0.0;
  double sum = 0.0;
  for (const BeamSegment& s : beam.segments) {
    const double to = from + s.length_mm;
    const double start = std::max(from, low);
    if (start < to) {
      // Antiderivative of (x - a)(x - b) about the middle: exact, without cancellation.
      const double middle = 0.5 * (start + to);
      const double half = 0.5 * (to - start);
      sum += 2.0 * half * ((middle - force_mm) * (middle - seen_mm) + half * half / 3.0) / stiffness_nmm2(s);
    }
    from = to;
  }
  return sum;
}

}  // namespace capstan::mechanics
