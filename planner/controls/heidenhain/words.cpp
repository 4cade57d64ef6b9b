#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/options.h"
#include "planner/controls/heidenhain/heidenhain.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/model/plan/resources/setup_position.h"

// What the plan and the machine's options make of the words of its programs.

namespace capstan::controls::heidenhain {
namespace {

using gcode::ArcBlock;
using gcode::HoleCycle;
using geometry::Vec2;

/// The surface of a cycle lies so far below where the tool is fed from: Q200 is a distance above 0.
constexpr double kClearanceMm = 1.0;
/// A feed of a cycle that is a rapid; the control writes it so, with a blank.
constexpr std::string_view kByRapid = " MAX";
/// What Q256 and Q253 say of cycle 205 where nothing asks for them: Q257 is 0, and Q379.
constexpr std::string_view kUnusedBreak = "+0.2", kUnusedFeed = "+750";
/// The least that Q256 takes, mm (iTNC 530, cycles 203 and 205: 0.1000 to 99999.9999).
constexpr double kLeastBreakMm = 0.1;
/// Runs the cycle that is defined.
constexpr std::string_view kCall = "CYCL CALL";
/// Of BEGIN PGM: default, unsourced.
constexpr std::size_t kLongestName = 20;

/// "+10.5", "-3", "+0".
std::string with_sign(double value, int decimals) {
  std::string text = trimmed(value, decimals);
  return text.front() == '-' ? text : "+" + text;
}

double angle_of(Vec2 v) { return std::atan2(v.y, v.x); }

/// How far an arc turns, rad, above 0: a whole turn where it ends where it began.
double turned(const ArcBlock& a) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Vec2 centre = xy(a.from) + Vec2{a.i, a.j};
  double sweep = kTurn;
  if (xy(a.from) != xy(a.to)) {
    sweep = angle_of(xy(a.to) - centre) - angle_of(xy(a.from) - centre);
    if (a.clockwise) sweep = -sweep;
    sweep -= kTurn * std::floor(sweep / kTurn);
  }
  return sweep + kTurn * a.further_turns;
}

std::string arc_text(const ArcBlock& a) {
  const std::string centre = "CC X" + with_sign(a.from.x + a.i, a.centre_decimals) + " Y" +
                             with_sign(a.from.y + a.j, a.centre_decimals) + "\n";
  const std::string way = a.clockwise ? " DR-" : " DR+";
  if (a.from.z == a.to.z)
    return centre + "C X" + with_sign(a.to.x, a.decimals) + " Y" + with_sign(a.to.y, a.decimals) + way +
           a.feed;
  const double degrees = (a.clockwise ? -180.0 : 180.0) / std::numbers::pi * turned(a);
  return centre + "CP IPA" + with_sign(degrees, kMostDecimals) + " IZ" +
         with_sign(a.to.z - a.from.z, a.decimals) + way + a.feed;
}

/// A cycle's definition: lines of parameters, each but the last with a ~ at its end, and its call.
class Cycle {
 public:
  explicit Cycle(const std::string& name) : text_("CYCL DEF " + name) {}
  Cycle& q(int number, const std::string& value, const std::string& meaning) {
    text_ += " ~\n  Q" + std::to_string(number) + "=" + value + " ;" + meaning;
    return *this;
  }
  [[nodiscard]] std::string called() const { return text_ + "\n" + std::string(kCall); }

