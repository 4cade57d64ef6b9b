// How long plans take against a catalogue's rates of removal: a sample of tests/sweep.
//
// The catalogue's time knows neither power nor force, bending or corners (tests/sweep/catalogue.cpp has its
// rules and their sources), so that no plan is to reach it everywhere; it tells plans that were held from
// those that were not. On each machine each of the twelve features is planned once, and each of the twelve
// materials met once.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "tests/sweep/sweep.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using testing::sweep::Case;
using testing::sweep::kMachines;
using testing::sweep::kMaterials;
using testing::sweep::Outcome;

/// What was planned of some cases.
struct Group {
  int planned = 0, asked = 0;
  std::vector<double> ratios;
  double worst = 0.0;
  std::string worst_case;
  void add(const Case& c, const Outcome& o) {
    ++asked;
    if (o.whole()) ++planned;
    const double ratio = o.ratio();
    if (!(ratio > 0.0)) return;
    ratios.push_back(ratio);
    if (ratio <= worst) return;
    worst = ratio;
    worst_case = c.name();
  }
};

/// The least value that this share of all does not exceed.
double quantile(std::vector<double> v, double share) {
  if (v.empty()) return 0.0;
  std::sort(v.begin(), v.end());
  const auto at = static_cast<std::size_t>(share * static_cast<double>(v.size() - 1) + 0.5);
  return v[at];
}

std::string spaced_out(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  std::string out;
  for (const char ch : name) out += ch == ',' ? ", " : std::string(1, ch);
  return out;
}

/// A figure with so many decimals, or a dash where there is none.
std::string figure(double v, int decimals) { return v > 0.0 ? fixed(v, decimals) : "-"; }

std::vector<std::string> plan_row(const Case& c, const Outcome& o) {
  const std::size_t missing = o.made.plan.unplanned.size();
  return {spaced_out(c.name()), figure(o.whole() ? o.plan_s : 0.0, 1), figure(o.catalogue_s, 1),
          figure(o.ratio(), 2), missing == 0 ? "" : std::to_string(missing)};
}

std::vector<std::string> row_of(const std::string& name, const Group& g) {
  const auto two = [](double v) { return figure(v, 2); };
  const std::string spaced = spaced_out(g.worst_case);
  return {name,
          std::to_string(g.asked),
          std::to_string(g.planned),
          two(quantile(g.ratios, 0.5)),
          two(quantile(g.ratios, 0.9)),
          two(g.worst),
          spaced.empty() ? "-" : spaced};
}

}  // namespace

Comparison catalogue_times(Extent extent) {
  constexpr std::size_t kEvery = 4;  // a fourth of the plans is a sample
  Comparison out{.name = "catalogue-times"};
  const std::vector<Case> cases = testing::sweep::each_once_per_machine();
  testing::sweep::Sweep sweep;
  Group all;
  std::vector<Group> machines(std::size(kMachines));
  std::map<std::string, Group> materials;
  Table data{{"machine", "ratio", "share"}, {}};
  Table plans{{"feature, material, machine", "plan, s", "catalogue, s", "plan over it", "features not made"},
              {}};
  for (std::size_t i = 0; i < cases.size(); i += extent == Extent::kSample ? kEvery : 1) {
    const Case& c = cases[i];
    const Outcome o = sweep.plan(c);
    if (!o.failed.empty()) {
      out.skipped = c.name() + ": " + o.failed;
      return out;
    }
    plans.rows.push_back(plan_row(c, o));
    all.add(c, o);
    machines[c.machine].add(c, o);
    materials[kMaterials[c.material].group].add(c, o);
  }
  if (extent == Extent::kSample) {
    out.lines = lines_of(plans);
    return out;
  }
  Table table{{"machine or group", "plans", "whole", "median", "9 of 10 below", "worst", "which"}, {}};
  for (std::size_t k = 0; k < machines.size(); ++k) {
    table.rows.push_back(row_of(kMachines[k], machines[k]));
    std::vector<double> sorted = machines[k].ratios;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
      data.rows.push_back({std::to_string(k), fixed(sorted[i], 4),
                           fixed(static_cast<double>(i + 1) / static_cast<double>(sorted.size()), 4)});
  }
  for (const char* group : {"P", "M", "K", "N", "S", "H", "plastic"})
    table.rows.push_back(row_of(group, materials[group]));
  out.text = markdown(table) + "\n" + markdown(plans);
  out.data.emplace_back("catalogue_times.dat", columns(data));
  out.headline = std::to_string(all.planned) + " of " + std::to_string(all.asked) +
                 " plans whole; time over a catalogue's: median " + fixed(quantile(all.ratios, 0.5), 1) +
                 ", 9 of 10 below " + fixed(quantile(all.ratios, 0.9), 1) + ", worst " + fixed(all.worst, 1);
  return out;
}

}  // namespace capstan::validation
