#include "planner/proof/verify/axis_places.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/reader_options.h"
#include "planner/proof/verify/volumes/number_text.h"

// A range is convex, so that straight moves are judged by where they end; the machine stands within its
// ranges when the program begins. Of an arc the box counts. A move in machine coordinates says its places
// itself.

namespace capstan::verify {
namespace {

constexpr double kRoundingMm = 1e-6;

class Placing {
 public:
  Placing(const ProgramCase& c, const ToolTable& table, const AxisPlaces& places, Findings& findings)
      : c_(c), table_(table), places_(places), findings_(findings) {}

  void run() {
    say_not_followed();
    for (const Block& b : c_.program.blocks) {
      if (b.kind != Block::Kind::kMove) continue;
      for (const AxisPlaces::Range& r : places_.ranges) judge(b, r);
    }
    for (const auto& [key, far] : farthest_)
      findings_.error(22, "CHK-PLACE-" + name(key.second), far.where, far.message, far.beyond_mm);
  }

 private:
  struct Far {
    Findings::Where where;
    std::string message;
    double beyond_mm = 0.0;
  };

  /// Of what is not followed no move is known, so that nothing is held to be within the limits.
  void say_not_followed() {
    if (c_.program.faults.empty()) return;
    const ReaderFault& first = c_.program.faults.front();
    findings_.error(22, "CHK-PLACE", {Findings::kWhole, "", first.line},
                    "not all of the program is followed, so that no axis can be held to its limits: line " +
                        std::to_string(first.line) + ", " + first.code + ": " + first.message);
  }

  [[nodiscard]] const std::string& name(std::size_t axis) const { return c_.machine.axes[axis].name; }

  void judge(const Block& b, const AxisPlaces::Range& r) {
    const bool round = !b.in_machine && is_arc(b.move) && r.axis < 2;
    if (!b.words[r.axis] && !round) return;
    const double to[3] = {b.to.x, b.to.y, b.to.z};
    if (b.in_machine) return hold(b, r, to[r.axis], to[r.axis], "");
    if (r.axis == 2 && touches_off_)
      return unplaced(b, r,
                      "the zero of Z is set anew with each tool, so that it is not known from the text");
    if (!b.known_to[r.axis] || (round && !(b.known_from[0] && b.known_from[1])))
      return unplaced(b, r, "where it stands after this move is not known from the text");
    const AxisPlaces::Offset* offset = offset_of(b);
    if (offset == nullptr)
      return unplaced(b, r,
                      "where " + (b.work_offset == 0 ? "its work offset" : offset_name(b.work_offset)) +
                          " lies is not told; state it with the axis limits");
    const double at[3] = {offset->at_mm.x, offset->at_mm.y, offset->at_mm.z};
    double shift = at[r.axis];
    std::string by = "work offset at " + plain(shift);
    if (r.axis == 2 && b.length_offset >= 0) {
      const auto length = length_of_tool(c_, table_, b.length_offset);
      if (!length)
        return unplaced(b, r,
                        "the length of T" + std::to_string(b.length_offset) +
                            " is not known from the gage line; measure the tool");
      shift += *length;
      by += ", T" + std::to_string(b.length_offset) + " " + plain(*length) + " long";
    }
    double lo = to[r.axis], hi = lo;
    if (round) {
      Move m;
      m.kind = b.move;
      m.from = b.from;
      m.to = b.to;
      m.centre = b.centre;
      const geometry::Box3 box = box_of(m);
      lo = r.axis == 0 ? box.lo.x : box.lo.y;
      hi = r.axis == 0 ? box.hi.x : box.hi.y;
    }
    hold(b, r, lo + shift, hi + shift, by);
  }

  /// The one of that name, else the one without a name.
  [[nodiscard]] const AxisPlaces::Offset* offset_of(const Block& b) const {
    const auto& all = places_.offsets;
    auto at = std::find_if(all.begin(), all.end(), [&](const AxisPlaces::Offset& o) {
      return !o.name.empty() && b.work_offset != 0 && offset_code(o.name) == b.work_offset;
    });
    if (at == all.end())
      at = std::find_if(all.begin(), all.end(), [](const AxisPlaces::Offset& o) { return o.name.empty(); });
    return at == all.end() ? nullptr : &*at;
  }

  void hold(const Block& b, const AxisPlaces::Range& r, double lo, double hi, const std::string& by) {
    const double below = r.least_mm - lo, above = hi - r.most_mm;
    const double beyond = std::max(below, above);
    if (!(beyond > kRoundingMm)) return;
    keep(b, r, beyond,
         "the move takes axis " + name(r.axis) + " to " + mm(below > above ? lo : hi) +
             " in machine coordinates" + (by.empty() ? "" : " (" + by + ")") + "; it may be from " +
             plain(r.least_mm) + " to " + plain(r.most_mm) + ": move the piece or its offset" +
             (r.axis == 2 ? ", or take another tool" : ""));
  }

  void unplaced(const Block& b, const AxisPlaces::Range& r, const std::string& why) {
    keep(b, r, 1e300, "axis " + name(r.axis) + " cannot be held to its limits: " + why);
  }

  void keep(const Block& b, const AxisPlaces::Range& r, double beyond, const std::string& message) {
    const Findings::Where where = c_.where(b);
    Far& far = farthest_[{where.order, r.axis}];
    if (beyond > far.beyond_mm) far = {where, message, beyond};
  }

  const ProgramCase& c_;
  const ToolTable& table_;
  const AxisPlaces& places_;
  Findings& findings_;
  const bool touches_off_ = touches_off(c_.machine);
  std::map<std::pair<std::size_t, std::size_t>, Far> farthest_;  ///< by step and axis
};

}  // namespace

std::vector<model::Finding> check_axis_places(const ProgramText& text, const model::Plan* plan,
                                              const model::Machine& machine,
                                              const std::vector<model::Cutter>& cutters,
                                              const AxisPlaces& places) {
  Findings findings;
  const DialectReader* reader = reader_of(machine.control.dialect);
  if (reader == nullptr) {
    findings.error(22, "CHK-PLACE", {0, "", -1},
                   "programs of the control '" + machine.control.dialect +
                       "' cannot be read back, so that no axis can be held to its limits");
    return findings.take();
  }
  const Program program = reader->program(text.text, machine);
  ProgramCase c = make_case(*reader, program, plan, machine, cutters);
  c.has_table = !text.tool_table.empty() && reader->tool_table != nullptr;
  const ToolTable table = c.has_table ? reader->tool_table(text.tool_table) : ToolTable{};
  Placing(c, table, places, findings).run();
  return findings.take();
}

}  // namespace capstan::verify
