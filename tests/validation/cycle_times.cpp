#include <map>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

/// Simulated time of a pocket of the reference's size at one feed of 600 mm/min by another planner (FreeCAD)
/// on the same simulated machine, s; stated with the aims of this comparison, not measured here.
constexpr double kOtherPlanner_s = 260.0;
constexpr double kWanted = 0.05;

struct Time {
  std::string program, step;
  double measured_s = 0.0, predicted_s = 0.0;
};

std::vector<Time> read(const std::string& text) {
  std::vector<Time> out;
  for (const auto& cells : cells_of(text)) {
    const auto measured = cells.size() == 4 ? parse_double(cells[2]) : std::nullopt;
    if (measured) out.push_back({cells[0], cells[1], *measured, parse_double(cells[3]).value_or(0.0)});
  }
  return out;
}

const char* name_of(const std::string& program) {
  if (program == "bracket") return "examples/bracket.p21";
  if (program == "surface") return "examples/surface.stl, EN AW-6061";
  if (program == "pocket-scheduled") return "reference pocket, scheduled feeds";
  if (program == "pocket-constant") return "reference pocket, one feed per step";
  return "";
}

}  // namespace

Comparison cycle_times(const std::string& file) {
  Comparison out{.name = "cycle-times"};
  const auto text = read_file(file);
  if (!text) {
    out.skipped = "no record of the simulated machine: " + text.error().message;
    return out;
  }
  Table rows{{"program", "simulated machine, s", "predicted, s", "error", "steps", "largest error of a step"},
             {}};
  Table data{{"measured", "predicted", "program"}, {}};
  std::map<std::string, double> whole;
  std::vector<double> of_steps, of_programs;

  for (const Time& t : read(*text)) {
    if (t.predicted_s <= 0.0) {
      whole[t.program + " " + t.step] = t.measured_s;
      continue;
    }
    const double error = t.predicted_s / t.measured_s - 1.0;
    data.rows.push_back({fixed(t.measured_s, 3), fixed(t.predicted_s, 3),
                         t.step == "all"
                             ? "9"
                             : std::to_string(t.program.starts_with("pocket") ? 2 : t.program == "surface")});
    if (t.step != "all") {
      of_steps.push_back(error);
      continue;
    }
    of_programs.push_back(error);
    const Spread s = spread_of(of_steps, kWanted);
    rows.rows.push_back({name_of(t.program), fixed(t.measured_s, 1), fixed(t.predicted_s, 1), percent(error),
                         std::to_string(s.n), percent(s.worst)});
    whole[t.program] = t.measured_s;
    of_steps.clear();
  }
  const double scheduled = whole["pocket-scheduled"], constant = whole["pocket-constant"];
  Table aims{{"reference pocket", "reached", "aimed at"}, {}};
  const double one_feed = whole["pocket-one-feed all"];
  if (scheduled > 0.0 && constant > 0.0) {
    aims.rows.push_back({"simulated time, scheduled over the best constant feed of each step",
                         fixed(scheduled / constant, 3), "≤ 0.6"});
  }
  if (scheduled > 0.0 && one_feed > 0.0) {
    aims.rows.push_back({"the same over one feed for the whole program, " +
                             fixed(whole["pocket-one-feed feed_mm_min"], 1) +
                             " mm/min, what its plunge bears",
                         fixed(scheduled / one_feed, 3), "(≤ 0.6)"});
  }
  if (scheduled > 0.0) {
    aims.rows.push_back({"simulated time over the 260 s of another planner at F600",
                         fixed(scheduled / kOtherPlanner_s, 3), "≤ 0.4"});
  }
  const Spread programs = spread_of(of_programs, kWanted);
  out.headline = std::to_string(programs.within) + " of " + std::to_string(programs.n) +
                 " programs within 5 % of LinuxCNC's simulated machine, worst " + percent(programs.worst);
  out.text = markdown(rows) + "\n" + markdown(aims);
  out.data.emplace_back("cycle_times.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
