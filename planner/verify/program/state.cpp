#include <algorithm>
#include <cmath>
#include <set>

#include "planner/verify/program/program_checks.h"

namespace capstan::verify {

using model::MoveKind;

const model::Cutter* ProgramCase::cutter(int tool) const {
  for (const auto& c : cutters) {
    if (c.pocket == tool) return &c;
  }
  return nullptr;
}

Findings::Where ProgramCase::where(const Block& b) const {
  if (b.marker < 0) return {1, "", b.line};
  const auto m = static_cast<std::size_t>(b.marker);
  return {m + 2, program.markers[m].id, b.line};
}

ProgramCase make_case(const Program& program, const model::Plan* plan, const model::Machine& machine,
                      const std::vector<model::Cutter>& cutters) {
  ProgramCase out{program, plan, machine, cutters, std::vector<long>(program.markers.size(), -1)};
  if (plan == nullptr) return out;
  std::size_t next = 0;
  for (std::size_t m = 0; m < program.markers.size(); ++m) {
    // In the plan's order as a rule: begin to look where the last one was found.
    for (std::size_t k = 0; k < plan->steps.size(); ++k) {
      const std::size_t i = (next + k) % plan->steps.size();
      if (model::step_id(*plan, plan->steps[i]) != program.markers[m].id) continue;
      out.step_of_marker[m] = static_cast<long>(i);
      next = i + 1;
      break;
    }
  }
  return out;
}

namespace {

constexpr unsigned kNeededAtStart = kStatedUnits | kStatedPlane | kStatedDistance | kStatedFeedMode |
                                    kStatedRadius | kStatedCycle | kStatedOffset | kStatedLength |
                                    kStatedSpindle | kStatedSpeed;

std::string missing_text(unsigned missing) {
  static constexpr std::pair<unsigned, const char*> kNames[] = {{kStatedUnits, "unit (G20/G21)"},
                                                                {kStatedPlane, "plane (G17)"},
                                                                {kStatedDistance, "distance mode (G90/G91)"},
                                                                {kStatedFeedMode, "feed mode (G93/G94/G95)"},
                                                                {kStatedRadius, "G40"},
                                                                {kStatedCycle, "G80"},
                                                                {kStatedOffset, "work offset"},
                                                                {kStatedLength, "length offset (G43)"},
                                                                {kStatedSpindle, "M3 or M4"},
                                                                {kStatedSpeed, "S"},
                                                                {kStatedFeed, "F"}};
  std::string out;
  for (const auto& [bit, name] : kNames) {
    if ((missing & bit) == 0U) continue;
    out += (out.empty() ? "" : ", ") + std::string(name);
  }
  return out;
}

class StateChecks {
 public:
  StateChecks(const ProgramCase& c, Findings& findings) : c_(c), out_(findings) {
    if (c.plan != nullptr && !c.plan->setups.empty()) {
      security_ = 1e300;
      for (const auto& s : c.plan->setups) security_ = std::min(security_, s.security_z_mm);
    }
  }
  void run() {
    for (const Block& b : c_.program.blocks) {
      if (b.kind == Block::Kind::kToolChange) tool_change(b);
      if (b.kind == Block::Kind::kMove) move(b);
      if (b.kind == Block::Kind::kEnd) end(b);
    }
    if (!c_.program.ended) {
      out_.error(32, "CHK-END", {c_.program.markers.size() + 2, "", c_.program.lines},
                 "the program has no end mark (M2 or M30)");
    }
  }

 private:
  void tool_change(const Block& b) {
    if (b.spindle_rpm != 0.0)
      out_.error(7, "CHK-TOOL-CHANGE", c_.where(b),
                 "M6 while the spindle turns at " + plain(b.spindle_rpm) + " rpm");
    const bool high = b.retracted || (security_ < 1e299 && b.known_to[2] && b.to.z >= security_ - 1e-6);
    if (!high)
      out_.error(7, "CHK-TOOL-CHANGE", c_.where(b), "M6 at z = " + plain(b.to.z) + ", not retracted");
    if (b.cycle_active) out_.error(26, "CHK-CYCLE", c_.where(b), "M6 while a cycle is active");
    if (b.tool > 0 && c_.cutter(b.tool) == nullptr)
      out_.error(4, "CHK-TOOL", c_.where(b), "T" + std::to_string(b.tool) + " is not in the tool library");
    if (c_.machine.magazine_pockets > 1 && b.tool > c_.machine.magazine_pockets) {
      out_.error(4, "CHK-TOOL", c_.where(b),
                 "T" + std::to_string(b.tool) + "; the magazine has " +
                     std::to_string(c_.machine.magazine_pockets) + " pockets");
    }
  }

