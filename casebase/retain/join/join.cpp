#include "casebase/retain/join/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "casebase/record/held.h"
#include "casebase/retain/join/told.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::casebase::retain {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGapShare = 0.02;
// A step is whole when its log begins and ends this near to its first and last line: a step's head and end
// are blocks without a motion, of which logs of motion say nothing. Defaults, unsourced.
constexpr long kHeadLines = 20;
constexpr double kHeadShare = 0.1;

// The step that uses a tool, if only one does.
std::map<int, const Step*> steps_by_tool(std::span<const Step> steps, const LogFrom& from) {
  std::map<int, const Step*> out;
  for (const Step& s : steps) {
    if (s.tool == 0 || !s.is_for(from.part)) continue;
    const auto [at, fresh] = out.emplace(s.tool, &s);
    if (!fresh) at->second = nullptr;
  }
  return out;
}

// Runs that name no step and show fewer than half of the tools.
std::set<int> other_runs(const std::map<int, const Step*>& by_tool, const std::vector<Executed>& executed) {
  std::map<int, std::set<int>> tools;
  for (const Executed& e : executed) {
    if (e.run != kSummedUp && e.workingstep.empty() && by_tool.contains(e.tool)) tools[e.run].insert(e.tool);
  }
  std::set<int> out;
  for (const auto& [run, used] : tools) {
    if (2 * used.size() < by_tool.size()) out.insert(run);
  }
  return out;
}

// Names, by run, that a log has while the plan has several steps of that name (the second is "name~2") and
// the log names none of the others: nobody can tell which stay was at which, or whether one was at several
// that follow each other. The markers of a program tell a single stay from them.
std::set<std::pair<int, std::string>> names_of_several(const std::map<std::string, const Step*>& by_id,
                                                       const std::vector<Executed>& executed,
                                                       const ProgramMarks* marks) {
  std::map<std::pair<int, std::string>, int> stays;
  for (const Executed& e : executed) ++stays[{e.run, e.workingstep}];
  std::set<std::pair<int, std::string>> out;
  for (const auto& [at, n] : stays) {
    const std::string second = at.second + "~2";
    if ((n > 1 || marks == nullptr) && by_id.contains(second) && !stays.contains({at.first, second}))
      out.insert(at);
  }
  return out;
}

// All stays of one run at one step as one.
void join(Executed& into, const Executed& e) {
  for (const Kept& k : e.load) {
    if (into.load.size() < kMaxSamples) into.load.push_back({into.moving_s + k.t_s, k.value});
  }
  into.active_s += e.active_s;
  into.moving_s += e.moving_s;
  into.gap_s += e.gap_s;
  into.cut_off = into.cut_off || e.cut_off;
  into.end_s = e.end_s;
  into.last_log_line = e.last_log_line;
  if (into.first_line == 0) into.first_line = e.first_line;
  into.last_line = std::max(into.last_line, e.last_line);
  for (std::size_t i = 0; i < kNumbers; ++i) {
    Statistic& s = into.number[i];
    const Statistic& more = e.number[i];
    if (std::abs(more.peak) > std::abs(s.peak)) s.peak = more.peak;
    s.seconds += more.seconds;
    if (more.held_s > s.held_s) {
      s.held = more.held;
      s.held_s = more.held_s;
    }
  }
  into.events.insert(into.events.end(), e.events.begin(), e.events.end());
}

// Whether the log ends within the step: what is shown of it is no whole step, however much that is. A log
// that shows the last line of the step in the program shows all of it.
bool ends_within(const Executed& e, const ProgramMarks* marks) {
  if (!e.cut_off) return false;
  if (marks == nullptr || e.last_line == 0) return true;
  for (std::size_t i = 0; i < marks->marks.size(); ++i) {
    if (marks->marks[i].id == e.workingstep) return e.last_line < marks->last_line(i);
  }
  return true;
}

// Why a step's log does not show all of it.
std::optional<std::string> in_part(const Executed& e, const ProgramMarks* marks) {
  if (!(e.moving_s > 0.0)) return "it did not move";
  if (e.gap_s > kGapShare * e.active_s) return "the log is silent for " + trimmed(e.gap_s, 1) + " s of it";
  if (marks == nullptr || e.first_line == 0) return std::nullopt;
  for (std::size_t i = 0; i < marks->marks.size(); ++i) {
    const ProgramMark& m = marks->marks[i];
    if (m.id != e.workingstep) continue;
    const long last = marks->last_line(i);
    const long free =
        std::max(kHeadLines, static_cast<long>(kHeadShare * static_cast<double>(last - m.line)));
    if (e.first_line > m.line + free) return "the log begins within it";
    if (e.last_line < last - free) return "the log ends within it";
  }
  return std::nullopt;
}

