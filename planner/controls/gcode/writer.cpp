#include "planner/controls/gcode/writer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "planner/controls/gcode/able.h"
#include "planner/controls/gcode/header.h"
#include "planner/controls/gcode/measuring/macros.h"
#include "planner/controls/gcode/measuring/probe_moves.h"
#include "planner/controls/gcode/moves/arcs.h"
#include "planner/controls/gcode/moves/helices.h"
#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/moves/repeats.h"
#include "planner/controls/gcode/moves/taps.h"
#include "planner/controls/gcode/moves/write_pocket.h"
#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/probing.h"
#include "planner/controls/gcode/program.h"
#include "planner/controls/gcode/setups.h"
#include "planner/controls/gcode/text.h"
#include "planner/controls/gcode/writable.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/plan/edit/cycles.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/model/plan/resources/shop_texts.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::Cutter;
using model::CutterPath;
using model::MoveKind;
using model::MoveRole;
using model::Plan;
using model::StepResult;

// Characters of a line that a message leaves free; defaults, unsourced.
constexpr std::size_t kFreeOfClamping = 22, kFreeOfProbing = 32, kFreeOfCondemned = 52;

class Writer {
 public:
  Writer(const Plan& plan, const Words& words, const std::vector<model::Condemnation>& condemned)
      : plan_(plan),
        words_(words),
        condemned_(condemned),
        program_(plan.machine.control, words),
        probings_(probings_before(plan)) {
    for (const StepResult& s : plan.steps) uses_through_ = uses_through_ || s.through;
  }

  Result<std::string> run() {
    if (!words_.first.empty()) program_.line(words_.first);
    write_header(plan_, condemned_, program_);
    if (auto ok = write_texts(plan_, model::kProgramHeader, program_); !ok) return tl::unexpected(ok.error());
    for (const auto& [tool, comment] : pockets_.tables) program_.marker(comment);
    write_setup(plan_, plan_.steps.front().setup, std::nullopt, program_);
    program_.blank();
    if (!words_.first_state.empty()) program_.line(words_.first_state);
    // What they leave is stated again.
    if (shop_blocks("start_blocks") && !words_.first_state.empty()) program_.line(words_.first_state);
    tolerance(0.0, true);
    retract();
    stop();
    const std::vector<std::string> ids = model::step_ids(plan_);
    for (std::size_t n = 0; n < plan_.steps.size(); ++n) {
      const StepResult& step = plan_.steps[n];
      const Cutter& cutter = *model::find_cutter(plan_, step.cutter_id);
      const bool measured = probe(step.step, &step);
      enter(step, cutter, ids[n], n, measured);
      by_cycles_ = cycles_[n].empty() ? words_.by_cycles : cycles_[n] != model::kExplicitMoves;
      if (write_pocket(pockets_.of_step[n], words_, program_)) continue;
      if (write_face(faces_[n], words_, program_)) continue;
      const bool smooth = !words_.smooth_on.empty() && cuts_across(*step.path);
      if (smooth) program_.line(words_.smooth_on);
      if (auto done = moves(step, cutter, ids[n]); !done) return tl::unexpected(done.error());
      if (smooth) program_.line(words_.smooth_off);
    }
    program_.blank();
    (void)probe({}, nullptr);
    program_.comment("end");
    retract();
    stop();
    shop_blocks("end_blocks");
    if (auto ok = write_texts(plan_, model::kProgramFooter, program_); !ok) return tl::unexpected(ok.error());
    program_.line(words_.last);
    if (auto ok = numbers_differ(plan_.machine, words_.first_subprogram, subprograms_.size()); !ok)
      return tl::unexpected(ok.error());
    for (std::size_t n = 0; n < subprograms_.size(); ++n)
      program_.line(words_.subprogram(words_.first_subprogram + static_cast<int>(n), subprograms_[n]));
    if (!words_.behind.empty()) program_.line(words_.behind);
    return program_.take();
  }

 private:
  // The blocks of the shop that this option of the machine has, if there are any.
  bool shop_blocks(std::string_view option) {
    const std::string_view stated = model::control_option(plan_.machine, option);
    for (const std::string& block : blocks_of(stated)) program_.line(block);
    return !stated.empty();
  }

  // Characters of a message that leaves so many of the line free.
  [[nodiscard]] std::size_t room(std::size_t free) const {
    const std::size_t of_line = words_.longest_line - std::min(free, words_.longest_line);
    return words_.longest_message > 0 ? std::min(of_line, words_.longest_message) : of_line;
  }

