#include "planner/controls/linuxcnc/linuxcnc.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "planner/controls/linuxcnc/arcs.h"
#include "planner/controls/linuxcnc/check.h"
#include "planner/controls/linuxcnc/comment.h"
#include "planner/controls/linuxcnc/probing.h"
#include "planner/controls/linuxcnc/program.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/physics/motion/time.h"

namespace capstan::controls {
namespace {

using geometry::Vec3;
using model::Cutter;
using model::CutterPath;
using model::FeedSchedule;
using model::MoveKind;
using model::MoveRole;
using model::Plan;
using model::StepResult;

constexpr int kSpeedDecimals = 1;
constexpr int kDwellDecimals = 3;
constexpr int kPitchDecimals = 6;
// Feed and pitch times speed of a tap may differ by what rounding of either explains.
constexpr double kPitchAgreement = 0.01;

class Writer {
 public:
  Writer(const Plan& plan, const std::vector<model::Condemnation>& condemned)
      : plan_(plan),
        condemned_(condemned),
        program_(plan.machine.control),
        probings_(probings_before(plan)) {}

  Result<std::string> run() {
    header();
    const std::vector<std::string> ids = model::step_ids(plan_);
    for (std::size_t n = 0; n < plan_.steps.size(); ++n) {
      const StepResult& step = plan_.steps[n];
      const Cutter& cutter = *model::find_cutter(plan_, step.cutter_id);
      measured_ = probe(step.step);
      enter(step, cutter, ids[n], n);
      if (auto done = moves(step, cutter, ids[n]); !done) return tl::unexpected(done.error());
    }
    program_.blank();
    (void)probe({});
    program_.comment("end");
    retract();
    stop();
    program_.line("M2");
    return program_.take();
  }

 private:
  // Measurements before a step (at the end: those that are left): a stop each, with nothing moving. Whether
  // there was one.
  bool probe(model::AnyRef before) {
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
    const std::size_t n = due->second.size();
    const std::string what = n == 1 ? first : std::to_string(n) + " touches as listed: " + first + ", ...";
    const Remedy remedy = remedy_of(plan_, due->second, before);
    for (const std::string& line : remedy.comments) program_.comment(line);
    // What is to be done stands whole, what is measured as far as there is room.
    constexpr std::size_t kRoom = 220;
    const std::string after = ", " + remedy.message;
    const std::size_t room = kRoom - std::min(kRoom, after.size());
    program_.line("(MSG, " + plain_text(what).substr(0, room) + after + ")");
    program_.line("M0");
    return true;
  }

  void header() {
    program_.comment("CAPSTAN PROGRAM version=1");
    const auto* project = plan_.model.get<model::Project>(plan_.project);
    if (project != nullptr && project->its_id) program_.comment("part: " + *project->its_id);
    if (!plan_.file_name.empty()) program_.comment("file: " + plan_.file_name);
    program_.comment("machine: " + plan_.machine.id);
    program_.comment("material: " + plan_.material.id);
    if (const auto t = motion::time_of(plan_); t && t->total_s() > 0.0)
      program_.comment("time: " + motion::text_of(*t));
    if (!plan_.stock.box.empty()) {
      const Vec3 s = plan_.stock.box.size();
      program_.comment("stock: " + program_.number(s.x) + " x " + program_.number(s.y) + " x " +
                       program_.number(s.z) + " mm");
    }
    for (std::size_t i = 0; i < plan_.setups.size(); ++i) {
      program_.comment("CAPSTAN SETUP n=" + std::to_string(i + 1) + " offset=" + plan_.setups[i].work_offset +
                       " security=" + program_.number(plan_.setups[i].security_z_mm));
    }
    for (const Cutter* c : by_pocket()) {
      const std::string t = std::to_string(c->pocket);
      program_.comment("CAPSTAN TOOL T" + t + " H" + t +
                       " length=" + program_.number(model::length_offset_mm(*c)) +
                       " diameter=" + program_.number(c->cutting_diameter_mm) + " id=\"" +
                       marker_text(c->id) + "\" " + std::string(model::to_text(c->cutter_class)));
    }
    for (const Cutter* c : by_pocket()) {
      if (const std::string fault = model::offset_fault(*c); !fault.empty()) {
        program_.comment("NOT MEASURED: " + fault + "; measure the tool before this program runs");
      } else if (c->table_line && c->table_line->against_reference) {
        program_.comment("T" + std::to_string(c->pocket) +
                         ": its length offset counts from a reference; its length is not known, " +
                         program_.number(c->functional_length_mm) + " mm is assumed");
      }
    }
    warnings();
    if (!plan_.steps.empty()) clamped(plan_.steps.front().setup, std::nullopt);
    program_.blank();
    program_.line("G21 G17 G90 G94 G40 G49 G80");
    tolerance(0.0);
    retract();
    stop();
  }

