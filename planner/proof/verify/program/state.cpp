#include <algorithm>
#include <cmath>
#include <set>

#include "planner/ground/base/file.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/program/program_checks.h"

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

bool is_id(const std::string& written, const std::string& id) {
  if (written == id) return true;
  constexpr std::string_view kHashed = "fnv1a:";
  return written.starts_with(kHashed) && written.substr(kHashed.size()) == hex64(fnv1a(id));
}

ProgramCase make_case(const DialectReader& reader, const Program& program, const model::Plan* plan,
                      const model::Machine& machine, const std::vector<model::Cutter>& cutters) {
  ProgramCase out{reader, program, plan, machine, cutters, std::vector<long>(program.markers.size(), -1)};
  if (plan == nullptr) return out;
  std::size_t next = 0;
  const std::vector<std::string> ids = model::step_ids(*plan);
  for (std::size_t m = 0; m < program.markers.size(); ++m) {
    // In the plan's order as a rule: begin to look where the last one was found.
    for (std::size_t k = 0; k < plan->steps.size(); ++k) {
      const std::size_t i = (next + k) % plan->steps.size();
      if (!is_id(program.markers[m].id, ids[i])) continue;
      out.step_of_marker[m] = static_cast<long>(i);
      next = i + 1;
      break;
    }
  }
  return out;
}

double top_of(const model::Machine& machine) {
  const model::LinearAxis& z = machine.axes[2];
  return z.travel_max_mm > z.travel_min_mm ? z.travel_max_mm : 0.0;
}

bool at_top(const Block& b, const model::Machine& machine) {
  return b.machine_z && *b.machine_z >= top_of(machine) - 1e-6;
}

bool parks(const Block& b, const model::Machine& machine) {
  if (!b.in_machine || b.move != model::MoveKind::kRapid || b.words[2] || b.spindle_rpm != 0.0 ||
      !at_top(b, machine))
    return false;
  const double to[] = {b.to.x, b.to.y};
  for (std::size_t i = 0; i < 2; ++i) {
    const model::LinearAxis& axis = machine.axes[i];
    if (b.words[i] && !(to[i] >= axis.travel_min_mm && to[i] <= axis.travel_max_mm)) return false;
  }
  return true;
}

namespace {

constexpr unsigned kNeededAtStart = kStatedUnits | kStatedPlane | kStatedDistance | kStatedFeedMode |
                                    kStatedRadius | kStatedCycle | kStatedOffset | kStatedLength |
                                    kStatedSpindle | kStatedSpeed;

std::string missing_text(unsigned missing, const ControlWords& words) {
  const std::pair<unsigned, std::string> names[] = {
      {kStatedUnits, std::string(words.unit)},
      {kStatedPlane, std::string(words.plane)},
      {kStatedDistance, std::string(words.distance)},
      {kStatedFeedMode, std::string(words.feed_mode)},
      {kStatedRadius, std::string(words.no_radius)},
      {kStatedCycle, std::string(words.no_cycle)},
      {kStatedOffset, "work offset"},
      {kStatedLength, "length offset (" + std::string(words.length) + ")"},
      {kStatedSpindle, std::string(words.start)},
      {kStatedSpeed, std::string(words.speed)},
      {kStatedFeed, std::string(words.feed)}};
  std::string out;
  for (const auto& [bit, name] : names) {
    if ((missing & bit) == 0U) continue;
    out += (out.empty() ? "" : ", ") + name;
  }
  return out;
}

class StateChecks {
 public:
  StateChecks(const ProgramCase& c, Findings& findings) : c_(c), words_(c.reader.words), out_(findings) {
    if (c.plan != nullptr && !c.plan->setups.empty()) {
      security_ = 1e300;
      for (const auto& s : c.plan->setups) security_ = std::min(security_, s.security_z_mm);
    }
  }
  void run() {
    if (c_.plan == nullptr) order();
    for (const Block& b : c_.program.blocks) {
      if (b.kind == Block::Kind::kToolChange) tool_change(b);
      if (b.kind == Block::Kind::kMove) move(b);
      if (b.kind == Block::Kind::kEnd) end(b);
      was_at_top_ = at_top(b, c_.machine);
      machine_z_ = b.machine_z;
    }
    if (!c_.program.ended) {
      out_.error(32, "CHK-END", {c_.program.markers.size() + 2, "", c_.program.lines},
                 "the program has no end mark (M2 or M30)");
    }
  }

 private:
  [[nodiscard]] std::string retract() const {
    return std::string(words_.to_top) + plain(top_of(c_.machine)) + std::string(words_.to_top_end);
  }

