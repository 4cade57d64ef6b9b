// How long plans take against a catalogue's rates of removal: all of tests/sweep as recorded, and a sample
// planned now.
//
// The catalogue's time knows neither power nor force, bending or corners (tests/sweep/catalogue.cpp has its
// rules and their sources), so that no plan is to reach it everywhere; it tells plans that were held from
// those that were not. The sample: on each machine each of the twelve features is planned once, and each of
// the twelve materials met once.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/sweep/sweep.h"
#include "tests/validation/catalogue/record.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using catalogue::Row;
using testing::sweep::Case;
using testing::sweep::kMachines;
using testing::sweep::kMaterials;

std::string name_of(const Row& r) { return r.feature + ", " + r.material + ", " + r.machine; }

/// What was planned of some cases.
struct Group {
  int planned = 0, asked = 0;
  std::vector<double> ratios;
  double worst = 0.0;
  std::string worst_case;
  int rings = 0, constant = 0;  ///< plans whose areas are cleared so, where both ways were tried
  void add(const Row& r) {
    ++asked;
    if (r.clearing == "rings" || r.clearing == "both") ++rings;
    if (r.clearing == "constant engagement" || r.clearing == "both") ++constant;
    if (r.whole()) ++planned;
    if (!(r.ratio() > 0.0)) return;
    ratios.push_back(r.ratio());
    if (r.ratio() <= worst) return;
    worst = r.ratio();
    worst_case = name_of(r);
  }
};

/// The least value that this share of all does not exceed.
double quantile(std::vector<double> v, double share) {
  if (v.empty()) return 0.0;
  std::sort(v.begin(), v.end());
  const auto at = static_cast<std::size_t>(share * static_cast<double>(v.size() - 1) + 0.5);
  return v[at];
}

/// A figure with so many decimals, or a dash where there is none.
std::string figure(double v, int decimals) { return v > 0.0 ? fixed(v, decimals) : "-"; }

std::vector<std::string> plan_row(const Row& r) {
  return {name_of(r), figure(r.plan_s, 1), figure(r.catalogue_s, 1), figure(r.ratio(), 2),
          r.whole() ? "" : std::to_string(r.not_made)};
}

std::vector<std::string> group_row(const std::string& name, const Group& g) {
  const auto two = [](double v) { return figure(v, 2); };
  return {name,
          std::to_string(g.asked),
          std::to_string(g.planned),
          two(quantile(g.ratios, 0.5)),
          two(quantile(g.ratios, 0.9)),
          two(g.worst),
          g.worst_case.empty() ? "-" : g.worst_case};
}

/// The record by machine and by group of materials, and its distribution.
struct Told {
  Group all;
  Table table{{"machine or group", "plans", "whole", "median", "9 of 10 below", "worst", "which"}, {}};
  Table data{{"machine", "ratio", "share"}, {}};
  Table clearing{{"group", "both ways tried", "rings taken", "constant engagement taken"}, {}};
};

Told told(const std::vector<Row>& record) {
  Told out;
  std::map<std::string, Group> machines, materials;
  for (const Row& r : record) {
    out.all.add(r);
    machines[r.machine].add(r);
    for (const auto& m : kMaterials)
      if (r.material == m.name) materials[m.group].add(r);
  }
  for (std::size_t k = 0; k < std::size(kMachines); ++k) {
    const Group& g = machines[kMachines[k]];
    out.table.rows.push_back(group_row(kMachines[k], g));
    std::vector<double> sorted = g.ratios;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
      out.data.rows.push_back({std::to_string(k), fixed(sorted[i], 4),
                               fixed(static_cast<double>(i + 1) / static_cast<double>(sorted.size()), 4)});
  }
  for (const char* group : {"P", "M", "K", "N", "S", "H", "plastic"}) {
    out.table.rows.push_back(group_row(group, materials[group]));
    const Group& g = materials[group];
    out.clearing.rows.push_back(
        {group, std::to_string(g.rings + g.constant), std::to_string(g.rings), std::to_string(g.constant)});
  }
  return out;
}

}  // namespace

Comparison catalogue_times(const std::string& file, Extent extent) {
  constexpr std::size_t kEvery = 4;  // of the sample, for a test
  Comparison out{.name = "catalogue-times"};
  const auto text = read_file(file);
  if (!text) {
    out.skipped = "no record of the sweep: " + text.error().message;
    return out;
  }
  const std::vector<Row> record = catalogue::read(*text);
  const Told all = told(record);
  const std::vector<Case> cases = testing::sweep::each_once_per_machine();
  testing::sweep::Sweep sweep;
  Table plans{{"feature, material, machine", "plan, s", "catalogue, s", "plan over it", "features not made"},
              {}};
  std::string apart;
  for (std::size_t i = 0; i < cases.size(); i += extent == Extent::kSample ? kEvery : 1) {
    const Row now = catalogue::row_of(cases[i], sweep.plan(cases[i]));
    plans.rows.push_back(plan_row(now));
    const auto recorded = catalogue::row_for(record, cases[i]);
    const std::string why = recorded ? catalogue::apart(*recorded, now) : "not recorded";
    if (!why.empty()) apart += "Apart from the record: " + name_of(now) + ": " + why + ".\n";
  }
  if (extent == Extent::kSample) {
    out.lines = lines_of(all.table);
    for (std::string& line : lines_of(all.clearing)) out.lines.push_back(std::move(line));
    for (std::string& line : lines_of(plans)) out.lines.push_back(std::move(line));
    // The test of the document fails at such a line.
    if (!apart.empty()) out.lines.push_back(apart);
    return out;
  }
  out.text = markdown(all.table) + "\n" + markdown(all.clearing) + "\n" + markdown(plans) +
             (apart.empty() ? "" : "\n" + apart);
  out.data.emplace_back("catalogue_times.dat", columns(all.data));
  out.headline = std::to_string(all.all.planned) + " of " + std::to_string(all.all.asked) +
                 " plans whole; time over a catalogue's: median " + fixed(quantile(all.all.ratios, 0.5), 1) +
                 ", 9 of 10 below " + fixed(quantile(all.all.ratios, 0.9), 1) + ", worst " +
                 fixed(all.all.worst, 1);
  return out;
}

}  // namespace capstan::validation
