#include "planner/controls/suitability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "planner/controls/controls.h"
#include "planner/controls/gcode/moves/face_cycles.h"
#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/specification.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "planner/model/plan/resources/control_options.h"

// A control keeps a programmed feed only while it could still stop within the moves that it has looked at:
// v^2 <= 2 a s, s the length of the next moves, a the least acceleration of the axes that move (LinuxCNC:
// "Trajectory Control", naive cam and blend look-ahead). It takes at least one block time for each move, so
// that a shorter one is slower than planned.

namespace capstan::controls {
namespace {

using model::CutterPath;
using model::Finding;
using model::MoveKind;
using model::StepResult;

// A feed or a time is missed when it is missed by more than this share: less is rounding.
constexpr double kMissed = 0.01;  // default, unsourced

/// Of one kind of finding in one step: where it is worst, and how often it is there.
struct Worst {
  long move = -1;
  double by = 0.0;
  std::size_t count = 0;
  void see(std::size_t at, double how_bad) {
    ++count;
    if (move < 0 || how_bad > by) {
      move = static_cast<long>(at);
      by = how_bad;
    }
  }
};

class Suitability {
 public:
  Suitability(const model::Plan& plan, const Conformance& control) : plan_(plan), can_(control) {}

  std::vector<Finding> all() {
    const std::vector<std::string> ids = model::step_ids(plan_);
    for (const model::Cutter& c : plan_.cutters) {
      if (can_.largest_tool_number > 0 && c.pocket > can_.largest_tool_number)
        add("FIT-TOOL-NUMBER", Severity::kError, {}, -1,
            "T" + std::to_string(c.pocket) + " of cutter " + c.id +
                " is more than the control's largest tool number, " +
                std::to_string(can_.largest_tool_number));
    }
    of_plan();
    pockets(ids);
    faces(ids);
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      const StepResult& step = plan_.steps[i];
      if (!step.path) continue;
      kinds(step, ids[i]);
      tolerance(step, ids[i]);
      times(step, ids[i]);
    }
    return std::move(out_);
  }

 private:
  void add(const char* code, Severity severity, const std::string& step, long move, std::string message) {
    out_.push_back({.property = kSaysWhatThePlanDoes,
                    .code = code,
                    .severity = severity,
                    .step = step,
                    .move = move,
                    .message = std::move(message)});
  }
  void add(const char* code, Severity severity, const std::string& step, const Worst& w,
           const std::string& message) {
    if (w.count > 0)
      add(code, severity, step, w.move,
          message + (w.count > 1 ? "; " + std::to_string(w.count - 1) + " more such moves" : std::string()));
  }

  void of_plan() {
    const double own = plan_.machine.control.path_tolerance_mm;
    const bool moves = std::any_of(plan_.steps.begin(), plan_.steps.end(),
                                   [](const StepResult& s) { return s.path != nullptr; });
    const bool set = model::control_option(plan_.machine, "path_tolerance") == "set";
    if (!can_.path_tolerance && own > 0.0 && moves && !set)
      add("FIT-TOLERANCE", Severity::kWarning, {}, -1,
          "no program of the control says how far corners are rounded: " + shortest(own) +
              " mm of the machine's file is assumed, and a parameter of the control decides; set that "
              "parameter, and state 'path_tolerance: set' under the machine's control");
    std::set<std::string> offsets, cutters;
    for (const model::SetupResult& s : plan_.setups) offsets.insert(s.work_offset);
    for (const StepResult& s : plan_.steps) cutters.insert(s.cutter_id);
    if (can_.work_offsets > 0 && offsets.size() > can_.work_offsets)
      add("FIT-OFFSETS", Severity::kError, {}, -1,
          "the plan has " + std::to_string(offsets.size()) + " work offsets; the control has " +
              std::to_string(can_.work_offsets));
    if (!can_.tool_changes && cutters.size() > 1)
      add("FIT-TOOL-CHANGE", Severity::kError, {}, -1,
          "the plan has " + std::to_string(cutters.size()) +
              " cutters; the control's programs change no tool: plan one program for each");
    // LinuxCNC's M6 waits for the hand; of controls that are told when to stop, nothing else stops.
    const std::string_view stop = model::control_option(plan_.machine, "prove_out");
    if (model::changed_by_hand(plan_.machine) && cutters.size() > 1 && !stop.empty() && stop != "m0")
      add("FIT-TOOL-CHANGE", Severity::kError, {}, -1,
          "machine '" + plan_.machine.id +
              "' has no tool changer, and the program would not stop between its " +
              std::to_string(cutters.size()) +
              " tools; state 'prove_out: m0' under the machine's control, or the pockets of its magazine");
  }

