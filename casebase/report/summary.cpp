#include "casebase/report/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "planner/ground/base/number.h"

namespace capstan::casebase::report {
namespace {

constexpr double kLeastApart = 0.05;
constexpr double kStandardErrors = 2.0;

bool is_seen(const std::optional<Figure>& f) { return f && f->origin != Origin::kSimulated; }

Spread spread_of(std::span<const Case* const> cases, std::optional<Figure> Observed::*figure) {
  Spread out;
  double sum = 0.0, square = 0.0;
  for (const Case* c : cases) {
    const std::optional<Figure>& f = c->observed.*figure;
    if (!is_seen(f)) continue;
    out.low = out.count == 0 ? f->value : std::min(out.low, f->value);
    out.high = out.count == 0 ? f->value : std::max(out.high, f->value);
    ++out.count;
    sum += f->value;
  }
  if (out.count == 0) return out;
  out.mean = sum / static_cast<double>(out.count);
  for (const Case* c : cases) {
    const std::optional<Figure>& f = c->observed.*figure;
    if (is_seen(f)) square += (f->value - out.mean) * (f->value - out.mean);
  }
  if (out.count > 1) out.std_dev = std::sqrt(square / static_cast<double>(out.count - 1));
  return out;
}

std::string name_of(const Case& c, By by) {
  switch (by) {
    case By::kWorkingstep:
      return c.from.workingstep.empty() ? std::string("(no workingstep)") : c.from.workingstep;
    case By::kTool:
      return c.asked.tool_class + " D" + trimmed(c.asked.cutter_diameter_mm, 3) +
             (c.from.tool_instance.empty() ? "" : " " + c.from.tool_instance);
    case By::kFeature:
      break;
  }
  return (c.asked.feature.empty() ? std::string("(no feature)") : c.asked.feature) +
         (c.asked.diameter_mm > 0.0 ? " D" + trimmed(c.asked.diameter_mm, 3) : std::string()) +
         (c.asked.width_mm > 0.0 ? " W" + trimmed(c.asked.width_mm, 3) : std::string());
}

std::optional<Figure> off_the_aim(const Case& c) {
  std::optional<Figure> size = c.observed.size_deviation_mm;
  if (!size || !c.bound.aimed_over_mm) return std::nullopt;
  size->value -= c.bound.aimed_over_mm->value;
  return size;
}

constexpr std::array kQuantities = {
    Quantity{"time", "motion: the machine's accelerations, block time and path tolerance",
             [](const Case& c) { return c.predicted.time_s; },
             [](const Case& c) { return c.observed.time_s; }},
    Quantity{"peak force", "cutting force: kc1.1 and mc of the material, its margin",
             [](const Case& c) { return c.predicted.peak_force_n; },
             [](const Case& c) { return c.observed.peak_force_n; }},
    Quantity{"torque", "cutting force at the cutter's radius",
             [](const Case& c) { return c.predicted.torque_nm; },
             [](const Case& c) { return c.observed.torque_nm; }},
    Quantity{"power", "cutting force and the spindle's efficiency",
             [](const Case& c) { return c.predicted.power_w; },
             [](const Case& c) { return c.observed.power_w; }},
    Quantity{"size", "bending of the cutter (amounts: it says nothing of vibration and runout)",
             [](const Case& c) { return c.predicted.deflection_mm; }, &off_the_aim, true},
};

}  // namespace

std::vector<Group> grouped(std::span<const Case> cases, By by) {
  std::map<std::string, Group> groups;
  for (const Case& c : cases) groups[name_of(c, by)].cases.push_back(&c);
  std::vector<Group> out;
  for (auto& [name, g] : groups) {
    g.name = name;
    for (const Case* c : g.cases) {
      g.good += c->observed.verdict == Verdict::kGood ? 1 : 0;
      g.bad += c->observed.verdict == Verdict::kBad ? 1 : 0;
    }
    for (std::size_t i = 0; i < kColumns.size(); ++i) g.figures[i] = spread_of(g.cases, kColumns[i].figure);
    out.push_back(std::move(g));
  }
  return out;
}

std::span<const Quantity> quantities() { return kQuantities; }

double ratio_of(const Quantity& q, const Case& c) {
  const std::optional<Figure> seen = q.observed(c);
  const double expected = q.predicted(c);
  if (!is_seen(seen) || !(expected > 0.0)) return 0.0;
  // Off by nothing is off by less than can be measured; a time or force of nothing was not observed.
  if (seen->value == 0.0 && !q.at_most) return 0.0;
  return std::max(kLeastRatio, std::abs(seen->value) / expected);
}

std::vector<Parting> partings_of(std::span<const Case* const> cases) {
  std::vector<Parting> out;
  for (const Quantity& q : quantities()) {
    std::vector<double> logs;
    for (const Case* c : cases) {
      if (const double r = ratio_of(q, *c); r > 0.0) logs.push_back(std::log(r));
    }
    if (logs.empty()) continue;
    const double n = static_cast<double>(logs.size());
    double mean = 0.0, square = 0.0;
    for (const double x : logs) mean += x / n;
    for (const double x : logs) square += (x - mean) * (x - mean);
    Parting p{.quantity = &q, .count = logs.size(), .ratio = std::exp(mean)};
    if (logs.size() > 1) {
      p.ln_std_dev = std::sqrt(square / (n - 1.0));
      const double off = q.at_most ? mean : std::abs(mean);
      p.apart = off > std::max(kLeastApart, kStandardErrors * p.ln_std_dev / std::sqrt(n));
    }
    out.push_back(p);
  }
  return out;
}

}  // namespace capstan::casebase::report