 private:
  std::string text_;
};

/// The heights of a cycle as their distances from its surface.
struct Heights {
  std::string clearance, depth, surface, second, plunge;
  explicit Heights(const HoleCycle& h) {
    const double above = rounded(std::min(kClearanceMm, 0.5 * (h.r_z - h.bottom_z)), h.decimals);
    const double top = h.r_z - above;
    clearance = with_sign(above, h.decimals);
    depth = with_sign(h.bottom_z - top, h.decimals);
    surface = with_sign(top, h.decimals);
    second = with_sign(h.initial_z - top, h.decimals);
    plunge = with_sign(top - h.bottom_z, h.decimals);
  }
};

std::string hole_text(const HoleCycle& h) {
  const Heights at(h);
  const std::string feed = trimmed(h.feed_mm_min, h.feed_decimals), dwell = with_sign(h.dwell_s, 3);
  if (h.feeds_out)
    return Cycle("201 REAMING")
        .q(200, at.clearance, "SET-UP CLEARANCE")
        .q(201, at.depth, "DEPTH")
        .q(206, feed, "FEED RATE FOR PLNGNG")
        .q(211, dwell, "DWELL TIME AT DEPTH")
        .q(208, feed, "RETRACTION FEED RATE")
        .q(203, at.surface, "SURFACE COORDINATE")
        .q(204, at.second, "2ND SET-UP CLEARANCE")
        .called();
  return Cycle("200 DRILLING")
      .q(200, at.clearance, "SET-UP CLEARANCE")
      .q(201, at.depth, "DEPTH")
      .q(206, feed, "FEED RATE FOR PLNGNG")
      .q(202, at.plunge, "PLUNGING DEPTH")
      .q(210, "+0", "DWELL TIME AT TOP")
      .q(203, at.surface, "SURFACE COORDINATE")
      .q(204, at.second, "2ND SET-UP CLEARANCE")
      .q(211, dwell, "DWELL TIME AT DEPTH")
      .called();
}

/// Equal pecks of Q202 from the surface on, the last one what is left; so the surface lies one above the
/// first bottom. Nothing where the pecks are others, or wait at their bottoms: Q211 waits at the last alone.
struct PeckHeights {
  std::string clearance, depth, surface, second, plunge;
  static std::optional<PeckHeights> of(const HoleCycle& h) {
    const auto sizes = gcode::peck_sizes(h);
    if (!sizes || h.feeds_out || rounded(h.pecks->dwell_s, 3) > 0.0) return std::nullopt;
    const double surface = rounded(h.pecks->bottoms_z.front() + sizes->step_mm, h.decimals);
    const double clearance = rounded(h.r_z - surface, h.decimals);
    if (clearance < 0.0) return std::nullopt;
    const auto n = [&](double v) { return with_sign(v, h.decimals); };
    return PeckHeights{n(clearance), n(h.bottom_z - surface), n(surface), n(h.initial_z - surface),
                       n(sizes->step_mm)};
  }
};

/// 203: up by Q256 after each peck. It comes out of the hole after Q213 breaks: more than there are.
std::optional<std::string> broken_text(const HoleCycle& h) {
  const auto at = PeckHeights::of(h);
  if (!at || h.pecks->back_mm < kLeastBreakMm) return std::nullopt;
  return Cycle("203 UNIVERSAL DRILLING")
      .q(200, at->clearance, "SET-UP CLEARANCE")
      .q(201, at->depth, "DEPTH")
      .q(206, trimmed(h.feed_mm_min, h.feed_decimals), "FEED RATE FOR PLNGNG")
      .q(202, at->plunge, "PLUNGING DEPTH")
      .q(210, "+0", "DWELL TIME AT TOP")
      .q(203, at->surface, "SURFACE COORDINATE")
      .q(204, at->second, "2ND SET-UP CLEARANCE")
      .q(212, "+0", "DECREMENT")
      .q(213, "+" + std::to_string(h.pecks->bottoms_z.size() + 1), "NR OF BREAKS")
      .q(205, "+0", "MIN. PLUNGING DEPTH")
      .q(211, with_sign(h.dwell_s, 3), "DWELL TIME AT DEPTH")
      .q(208, std::string(kByRapid), "RETRACTION FEED RATE")
      .q(256, with_sign(h.pecks->back_mm, h.decimals), "DIST FOR CHIP BRKNG")
      .called();
}

/// 205: out to Q203 + Q200 after each peck, and back by rapid to Q258 (Q259 at the last) above its bottom.
/// `version` says which parameters the control's has.
std::optional<std::string> cleared_text(const HoleCycle& h, std::string_view version) {
  const auto at = PeckHeights::of(h);
  if (!at) return std::nullopt;
  const std::string back = with_sign(h.pecks->back_mm, h.decimals);
  Cycle cycle("205 UNIVERSAL PECKING");
  cycle.q(200, at->clearance, "SET-UP CLEARANCE")
      .q(201, at->depth, "DEPTH")
      .q(206, trimmed(h.feed_mm_min, h.feed_decimals), "FEED RATE FOR PLNGNG")
      .q(202, at->plunge, "PLUNGING DEPTH")
      .q(203, at->surface, "SURFACE COORDINATE")
      .q(204, at->second, "2ND SET-UP CLEARANCE")
      .q(212, "+0", "DECREMENT")
      .q(205, "+0", "MIN. PLUNGING DEPTH")
      .q(258, back, "UPPER ADV. STOP DIST.")
      .q(259, back, "LOWER ADV. STOP DIST.")
      .q(257, "+0", "DEPTH FOR CHIP BRKNG")
      .q(256, std::string(kUnusedBreak), "DIST FOR CHIP BRKNG")
      .q(211, with_sign(h.dwell_s, 3), "DWELL TIME AT DEPTH");
  if (version != "tnc430")
    cycle.q(379, "+0", "STARTING POINT").q(253, std::string(kUnusedFeed), "F PRE-POSITIONING");
  if (version == "tnc640")
    cycle.q(208, std::string(kByRapid), "RETRACTION FEED RATE").q(395, "+0", "DEPTH REFERENCE");
  return cycle.called();
}

/// The pitch is below 0 for left-hand threads.
std::string tap_text(const HoleCycle& h) {
  const Heights at(h);
  return Cycle("207 RIGID TAPPING NEW")
      .q(200, at.clearance, "SET-UP CLEARANCE")
      .q(201, at.depth, "DEPTH OF THREAD")
      .q(239, with_sign(h.rpm < 0.0 ? -h.pitch_mm : h.pitch_mm, kMostDecimals), "THREAD PITCH")
      .q(203, at.surface, "SURFACE COORDINATE")
      .q(204, at.second, "2ND SET-UP CLEARANCE")
      .called();
}

/// 202: the spindle stands turned to Q336 while the bar comes out. Q214 0: it is not moved off the wall.
std::string bored_text(const HoleCycle& h) {
  const Heights at(h);
  return Cycle("202 BORING")
      .q(200, at.clearance, "SET-UP CLEARANCE")
      .q(201, at.depth, "DEPTH")
      .q(206, trimmed(h.feed_mm_min, h.feed_decimals), "FEED RATE FOR PLNGNG")
      .q(211, with_sign(h.dwell_s, 3), "DWELL TIME AT DEPTH")
      .q(208, std::string(kByRapid), "RETRACTION FEED RATE")
      .q(203, at.surface, "SURFACE COORDINATE")
      .q(204, at.second, "2ND SET-UP CLEARANCE")
      .q(214, "+0", "DISENGAGING DIRECTN")
      .q(336, "+0", "ANGLE OF SPINDLE")
      .called();
}

/// What the machine can do of cycles.
struct Abilities {
  std::string pecking_cycle;
  bool oriented_stop = false;
};

/// Nothing where no cycle makes these moves.
std::optional<gcode::CycleText> cycle_text(const HoleCycle& h, const Abilities& machine) {
  const auto made = [](const std::optional<std::string>& text) {
    return text ? std::optional(gcode::CycleText{*text}) : std::nullopt;
  };
  if (h.stops) return made(machine.oriented_stop ? std::optional(bored_text(h)) : std::nullopt);
  if (!h.pecks) return made(hole_text(h));
  if (!h.pecks->clears) return made(broken_text(h));
  return made(machine.pecking_cycle == "explicit" ? std::nullopt : cleared_text(h, machine.pecking_cycle));
}

std::string path_mode(const std::string& tolerance, bool finishes) {
  return "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T" + tolerance +
         "\nCYCL DEF 32.2 HSC-MODE:" + (finishes ? "0" : "1") + " TA0.5";
}

/// The raw piece as it lies in the first set-up.
std::string raw_piece(const model::Plan& plan) {
  if (plan.stock.box.empty() || plan.steps.empty()) return {};
  const auto here = model::placed_in(plan, plan.steps.front().setup);
  geometry::Box3 raw;
  raw.add(here.to_parent(plan.stock.box.lo));
  raw.add(here.to_parent(plan.stock.box.hi));
  const auto point = [&](geometry::Vec3 p) {
    const int decimals = plan.machine.control.decimals;
    return "X" + with_sign(p.x, decimals) + " Y" + with_sign(p.y, decimals) + " Z" + with_sign(p.z, decimals);
  };
  return "\nBLK FORM 0.1 Z " + point(raw.lo) + "\nBLK FORM 0.2 " + point(raw.hi);
}

/// No comment goes on in the next line.
std::string comment(std::string_view text) {
  std::string out(text);
  if (out.ends_with('~')) out.back() = '-';
  return out;
}

}  // namespace

