#include "planner/controls/grbl/grbl.h"

#include <array>
#include <string>
#include <string_view>

#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/writer.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::grbl {
namespace {

// gnea/grbl 1.1h, README.md.
constexpr std::array<std::string_view, 6> kWorkOffsets = {"G54", "G55", "G56", "G57", "G58", "G59"};

/// M7 is compiled in on few machines (config.h, ENABLE_M7); elsewhere Grbl refuses its block.
Status has_the_coolant(const model::Plan& plan) {
  if (model::control_option(plan.machine, "mist") == "yes") return {};
  for (const model::StepResult& step : plan.steps) {
    if (!step.mist) continue;
    return fail({.code = "OUT-CONTROL",
                 .message = "the step asks for mist (M7), which the Grbl of machine '" + plan.machine.id +
                            "' does not have",
                 .path = model::step_id(plan, step),
                 .expected = "a step without mist, or a Grbl with M7",
                 .hint =
                     "state 'mist: yes' under the machine's control where M7 is compiled in, or a machine "
                     "without mist (coolant: {mist: false})"});
  }
  return {};
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  if (auto ok = gcode::options_right(plan); !ok) return tl::unexpected(ok.error());
  if (auto ok = has_the_coolant(plan); !ok) return tl::unexpected(ok.error());
  gcode::Words words = words_of(plan);
  words.work_offsets = kWorkOffsets;
  return gcode::write(plan, words, condemned, job);
}

}  // namespace

constinit const Dialect kDialect{
    .id = "grbl",
    .name = "Grbl 1.1",
    .program = {"grbl", ".gcode", "text/x-gcode"},
    .tool_table = {},
    .work_offsets = kWorkOffsets,
    // gnea/grbl 1.1h, README.md: no cycles, no G33.1, G61 alone, up to 16 motions ahead; gcode.h,
    // MAX_TOOL_NUMBER. Tools are changed by whoever sends the program. The path is exact, within every
    // tolerance.
    .conformance = {.rigid_tapping = false,
                    .largest_tool_number = 255,
                    .look_ahead_moves = 16,
                    .axes = 3,
                    .work_offsets = kWorkOffsets.size(),
                    .compensation = false},
    .decimals = 3,  // of a micrometre: positions are floats of 24 bits, and reports have three (config.h)
    .write_program = &write_program,
};

}  // namespace capstan::controls::grbl