  void move(const Block& b) {
    const bool feeds = b.move != MoveKind::kRapid;
    const bool named_z = b.words[2] && !b.in_machine;
    if (!b.in_machine && b.work_offset == 0 && said_.insert({3, b.marker}).second)
      out_.error(3, "CHK-WORK-OFFSET", c_.where(b), "a move before a work offset (G54 to G59.3) was stated");
    if (b.tool == 0 && feeds && said_.insert({4, b.marker}).second)
      out_.error(4, "CHK-TOOL", c_.where(b), "a feed move without a loaded tool");
    if (b.length_offset > 0 && b.length_offset != b.tool && said_.insert({5, b.line}).second)
      out_.error(
          5, "CHK-TOOL-NUMBER", c_.where(b),
          "H" + std::to_string(b.length_offset) + " is active with T" + std::to_string(b.tool) + " loaded");
    if (b.radius_offset >= 0 && b.radius_offset != b.tool && said_.insert({5, b.line}).second)
      out_.error(
          5, "CHK-TOOL-NUMBER", c_.where(b),
          "D" + std::to_string(b.radius_offset) + " is active with T" + std::to_string(b.tool) + " loaded");
    const bool low = security_ < 1e299 ? b.to.z < security_ - 1e-6 : true;
    if (b.length_offset < 0 && low && (named_z || feeds) && said_.insert({8, b.marker}).second)
      out_.error(8, "CHK-LENGTH-OFFSET", c_.where(b),
                 "the tool goes to z = " + plain(b.to.z) + " without a length offset");
    const bool cutting = feeds && !b.in_machine;
    if (cutting && !b.known_from[2] && !b.words[2] && said_.insert({27, b.line}).second)
      out_.error(27, "CHK-POSITION", c_.where(b), "a feed move starts where the height is not known");
    restart(b);
    if (c_.plan == nullptr && cutting && b.spindle_rpm == 0.0)
      out_.warn(15, "CHK-SPINDLE-STOPPED", c_.where(b),
                "a feed move with the spindle stopped; without the plan it cannot be told whether it cuts");
    direction(b, cutting);
    tap(b);
  }

  /// Without the plan nobody has said that a left-hand cutter is meant.
  void direction(const Block& b, bool cutting) {
    if (c_.plan != nullptr || !cutting || b.synchronised || b.spindle_rpm >= 0.0) return;
    if (!said_.insert({15, b.marker}).second) return;
    const model::Cutter* t = c_.cutter(b.tool);
    if (t != nullptr && t->hand == model::Hand::kLeft) return;
    out_.error(
        15, "CHK-SPINDLE-REVERSED", c_.where(b),
        "a feed move with the spindle turning counter-clockwise (M4): that breaks a right-hand cutter");
  }

  void tap(const Block& b) {
    const model::Cutter* t = c_.cutter(b.tool);
    if (!b.synchronised || t == nullptr || !(t->thread_pitch_mm > 0.0) || b.from_cycle) return;
    if (std::abs(b.pitch_mm - t->thread_pitch_mm) > 1e-3)
      out_.error(18, "CHK-TAP-FEED", c_.where(b),
                 "G33.1 with a pitch of " + mm(b.pitch_mm) + "; the tap's is " + mm(t->thread_pitch_mm));
  }

  void restart(const Block& b) {
    // The start-up line before the first marker may retract; each step states everything itself.
    if (b.in_machine || (b.marker < 0 && !c_.program.markers.empty())) return;
    const bool feeds = b.move != MoveKind::kRapid;
    if (!feeds || b.marker == checked_) return;
    checked_ = b.marker;
    unsigned needed = kNeededAtStart;
    if (!b.synchronised) needed |= kStatedFeed;
    const unsigned missing = needed & ~b.stated;
    if (missing != 0U) {
      out_.error(27, "CHK-RESTART", c_.where(b),
                 "not stated between the step's start and its first feed move: " + missing_text(missing));
    }
  }