std::string program_name(const model::Plan& plan) {
  const std::size_t slash = plan.file_name.find_last_of("/\\");
  std::string out;
  for (const char c : slash == std::string::npos ? plan.file_name : plan.file_name.substr(slash + 1)) {
    if (c == '.' || out.size() >= kLongestName) break;
    const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    const bool taken =
        (capital >= 'A' && capital <= 'Z') || (capital >= '0' && capital <= '9') || capital == '-';
    out += taken ? capital : '_';
  }
  return out.empty() ? "CAPSTAN" : out;
}

gcode::Words words_of(const model::Plan& plan) {
  const model::Machine& machine = plan.machine;
  const auto is = [&](std::string_view name, std::string_view value) {
    return model::control_option(machine, name) == value;
  };
  const std::string name = program_name(plan) + " MM";
  gcode::Words w;
  w.longest_line = static_cast<std::size_t>(model::control_number(machine, "line_length", 0.0));
  w.speed_decimals = 0;
  w.dwell_decimals = 3;
  w.first = "BEGIN PGM " + name + raw_piece(plan);
  w.last = "M30\nEND PGM " + name;
  w.comment_begin = "; ";
  w.comment_end = "";
  w.comment = &comment;
  // Unit, plane and absolute places are those of the language; R0 stands in each straight block.
  w.first_state = is("plane_reset", "yes") ? "PLANE RESET STAY\nM129" : "";
  w.step_state = "";
  w.block_numbers = gcode::BlockNumbers::kLines;
  w.change_tool = [](const std::string& tool, const std::string& /*id*/, const std::string& speed) {
    return "TOOL CALL " + tool + " Z S" + speed;
  };
  if (is("next_tool", "staged"))
    w.stage_tool = [](const std::string& next, const std::string& /*id*/) { return "TOOL DEF " + next; };
  w.tool_end = gcode::tool_end_of(machine);
  w.work_offset = [](const std::string& offset) {
    return "CYCL DEF 247 DATUM SETTING ~\n  Q339=+" + offset.substr(kPreset.size()) + " ;DATUM NUMBER";
  };
  w.length_offset = [](const std::string& /*tool*/) { return std::string(); };
  w.number = &trimmed;
  w.coordinate = &with_sign;
  w.rapid_begin = "L";
  w.rapid_end = " R0 FMAX";
  w.cut_begin = "L";
  w.cut_end = " R0";
  w.arc = &arc_text;
  w.spindle = [](const std::string& speed, bool clockwise, bool called) {
    return (called ? std::string() : "TOOL CALL Z S" + speed + "\n") + (clockwise ? "M3" : "M4");
  };
  w.new_speed = [](const std::string& speed) { return "TOOL CALL Z S" + speed; };
  w.path_mode = &path_mode;
  w.retract = [](const std::string& z) {
    return "L Z" + with_sign(parse_double(z).value_or(0.0), kMostDecimals) + " R0 FMAX M91";
  };
  w.message = [](const std::string& text) { return "; " + comment(text); };
  w.dwell = [](const std::string& seconds) {
    return "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL " + seconds;
  };
  w.tap = &tap_text;
  w.tap_stops_spindle = true;
  w.cycle_call = kCall;
  w.cycle_call_there = "M99";
  w.by_cycles = !is("cycles", "explicit");
  const Abilities abilities{std::string(model::control_option(machine, "pecking_cycle")),
                            is("oriented_stop", "yes")};
  w.cycle = [abilities](const HoleCycle& h, std::span<const geometry::Vec2> /*places*/) {
    return cycle_text(h, abilities);
  };
  w.more_centre_decimals = std::max(0, kMostDecimals - machine.control.decimals);
  w.turns = true;
  return w;
}

}  // namespace capstan::controls::heidenhain
