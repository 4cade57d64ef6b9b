#include <map>
#include <vector>

#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/touches/measured.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/reader_options.h"

// What the text does between two steps, against the plan: tools are changed where the next step has another
// one, the program stops where a piece is clamped anew, measured, or a step is condemned, and nowhere else.

namespace capstan::verify {
namespace {

class Between {
 public:
  Between(const ProgramCase& c, Findings& out) : c_(c), out_(out), touches_(touches_before(*c.plan)) {}

  void run() {
    for (const Block& b : c_.program.blocks) {
      switch (b.kind) {
        case Block::Kind::kToolChange:
          change(b);
          break;
        case Block::Kind::kStop:
          stop(b);
          break;
        case Block::Kind::kEnd:
          end(b);
          break;
        case Block::Kind::kMove:
          if (b.marker < 0) {
            before_steps(b);
          } else if (!b.in_machine && b.marker != step_) {
            begin(b);
          }
          break;
        case Block::Kind::kDwell:
          if (b.marker < 0) before_steps(b);
          break;
      }
    }
    for (const auto& [line, code] : c_.program.odd)
      out_.error(33, "CHK-TEXT-STATE", {1, "", line}, code + ", which the plan does not ask for");
  }

 private:
  [[nodiscard]] const model::StepResult* planned(int marker) const {
    if (marker < 0) return nullptr;
    const long i = c_.step_of_marker[static_cast<std::size_t>(marker)];
    return i < 0 ? nullptr : &c_.plan->steps[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] int pocket(const model::StepResult* s) const {
    const auto* cutter = s != nullptr ? model::find_cutter(*c_.plan, s->cutter_id) : nullptr;
    return cutter != nullptr ? cutter->pocket : 0;
  }

  /// Whether a step needs the zero of Z set with the tool that was changed last for `before`.
  [[nodiscard]] bool sets_anew(const model::StepResult* s, const model::StepResult* before) const {
    return touches_off_ && s != nullptr && before != nullptr && s->setup != before->setup;
  }

  void before_steps(const Block& b) {
    // Each step states its own: one from before the first acts where a step is edited or begun by itself.
    if (b.work_offset != 0)
      out_.error(33, "CHK-TEXT-STATE", c_.where(b),
                 "the work offset " + offset_name(b.work_offset) +
                     " is stated before the first step; the plan's steps state theirs, so take it out");
    const bool retract = b.kind == Block::Kind::kMove && b.in_machine && b.move == model::MoveKind::kRapid &&
                         !b.words[0] && !b.words[1] && at_top(b, c_.machine);
    if (b.spindle_rpm != 0.0)
      out_.error(15, "CHK-TEXT-STATE", c_.where(b),
                 "the spindle turns before the first step, with whatever tool is in it; take it out");
    if (!retract)
      out_.error(33, "CHK-TEXT", c_.where(b),
                 "a move or a wait before the first step that the plan does not have");
  }

  void change(const Block& b) {
    if (b.flood || b.mist || b.through)
      out_.error(29, "CHK-TEXT-STATE", c_.where(b), "the coolant is on in a change of tools");
    const model::StepResult* s = planned(b.marker);
    for (const long line : c_.probe_calls) {
      if (line > last_change_ && line < b.line) loaded_ = 0;  // the probe is in the spindle
    }
    last_change_ = b.line;
    if (b.tool == loaded_ && !sets_anew(s, planned(changed_)))
      out_.error(4, "CHK-TEXT-TOOL", c_.where(b),
                 "T" + std::to_string(b.tool) + " is changed for itself; the plan has no change here");
    loaded_ = b.tool;
    if (b.marker == changed_)
      out_.error(4, "CHK-TEXT-TOOL", c_.where(b), "a second change of tools in one step; the plan has one");
    changed_ = b.marker;
    if (s == nullptr || b.tool != pocket(s))
      out_.error(
          4, "CHK-TEXT-TOOL", c_.where(b),
          "T" + std::to_string(b.tool) + " is loaded; the plan " +
              (s != nullptr ? "has T" + std::to_string(pocket(s)) : std::string("has no change here")));
  }

  void stop(const Block& b) {
    ++stops_;
    last_stop_ = b.line;
    std::string wrong;
    if (b.spindle_rpm != 0.0) wrong = "with the spindle on";
    if (b.flood || b.mist || b.through) wrong = "with the coolant on";
    if (!at_top(b, c_.machine)) wrong = "before the tool is at the top of Z";
    if (!wrong.empty()) out_.error(31, "CHK-TEXT-STOP", c_.where(b), "the program stops " + wrong);
  }

  /// The first move of a step: what had to be done before it was done.
  void begin(const Block& b) {
    const model::StepResult* s = planned(b.marker);
    const bool first = step_ < 0;
    step_ = b.marker;
    if (s == nullptr) return;
    int wanted = 0;
    if (!first && proves_out_ && pocket(s) != proved_) ++wanted;
    proved_ = pocket(s);
    if (!first && setup_ != s->setup) ++wanted;
    if (sets_anew(s, planned(changed_)))
      out_.error(4, "CHK-TEXT-TOOL", c_.where(b),
                 "set-up " + std::to_string(s->setup + 1) + " goes on with T" + std::to_string(loaded_) +
                     ", and nobody sets the zero of Z with it there; state T" + std::to_string(loaded_) +
                     " M6 behind its work offset");
    if (touches_.contains(s->step)) ++wanted;
    if (c_.program.markers[static_cast<std::size_t>(b.marker)].condemned) ++wanted;
    setup_ = s->setup;
    stops(c_.where(b), wanted);
  }

  void end(const Block& b) {
    stops(c_.where(b), touches_.contains({}) ? 1 : 0);
    if (!at_top(b, c_.machine))
      out_.error(32, "CHK-END-LOW", c_.where(b), "the program ends before the tool is at the top of Z");
  }

  void stops(Findings::Where at, int wanted) {
    if (stops_ > wanted) at.move = last_stop_;
    if (stops_ != wanted)
      out_.error(31, "CHK-TEXT-STOP", at,
                 "the text stops (M0) " + std::to_string(stops_) + " times before this; the plan asks for " +
                     std::to_string(wanted) + ": to clamp anew, to measure, or before a condemned step");
    stops_ = 0;
  }

  const ProgramCase& c_;
  Findings& out_;
  std::map<model::AnyRef, std::vector<model::AnyRef>> touches_;
  /// The machine stops behind the last step of each tool.
  const bool proves_out_ = model::control_option(c_.machine, "prove_out") == "m0";
  const bool touches_off_ = touches_off(c_.machine);
  int proved_ = 0;
  int step_ = -1, changed_ = -2, loaded_ = 0, stops_ = 0;
  long last_stop_ = -1, last_change_ = -1;
  std::size_t setup_ = 0;
};

}  // namespace

void check_between(const ProgramCase& c, Findings& findings) {
  if (c.plan != nullptr) Between(c, findings).run();
}

}  // namespace capstan::verify
