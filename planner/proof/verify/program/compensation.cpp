#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

using model::MoveKind;

namespace {

constexpr double kSlackMm = 1e-6;

/// Follows radius compensation (G41, G42) through the blocks.
class Compensation {
 public:
  Compensation(const ProgramCase& c, Findings& out) : c_(c), words_(c.reader.words), out_(out) {}

  void run() {
    for (const Block& b : c_.program.blocks) {
      const bool on = b.radius_offset >= 0;
      if (b.kind == Block::Kind::kToolChange && on)
        out_.error(25, "CHK-COMP-CHANGE", c_.where(b),
                   std::string(words_.change) +
                       " changes the tool while cutter compensation is active; cancel it before (" +
                       std::string(words_.no_radius) + ")");
      if (b.kind == Block::Kind::kEnd && on)
        out_.error(25, "CHK-COMP-END", c_.where(b),
                   "the program ends with cutter compensation active; cancel it before (" +
                       std::string(words_.no_radius) + ")");
      if (b.kind != Block::Kind::kMove) continue;
      // A move of the height alone neither leads in nor out.
      const bool flat = b.words[0] || b.words[1] || b.move != MoveKind::kLine;
      if (!flat || (b.move == MoveKind::kRapid && norm(xy(b.to) - xy(b.from)) <= kSlackMm)) continue;
      if (on && !was_on_) lead_in(b);
      if (on && was_on_) follow(b);
      if (!on && was_on_) lead_out(b);
      was_on_ = on;
    }
  }

 private:
  [[nodiscard]] double radius_of(const Block& b) const {
    const model::Cutter* t = c_.cutter(b.radius_offset > 0 ? b.radius_offset : b.tool);
    return t != nullptr ? 0.5 * t->cutting_diameter_mm : 0.0;
  }

  void lead_in(const Block& b) {
    const double r = radius_of(b);
    const double length = norm(xy(b.to) - xy(b.from));
    if (b.move == MoveKind::kArcCw || b.move == MoveKind::kArcCcw) {
      out_.error(25, "CHK-COMP-ARC", c_.where(b),
                 "cutter compensation begins on an arc; it needs a straight lead-in longer than " + mm(r));
      return;
    }
    if (!b.known_from[0] || !b.known_from[1]) {
      out_.unproved(
          Severity::kWarning, 25, "CHK-COMP-UNKNOWN", c_.where(b),
          "cutter compensation begins where the position is not known; its lead-in cannot be judged");
    } else if (length <= r + kSlackMm) {
      out_.error(25, "CHK-COMP-LEAD", c_.where(b),
                 "the lead-in of cutter compensation is " + mm(length) +
                     " long; it must be longer than the tool's "
                     "radius of " +
                     mm(r) + " (T" + std::to_string(b.tool) + ")",
                 r - length);
    }
  }

  void follow(const Block& b) {
    if (b.move != MoveKind::kArcCw && b.move != MoveKind::kArcCcw) return;
    // The tool is left of the path under G41: inside a counter-clockwise arc; right under G42: inside a
    // clockwise.
    const bool inside = (b.move == MoveKind::kArcCcw) == b.radius_left;
    const double r = radius_of(b);
    if (inside && b.radius_start < r - kSlackMm) {
      out_.error(25, "CHK-COMP-CONCAVE", c_.where(b),
                 "a concave arc of radius " + mm(b.radius_start) +
                     " under cutter compensation; the tool's radius is " + mm(r) + " (T" +
                     std::to_string(b.tool) + "); use a smaller tool",
                 r - b.radius_start);
    }
  }

  void lead_out(const Block& b) {
    if (b.move == MoveKind::kArcCw || b.move == MoveKind::kArcCcw) {
      out_.error(25, "CHK-COMP-ARC", c_.where(b),
                 "cutter compensation is cancelled on an arc; the path out must be straight");
    }
  }

  const ProgramCase& c_;
  const ControlWords& words_;
  Findings& out_;
  bool was_on_ = false;
};

}  // namespace

void check_compensation(const ProgramCase& c, Findings& findings) { Compensation(c, findings).run(); }

void check_program_coolant(const ProgramCase& c, Findings& findings) {
  // Of each step each kind once: that the machine lacks something does not hide that it is off.
  std::set<std::pair<int, std::string>> said;
  for (const Block& b : c.program.blocks) {
    const bool cuts = b.kind == Block::Kind::kMove && b.move != MoveKind::kRapid && !b.in_machine;
    if (!cuts) continue;
    const auto lacks = [&](bool machine_has, const char* word) {
      if (machine_has || !said.insert({b.marker, std::string("has no ") + word}).second) return;
      findings.error(29, "CHK-COOLANT-MACHINE", c.where(b),
                     std::string(word) + " is on, machine '" + c.machine.id + "' has none; take it out");
    };
    if (b.flood) lacks(c.machine.has_flood, "flood coolant (M8)");
    if (b.mist) lacks(c.machine.has_mist, "mist (M7)");
    if (b.through) lacks(c.machine.has_through, "coolant through the spindle");
    if (c.plan == nullptr || b.marker < 0) continue;
    const long i = c.step_of_marker[static_cast<std::size_t>(b.marker)];
    if (i < 0) continue;
    const model::StepResult& s = c.plan->steps[static_cast<std::size_t>(i)];
    const auto missing = [&](const char* what, const char* code) {
      if (!said.insert({b.marker, what}).second) return;
      findings.error(29, "CHK-COOLANT", c.where(b),
                     "the step cuts with " + std::string(what) + ", the program has it off; state " + code);
    };
    if (s.flood && !b.flood) missing("flood coolant", "M8");
    if (s.mist && !b.mist) missing("mist", "M7");
    if (s.through && !b.through)
      missing("coolant through the spindle", "its code (through_coolant under the machine's control)");
    if (!s.through && b.through && said.insert({b.marker, "through"}).second)
      findings.error(
          29, "CHK-COOLANT-OTHER", c.where(b),
          "the program cuts with coolant through the spindle on, the step is planned without; switch "
          "it off");
    if (!s.flood && !s.mist && !s.through && (b.flood || b.mist) && said.insert({b.marker, "dry"}).second) {
      findings.error(29, "CHK-COOLANT-DRY", c.where(b),
                     "the step is planned dry, the program cuts with coolant on; state M9");
    } else if (((b.flood && !s.flood) || (b.mist && !s.mist)) && said.insert({b.marker, "other"}).second) {
      findings.error(29, "CHK-COOLANT-OTHER", c.where(b),
                     std::string("the program cuts with ") +
                         (b.flood && !s.flood ? "flood coolant (M8)" : "mist (M7)") +
                         " on, the step is planned without; state M9" +
                         (s.flood  ? ", then M8"
                          : s.mist ? ", then M7"
                                   : "") +
                         (s.through ? ", then the code of the coolant through the spindle" : ""));
    }
  }
}

}  // namespace capstan::verify
