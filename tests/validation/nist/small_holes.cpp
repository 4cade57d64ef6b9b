#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/stability.h"
#include "planner/physics/motion/time.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using nist::Plate;
using nist::PlatePart;
using nist::ToolRun;

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

/// Bores of one nominal size, and who mills them.
struct Bore {
  const char* name;
  std::vector<std::string> designators;
  int tool;
  double nominal_mm;
};
const std::vector<Bore>& bores() {
  static const std::vector<Bore> all = {{"4 mm, T5, into the solid", {"DIAMETER5", "DIAMETER6"}, 5, 4.0},
                                        {"4.5 mm, T5, spotted before", {"DIAMETER4"}, 5, 4.5},
                                        {"3 mm, T1", {"DIAMETER7"}, 1, 3.0}};
  return all;
}

/// What the program asks of a bore.
struct Programmed {
  double diameter_mm = 0.0, pitch_mm = 0.0, orbit_mm = 0.0;
  std::vector<std::size_t> moves;  ///< the arcs that mill it
};

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

double mean_of(const std::vector<nist::Measured>& all, int part, const Bore& bore) {
  double sum = 0.0;
  int n = 0;
  for (const nist::Measured& m : all) {
    if (m.part != part ||
        std::find(bore.designators.begin(), bore.designators.end(), m.designator) == bore.designators.end()) {
      continue;
    }
    sum += m.value;
    ++n;
  }
  return n == 0 ? std::nan("") : sum / n;
}

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
double speed_in(const Plate& plate, const nist::MachineFit& fit, const ToolRun& run, const Programmed& p,
                double feed_ipm) {
  model::FeedSchedule schedule = run.schedule;
  std::fill(schedule.feed_mm_min.begin(), schedule.feed_mm_min.end(), kInch * feed_ipm);
  const auto t = motion::time_of(run.path, schedule, nist::machine_of(plate, fit));
  if (!t) return std::nan("");
  double length = 0.0, time = 0.0;
  for (const std::size_t i : p.moves) {
    length += model::move_length(run.path, i);
    time += t->move_s[i];
  }
  return length / time;
}

struct Prediction {
  double stiffness_n_mm = 0.0, frequency_hz = 0.0, stable_mm = 0.0;
  double bore_by_bending_mm = 0.0;  ///< change of the diameter
};

Prediction predict(double tool_mm, double stickout_mm, const Programmed& p, double per_rev_mm, double rpm) {
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

/// Exponent and correlation of ln y over ln x.
struct Power {
  double exponent = 0.0, r = 0.0;
};
Power power_of(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    n += 1.0, sx += a, sy += b, sxx += a * a, sxy += a * b, syy += b * b;
  }
  const double cov = n * sxy - sx * sy;
  return {cov / (n * sxx - sx * sx), cov / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy))};
}

}  // namespace