  void tool_change(const Block& b) {
    if (b.spindle_rpm != 0.0)
      out_.error(7, "CHK-TOOL-CHANGE", c_.where(b),
                 std::string(words_.change) + " while the spindle turns at " + plain(b.spindle_rpm) + " rpm");
    // The next tool may be longer: only the top of the machine clears whatever it is.
    if (!at_top(b, c_.machine) && (c_.plan != nullptr || !b.unmoved))
      out_.error(7, "CHK-TOOL-CHANGE", c_.where(b),
                 std::string(words_.change) +
                     (b.known_to[2] ? " at z = " + plain(b.to.z) : std::string(" at an unknown height")) +
                     ", not retracted: " + retract() + " comes before it");
    if (b.cycle_active)
      out_.error(26, "CHK-CYCLE", c_.where(b),
                 std::string(words_.change) +
                     " changes the tool while a cycle is active; cancel it before (" +
                     std::string(words_.no_cycle) + ")");
    if (b.tool > 0 && c_.cutters.empty() && !c_.has_table && c_.plan == nullptr) {
      if (said_.insert({105, 0}).second)
        out_.error(
            4, "CHK-TABLE-MISSING", c_.where(b),
            "T" + std::to_string(b.tool) +
                " is loaded, and no tool table is at hand: name it beside the program (check PROGRAM TABLE)");
    } else if (b.tool > 0 && c_.cutter(b.tool) == nullptr)
      out_.error(4, "CHK-TOOL", c_.where(b), "T" + std::to_string(b.tool) + " is not in the tool library");
    const model::Cutter* cutter = c_.cutter(b.tool);
    const int at = cutter != nullptr ? model::magazine_pocket(*cutter) : b.tool;
    if (c_.machine.magazine_pockets > 1 && at > c_.machine.magazine_pockets) {
      out_.error(4, "CHK-TOOL", c_.where(b),
                 "T" + std::to_string(b.tool) + " is in pocket " + std::to_string(at) +
                     "; the magazine has " + std::to_string(c_.machine.magazine_pockets) + " pockets");
    }
  }

  void move(const Block& b) {
    const bool feeds = b.move != MoveKind::kRapid;
    const bool named_z = b.words[2] && !b.in_machine;
    if (!b.in_machine && b.work_offset == 0 && said_.insert({3, b.marker}).second)
      out_.error(3, "CHK-WORK-OFFSET", c_.where(b),
                 "a move before a work offset (" + std::string(c_.reader.work_offsets.front()) + " to " +
                     std::string(c_.reader.work_offsets.back()) + ") was stated");
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
                 "the tool goes to Z" + plain(b.to.z) + " without a length offset; state " +
                     std::string(words_.length) + " before");
    const bool cutting = feeds && !b.in_machine;
    if (cutting && !b.known_from[2] && !b.words[2] && said_.insert({27, b.line}).second)
      out_.error(27, "CHK-POSITION", c_.where(b),
                 "a feed move starts where the height is not known; state Z before it");
    height(b);
    tool_of_marker(b);
    restart(b);
    if (c_.plan == nullptr && cutting && b.spindle_rpm == 0.0)
      out_.unproved(
          Severity::kWarning, 15, "CHK-SPINDLE-STOPPED", c_.where(b),
          "a feed move with the spindle stopped, which may cut; start it (M3), or check with the plan");
    direction(b, cutting);
    tap(b);
  }

  /// A height that is not known is not clear of anything, the top of the machine is.
  void height(const Block& b) {
    const bool across = b.words[0] || b.words[1];
    if (!b.in_machine) {
      if (b.move != MoveKind::kRapid || !across || b.known_from[2] || was_at_top_) return;
      if (said_.insert({9, b.line}).second)
        out_.error(9, "CHK-HEIGHT", c_.where(b),
                   "a rapid across where the height of the tool is not known; retract first, " + retract());
      return;
    }
    if (across && (b.words[2] || !was_at_top_))
      out_.error(9, "CHK-MACHINE-MOVE", c_.where(b),
                 "a move across in machine coordinates (" + std::string(words_.in_machine) +
                     ") below the top of Z, " + plain(top_of(c_.machine)) +
                     ", may hit the piece; go to the top first");
    if (!b.words[2] || b.to.z >= top_of(c_.machine) - 1e-6) return;
    const std::string text = std::string(words_.in_machine) + " moves Z to " + plain(b.to.z) +
                             " in machine coordinates, below the top, " + plain(top_of(c_.machine));
    // Own programs go to the top and nowhere else; others may have another height in mind.
    if (!c_.program.markers.empty() || (machine_z_ && b.to.z < *machine_z_ - 1e-6)) {
      out_.error(10, "CHK-MACHINE-MOVE", c_.where(b), text + ", may hit the piece; go to the top");
    } else {
      out_.warn(10, "CHK-MACHINE-MOVE", c_.where(b), text + ", does not count as retracted; go to the top");
    }
  }