std::optional<Figure> figure(double value) { return Figure{value, 0.0, Origin::kMeasured}; }

// Speed and feed as the log shows them, where the step states none, and the time that they promise.
void bind_by_log(Case& c, const Executed& e) {
  const double rpm = e.of(Item::kSpindle).held, feed = e.of(Item::kFeed).held;
  const double teeth = std::max(1, c.asked.teeth);
  if (c.bound.vc_m_min == 0.0) c.bound.vc_m_min = kPi * c.asked.cutter_diameter_mm * rpm / 1000.0;
  const bool fed = c.bound.fz_mm == 0.0 && rpm > 0.0;
  if (fed) c.bound.fz_mm = feed / rpm / teeth;
  if (fed && feed > 0.0 && c.predicted.time_s == 0.0) {
    c.predicted.time_s = c.bound.path_length_mm / feed * 60.0;
  }
}

Case observed(Case c, const Executed& e, const LogFrom& from) {
  c.origin = Origin::kMeasured;
  bind_by_log(c, e);
  c.observed = {};
  c.observed.time_s = figure(e.moving_s);
  // What it was cut with, where the log shows speed and feed: forces and wear that are measured beside are of
  // it. A table of times has what somebody noted.
  const double rpm = e.of(Item::kSpindle).held, fed = e.of(Item::kFeed).held;
  const double fz = e.run != kSummedUp ? held_fz_mm(fed, rpm, c.asked.teeth) : 0.0;
  if (fz > 0.0) c.observed.executed_fz_mm = figure(fz);
  const double vc = e.run != kSummedUp ? kPi * c.asked.cutter_diameter_mm * rpm / 1000.0 : 0.0;
  if (vc >= 0.01 && vc <= 20000.0) c.observed.executed_vc_m_min = figure(vc);
  if (const Statistic& lag = e.of(Item::kLag); lag.seconds > 0.0)
    c.observed.lag_mm = figure(std::abs(lag.peak));
  if (const Statistic& load = e.of(Item::kLoad); load.seconds > 0.0) {
    c.observed.spindle_load_percent = figure(load.peak);
  }
  for (const Kept& k : e.load) c.observed.load_series_percent.samples.push_back({k.t_s, k.value});
  c.observed.verdict = e.events.empty() ? Verdict::kUnknown : Verdict::kBad;
  c.from.machine = printable(from.machine);
  c.from.part = printable(from.part);
  if (!e.tool_instance.empty()) c.from.tool_instance = printable(e.tool_instance);
  if (from.dated) c.from.time_utc = stamp_of(e.end_s);
  c.from.source = source_of(from);
  if (e.run != kSummedUp) c.from.source += fmt::format(" run {}", e.run);
  return c;
}

/// A feed that is so far from the planned one that tuning would not hear the case: a unit may be another.
std::optional<Diagnostic> far_from_plan(const Case& c, const LogFrom& from, std::uint64_t line) {
  const double planned = c.predicted.held_fz_mm > 0.0 ? c.predicted.held_fz_mm : c.bound.fz_mm;
  if (!c.observed.executed_fz_mm || !(planned > 0.0)) return std::nullopt;
  const double executed = c.observed.executed_fz_mm->value, share = executed / planned;
  if (share <= kMostMultiplier && share >= 1.0 / kMostMultiplier) return std::nullopt;
  Diagnostic d = left_out(
      from, line,
      fmt::format("the log shows {} mm per tooth, {} times the planned {}; within a factor of {} "
                  "a case is heard",
                  trimmed(executed, 4), trimmed(share, 2), trimmed(planned, 4), trimmed(kMostMultiplier, 1)),
      c.from.workingstep);
  d.code = "LOG-FEED";
  d.severity = Severity::kWarning;
  d.hint =
      "is the unit of feed and speed what the names of the columns, or --unit, say; is it that plan's log";
  return d;
}

std::string text_of(const std::vector<Event>& events) {
  const Event& first = events.front();
  return fmt::format("{} above {}: {} up to {}, the first for {} s at line {} of the program", first.item,
                     shortest(first.above), counted(events.size(), "time", "times"),
                     trimmed(std::max_element(events.begin(), events.end(),
                                              [](const Event& a, const Event& b) { return a.peak < b.peak; })
                                 ->peak,
                             4),
                     trimmed(first.lasted_s, 2), first.program_line);
}

}  // namespace