  // What a message has no room for is in a comment before it.
  void tell(const std::string& text) {
    const std::size_t most = words_.longest_message;
    const bool cut = most > 0 && text.size() > most;
    if (cut) program_.comment(text);
    program_.line(words_.message(cut ? shortened(text, most) : text));
    program_.line("M0");
    if (!words_.message_end.empty()) program_.line(words_.message_end);
  }

  // `after` is written whole, `text` before it as far as there is room: the comments have it all.
  static std::string fitted(const std::string& text, const std::string& after, std::size_t longest) {
    return shortened(plain_text(text), longest - std::min(longest, after.size())) + after;
  }

  // Measurements before a step (at the end: those that are left, `next` null): a stop each, with nothing
  // moving but what the machine's file states of touches, where their way is clear. Whether there was one.
  bool probe(model::AnyRef before, const StepResult* next) {
    const auto due = probings_.find(before);
    if (due == probings_.end()) return false;
    program_.blank();
    retract();
    stop();
    std::string first;
    for (const model::AnyRef r : due->second) {
      const std::vector<std::string> lines = probing_text(plan_, r);
      for (const std::string& line : lines) program_.comment(line);
      if (first.empty()) first = lines.front();
    }
    by_machine(due->second, next);
    const std::size_t n = due->second.size();
    const std::string what = n == 1 ? first : std::to_string(n) + " touches as listed: " + first + ", ...";
    const Remedy remedy = remedy_of(plan_, due->second, before);
    for (const std::string& line : remedy.comments) program_.comment(line);
    tell(fitted(what, ", " + remedy.message, room(kFreeOfProbing)));
    return true;
  }

  // What the machine measures, by its macro or by moves. Behind it the tool is away, and is called again.
  void by_machine(const std::vector<model::AnyRef>& touches, const StepResult* next) {
    for (const TouchBlocks& made : {macro_calls(plan_, touches, next, {tool_, setup_}, words_),
                                    probe_moves(plan_, touches, next, {tool_, setup_}, words_)}) {
      for (const std::string& line : made.comments) program_.comment(line);
      for (const std::string& block : made.blocks) program_.line(block);
      if (made.blocks.empty()) continue;
      retract();
      stop();
      probe_is_in_ = true;
    }
  }

  // The reasons to stop before a step; those of the whole plan stop before its first.
  [[nodiscard]] std::vector<const model::Condemnation*> reasons(const StepResult& step, std::size_t n) const {
    std::vector<const model::Condemnation*> out;
    if (condemned_.empty()) return out;
    const std::string id = model::step_id(plan_, step);
    for (const auto& c : condemned_) {
      if (c.step.empty() ? n == 0 : c.step == id) out.push_back(&c);
    }
    return out;
  }

  void stop_for(const std::vector<const model::Condemnation*>& why, std::size_t n) {
    for (const auto* c : why) program_.comment("CONDEMNED: " + c->text);
    const std::string before = "condemned step " + std::to_string(n + 1) + ": ";
    const std::string after = why.size() == 1 ? "; continue at your own risk"
                                              : "; and " + std::to_string(why.size() - 1) +
                                                    " more, see the program; continue at your own risk";
    tell(fitted(before + why.front()->text, after, room(kFreeOfCondemned)));
  }

  // The step's own tolerance, where the control blends at all.
  void tolerance(double of_step_mm, bool finishes) {
    const double own = plan_.machine.control.path_tolerance_mm;
    const double p = own > 0.0 && of_step_mm > 0.0 ? of_step_mm : own;
    const bool exact = p < 0.0 || rounded(p, plan_.machine.control.decimals) == 0.0;
    program_.line(words_.path_mode(exact ? std::string() : program_.number(p), finishes));
  }

  void retract() {
    program_.line(words_.retract(program_.number(plan_.machine.axes[2].travel_max_mm)));
    program_.lost_z();
  }

  void stop() {
    program_.line("M5");
    program_.line("M9");
    through(false);
    speed_ = 0.0;
    flood_ = mist_ = false;
  }

