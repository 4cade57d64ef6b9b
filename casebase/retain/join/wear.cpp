#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "casebase/record/held.h"
#include "casebase/retain/join/join.h"
#include "casebase/retain/join/told.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

constexpr double kAgree = 0.01;  // share by which the table's speed, feed and depth may be off the step's

/// The rows of one edge, in their order.
struct Edge {
  std::string name;
  std::vector<const Worn*> rows;
};

/// Edges in the order in which the table names them first.
std::vector<Edge> edges_of(std::span<const Worn> rows, const LogFrom& from) {
  const std::string file = name_of_log(from);
  std::vector<Edge> out;
  std::map<std::string, std::size_t> at;
  for (const Worn& w : rows) {
    const std::string name = printable(w.edge.empty() ? file + ":" + w.part : w.edge);
    const auto [found, fresh] = at.emplace(name, out.size());
    if (fresh) out.push_back({name, {}});
    out[found->second].rows.push_back(&w);
  }
  return out;
}

/// The step of a row; null where it belongs to none, or to several.
const Step* step_of(const Worn& w, std::span<const Step> steps) {
  const Step* found = nullptr;
  for (const Step& s : steps) {
    if (!s.is_for(w.part)) continue;
    if (!w.workingstep.empty() ? s.id != w.workingstep : w.tool != 0 && s.tool != w.tool) continue;
    if (found != nullptr) return nullptr;
    found = &s;
  }
  return found;
}

double speed_m_min(const Worn& w, const Case& c) {
  return w.rpm * std::numbers::pi * c.asked.cutter_diameter_mm / 1000.0;
}

bool agree(double stated, double planned) {
  return stated <= 0.0 || planned <= 0.0 || std::abs(stated - planned) <= kAgree * planned;
}

/// What the table and the step say differently of the cut.
std::optional<std::string> parted(const Worn& w, const Case& planned) {
  const double feed_mm = planned.bound.fz_mm * std::max(1, planned.asked.teeth);
  const auto differ = [](const char* what, double table, double step, const std::string& unit = " mm") {
    return std::string(what) + " is " + trimmed(table, 4) + unit + " in the table and " + trimmed(step, 4) +
           unit + " in the step";
  };
  const double vc = speed_m_min(w, planned);
  if (!agree(vc, planned.bound.vc_m_min)) return differ("the speed", vc, planned.bound.vc_m_min, " m/min");
  if (!agree(w.feed_per_turn_mm, feed_mm)) return differ("the feed per turn", w.feed_per_turn_mm, feed_mm);
  if (!agree(w.depth_mm, planned.bound.ap_mm)) return differ("the depth", w.depth_mm, planned.bound.ap_mm);
  return std::nullopt;
}

/// What was executed: as the table has it, else as the step.
void execute(Case& c, const Worn& w) {
  const int teeth = std::max(1, c.asked.teeth);
  const double vc = speed_m_min(w, c);
  if (c.bound.vc_m_min == 0.0) c.bound.vc_m_min = vc;
  if (c.bound.fz_mm == 0.0) c.bound.fz_mm = w.feed_per_turn_mm / teeth;
  const auto figure = [](double stated, double planned) -> std::optional<Figure> {
    if (stated > 0.0) return Figure{stated, 0.0, Origin::kMeasured};
    if (planned > 0.0) return Figure{planned, 0.0, Origin::kEntered};
    return std::nullopt;
  };
  c.observed.executed_vc_m_min = figure(vc, c.bound.vc_m_min);
  c.observed.executed_fz_mm = figure(w.feed_per_turn_mm / teeth, c.bound.fz_mm);
}

/// The case of an edge, or why it makes none.
tl::expected<Case, std::string> case_of_edge(const Edge& edge, std::span<const Step> steps,
                                             const LogFrom& from) {
  const Step* step = step_of(*edge.rows.front(), steps);
  for (const Worn* w : edge.rows) {
    const Step* other = step_of(*w, steps);
    if (other == nullptr)
      return tl::unexpected("line " + std::to_string(w->line) + " is of no step of the plan, or of several");
    if (other != step) return tl::unexpected(std::string("it cut in several steps, and its wear is of none"));
    if (auto differ = parted(*w, step->planned)) return tl::unexpected(*std::move(differ));
  }
  const Worn& last = *edge.rows.back();
  Case c = step->planned;
  c.origin = Origin::kMeasured;
  c.observed = {};
  // The time is that of the edge, over many parts: it is held against no path and no time of the step.
  c.predicted.time_s = 0.0;
  c.bound.path_length_mm = 0.0;
  c.bound.path_blocks = 0;
  execute(c, last);
  c.observed.time_s = Figure{last.time_s, 0.0, Origin::kMeasured};
  bool worn = false;
  for (const Worn* w : edge.rows) {
    if (!w->wear_mm) continue;
    worn = worn || w->time_s > 0.0;
    c.observed.wear_series_mm.samples.push_back({w->time_s, *w->wear_mm});
    c.observed.wear_mm = Figure{*w->wear_mm, 0.0, Origin::kMeasured};
  }
  if (!worn) return tl::unexpected(std::string("its wear was never read after it had cut"));
  c.from.machine = printable(from.machine);
  c.from.part = printable(last.part);
  c.from.tool_instance = edge.name;
  c.from.source = source_of(from);
  if (const auto wrong = fault_of(c)) return tl::unexpected(*wrong);
  c.id = id_of(c);
  return c;
}

}  // namespace

std::vector<Case> cases_of_wear(std::span<const Step> steps, std::span<const Worn> rows, const LogFrom& from,
                                Job& job) {
  std::vector<Case> out;
  for (const Edge& edge : edges_of(rows, from)) {
    auto c = case_of_edge(edge, steps, from);
    if (c) {
      out.push_back(*std::move(c));
    } else {
      job.report(left_out(from, edge.rows.front()->line,
                          "edge '" + edge.name + "': " + c.error() + "; it makes no case", {}));
    }
  }
  return out;
}

}  // namespace capstan::casebase::retain