Status match(ProgramMarks& marks, const model::Plan& plan, const std::string& file) {
  const auto wrong = [&](long line, std::string message) {
    return fail(Diagnostic{.code = "LOG-PROGRAM",
                           .message = std::move(message),
                           .file = file,
                           .line = static_cast<std::uint64_t>(line),
                           .expected = "the program that `capstan plan` wrote with the plan",
                           .hint = "write the program and the plan in one call"});
  };
  if (marks.marks.empty()) return wrong(0, "there is no marker of a workingstep in the program");
  const std::vector<std::string> ids = model::step_ids(plan);
  const auto tool_of = [&](std::size_t place) {
    const model::Cutter* cutter =
        place < plan.steps.size() ? model::find_cutter(plan, plan.steps[place].cutter_id) : nullptr;
    return cutter == nullptr ? 0 : cutter->pocket;
  };
  for (ProgramMark& m : marks.marks) {
    if (m.n < 1 || static_cast<std::size_t>(m.n) > ids.size()) {
      return wrong(m.line, fmt::format("the plan has no step {}", m.n));
    }
    const std::string& id = ids[static_cast<std::size_t>(m.n - 1)];
    if (m.id != id && m.id != "fnv1a:" + hex64(fnv1a(id))) {
      return wrong(m.line, "step " + std::to_string(m.n) + " is '" + m.id.substr(0, 40) + "', in the plan '" +
                               id.substr(0, 40) + "'");
    }
    const int tool = tool_of(static_cast<std::size_t>(m.n - 1));
    if (m.tool > 0 && tool > 0 && m.tool != tool) {
      return wrong(m.line, fmt::format("step {} '{}' is cut with T{}, in the plan with T{}", m.n,
                                       id.substr(0, 40), m.tool, tool));
    }
    m.id = id;
  }
  return {};
}

std::vector<Case> cases_of(std::span<const Step> steps, const std::vector<Executed>& executed,
                           const ProgramMarks* marks, const LogFrom& from, Job& job) {
  const auto by_tool = steps_by_tool(steps, from);
  const std::set<int> others = other_runs(by_tool, executed);
  std::map<std::string, const Step*> by_id;
  for (const Step& s : steps) {
    if (s.is_for(from.part)) by_id[s.id] = &s;
  }
  const auto several = names_of_several(by_id, executed, marks);
  // By run and place among the steps: their order is the order of the cases.
  std::map<std::pair<int, const Step*>, Executed> whole;
  for (const Executed& e : executed) {
    const Step* step = nullptr;
    std::string why = " is no step of the plan, or of several";
    if (!e.workingstep.empty()) {
      const auto at = by_id.find(e.workingstep);
      if (at != by_id.end()) step = at->second;
      if (several.contains({e.run, e.workingstep})) {
        step = nullptr;
        why = " is a name of several steps, which the log does not tell apart (name, name~2)";
      }
    } else if (const auto at = by_tool.find(e.tool); at != by_tool.end()) {
      step = at->second;
      if (others.contains(e.run)) {
        step = nullptr;
        why = " is in a run that shows fewer than half of the tools";
      }
    }
    if (step == nullptr) {
      const std::string what =
          e.workingstep.empty() ? "tool " + std::to_string(e.tool) : "'" + e.workingstep + "'";
      job.report(left_out(from, e.first_log_line,
                          what + why + "; " + trimmed(e.active_s, 1) + " s are left out", e.workingstep));
      continue;
    }
    Executed named = e;
    named.workingstep = step->id;
    const auto [at, fresh] = whole.emplace(std::pair(e.run, step), named);
    if (!fresh) join(at->second, e);
  }
  std::vector<Case> out;
  for (const auto& [key, e] : whole) {
    if (ends_within(e, marks)) {
      Diagnostic d =
          left_out(from, e.last_log_line, "the log ends within it: it makes no case", e.workingstep);
      d.severity = Severity::kWarning;
      d.hint = "import a log that goes on until the program ends or the machine stands still";
      job.report(std::move(d));
      continue;
    }
    if (const auto why = in_part(e, marks)) {
      job.report(left_out(from, e.first_log_line, *why + ": it makes no case", e.workingstep));
      continue;
    }
    Case c = observed(key.second->planned, e, from);
    if (const auto wrong = fault_of(c)) {
      job.report(left_out(from, e.first_log_line, *wrong + ": it makes no case", e.workingstep));
      continue;
    }
    if (auto far = far_from_plan(c, from, e.first_log_line)) job.report(*std::move(far));
    if (!e.events.empty()) job.warn("LOG-EVENT", text_of(e.events), e.workingstep);
    c.id = id_of(c);
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace capstan::casebase::retain
