#include "planner/controls/gcode/measuring/probe_moves.h"

#include <optional>
#include <string>

#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::gcode {
namespace {

/// What the machine's file says of its touches, mm and mm/min; 0: not stated.
struct Feeds {
  double touch = 0.0, way = 0.0, overtravel_mm = 0.0;
};

const model::Cutter* probe_of(const model::Plan& plan, const std::string& number) {
  for (const model::Cutter& c : plan.cutters) {
    if (c.cutter_class == model::CutterClass::kTouchProbe && c.pocket > 0 &&
        std::to_string(c.pocket) == number)
      return &c;
  }
  return nullptr;
}

/// Why this probe cannot be called with a length that is true; empty: it can.
std::string no_length(const model::Cutter* probe) {
  if (probe == nullptr) return "its probe is none of the tool list";
  if (!model::offset_fault(*probe).empty() || !(model::length_offset_mm(*probe) > 0.0))
    return "the length of its probe is not measured";
  if (probe->table_line && probe->table_line->against_reference)
    return "the length of its probe counts from a reference";
  return {};
}

/// The moves of one touch, from the top of Z and back to it.
class Moves {
 public:
  Moves(const model::Plan& plan, const Words& words, const Feeds& feeds)
      : control_(plan.machine.control), words_(words), feeds_(feeds) {
    retract_ = words.retract(number(plan.machine.axes[2].travel_max_mm));
  }

  /// Takes the probe, in the state that its moves need.
  [[nodiscard]] std::vector<std::string> called(const model::Cutter& probe, const std::string& offset) const {
    const std::string t = std::to_string(probe.pocket);
    std::vector<std::string> out{words_.change_tool(t, probe.id, "0"), words_.step_state};
    if (!words_.probe_state.empty()) out.emplace_back(words_.probe_state);
    out.push_back(words_.work_offset ? words_.work_offset(offset) : offset);
    out.push_back(words_.length_offset(t));
    out.push_back(retract_);
    return out;
  }

  void touch(const Touch& t, std::vector<std::string>& out) const {
    const std::string way = " F" + words_.number(feeds_.way, control_.feed_decimals);
    const std::string axis(1, "XYZ"[t.axis]);
    // Along Z the ball's lowest place meets the wall, along X and Y its side does.
    const double met = on(t.wall, t.axis) - (t.axis == 2 ? 0.0 : t.sense * t.ball);
    const double start = t.axis == 2 ? t.start.z - t.ball : on(t.start, t.axis);
    out.push_back("G0 X" + number(t.start.x) + " Y" + number(t.start.y));
    out.push_back("G1 Z" + number(t.start.z - t.ball) + way);
    out.push_back(std::string(words_.probe) + " " + axis + number(met + t.sense * feeds_.overtravel_mm) +
                  " F" + words_.number(feeds_.touch, control_.feed_decimals));
    if (words_.probed) out.push_back(words_.probed(t.feature, axis + number(met)));
    out.push_back("G1 " + axis + number(start) + way);
    out.push_back(retract_);
  }

 private:
  [[nodiscard]] std::string number(double v) const { return words_.number(v, control_.decimals); }

  const model::Control& control_;
  const Words& words_;
  const Feeds feeds_;
  std::string retract_;
};

}  // namespace

TouchBlocks probe_moves(const model::Plan& plan, const std::vector<model::AnyRef>& touches,
                        const model::StepResult* next, Standing standing, const Words& words) {
  TouchBlocks out;
  const auto stated = [&](std::string_view name) { return model::control_number(plan.machine, name, 0.0); };
  const Feeds feeds{stated("probe_feed_mm_min"), stated("probe_way_mm_min"), stated("probe_overtravel_mm")};
  if (words.probe.empty() || !(feeds.touch > 0.0)) return out;
  std::string why_none = not_here(next, standing);
  if (why_none.empty() && (!(feeds.way > 0.0) || !(feeds.overtravel_mm > 0.0)))
    why_none = "the machine's file states no probe_way_mm_min or probe_overtravel_mm";
  const Moves moves(plan, words, feeds);
  const model::Cutter* called = nullptr;
  for (const model::AnyRef r : touches) {
    std::string why_not = why_none;
    const auto t = why_not.empty() ? touch_of(plan, r, standing.setup, why_not) : std::nullopt;
    const model::Cutter* probe = t ? probe_of(plan, t->probe) : nullptr;
    if (t) why_not = no_length(probe);
    if (why_not.empty()) why_not = in_the_way(plan, *t, standing.setup, feeds.overtravel_mm);
    if (why_not.empty() && called != nullptr && called != probe) why_not = "it is of another probe";
    if (!why_not.empty()) {
      out.comments.push_back("by hand, not by " + std::string(words.probe) + ": " + why_not);
      continue;
    }
    if (called == nullptr) {
      out.comments.push_back("by " + std::string(words.probe) + "; the length of T" + t->probe +
                             " is to the lowest place of its ball");
      out.blocks = moves.called(*probe, plan.setups[standing.setup].work_offset);
      called = probe;
    }
    moves.touch(*t, out.blocks);
  }
  return out;
}

}  // namespace capstan::controls::gcode