  // Pockets that are asked for as cycles of the control whose programs are written: which are moves, and what
  // no program says of the others.
  void pockets(const std::vector<std::string>& ids) {
    const Dialect* writes = find_dialect(plan_.machine.control.dialect);
    const auto asked = gcode::asked_pockets(plan_, writes != nullptr ? writes->pockets : nullptr);
    std::map<int, double> radii;  // by tool
    double planned_s = 0.0, estimated_s = 0.0;
    for (std::size_t i = 0; i < asked.of_step.size(); ++i) {
      const gcode::PocketOfStep& pocket = asked.of_step[i];
      if (!pocket.why_not.empty())
        add("FIT-POCKET-CYCLE", Severity::kNote, ids[i], -1,
            "the pocket is asked for as a cycle of the control, and stays moves: " + pocket.why_not);
      if (!pocket.cycle) continue;
      radii[pocket.cycle->tool] = 0.5 * pocket.cycle->cutter_mm;
      planned_s += pocket.cycle->planned_s;
      estimated_s += gcode::estimated_s(*pocket.cycle);
    }
    if (radii.empty()) return;
    std::string must;
    for (const auto& [tool, radius] : radii)
      must += "R of T" + std::to_string(tool) + " " + shortest(radius) + " mm; ";
    for (const auto& [tool, text] : asked.tables) must += text + "; ";
    add("FIT-POCKET-CYCLE", Severity::kNote, {}, -1,
        "the pocket cycles count with the tool table of the control, which is not seen; before the first cut "
        "see that it has: " +
            must + "tool life counts the " + trimmed(planned_s, 0) +
            " s of the planned paths, the cycles' take about " + trimmed(estimated_s, 0) +
            " s: look at the edges by that");
  }

  // The same of faces.
  void faces(const std::vector<std::string>& ids) {
    const Dialect* writes = find_dialect(plan_.machine.control.dialect);
    const auto asked = gcode::asked_faces(plan_, writes != nullptr ? writes->faces : nullptr);
    std::map<int, double> radii;  // by tool
    double planned_s = 0.0, estimated_s = 0.0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if (!asked[i].why_not.empty())
        add("FIT-FACE-CYCLE", Severity::kNote, ids[i], -1,
            "the face is asked for as a cycle of the control, and stays moves: " + asked[i].why_not);
      if (!asked[i].cycle) continue;
      radii[asked[i].cycle->tool] = 0.5 * asked[i].cycle->cutter_mm;
      planned_s += asked[i].cycle->planned_s;
      estimated_s += gcode::estimated_s(*asked[i].cycle);
    }
    if (radii.empty()) return;
    std::string must;
    for (const auto& [tool, radius] : radii)
      must += "R of T" + std::to_string(tool) + " " + shortest(radius) + " mm; ";
    add("FIT-FACE-CYCLE", Severity::kNote, {}, -1,
        "the face cycles count with the tool table of the control, which is not seen; before the first cut "
        "see "
        "that it has: " +
            must + "tool life counts the " + trimmed(planned_s, 0) +
            " s of the planned paths, the cycles' take about " + trimmed(estimated_s, 0) + " s");
  }