  // What the check found, for whoever loads the program in spite of it.
  void warnings() {
    if (condemned_.empty()) return;
    const std::size_t n = condemned_.size();
    program_.comment("CONDEMNED: the check refuses this program for " +
                     (n == 1 ? "the reason below" : "the " + std::to_string(n) + " reasons below") +
                     "; it was asked for all the same, and stops before each condemned step");
    for (const auto& c : condemned_) program_.comment("CONDEMNED: " + model::text_of(plan_, c));
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
    constexpr std::size_t kLongest = 200;  // of a line's 255 characters; default, unsourced
    program_.line("(MSG, " + before +
                  plain_text(why.front()->text).substr(0, kLongest - before.size() - after.size()) + after +
                  ")");
    program_.line("M0");
  }

  // What the operator must know before a set-up begins: where zero is, what holds the piece, and where.
  void clamped(std::size_t n, std::optional<std::size_t> before) {
    const model::SetupResult& setup = plan_.setups[n];
    const model::Workholding& h = setup.holding;
    const std::string name = "set-up " + std::to_string(n + 1) + ": ";
    lies(n, before, name);
    if (!h.pickup_text.empty())
      program_.comment(name + "pick up " + setup.work_offset + ": " + h.pickup_text);
    if (h.solids.empty()) {
      program_.comment(name + "what holds the piece is not planned: fixtures and clamps are not checked");
      return;
    }
    program_.comment(name + "held by " + (h.description.empty() ? h.id : h.description));
    for (const model::FixtureSolid& s : h.solids) {
      geometry::Box3 box;
      for (const geometry::Vec2 p : s.outline) {
        box.add({p.x, p.y, s.bottom_mm});
        box.add({p.x, p.y, s.top_mm});
      }
      if (box.empty()) continue;
      const auto range = [&](double lo, double hi) {
        return program_.number(lo) + " to " + program_.number(hi);
      };
      program_.comment(name + s.id + ": X " + range(box.lo.x, box.hi.x) + ", Y " + range(box.lo.y, box.hi.y) +
                       ", Z " + range(box.lo.z, box.hi.z) + " mm" + (s.presses ? "" : ", does not press"));
    }
  }

  // How the piece lies and where zero is on it, in words and numbers.
  void lies(std::size_t n, std::optional<std::size_t> before, const std::string& name) {
    const auto here = model::placed_in(plan_, n);
    if (before)
      program_.comment(name + "the workpiece is " + model::turn_text(model::placed_in(plan_, *before), here) +
                       " after set-up " + std::to_string(*before + 1));
    program_.comment(name + "the workpiece's " + model::axis_text(here, {0, 0, 1}) + " up, its " +
                     model::axis_text(here, {1, 0, 0}) + " to the right, its " +
                     model::axis_text(here, {0, 1, 0}) + " to the back");
    const std::string at = zero(n);
    const Vec3 own = here.to_local({0, 0, 0});
    const std::string in_part = "the point X" + program_.number(own.x) + " Y" + program_.number(own.y) +
                                " Z" + program_.number(own.z) + " of the part's drawing";
    program_.comment(
        name + "zero " + plan_.setups[n].work_offset +
        (at.empty() ? ": " + in_part : " on the raw piece as it lies: " + at + "; that is " + in_part));
    if (at.empty()) return;
    geometry::Box3 raw;
    raw.add(here.to_parent(plan_.stock.box.lo));
    raw.add(here.to_parent(plan_.stock.box.hi));
    program_.comment(name + "the raw piece reaches from X" + program_.number(raw.lo.x) + " Y" +
                     program_.number(raw.lo.y) + " Z" + program_.number(raw.lo.z) + " to X" +
                     program_.number(raw.hi.x) + " Y" + program_.number(raw.hi.y) + " Z" +
                     program_.number(raw.hi.z) +
                     (before ? "; a side that was cut before stands back by what was cut" : ""));
  }

  [[nodiscard]] std::string zero(std::size_t n) const {
    return model::zero_text(plan_.stock.box, model::placed_in(plan_, n), plan_.machine.control.decimals);
  }

