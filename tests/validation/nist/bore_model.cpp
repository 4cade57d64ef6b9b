#include "tests/validation/nist/bore_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/stability.h"
#include "planner/physics/motion/time.h"
#include "tests/support/mechanics/wall_error.h"

namespace capstan::validation::nist {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInch = 25.4;

// What the files do not state, taken here. Material: aluminium, the coefficients of 6082-T6 (set [189] of doi
// 10.1186/s10033-021-00536-9, table 5). Cutters: carbide, two teeth, 30 degrees of helix, flutes three
// diameters long, a shank of 1/8 in. Defaults, unsourced.
constexpr mechanics::CuttingCoefficients kAluminium{631.0, 13.0, 99.0, 10.0, 273.0, 2.8};
constexpr int kTeeth = 2;
constexpr double kHelix_rad = kPi / 6.0;
constexpr double kFlutesInDiameters = 3.0;
constexpr double kShank_mm = 3.175;
constexpr double kDensity_kg_m3 = 14.5e3;  // cemented carbide; default, unsourced
constexpr double kDamping = 0.02;          // default, unsourced

mechanics::ToolBeam beam_of(double diameter_mm, double stickout_mm) {
  const double flutes = std::min(stickout_mm, kFlutesInDiameters * diameter_mm);
  mechanics::ToolBeam beam;
  beam.segments.push_back(
      {flutes, mechanics::kFluteEquivalentDiameterRatio * diameter_mm, mechanics::kCarbideYoungsModulusNMm2});
  if (stickout_mm > flutes) {
    beam.segments.push_back({stickout_mm - flutes, kShank_mm, mechanics::kCarbideYoungsModulusNMm2});
  }
  return beam;
}

/// Stiffness at the tip and first natural frequency; the mass that swings is 3 / 12.36 of a plain
/// cantilever's (k = 3 E I / L^3, w^2 = 12.36 E I / (m L^3); derived).
model::ToolPointMode mode_of(const mechanics::ToolBeam& beam, const char* direction) {
  double mass_kg = 0.0;
  for (const auto& s : beam.segments) {
    mass_kg += kDensity_kg_m3 * 0.25 * kPi * s.diameter_mm * s.diameter_mm * s.length_mm * 1e-9;
  }
  const double k = 1.0 / mechanics::bending_mm_n(beam, 0.0, 0.0);
  const double w = std::sqrt(1000.0 * k / (3.0 / 12.36 * mass_kg));
  return {.cutter_id = {},
          .direction = direction,
          .frequency_hz = w / (2.0 * kPi),
          .damping_ratio = kDamping,
          .stiffness_n_mm = k};
}

/// Mean speed in the bore, mm/s, as the machine of the calibrated times moves.
double speed_in(const Plate& plate, const MachineFit& fit, const ToolRun& run, const Programmed& p,
                double feed_ipm) {
  model::FeedSchedule schedule = run.schedule;
  std::fill(schedule.feed_mm_min.begin(), schedule.feed_mm_min.end(), kInch * feed_ipm);
  const auto t = motion::time_of(run.path, schedule, machine_of(plate, fit));
  if (!t) return std::nan("");
  double length = 0.0, time = 0.0;
  for (const std::size_t i : p.moves) {
    length += model::move_length(run.path, i);
    time += t->move_s[i];
  }
  return length / time;
}

}  // namespace

Programmed programmed(const ToolRun& run, double tool_mm, double nominal_mm) {
  Programmed out;
  for (std::size_t i = 1; i < run.path.size(); ++i) {
    if (!is_arc(run.path.kind[i]) || model::arc_sweep(run.path, i) < 3.0) continue;
    const double r = std::hypot(run.path.x[i] - run.path.cx[i], run.path.y[i] - run.path.cy[i]);
    const double drop = run.path.z[i - 1] - run.path.z[i];
    if (std::abs(tool_mm + 2.0 * r - nominal_mm) > 0.15) continue;
    out.moves.push_back(i);
    // The two half circles of a turn have radii that differ by the pitch of their spiral; level ones finish.
    if (std::abs(drop) < 1e-6) out.orbit_mm = std::max(out.orbit_mm, r);
    if (drop > 0.0) out.pitch_mm = std::max(out.pitch_mm, 2.0 * drop);
  }
  out.diameter_mm = tool_mm + 2.0 * out.orbit_mm;
  return out;
}

Prediction predict_bore(double tool_mm, double stickout_mm, const Programmed& p, double per_rev_mm,
                        double rpm) {
  const mechanics::ToolBeam beam = beam_of(tool_mm, stickout_mm);
  const auto x = mode_of(beam, "x");
  Prediction out{.stiffness_n_mm = x.stiffness_n_mm, .frequency_hz = x.frequency_hz};
  const mechanics::ImmersionArc slot{0.0, kPi};
  const auto lobes = mechanics::StabilityLobes::make(
      {x, mode_of(beam, "y")},
      {.arc = slot, .teeth = kTeeth, .ktc_n_mm2 = kAluminium.ktc_n_mm2, .krc_n_mm2 = kAluminium.krc_n_mm2});
  if (lobes) out.stable_mm = lobes->limit_mm(rpm);
  // A full slot as deep as the helix falls in a turn: the most that the edge can meet.
  const mechanics::Section section{.ap_mm = p.pitch_mm, .arc = slot};
  const mechanics::Tooth tooth{.cutting_diameter_mm = tool_mm, .helix_rad = kHelix_rad, .teeth = kTeeth};
  const mechanics::ForceLaw law{.kienzle = {}, .mechanistic = kAluminium};
  const auto wall =
      mechanics::wall_error(section, tooth, law, per_rev_mm / kTeeth, mechanics::WallSide::kRight, beam);
  out.bore_by_bending_mm = wall ? -2.0 * wall->largest_mm() : std::nan("");
  return out;
}

BoreOfRow bore_of(const Plate& plate, const MachineFit& fit, const Row& row, double nominal_mm) {
  const int number = row.time->tool;
  const auto& runs = plate.programs.at(2);
  const auto run = std::find_if(runs.begin(), runs.end(), [&](const ToolRun& r) { return r.tool == number; });
  const auto tool = std::find_if(plate.tools.begin(), plate.tools.end(),
                                 [&](const PlateTool& t) { return t.number == number; });
  BoreOfRow out;
  out.asked = programmed(*run, tool->diameter_mm, nominal_mm);
  out.speed_mm_s = speed_in(plate, fit, *run, out.asked, row.feed_ipm);
  out.per_rev_mm = 60.0 * out.speed_mm_s / row.rpm;
  out.predicted =
      predict_bore(tool->diameter_mm, row.part->long_tools ? tool->stickout_long_mm : tool->stickout_short_mm,
                   out.asked, out.per_rev_mm, row.rpm);
  return out;
}

}  // namespace capstan::validation::nist