  void kinds(const StepResult& step, const std::string& id) {
    const CutterPath& path = *step.path;
    Worst arcs, helices, taps, radii, axes, feeds;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const bool arc = model::is_arc(path.kind[i]);
      if (arc && !can_.arcs) arcs.see(i, 0.0);
      if (arc && can_.arcs && !can_.helices && path.z[i] != path.z[i - 1]) helices.see(i, 0.0);
      if (path.role[i] == model::MoveRole::kTap && !can_.rigid_tapping) taps.see(i, 0.0);
      const int moving = (path.x[i] != path.x[i - 1] ? 1 : 0) + (path.y[i] != path.y[i - 1] ? 1 : 0) +
                         (path.z[i] != path.z[i - 1] ? 1 : 0);
      if (!arc && moving > can_.axes) axes.see(i, moving);
      const double radius_mm = arc ? std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]) : 0.0;
      if (can_.largest_radius_mm > 0.0 && radius_mm > can_.largest_radius_mm) radii.see(i, radius_mm);
      const double feed = path.kind[i] == MoveKind::kRapid ? 0.0 : 60.0 * feed_of(step, i);
      if (can_.largest_feed_mm_min > 0.0 && feed > can_.largest_feed_mm_min) feeds.see(i, feed);
    }
    add("FIT-ARC", Severity::kError, id, arcs, "the control knows no arcs, and the path has one");
    add("FIT-HELIX", Severity::kError, id, helices, "the control knows no helices, and the path has one");
    add("FIT-TAP", Severity::kError, id, taps,
        "the control does not keep spindle and feed together for tapping");
    add("FIT-AXES", Severity::kError, id, axes,
        trimmed(axes.by, 0) + " axes move at once; the control moves " + std::to_string(can_.axes));
    add("FIT-RADIUS", Severity::kError, id, radii,
        "an arc has a radius of " + trimmed(radii.by, 3) + " mm; the control's largest is " +
            shortest(can_.largest_radius_mm) + " mm");
    add("FIT-FEED", Severity::kError, id, feeds,
        "the feed is " + trimmed(feeds.by, 1) + " mm/min; the control's largest is " +
            shortest(can_.largest_feed_mm_min));
  }

  void tolerance(const StepResult& step, const std::string& id) {
    const double own = plan_.machine.control.path_tolerance_mm;
    const double asked = step.contour_tolerance_mm > 0.0 ? step.contour_tolerance_mm : own;
    const double last = std::pow(10.0, -plan_.machine.control.decimals);
    if (!can_.path_tolerance && asked != own) {
      add("FIT-TOLERANCE", Severity::kWarning, id, -1,
          "the step may be rounded by " + shortest(asked) + " mm; the control rounds each by " +
              shortest(own) + " mm");
    } else if (asked > 0.0 && asked < last) {
      add("FIT-TOLERANCE", Severity::kWarning, id, -1,
          "the step may be rounded by " + shortest(asked) +
              " mm, less than the last decimal of the program, " + shortest(last) +
              " mm: give the control's numbers more decimals");
    }
  }

  double feed_of(const StepResult& step, std::size_t move) const {
    return (step.schedule ? step.schedule->feed_mm_min[move] : step.feed_mm_min) / 60.0;
  }

  void times(const StepResult& step, const std::string& id) {
    const CutterPath& path = *step.path;
    const double block_s = can_.block_time_s > 0.0 ? can_.block_time_s : plan_.machine.control.block_time_s;
    double acceleration = plan_.machine.axes[0].acceleration_mm_s2;
    for (const auto& axis : plan_.machine.axes)
      acceleration = std::min(acceleration, axis.acceleration_mm_s2);
    Worst blocks, ahead;
    double sum_mm = 0.0;  // of the moves (i, end), at most as many as it looks ahead
    std::size_t end = 1;
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (end < i) end = i;
      while (can_.look_ahead_moves > 0 && end < path.size() && end - i < can_.look_ahead_moves)
        sum_mm += model::move_length(path, end++);
      const double length = model::move_length(path, i);
      if (path.kind[i] != MoveKind::kRapid && path.kind[i] != MoveKind::kDwell && length > 0.0) {
        const double v = feed_of(step, i);
        if (length < (1.0 - kMissed) * v * block_s) blocks.see(i, v * block_s / length);
        // The path's last moves end in a stop that is in sight.
        const double stop_mm = acceleration > 0.0 ? 0.5 * v * v / acceleration : 0.0;
        if (can_.look_ahead_moves > 0 && end < path.size() && sum_mm < (1.0 - kMissed) * stop_mm)
          ahead.see(i, stop_mm / sum_mm);
      }
      if (end > i) sum_mm = std::max(0.0, sum_mm - length);
    }
    add("FIT-BLOCK-TIME", Severity::kNote, id, blocks,
        "a move is " + trimmed(blocks.by, 2) +
            " times shorter than the feed covers in the control's block time, " + shortest(block_s) +
            " s: it is slower than planned");
    add("FIT-LOOK-AHEAD", Severity::kNote, id, ahead,
        "the feed wants a way " + trimmed(ahead.by, 2) + " times as long to stop as the " +
            std::to_string(can_.look_ahead_moves) +
            " moves that the control looks ahead: it is slower than planned");
  }

  const model::Plan& plan_;
  const Conformance& can_;
  std::vector<Finding> out_;
};

}  // namespace

std::vector<Finding> suitability(const model::Plan& plan, const Conformance& control) {
  return Suitability(plan, control).all();
}

std::vector<Finding> suitability(const model::Plan& plan) {
  const Dialect* dialect = find_dialect(plan.machine.control.dialect);
  return dialect != nullptr ? suitability(plan, dialect->conformance) : std::vector<Finding>{};
}

}  // namespace capstan::controls