  // What to do between two set-ups, in a message that a line of the control can hold.
  [[nodiscard]] std::string to_clamp(std::size_t n, std::size_t before) const {
    constexpr std::size_t kLongest = 230;  // of a line's 255 characters; default, unsourced
    const auto here = model::placed_in(plan_, n);
    const std::string offset = plan_.setups[n].work_offset, at = zero(n);
    const std::string first = "set-up " + std::to_string(n + 1) + ": clamp the workpiece anew, " +
                              model::turn_text(model::placed_in(plan_, before), here) + ", its " +
                              model::axis_text(here, {0, 0, 1}) + " up; set " + offset;
    const std::string last = ", then continue";
    const std::string where = at.empty() ? " as the program says" : ": " + at;
    const bool fits = first.size() + where.size() + last.size() <= kLongest;
    return first + (fits ? where : " as the program says") + last;
  }

  [[nodiscard]] std::vector<const Cutter*> by_pocket() const {
    std::vector<const Cutter*> out;
    for (const Cutter& c : plan_.cutters) out.push_back(&c);
    std::sort(out.begin(), out.end(), [](const Cutter* a, const Cutter* b) { return a->pocket < b->pocket; });
    return out;
  }

  // The step's own tolerance, where the control blends at all.
  void tolerance(double of_step_mm) {
    const double own = plan_.machine.control.path_tolerance_mm;
    const double p = own > 0.0 && of_step_mm > 0.0 ? of_step_mm : own;
    program_.line(program_.number(p) == "0" || p < 0.0 ? "G61" : "G64 P" + program_.number(p));
  }

  void retract() {
    program_.line("G53 G0 Z" + program_.number(plan_.machine.axes[2].travel_max_mm));
    program_.lost_z();
  }

  void stop() {
    program_.line("M5");
    program_.line("M9");
    speed_ = 0.0;
    flood_ = mist_ = false;
  }

  // The marker, and everything the control must know, wherever it comes from.
  void enter(const StepResult& step, const Cutter& cutter, const std::string& id, std::size_t n) {
    const model::SetupResult& setup = plan_.setups[step.setup];
    const bool new_tool = cutter.pocket != tool_;
    const bool first = tool_ == 0;
    const bool new_setup = !first && step.setup != setup_;
    const auto why = reasons(step, n);
    program_.blank();
    if ((new_tool || new_setup || !why.empty()) && !first) {
      retract();
      stop();
    }
    program_.line("(CAPSTAN STEP id=\"" + marker_text(id) + "\" n=" + std::to_string(n + 1) +
                  " tool=" + std::to_string(cutter.pocket) + " setup=" + std::to_string(step.setup + 1) +
                  (why.empty() ? std::string() : " condemned=\"" + marker_text(why.front()->code) + "\"") +
                  ")");
    if (new_setup) {
      clamped(step.setup, setup_);
      program_.line("(MSG, " + plain_text(to_clamp(step.setup, setup_)) + ")");
      program_.line("M0");
    }
    if (!why.empty()) stop_for(why, n);
    program_.line("G21 G17 G90 G94 G40 G80");
    tolerance(step.contour_tolerance_mm);
    program_.line(setup.work_offset);
    const std::string t = std::to_string(cutter.pocket);
    if (new_tool && cutter.cutter_class == model::CutterClass::kBoringTool)
      program_.comment("T" + t + ": the boring tool is set to diameter " +
                       program_.number(cutter.cutting_diameter_mm) + " mm");
    if (new_tool) program_.line("T" + t + " M6");
    program_.line("G43 H" + t);
    tool_ = cutter.pocket;
    setup_ = step.setup;
    approach(step, setup, new_tool || new_setup || measured_ || !why.empty());
  }