  // The marker, and everything the control must know, wherever it comes from. `measured`: behind a stop for
  // measuring.
  void enter(const StepResult& step, const Cutter& cutter, const std::string& id, std::size_t n,
             bool measured) {
    const model::SetupResult& setup = plan_.setups[step.setup];
    const bool other_tool = cutter.pocket != tool_, new_tool = other_tool || probe_is_in_;
    probe_is_in_ = false;
    const bool first = tool_ == 0;
    const bool new_setup = !first && step.setup != setup_;
    const bool again = new_setup && !new_tool && words_.call_again;
    forget_cycle();
    const auto why = reasons(step, n);
    program_.blank();
    if ((new_tool || new_setup || !why.empty()) && !first) {
      retract();
      stop();
      if (other_tool && !words_.tool_end.empty()) program_.line(words_.tool_end);
    }
    program_.marker("CAPSTAN STEP id=\"" + marker_text(id) + "\" n=" + std::to_string(n + 1) +
                    " tool=" + std::to_string(cutter.pocket) + " setup=" + std::to_string(step.setup + 1) +
                    (why.empty() ? std::string() : " condemned=\"" + marker_text(why.front()->code) + "\""));
    if (new_setup) {
      write_setup(plan_, step.setup, setup_, program_);
      tell(plain_text(clamping_text(plan_, step.setup, setup_, room(kFreeOfClamping))));
    }
    if (!why.empty()) stop_for(why, n);
    // Behind a step with the same tool a restart would not call it.
    if (new_tool || again) program_.number_step(n + 1);
    if (!words_.step_state.empty()) program_.line(words_.step_state);
    tolerance(step.contour_tolerance_mm, !roughs(step));
    program_.line(words_.work_offset ? words_.work_offset(setup.work_offset) : setup.work_offset);
    const std::string t = std::to_string(cutter.pocket);
    if (other_tool && cutter.cutter_class == model::CutterClass::kBoringTool)
      program_.comment("T" + t + ": the boring tool is set to diameter " +
                       program_.number(cutter.cutting_diameter_mm) + " mm");
    if (new_tool) {
      called_ = speed_text(speed(step, step.path->size() > 1 ? 1 : 0));
      program_.line(words_.change_tool(t, cutter.id, called_));
      if (const Cutter* next = next_tool(plan_, n); next != nullptr && words_.stage_tool)
        program_.line(words_.stage_tool(std::to_string(next->pocket), next->id));
    }
    if (again) program_.line(words_.call_again(t, cutter.id, setup.work_offset));
    if (words_.offset_moves_z) {
      program_.with_next_height(" " + words_.length_offset(t));
    } else if (const std::string offset = words_.length_offset(t); !offset.empty()) {
      program_.line(offset);
    }
    tool_ = cutter.pocket;
    setup_ = step.setup;
    approach(step, setup, new_tool || new_setup || measured || !why.empty());
  }

  // Other cycles may end the one that is defined, and a restart begins at a step.
  void forget_cycle() { defined_.clear(); }

  // To the start of the path, from the top of the machine or from the security plane.
  void approach(const StepResult& step, const model::SetupResult& setup, bool from_top) {
    const Vec3 start = program_.round(step.path->point(0));
    const auto before = program_.at();
    program_.forget();
    program_.with_next_move({});  // the last step's
    if (!from_top) {
      double top = std::max(start.z, program_.round({0.0, 0.0, setup.security_z_mm}).z);
      if (before) top = std::max(top, before->z);
      program_.rapid_z(top);
    }
    spindle(speed(step, step.path->size() > 1 ? 1 : 0), true);
    program_.rapid_xy(start);
    coolant(step);
    program_.rapid_z(start.z);
  }

  [[nodiscard]] bool roughs(const StepResult& step) const {
    const auto* w = plan_.model.get<model::MachiningWorkingstep>(step.step);
    return w != nullptr && model::has(w->its_operation.type, model::OperationTrait::kRoughs);
  }

  static double speed(const StepResult& step, std::size_t move) {
    return step.schedule ? step.schedule->spindle_rpm[move] : step.spindle_rpm;
  }

  [[nodiscard]] std::string speed_text(double rpm) const {
    const double turns_at = std::abs(rounded(rpm, words_.speed_decimals));
    return words_.speed ? words_.speed(turns_at) : words_.number(turns_at, words_.speed_decimals);
  }

