#include "planner/controls/siemens/siemens.h"

#include <array>
#include <string_view>

#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/writer.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::siemens {
namespace {

constexpr std::size_t kPlain = 4;  // G54 to G57
constexpr std::size_t kMore = 95;  // G505 to G599

/// "G505" to "G599".
struct MoreOffsets {
  std::array<char, kMore * 4> text{};
  constexpr MoreOffsets() {
    for (std::size_t i = 0; i < kMore; ++i) {
      const std::size_t n = 505 + i;
      text[4 * i] = 'G';
      for (std::size_t k = 0, power = 100; k < 3; ++k, power /= 10)
        text[4 * i + 1 + k] = static_cast<char>('0' + n / power % 10);
    }
  }
};
constexpr MoreOffsets kMoreOffsets;

constexpr std::array<std::string_view, kPlain + kMore> kOffsets = [] {
  std::array<std::string_view, kPlain + kMore> out{"G54", "G55", "G56", "G57"};
  for (std::size_t i = 0; i < kMore; ++i)
    out[kPlain + i] = std::string_view(kMoreOffsets.text.data() + 4 * i, 4);
  return out;
}();

/// A tool's id is its name in the control's list, where tools are called by name.
Status names_right(const model::Plan& plan) {
  if (model::control_option(plan.machine, "tool_call") != "name") return {};
  for (const model::Cutter& c : plan.cutters) {
    if (is_tool_name(c.id)) continue;
    return fail(
        {.code = "OUT-TOOL",
         .message = "the id of cutter '" + c.id + "' is no name of a tool: printable characters without " +
                    "blanks and quotes, " + std::to_string(kLongestToolName) + " at most",
         .path = c.id,
         .hint = "give it another id in the tool library, or call tools by number (tool_call: number)"});
  }
  return {};
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  if (auto ok = gcode::options_right(plan); !ok) return tl::unexpected(ok.error());
  if (auto ok = names_right(plan); !ok) return tl::unexpected(ok.error());
  gcode::Words words = words_of(plan.machine);
  words.work_offsets = kOffsets;
  words.pockets = kDialect.pockets;
  words.faces = kDialect.faces;
  return gcode::write(plan, words, condemned, job);
}

}  // namespace

constinit const Dialect kDialect{
    .id = "siemens",
    .name = "Siemens 840D sl",
    .program = {"siemens", ".mpf", "text/x-gcode"},
    .tool_table = {},
    .work_offsets = kOffsets,
    // SINUMERIK 840D sl / 828D, programming manual fundamentals, 05/2017 (A5E40869423): G54 to G57 and G505
    // to G599, geometry settings; T0 to T32000, tool change; TURN=; G331, G332; G641; G41. BSPLINE: job
    // planning. Look-ahead and time for a block: default, unsourced.
    .conformance = {.largest_tool_number = 32000,
                    .look_ahead_moves = 100,
                    .axes = 5,
                    .work_offsets = kOffsets.size(),
                    .block_time_s = 0.001,
                    .splines = true},
    .decimals = 3,
    .write_program = &write_program,
    .pockets = &kPockets,
    .faces = &kFaces,
};

}  // namespace capstan::controls::siemens
