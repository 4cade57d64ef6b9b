#include "planner/making/optimise/cut/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/making/optimise/cut/limits.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/stability.h"

namespace capstan::optimise {

bool has_modes(const CutQuestion& q) {
  return is_milling(q.kind) && !mechanics::modes_for(q.machine, q.cutter.id).empty();
}

namespace {

/// The lobes of up and of down milling, each with the margin on its depth: kSingleToothMargin, and the law's
/// uncertainty on the force.
struct Lobes {
  std::vector<std::pair<mechanics::StabilityLobes, double>> of;
  [[nodiscard]] double depth(double n_rpm) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [lobes, margin] : of) least = std::min(least, margin * lobes.limit_mm(n_rpm));
    return least;
  }
};

/// Nothing where the machine has no modes for the cutter.
std::optional<Lobes> lobes_of(const CutQuestion& q, double ae_mm, double fz_mm) {
  if (!has_modes(q) || !(ae_mm > 0.0) || !(fz_mm > 0.0)) return std::nullopt;
  const double d = q.cutter.cutting_diameter_mm;
  const auto law = mechanics::force_law(q.material, q.cutter);
  const auto modes = mechanics::modes_for(q.machine, q.cutter.id);
  // Kienzle's law counts whole, not by its slope at a chip; as cases correct it, too.
  const bool corrected = law.mechanistic && model::kienzle_by_cases(q.material, q.cutter.substrate);
  Lobes out;
  for (const auto direction : {mechanics::CutDirection::kUp, mechanics::CutDirection::kDown}) {
    mechanics::ChatterCut cut{.arc = mechanics::immersion_arc(std::min(ae_mm, d), d, direction),
                              .teeth = teeth_of(q)};
    const double swept = std::max(cut.arc.exit_rad - cut.arc.entry_rad, 1e-6);
    const double mean = fz_mm * (std::cos(cut.arc.entry_rad) - std::cos(cut.arc.exit_rad)) / swept;
    const double kc = mechanics::specific_force_n_mm2(law.kienzle, std::max(mean, 1e-6));
    double ktc = law.mechanistic ? law.mechanistic->ktc_n_mm2 : kc;
    if (corrected) ktc += law.mechanistic->kte_n_mm / std::max(mean, 1e-6);
    cut.ktc_n_mm2 = law.uncertainty_factor * ktc;
    cut.krc_n_mm2 = law.mechanistic && !corrected ? law.uncertainty_factor * law.mechanistic->krc_n_mm2
                                                  : mechanics::kRadialToTangentialRatio * cut.ktc_n_mm2;
    auto lobes = mechanics::StabilityLobes::make(modes, cut);
    if (!lobes) return std::nullopt;
    const double engaged = cut.teeth * swept / (2.0 * std::numbers::pi);
    const bool few = engaged < mechanics::kSafeTeeth - 1e-9;
    out.of.emplace_back(*std::move(lobes), few ? mechanics::kSingleToothMargin : 1.0);
  }
  return out;
}

}  // namespace

std::optional<double> stable_depth(const CutQuestion& q, double ae_mm, double fz_mm, double n_rpm) {
  const auto lobes = lobes_of(q, ae_mm, fz_mm);
  if (!lobes) return std::nullopt;
  return lobes->depth(n_rpm);
}

std::optional<double> quiet_speed(const CutQuestion& q, double ap_mm, double ae_mm, double fz_mm,
                                  double n_rpm) {
  constexpr double kStep = 0.98;
  const auto lobes = lobes_of(q, ae_mm, fz_mm);
  if (!lobes) return std::nullopt;
  const double last = std::max({kSlowestSpeedShare * n_rpm, speeds(q).lo, 1.0});
  for (double n = std::floor(n_rpm); n >= last; n = std::floor(n * kStep)) {
    if (lobes->depth(n) >= ap_mm) return n;
  }
  return std::nullopt;
}

}  // namespace capstan::optimise