  void end(const Block& b) {
    Findings::Where at = c_.where(b);
    at.order = c_.program.markers.size() + 2;
    if (b.spindle_rpm != 0.0)
      out_.error(32, "CHK-END", at,
                 "the program ends with the spindle on (" + plain(b.spindle_rpm) + " rpm)");
    const bool high = b.retracted || (security_ < 1e299 && b.known_to[2] && b.to.z >= security_ - 1e-6);
    if (!high)
      out_.error(32, "CHK-END-LOW", at, "the program ends at z = " + plain(b.to.z) + ", not retracted");
    if (b.cycle_active) out_.error(26, "CHK-CYCLE", at, "a cycle is still active at the end");
    if (b.radius_offset >= 0)
      out_.error(32, "CHK-END-RADIUS", at, "radius compensation is still active at the end");
  }

  const ProgramCase& c_;
  Findings& out_;
  double security_ = 1e300;
  int checked_ = -2;
  std::set<std::pair<int, long>> said_;
};

}  // namespace

void check_state(const ProgramCase& c, Findings& findings) { StateChecks(c, findings).run(); }

void check_tool_table(const ProgramCase& c, const ToolTable& table, Findings& findings) {
  const Findings::Where whole{0, "", -1};
  for (const std::string& f : table.faults)
    findings.error(6, "CHK-TABLE", whole, "the tool table is not understood: " + f);
  std::set<int> used;
  for (const Block& b : c.program.blocks) {
    if (b.kind == Block::Kind::kToolChange && b.tool > 0) used.insert(b.tool);
  }
  for (const int t : used) {
    const auto count =
        std::count_if(table.entries.begin(), table.entries.end(), [&](const auto& e) { return e.tool == t; });
    if (count == 0)
      findings.error(4, "CHK-TABLE-TOOL", whole, "T" + std::to_string(t) + " is not in the tool table");
    if (count > 1)
      findings.error(
          5, "CHK-TABLE-TWICE", whole,
          "T" + std::to_string(t) + " stands " + std::to_string(count) + " times in the tool table");
  }
  for (const ToolTableEntry& e : table.entries) {
    const model::Cutter* t = c.cutter(e.tool);
    if (t == nullptr) continue;
    const std::string name = "T" + std::to_string(e.tool);
    const Findings::Where at{0, "", -1};
    const double offset = model::length_offset_mm(*t);
    if (e.has_length && (t->table_line || offset != 0.0) && std::abs(e.length_mm - offset) > 0.01) {
      const double ratio = e.length_mm / offset;
      const bool inch = std::abs(ratio - 25.4) < 0.1 || std::abs(ratio * 25.4 - 1.0) < 0.005;
      findings.error(6, "CHK-TABLE-LENGTH", at,
                     name + " has a length offset of " + plain(e.length_mm) + " in the tool table (line " +
                         std::to_string(e.line) + "); the tool's is " + mm(offset) +
                         (inch ? ": the unit is another one" : ""),
                     std::abs(e.length_mm - offset));
    }
    if (e.has_diameter && std::abs(e.diameter_mm - t->cutting_diameter_mm) > 0.01) {
      findings.error(6, "CHK-TABLE-DIAMETER", at,
                     name + " has a diameter of " + plain(e.diameter_mm) + " in the tool table (line " +
                         std::to_string(e.line) + "); the tool's is " + mm(t->cutting_diameter_mm));
    }
  }
}

void check_machine_moves(const ProgramCase& c, Findings& findings) {
  geometry::Box3 box;
  for (const Block& b : c.program.blocks) {
    if (b.kind != Block::Kind::kMove) continue;
    const double to[3] = {b.to.x, b.to.y, b.to.z};
    if (b.in_machine) {
      for (std::size_t a = 0; a < 3; ++a) {
        const model::LinearAxis& axis = c.machine.axes[a];
        if (!b.words[a] || !(axis.travel_max_mm > axis.travel_min_mm)) continue;
        if (to[a] < axis.travel_min_mm - 1e-6 || to[a] > axis.travel_max_mm + 1e-6) {
          findings.error(22, "CHK-TRAVEL", c.where(b),
                         "machine coordinate " + axis.name + " " + plain(to[a]) + " is outside the travel, " +
                             plain(axis.travel_min_mm) + " to " + plain(axis.travel_max_mm));
        }
      }
    }
  }
}

}  // namespace capstan::verify
