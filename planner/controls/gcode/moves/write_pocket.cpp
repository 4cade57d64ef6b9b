#include "planner/controls/gcode/moves/write_pocket.h"

#include "planner/model/plan/edit/cycles.h"

namespace capstan::controls::gcode {

bool write_pocket(const model::Plan& plan, std::size_t n, std::string_view cycles, const Words& words,
                  Program& out) {
  if (!(cycles.empty() ? words.by_pockets : cycles == model::kPocketCycles)) return false;
  PocketOfStep of_step = pocket_of(plan, n);
  std::optional<std::string> text;
  if (of_step.cycle) {
    text = words.pocket ? words.pocket(*of_step.cycle) : std::nullopt;
    if (!text) of_step.why_not = "it has none";
  }
  if (!of_step.why_not.empty()) out.comment("no cycle of the control for this pocket: " + of_step.why_not);
  if (!text) return false;
  const PocketCycle& c = *of_step.cycle;
  out.comment("the pocket cycle takes the control's own path, not the planned one: about " +
              words.number(estimated_s(c), 0) + " s; " + words.number(c.planned_s, 0) + " s as planned");
  out.comment("it counts with the radius that the control's tool list has for T" + std::to_string(c.tool) +
              ": " + out.number(0.5 * c.cutter_mm) + " mm");
  out.write_waiting();
  out.moved(*text, out.round({c.centre.x, c.centre.y, c.back_z}));
  out.forget_feed();
  return true;
}

}  // namespace capstan::controls::gcode