  // `always`: stated even when it is so already. A start and a reversal wait for the spindle.
  void spindle(double rpm, bool always) {
    const double wanted = rounded(rpm, words_.speed_decimals);
    if (wanted == speed_ && !always) return;
    program_.with_next_move({});
    if (wanted == 0.0) {
      program_.line("M5");
      speed_ = 0.0;
      return;
    }
    const bool turns = speed_ != 0.0 && (speed_ > 0.0) == (wanted > 0.0);
    if (!turns && speed_ != 0.0) program_.line("M5");
    const std::string text = speed_text(wanted);
    if (turns && !always && words_.speed_in_move) {
      program_.with_next_move(" S" + text);
      speed_ = wanted;
      return;
    }
    if (turns && !always && words_.new_speed) {
      program_.line(words_.new_speed(text));
      speed_ = wanted;
      return;
    }
    program_.line(words_.spindle ? words_.spindle(text, wanted > 0.0, text == called_)
                                 : "S" + text + (wanted > 0.0 ? " M3" : " M4"));
    called_.clear();
    if (!turns) dwell(plan_.machine.spindle.spin_up_s);
    speed_ = wanted;
  }

  void coolant(const StepResult& step) {
    // First, for the code that switches it off may be M9.
    if (!step.through) through(false, uses_through_);
    if ((flood_ && !step.flood) || (mist_ && !step.mist) || (!step.flood && !step.mist)) program_.line("M9");
    if (step.mist) program_.line("M7");
    if (step.flood) program_.line("M8");
    flood_ = step.flood;
    mist_ = step.mist;
    if (step.through) through(true);
  }

  // Coolant through the spindle; a program that has it on somewhere states it at each step.
  void through(bool on, bool always = false) {
    const auto codes = through_codes_of(plan_.machine);  // there where a step has it on: able.h
    if (codes && (on || through_ || always)) program_.line(on ? codes->on : codes->off);
    through_ = on;
  }

  Status moves(const StepResult& step, const Cutter& cutter, const std::string& id) {
    const CutterPath& path = *step.path;
    bool tapped = false;
    for (std::size_t i = 1; i < path.size(); ++i) {
      // A spindle that tapping has stopped is not started to draw the tap away.
      if (!tapped || path.kind[i] != MoveKind::kRapid) spindle(speed(step, i), false);
      const double feed = step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min;
      const Vec3 to = program_.round(path.point(i));
      if (path.role[i] == MoveRole::kTap && path.kind[i] != MoveKind::kRapid) {
        const auto last = tap(step, cutter, i);
        if (!last) return located(last.error(), id, i);
        i = *last;
        if (words_.tap_stops_spindle) {
          tapped = true;
          speed_ = 0.0;
        }
        continue;
      }
      if (const auto last = cycle(step, i)) {
        i = *last;
        continue;
      }
      if (const auto last = by_subprogram(step, i)) {
        i = *last;
        continue;
      }
      if (const auto helix =
              words_.turns ? helix_at(step, i, *program_.at(), program_.arc_form()) : std::nullopt) {
        program_.helix(*helix, path.kind[i] == MoveKind::kArcCw, feed);
        i = helix->last_move;
        continue;
      }
      switch (path.kind[i]) {
        case MoveKind::kRapid:
          program_.rapid(to);
          break;
        case MoveKind::kLine:
          program_.cut(to, feed);
          break;
        case MoveKind::kArcCw:
        case MoveKind::kArcCcw:
          if (auto done = arc(path, i, feed); !done) return located(done.error(), id, i);
          break;
        case MoveKind::kDwell:
          dwell(step.schedule ? step.schedule->dwell_s[i] : 0.0);
          break;
      }
    }
    return {};
  }

  static tl::unexpected<Diagnostic> located(Diagnostic d, const std::string& id, std::size_t move) {
    d.path = id + ", move " + std::to_string(move);
    return fail(std::move(d));
  }

  void dwell(double seconds) {
    if (rounded(seconds, words_.dwell_decimals) <= 0.0) return;
    forget_cycle();
    program_.write_waiting();
    program_.line(words_.dwell(words_.number(seconds, words_.dwell_decimals)));
  }

  Status arc(const CutterPath& path, std::size_t i, double feed) {
    const auto pieces = arc_pieces(path, i, *program_.at(), program_.arc_form());
    if (!pieces) return tl::unexpected(pieces.error());
    for (const ArcPiece& p : *pieces) {
      if (p.line) {
        program_.cut(p.to, feed);
      } else {
        program_.arc(p.to, p.i, p.j, path.kind[i] == MoveKind::kArcCw, feed);
      }
    }
    return {};
  }

