#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/ground/base/number.h"
#include "tests/validation/nist/bore_model.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using nist::Plate;
using nist::PlatePart;
using nist::Prediction;
using nist::Programmed;
using nist::programmed;
using nist::ToolRun;

constexpr double kInch = 25.4;

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
        last = nist::predict_bore(tool->diameter_mm, stickout, p, 0.05, rpm);
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
      const nist::BoreOfRow at = nist::bore_of(plate, study.fit, *row, bore.nominal_mm);
      line.speed = at.speed_mm_s;
      line.per_rev = at.per_rev_mm;
      line.p = at.predicted;
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
