#include "planner/controls/gcode/writable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "planner/controls/gcode/words.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::controls::gcode {
namespace {

using model::CutterPath;
using model::MoveKind;
using model::StepResult;

using Offsets = std::span<const std::string_view>;

// Past this a number is no position on any machine, and fixed notation has no digits left for it.
constexpr double kLargest = 1e6;

tl::unexpected<Diagnostic> bad(const char* code, std::string message, const std::string& step,
                               std::string hint = {}) {
  return fail(Diagnostic{.code = code, .message = std::move(message), .path = step, .hint = std::move(hint)});
}

bool fits(double v) { return std::isfinite(v) && std::abs(v) <= kLargest; }

Status check_tools(const model::Plan& plan, Job& job) {
  std::map<int, const model::Cutter*> by_pocket;
  for (const model::Cutter& c : plan.cutters) {
    if (c.pocket <= 0)
      return bad("OUT-TOOL", "cutter " + c.id + " has no tool number", c.id, "load it into the magazine");
    const auto [it, fresh] = by_pocket.emplace(c.pocket, &c);
    if (!fresh) {
      return bad("OUT-TOOL",
                 "cutters " + it->second->id + " and " + c.id + " are both T" + std::to_string(c.pocket),
                 c.id, "give one of them another tool number");
    }
    if (!fits(c.functional_length_mm) || !fits(c.cutting_diameter_mm)) {
      return bad("OUT-NUMBER", "length or diameter of cutter " + c.id + " is out of range", c.id,
                 "at most " + trimmed(kLargest, 0) + " mm; correct it in the tool library");
    }
    const auto& line = c.table_line;
    if (line &&
        std::any_of(line->words.begin(), line->words.end(), [](const auto& w) { return !fits(w.value); }))
      return bad("OUT-NUMBER", "a word of the tool table's line of cutter " + c.id + " is no size", c.id);
    if (const std::string fault = model::offset_fault(c); !fault.empty()) {
      const bool named = c.id == "T" + std::to_string(c.pocket);  // by the text itself
      job.warn("OUT-TOOL-LENGTH", fault + "; measure the tool before the program runs", named ? "" : c.id);
    } else if (c.functional_length_mm <= 0.0) {
      job.warn(
          "OUT-TOOL-LENGTH",
          "T" + std::to_string(c.pocket) + " has no known length; measure it and enter it in the tool table",
          c.id);
    }
  }
  return {};
}

Status check_path(const CutterPath& path, const std::string& id) {
  for (const auto* column : {&path.x, &path.y, &path.z, &path.cx, &path.cy}) {
    if (column->size() != path.size()) return bad("OUT-SCHEDULE", "the path's columns differ in length", id);
    const auto at = std::find_if_not(column->begin(), column->end(), fits);
    if (at != column->end()) {
      return bad("OUT-NUMBER",
                 "a coordinate of move " + std::to_string(at - column->begin()) + " is no position", id);
    }
  }
  return {};
}

Status check_schedule(const CutterPath& path, const model::FeedSchedule& f, int feed_decimals,
                      const std::string& id) {
  const std::size_t n = path.size();
  if (f.feed_mm_min.size() != n || f.spindle_rpm.size() != n || f.dwell_s.size() != n) {
    return bad("OUT-SCHEDULE", "the feed schedule does not have one entry per move of the path", id);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const std::string move = "move " + std::to_string(i);
    if (!fits(f.spindle_rpm[i]))
      return bad("OUT-NUMBER", "the spindle speed of " + move + " is no speed", id);
    if (path.kind[i] == MoveKind::kRapid) continue;
    if (path.kind[i] == MoveKind::kDwell) {
      if (!fits(f.dwell_s[i]) || f.dwell_s[i] < 0.0)
        return bad("OUT-NUMBER", "the dwell of " + move + " is no time", id);
      continue;
    }
    const double feed = f.feed_mm_min[i];
    if (!fits(feed) || rounded(feed, feed_decimals) <= 0.0) {
      return bad("OUT-FEED",
                 move + " has a feed of " + trimmed(feed, 6) + " mm/min; a program can say " +
                     trimmed(std::pow(10.0, -feed_decimals), feed_decimals) + " to " + trimmed(kLargest, 0),
                 id, "state a feed that the machine has, or leave it open");
    }
  }
  return {};
}

Status check_step(const model::Plan& plan, const StepResult& step, const std::string& id, Offsets offsets) {
  if (!step.path || step.path->size() == 0) {
    return bad("OUT-OPEN", "the step has no path", id, "bind what is open before writing a program");
  }
  if (model::find_cutter(plan, step.cutter_id) == nullptr) {
    return bad("OUT-TOOL", "the step's cutter \"" + step.cutter_id + "\" is not among the plan's", id);
  }
  if (step.setup >= plan.setups.size()) return bad("OUT-SETUP", "the step's set-up does not exist", id);
  const model::SetupResult& setup = plan.setups[step.setup];
  if (std::find(offsets.begin(), offsets.end(), setup.work_offset) == offsets.end()) {
    return bad("OUT-SETUP", "\"" + setup.work_offset + "\" is not a work offset", id,
               std::string(offsets.front()) + " to " + std::string(offsets.back()));
  }
  if (!fits(setup.security_z_mm)) return bad("OUT-NUMBER", "the security plane is no position", id);
  if (auto path = check_path(*step.path, id); !path) return path;
  if (step.schedule)
    return check_schedule(*step.path, *step.schedule, plan.machine.control.feed_decimals, id);
  const std::size_t n = step.path->size();
  const std::vector<double> dwells(n, 0.0);
  return check_schedule(
      *step.path,
      {std::vector<double>(n, step.feed_mm_min), std::vector<double>(n, step.spindle_rpm), dwells},
      plan.machine.control.feed_decimals, id);
}

/// The first number of a machine that a program cannot be written with, with its range; empty: none.
std::string bad_number(const model::Machine& machine) {
  const auto decimals = [](const char* name, int v) {
    return v >= 0 && v <= kMostDecimals
               ? std::string()
               : std::string(name) + " " + std::to_string(v) + ", 0 to " + std::to_string(kMostDecimals);
  };
  const auto size = [](const char* name, double v) {
    return fits(v) ? std::string()
                   : std::string(name) + " " + (std::isfinite(v) ? shortest(v) : std::string("no number")) +
                         ", at most " + trimmed(kLargest, 0);
  };
  for (const std::string& fault : {decimals("decimals", machine.control.decimals),
                                   decimals("feed decimals", machine.control.feed_decimals),
                                   size("path tolerance", machine.control.path_tolerance_mm),
                                   size("travel of Z", machine.axes[2].travel_max_mm),
                                   size("spin-up time", machine.spindle.spin_up_s)}) {
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace

Status writable(const model::Plan& plan, Offsets work_offsets, Job& job) {
  if (plan.steps.empty()) return fail("OUT-EMPTY", "the plan has no step to write a program of");
  if (!bad_number(plan.machine).empty()) {
    return fail({.code = "OUT-NUMBER",
                 .message = "machine '" + plan.machine.id +
                            "' has a number that no control can have: " + bad_number(plan.machine),
                 .hint = "correct it in the machine's file"});
  }
  if (auto tools = check_tools(plan, job); !tools) return tools;
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (auto step = check_step(plan, plan.steps[i], ids[i], work_offsets); !step) return step;
  }
  return {};
}

}  // namespace capstan::controls::gcode
