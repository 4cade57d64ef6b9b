// Roughing times of pockets, ours against FreeCAD's paths, at equal limits.

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/validation/freecad/rivals.h"
#include "tests/validation/freecad/simulated.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

/// "27.4", or with what it is of ours.
std::string against(double time_s, double ours_s) {
  return fixed(time_s, 1) + " (" + fixed(ours_s / time_s, 2) + ")";
}

}  // namespace

Comparison freecad(const std::string& record, Extent extent) {
  Comparison out{.name = "freecad"};
  Table rows{{"part", "material", "ours, s", "pocket, one feed", "adaptive, one feed", "pocket, our feeds",
              "adaptive, our feeds", "which, with our feeds"},
             {}};
  int cases = 0, plain = 0, generous = 0;
  double worst_plain = 0.0, worst_generous = 0.0;
  const std::vector<RivalCase> all = rival_cases();
  // Of a sample the plain pocket of 20 mm in aluminium, and the one around a boss in C45.
  for (std::size_t i = extent == Extent::kSample ? 1 : 0; i < all.size();
       i += extent == Extent::kSample ? 8 : 1) {
    const RivalCase& c = all[i];
    const auto m = match(c, "generic_vmc");
    if (!m) {
      out.skipped = to_text(m.error());
      return out;
    }
    std::vector<std::string> cells{part_name(c), c.material, fixed(m->ours_s, 1)};
    double best[2] = {1e300, 1e300};
    for (const bool constant : {true, false}) {
      for (const bool adaptive : {false, true}) {
        const Rival* r = fastest(*m, adaptive, constant);
        if (r == nullptr) {
          out.skipped = "FreeCAD's programs are absent (tests/validation/freecad/programs)";
          return out;
        }
        const double time_s = constant ? r->constant_s : r->scheduled_s;
        best[constant ? 0 : 1] = std::min(best[constant ? 0 : 1], time_s);
        cells.push_back(against(time_s, m->ours_s));
      }
    }
    cells.push_back(fastest(*m, false, false)->name + ", " + fastest(*m, true, false)->name);
    rows.rows.push_back(std::move(cells));
    ++cases;
    if (m->ours_s <= best[0]) ++plain;
    if (m->ours_s <= best[1]) ++generous;
    worst_plain = std::max(worst_plain, m->ours_s / best[0]);
    worst_generous = std::max(worst_generous, m->ours_s / best[1]);
  }
  out.headline = "roughing not slower in " + std::to_string(plain) + " of " + std::to_string(cases) +
                 " with one feed on its paths (worst ratio " + fixed(worst_plain, 2) + "), in " +
                 std::to_string(generous) + " with our feeds on them (" + fixed(worst_generous, 2) + ")";
  const auto text = read_file(record);
  if (!text) {
    out.skipped = "no record of the simulated machine: " + text.error().message;
    return out;
  }
  Table timed{{"part", "material", "path", "simulated machine, s", "predicted, s", "error", "ours over it"},
              {}};
  std::map<std::string, double> ours;
  for (const SimulatedRoughing& s : simulated_of(*text)) {
    if (s.path == kOurs) ours[s.part + s.material] = s.measured_s;
    const double over = ours[s.part + s.material] / s.measured_s;
    timed.rows.push_back({s.part, s.material, s.path, fixed(s.measured_s, 1), fixed(s.predicted_s, 1),
                          percent(s.predicted_s / s.measured_s - 1.0),
                          s.path == kOurs ? "" : fixed(over, 2)});
  }
  if (extent == Extent::kSample) {
    out.lines = lines_of(rows);
    for (std::string& line : lines_of(timed)) out.lines.push_back(std::move(line));
    return out;
  }
  out.text = markdown(rows) + "\n" + markdown(timed);
  return out;
}

}  // namespace capstan::validation