Comparison small_holes(const Plate& plate, const nist::TimeStudy& study,
                       const std::vector<nist::Measured>& measured) {
  Comparison out{.name = "small-holes"};
  Table rows{{"part", "stick-out", "rpm", "F, in/min", "speed in the 4 mm bore (predicted), mm/s",
              "feed per revolution there, mm", "4 mm bores: measured − programmed, mm",
              "static bending says, mm", "stable depth, mm", "4.5 mm bores, mm", "3 mm bores, mm"},
             {}};
  Table data{{"part", "long", "rpm", "per_rev", "over4", "over45", "over3", "bending", "stable"}, {}};
  Table tools{{"tool", "stick-out, mm", "stiffness at the tip, N/mm", "first frequency, Hz",
               "stable depth of a slot at 6,000 / 9,000 / 12,000 rpm, mm", "depth per turn of the helix, mm"},
              {}};
  std::vector<double> asked, real, over;
  const auto& runs = plate.programs.at(2);
  const auto run_of = [&](int tool) {
    return std::find_if(runs.begin(), runs.end(), [&](const ToolRun& r) { return r.tool == tool; });
  };
  const auto tool_of = [&](int number) {
    return std::find_if(plate.tools.begin(), plate.tools.end(),
                        [&](const nist::PlateTool& t) { return t.number == number; });
  };
  for (const int number : {5, 1}) {
    const auto tool = tool_of(number);
    const Programmed p = programmed(*run_of(number), tool->diameter_mm, number == 5 ? 4.0 : 3.0);
    for (const double stickout : {tool->stickout_short_mm, tool->stickout_long_mm}) {
      std::string stable;
      Prediction last;
      for (const double rpm : {6000.0, 9000.0, 12000.0}) {
        last = predict(tool->diameter_mm, stickout, p, 0.05, rpm);
        stable += (stable.empty() ? "" : " / ") + fixed(last.stable_mm, 3);
      }
      tools.rows.push_back({"T" + std::to_string(number), fixed(stickout, 1), fixed(last.stiffness_n_mm, 0),
                            fixed(last.frequency_hz, 0), stable, fixed(p.pitch_mm, 3)});
    }
  }
  // What the tools' own size takes off is what the stiff, short tools show: the mean over the short parts.
  double own_size = 0.0;
  int short_parts = 0;
  struct Line {
    const PlatePart* part;
    double rpm, ipm, speed, per_rev, over[3];
    Prediction p;
  };
  std::vector<Line> lines;
  for (const PlatePart& part : plate.parts) {
    const auto row = std::find_if(study.rows.begin(), study.rows.end(), [&](const nist::Row& r) {
      return r.part->part == part.part && r.time->tool == 5;
    });
    if (row == study.rows.end()) continue;
    Line line{.part = &part,
              .rpm = row->rpm,
              .ipm = row->feed_ipm,
              .speed = 0.0,
              .per_rev = 0.0,
              .over = {},
              .p = {}};
    for (std::size_t b = 0; b < 3; ++b) {
      const Bore& bore = bores()[b];
      const auto tool = tool_of(bore.tool);
      const Programmed p = programmed(*run_of(bore.tool), tool->diameter_mm, bore.nominal_mm);
      line.over[b] = mean_of(measured, part.part, bore) - p.diameter_mm;
      if (b != 0) continue;
      line.speed = speed_in(plate, study.fit, *run_of(5), p, line.ipm);
      line.per_rev = 60.0 * line.speed / line.rpm;
      line.p = predict(tool->diameter_mm, part.long_tools ? tool->stickout_long_mm : tool->stickout_short_mm,
                       p, line.per_rev, line.rpm);
    }
    if (!part.long_tools && part.part < 19) {
      own_size += line.over[0];
      ++short_parts;
    }
    lines.push_back(line);
  }
  own_size /= short_parts;
  const auto mm = [](double v) { return (v > 0.0 ? "+" : "") + fixed(v, 3); };
  for (const Line& l : lines) {
    rows.rows.push_back({std::to_string(l.part->part), l.part->long_tools ? "long" : "short", fixed(l.rpm, 0),
                         shortest(l.ipm), fixed(l.speed, 1), fixed(l.per_rev, 3), mm(l.over[0]),
                         mm(l.p.bore_by_bending_mm), fixed(l.p.stable_mm, 3), mm(l.over[1]), mm(l.over[2])});
    data.rows.push_back({std::to_string(l.part->part), l.part->long_tools ? "1" : "0", fixed(l.rpm, 0),
                         fixed(l.per_rev, 5), fixed(l.over[0], 4), fixed(l.over[1], 4), fixed(l.over[2], 4),
                         fixed(l.p.bore_by_bending_mm, 5), fixed(l.p.stable_mm, 4)});
    if (!l.part->long_tools) continue;
    asked.push_back(kInch * l.ipm / l.rpm);
    real.push_back(l.per_rev);
    over.push_back(l.over[0] - own_size);
  }
  const Power by_program = power_of(asked, over), by_motion = power_of(real, over);
  const Table fits{
      {"long stick-out: size of the 4 mm bores over that of the short one, against feed per revolution",
       "exponent", "correlation of the logarithms"},
      {{"as programmed", fixed(by_program.exponent, 2), fixed(by_program.r, 2)},
       {"as the machine moves (predicted)", fixed(by_motion.exponent, 2), fixed(by_motion.r, 2)}}};
  out.headline =
      "sizes not predicted: bending has the wrong sign; they follow the feed per revolution as the machine "
      "moves, correlation " +
      fixed(by_motion.r, 2);
  out.text = markdown(tools) + "\n" + markdown(rows) + "\n" + markdown(fits);
  out.data.emplace_back("small_holes.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