  // From move `i` on equal holes as a canned cycle, where the control has one that makes the same moves.
  // Gives their last move.
  std::optional<std::size_t> cycle(const StepResult& step, std::size_t i) {
    if (!words_.cycle || !by_cycles_ || !program_.at()) return std::nullopt;
    const auto holes = holes_at(step, i, *program_.at(), plan_.machine.control);
    if (!holes) return std::nullopt;
    const auto text = words_.cycle(holes->cycle, holes->places);
    if (!text) return std::nullopt;
    const double z = program_.at()->z;
    program_.write_waiting();
    const bool same = !words_.cycle_call.empty() && text->text == defined_;
    const bool by_calls = !words_.cycle_call_there.empty();
    const geometry::Vec2 last = by_calls ? holes->places.front() : holes->places.back();
    program_.moved(same ? std::string(words_.cycle_call) : text->text, program_.round({last.x, last.y, z}),
                   text->computed_place);
    defined_ = text->text;
    if (by_calls) {
      for (std::size_t n = 1; n < holes->places.size(); ++n) {
        program_.with_next_move(" " + std::string(words_.cycle_call_there));
        program_.rapid(program_.round({holes->places[n].x, holes->places[n].y, z}));
      }
    }
    program_.forget_feed();
    if (holes->cycle.stops) speed_ = 0.0;
    return holes->last_move;
  }

  // From move `i` on equal holes of explicit moves as calls of one subprogram. Gives their last move.
  std::optional<std::size_t> by_subprogram(const StepResult& step, std::size_t i) {
    if (!words_.call || !program_.at()) return std::nullopt;
    const auto holes = repeats_at(step, i, *program_.at(), plan_.machine.control, words_);
    if (!holes) return std::nullopt;
    const auto known = std::find(subprograms_.begin(), subprograms_.end(), holes->lines);
    const int number = words_.first_subprogram + static_cast<int>(known - subprograms_.begin());
    if (number > words_.last_subprogram) return std::nullopt;
    if (known == subprograms_.end()) subprograms_.push_back(holes->lines);
    const double z = program_.at()->z;
    program_.write_waiting();
    for (std::size_t n = 0; n < holes->places.size(); ++n) {
      const Vec3 place = program_.round({holes->places[n].x, holes->places[n].y, z});
      if (n > 0) program_.rapid(place);
      program_.moved(words_.call(number), place);
    }
    program_.forget_feed();
    return holes->last_move;
  }

  // A tap down and up again. Gives the index of the move up.
  Result<std::size_t> tap(const StepResult& step, const Cutter& cutter, std::size_t down) {
    if (!words_.tap)
      return fail(
          {.code = "OUT-TAP",
           .message = "programs of this control cannot keep a tap and its feed in step",
           .hint = "mill the thread (a thread mill among the tools), or tap by hand and leave the step out"});
    const Vec3 top = *program_.at();
    const auto hole = tap_at(plan_, step, cutter, down, top, speed_);
    if (!hole) return tl::unexpected(hole.error());
    program_.write_waiting();
    forget_cycle();
    program_.moved(words_.tap(hole->cycle), top);
    program_.forget_feed();
    return hole->last_move;
  }

  const Plan& plan_;
  const Words& words_;
  const std::vector<model::Condemnation>& condemned_;
  Program program_;
  std::map<model::AnyRef, std::vector<model::AnyRef>> probings_;    // by the step they precede
  std::vector<std::string> cycles_ = model::cycles_by_step(plan_);  // by step: what edits say of them
  AskedPockets pockets_ = asked_pockets(plan_, words_.pockets);
  std::vector<FaceOfStep> faces_ = asked_faces(plan_, words_.faces);
  bool by_cycles_ = false;  // of the step at hand
  int tool_ = 0;
  std::size_t setup_ = 0;
  double speed_ = 0.0;
  std::string called_;  // speed that the change of the tool stated, until the spindle starts
  bool flood_ = false, mist_ = false, through_ = false;
  bool probe_is_in_ = false;              // in place of tool_
  bool uses_through_ = false;             // a step of the plan does
  std::vector<std::string> subprograms_;  // lines of each
  std::string defined_;                   // text of the cycle that a call would run
};

}  // namespace

Result<std::string> write(const Plan& plan, const Words& words,
                          const std::vector<model::Condemnation>& condemned, Job& job) {
  if (auto ok = writable(plan, words.work_offsets, job); !ok) return tl::unexpected(ok.error());
  if (auto ok = able(plan, words); !ok) return tl::unexpected(ok.error());
  auto text = Writer(plan, words, condemned).run();
  if (!text) return text;
  if (auto ok = codes_known(*text, words.codes); !ok) return tl::unexpected(ok.error());
  return text;
}

}  // namespace capstan::controls::gcode