  // To the start of the path, from the top of the machine or from the security plane.
  void approach(const StepResult& step, const model::SetupResult& setup, bool from_top) {
    const Vec3 start = program_.round(step.path->point(0));
    const auto before = program_.at();
    program_.forget();
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

  static double speed(const StepResult& step, std::size_t move) {
    return step.schedule ? step.schedule->spindle_rpm[move] : step.spindle_rpm;
  }

  // `always`: stated even when it is so already. A start and a reversal wait for the spindle.
  void spindle(double rpm, bool always) {
    const double wanted = rounded(rpm, kSpeedDecimals);
    if (wanted == speed_ && !always) return;
    if (wanted == 0.0) {
      program_.line("M5");
      speed_ = 0.0;
      return;
    }
    const bool turns = speed_ != 0.0 && (speed_ > 0.0) == (wanted > 0.0);
    if (!turns && speed_ != 0.0) program_.line("M5");
    program_.line("S" + trimmed(std::abs(wanted), kSpeedDecimals) + (wanted > 0.0 ? " M3" : " M4"));
    const std::string wait = trimmed(plan_.machine.spindle.spin_up_s, kDwellDecimals);
    if (!turns && plan_.machine.spindle.spin_up_s > 0.0 && wait != "0") program_.line("G4 P" + wait);
    speed_ = wanted;
  }

  void coolant(const StepResult& step) {
    if ((flood_ && !step.flood) || (mist_ && !step.mist) || (!step.flood && !step.mist)) program_.line("M9");
    if (step.mist) program_.line("M7");
    if (step.flood) program_.line("M8");
    flood_ = step.flood;
    mist_ = step.mist;
  }

  Status moves(const StepResult& step, const Cutter& cutter, const std::string& id) {
    const CutterPath& path = *step.path;
    for (std::size_t i = 1; i < path.size(); ++i) {
      spindle(speed(step, i), false);
      const double feed = step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min;
      const Vec3 to = program_.round(path.point(i));
      if (path.role[i] == MoveRole::kTap && path.kind[i] != MoveKind::kRapid) {
        const auto last = tap(step, cutter, i);
        if (!last) return located(last.error(), id, i);
        i = *last;
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
    const std::string text = trimmed(seconds, kDwellDecimals);
    if (text != "0") program_.line("G4 P" + text);
  }

  Status arc(const CutterPath& path, std::size_t i, double feed) {
    const auto pieces = arc_pieces(path, i, *program_.at(), plan_.machine.control.decimals);
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

  // G33.1 goes down in step with the spindle, reverses it, and comes back to where it began: the move down,
  // perhaps dwells, and the move up. Gives the index of the move up.
  Result<std::size_t> tap(const StepResult& step, const Cutter& cutter, std::size_t down) {
    const CutterPath& path = *step.path;
    const Vec3 top = *program_.at();
    const Vec3 bottom = program_.round(path.point(down));
    std::size_t up = down + 1;
    while (up < path.size() && path.kind[up] == MoveKind::kDwell) ++up;
    const bool back = up < path.size() && path.kind[up] == MoveKind::kLine &&
                      path.role[up] == MoveRole::kTap && program_.round(path.point(up)) == top;
    if (path.kind[down] != MoveKind::kLine || xy(bottom) != xy(top) || bottom.z >= top.z || !back) {
      return fail("OUT-TAP", "a tapping move must run straight down and the same way back");
    }
    if (speed_ == 0.0) return fail("OUT-TAP", "the spindle stands still when tapping begins");
    const double feed = step.schedule ? step.schedule->feed_mm_min[down] : step.feed_mm_min;
    const double by_feed = feed / std::abs(speed_);
    const double pitch = cutter.thread_pitch_mm > 0.0 ? cutter.thread_pitch_mm : by_feed;
    if (std::abs(by_feed - pitch) > kPitchAgreement * pitch) {
      return fail("OUT-TAP", "feed and speed make a pitch of " + trimmed(by_feed, 4) + " mm, the tap has " +
                                 trimmed(pitch, 4) + " mm");
    }
    program_.moved("G33.1 Z" + program_.number(bottom.z) + " K" + trimmed(pitch, kPitchDecimals), top);
    return up;
  }

  const Plan& plan_;
  const std::vector<model::Condemnation>& condemned_;
  Program program_;
  std::map<model::AnyRef, std::vector<model::AnyRef>> probings_;  // by the step they precede
  bool measured_ = false;
  int tool_ = 0;
  std::size_t setup_ = 0;
  double speed_ = 0.0;
  bool flood_ = false, mist_ = false;
};

}  // namespace

Result<std::string> write_linuxcnc(const Plan& plan, Job& job,
                                   const std::vector<model::Condemnation>& condemned) {
  if (plan.machine.control.dialect != "linuxcnc") {
    return fail({.code = "OUT-DIALECT",
                 .message = "the machine '" + plan.machine.id + "' has a control of dialect '" +
                            plan.machine.control.dialect + "', and this writes LinuxCNC programs only",
                 .expected = "linuxcnc",
                 .hint = "write .json or .p21 instead"});
  }
  if (auto ok = writable(plan, job); !ok) return tl::unexpected(ok.error());
  return Writer(plan, condemned).run();
}

}  // namespace capstan::controls
