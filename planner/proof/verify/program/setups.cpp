#include <algorithm>
#include <set>

#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/told/raw_piece.h"

// The text's set-ups: their work offsets, and how it passes from one to the next.

namespace capstan::verify {
namespace {

/// What is wanted of the steps behind one marker.
struct Wanted {
  long setup = 0;  ///< counted from 1; 0: nobody said
  int offset = 0;  ///< 0: nobody said
  std::optional<double> security_mm;
};

class SetupChecks {
 public:
  SetupChecks(const ProgramCase& c, Findings& findings) : c_(c), out_(findings) {
    for (std::size_t m = 0; m < c.program.markers.size(); ++m) wanted_.push_back(wanted(m));
  }

  void run() {
    headers();
    const Block* last = nullptr;  // of the work so far
    for (const Block& b : c_.program.blocks) {
      if (b.kind != Block::Kind::kMove || b.in_machine || b.marker < 0) continue;
      const Wanted& w = wanted_[static_cast<std::size_t>(b.marker)];
      offset(b, w);
      if (w.setup == 0) continue;
      if (last != nullptr) {
        const Wanted& before = wanted_[static_cast<std::size_t>(last->marker)];
        if (before.setup != w.setup) change(*last, b, before, w);
      }
      last = &b;
    }
  }

 private:
  [[nodiscard]] const char* source() const { return c_.plan != nullptr ? "plan" : "program's header"; }

  [[nodiscard]] Wanted wanted(std::size_t m) const {
    Wanted w;
    const StepMarker& marker = c_.program.markers[m];
    if (c_.plan != nullptr) {
      const long step = c_.step_of_marker[m];
      if (step < 0) return w;
      const std::size_t i = c_.plan->steps[static_cast<std::size_t>(step)].setup;
      if (i >= c_.plan->setups.size()) return w;
      const model::SetupResult& s = c_.plan->setups[i];
      return {static_cast<long>(i) + 1, offset_code(s.work_offset), s.security_z_mm};
    }
    w.setup = marker.setup;
    for (const HeaderSetup& h : c_.program.setups) {
      if (marker.setup <= 0 || h.n != marker.setup) continue;
      w.offset = h.offset;
      w.security_mm = h.security_mm;
      break;
    }
    return w;
  }

  /// The header and the markers are what the operator reads when he clamps and sets the offsets.
  void headers() {
    if (c_.plan == nullptr) return;
    for (const HeaderSetup& h : c_.program.setups) {
      if (h.n < 1 || static_cast<std::size_t>(h.n) > c_.plan->setups.size()) continue;
      const std::string& planned = c_.plan->setups[static_cast<std::size_t>(h.n) - 1].work_offset;
      if (h.offset == offset_code(planned)) continue;
      out_.error(3, "CHK-HEADER-OFFSET", {1, "", h.line},
                 "the header says " + offset_name(h.offset) + " for set-up " + std::to_string(h.n) +
                     "; the plan has " + planned);
    }
    for (std::size_t m = 0; m < wanted_.size(); ++m) {
      const StepMarker& marker = c_.program.markers[m];
      if (marker.setup == 0 || wanted_[m].setup == 0 || marker.setup == wanted_[m].setup) continue;
      out_.error(3, "CHK-TEXT-SETUP", {m + 2, marker.id, marker.line},
                 "the marker says set-up " + std::to_string(marker.setup) +
                     "; the plan has the step in set-up " + std::to_string(wanted_[m].setup));
    }
  }

  void offset(const Block& b, const Wanted& w) {
    if (w.offset == 0 || b.work_offset == 0 || b.work_offset == w.offset) return;
    if (!said_.insert(b.marker).second) return;
    out_.error(3, "CHK-TEXT-OFFSET", c_.where(b),
               "the text moves in " + offset_name(b.work_offset) + "; the " + source() + " has " +
                   offset_name(w.offset) + " for set-up " + std::to_string(w.setup));
  }

  void change(const Block& last, const Block& first, const Wanted& from, const Wanted& to) {
    const std::string between =
        "from set-up " + std::to_string(from.setup) + " to set-up " + std::to_string(to.setup);
    std::string wrong;
    long line = first.line;
    // A stop comes after what its own block moves.
    for (const Block& s : c_.program.stops) {
      if (s.line < last.line || s.line >= first.line) continue;
      const std::string found = unsafe(s, from);
      if (found.empty()) return;
      if (wrong.empty()) {
        wrong = found;
        line = s.line;
      }
    }
    Findings::Where at = c_.where(first);
    at.move = line;
    out_.error(31, "CHK-SETUP-STOP", at,
               wrong.empty()
                   ? "the text goes " + between + " without a stop (M0) in which the piece is clamped anew"
                   : "the stop in which the piece is clamped anew, " + between + ", comes " + wrong);
  }

  /// Why nobody should reach into the machine in this stop; empty: he may.
  [[nodiscard]] std::string unsafe(const Block& s, const Wanted& w) const {
    if (s.spindle_rpm != 0.0) return "with the spindle on (" + plain(s.spindle_rpm) + " rpm)";
    const bool high =
        at_top(s, c_.machine) || (w.security_mm && s.known_to[2] && s.to.z >= *w.security_mm - 1e-6);
    if (!high)
      return s.known_to[2] ? "at z = " + plain(s.to.z) + ", not retracted" : std::string("not retracted");
    if (s.mist || s.flood || s.through) return "with the coolant on";
    return {};
  }

  const ProgramCase& c_;
  Findings& out_;
  std::vector<Wanted> wanted_;
  std::set<int> said_;
};

}  // namespace

void check_setups(const ProgramCase& c, Findings& findings) { SetupChecks(c, findings).run(); }

void say_unjudged(const ProgramCase& c, bool sweeps, Findings& findings) {
  if (c.plan != nullptr) return;
  const auto raw = told_raw(c.program);
  std::string text =
      "not judged without the plan: raw piece, part, fixtures, order of steps (rapids through material, "
      "gouges, "
      "depth and load of cuts, holder and clamps)";
  if (raw && sweeps) {
    text =
        "not judged without the plan: part, fixtures, order of steps (gouges, depth and load of cuts, holder "
        "and clamps), material behind the first set-up; rapids of set-up " +
        std::to_string(raw->setup) + " are held against the raw piece as the header says it";
    if (!c.program.stock.empty()) text += " (" + c.program.stock + ")";
  } else if (raw) {
    text += "; the raw piece that the header says is not cut here";
  } else if (!c.program.stock.empty()) {
    text += "; the header says how large the raw piece is (" + c.program.stock +
            "), but not where it lies in the first set-up";
  }
  findings.unproved(Severity::kNote, 9, "CHK-NOT-JUDGED", {Findings::kWhole, "", -1}, std::move(text));
}

}  // namespace capstan::verify
