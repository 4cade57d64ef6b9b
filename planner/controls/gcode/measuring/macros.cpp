#include "planner/controls/gcode/measuring/macros.h"

#include <array>
#include <optional>
#include <utility>

#include "planner/controls/gcode/options.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::gcode {
namespace {

/// A touch as the macro makes it, or why it stays the operator's.
struct MacroCall {
  std::vector<std::string> blocks;
  std::string why_not;
};

MacroCall macro_call(const model::Plan& plan, model::AnyRef probing, std::size_t setup, std::string macro,
                     const Words& words) {
  MacroCall out;
  const auto t = touch_of(plan, probing, setup, out.why_not);
  if (!t) return out;
  if (t->probe.empty() && macro.find("{probe}") != std::string::npos) {
    out.why_not = "the number of the probe is not stated";
    return out;
  }
  out.why_not = in_the_way(plan, *t, setup, model::probe_macro_beyond_mm(plan.machine));
  if (!out.why_not.empty()) return out;
  const auto number = [&](double v) { return words.number(v, plan.machine.control.decimals); };
  const std::array<std::pair<std::string_view, std::string>, 14> places = {
      {{"{feature}", t->feature},
       {"{probe}", t->probe},
       {"{axis}", std::string(1, "XYZ"[t->axis])},
       {"{axis_number}", std::to_string(t->axis + 1)},
       {"{sign}", t->sense > 0 ? "+" : "-"},
       {"{direction}", std::to_string(t->sense)},
       {"{way}", t->sense > 0 ? "1" : "2"},
       {"{nominal}", number(on(t->wall, t->axis))},
       {"{distance}", number(t->sense * (on(t->wall, t->axis) - on(t->start, t->axis)) - t->ball)},
       {"{security}", number(plan.setups[setup].security_z_mm)},
       {"{x}", number(t->start.x)},
       {"{y}", number(t->start.y)},
       {"{z}", number(t->start.z)},
       {"{tip}", number(t->start.z - t->ball)}}};
  for (const auto& [place, text] : places) {
    for (std::size_t at = macro.find(place); at != std::string::npos;
         at = macro.find(place, at + text.size()))
      macro.replace(at, place.size(), text);
  }
  out.blocks = blocks_of(macro);
  return out;
}

}  // namespace

TouchBlocks macro_calls(const model::Plan& plan, const std::vector<model::AnyRef>& touches,
                        const model::StepResult* next, Standing standing, const Words& words) {
  TouchBlocks out;
  const std::string macro(model::probe_macro_blocks(plan.machine));
  if (macro.empty()) return out;
  std::string why_none = not_here(next, standing);
  if (const auto id = model::unconfirmed_probe_macro(plan.machine); why_none.empty() && !id.empty())
    why_none = "nobody has confirmed " + std::string(id) + " (probe_macro_confirmed)";
  for (const model::AnyRef r : touches) {
    const MacroCall call =
        why_none.empty() ? macro_call(plan, r, standing.setup, macro, words) : MacroCall{{}, why_none};
    if (!call.why_not.empty()) out.comments.push_back("by hand, not by the macro: " + call.why_not);
    out.blocks.insert(out.blocks.end(), call.blocks.begin(), call.blocks.end());
  }
  return out;
}

}  // namespace capstan::controls::gcode