  /// The program's own word for what is loaded.
  void tool_of_marker(const Block& b) {
    if (b.marker < 0 || b.in_machine) return;
    const long wanted = c_.program.markers[static_cast<std::size_t>(b.marker)].tool;
    if (wanted <= 0 || wanted == b.tool || !said_.insert({104, b.marker}).second) return;
    out_.error(4, "CHK-MARKER-TOOL", c_.where(b),
               "T" + std::to_string(b.tool) + " is loaded, the step's marker says T" +
                   std::to_string(wanted) + "; load that one, or write the program again");
  }

  /// The steps' own numbers: 1, 2, 3, ...
  void order() {
    long last = 0;
    for (const StepMarker& m : c_.program.markers) {
      const long expected = last + 1;
      last = m.n;
      if (m.n == expected) continue;
      out_.error(28, "CHK-MARKER-ORDER", {1, m.id, m.line},
                 "the marker of step '" + m.id + "' has n=" + std::to_string(m.n) +
                     " where n=" + std::to_string(expected) +
                     " comes: steps are missing, doubled or in another order; write the program again");
      return;
    }
  }

  /// Without the plan nobody has said that a left-hand cutter is meant.
  void direction(const Block& b, bool cutting) {
    if (c_.plan != nullptr || !cutting || b.synchronised || b.spindle_rpm >= 0.0) return;
    if (!said_.insert({15, b.marker}).second) return;
    const model::Cutter* t = c_.cutter(b.tool);
    if (t != nullptr && t->hand == model::Hand::kLeft) return;
    out_.error(
        15, "CHK-SPINDLE-REVERSED", c_.where(b),
        "a feed move with the spindle turning counter-clockwise (M4), which breaks a right-hand cutter; "
        "state M3, or a left-hand cutter");
  }

  void tap(const Block& b) {
    const model::Cutter* t = c_.cutter(b.tool);
    if (!b.synchronised || t == nullptr || !(t->thread_pitch_mm > 0.0) || b.from_cycle) return;
    if (std::abs(b.pitch_mm - t->thread_pitch_mm) > 1e-3)
      out_.error(18, "CHK-TAP-FEED", c_.where(b),
                 "tapping with a pitch of " + mm(b.pitch_mm) + ", the tap's is " + mm(t->thread_pitch_mm) +
                     "; state a pitch of " + mm(t->thread_pitch_mm) + " (G33.1: K), or load another tap");
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
      out_.error(
          27, "CHK-RESTART", c_.where(b),
          "not stated between the step's start and its first feed move: " + missing_text(missing, words_));
    }
  }

  void end(const Block& b) {
    Findings::Where at = c_.where(b);
    at.order = c_.program.markers.size() + 2;
    if (b.spindle_rpm != 0.0)
      out_.error(32, "CHK-END", at,
                 "the program ends with the spindle on (" + plain(b.spindle_rpm) + " rpm)");
    const bool high =
        at_top(b, c_.machine) || (security_ < 1e299 && b.known_to[2] && b.to.z >= security_ - 1e-6);
    if (!high)
      out_.error(32, "CHK-END-LOW", at, "the program ends at z = " + plain(b.to.z) + ", not retracted");
    if (b.cycle_active)
      out_.error(26, "CHK-CYCLE", at,
                 "a cycle is still active at the end; cancel it (" + std::string(words_.no_cycle) + ")");
    if (b.radius_offset >= 0)
      out_.error(32, "CHK-END-RADIUS", at,
                 "radius compensation is still active at the end; cancel it (" +
                     std::string(words_.no_radius) + ")");
  }

  const ProgramCase& c_;
  const ControlWords& words_;
  Findings& out_;
  double security_ = 1e300;
  int checked_ = -2;
  bool was_at_top_ = false;
  std::optional<double> machine_z_;
  std::set<std::pair<int, long>> said_;
};

}  // namespace

void check_state(const ProgramCase& c, Findings& findings) { StateChecks(c, findings).run(); }

void check_machine_moves(const ProgramCase& c, Findings& findings) {
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
