#include "planner/controls/heidenhain/heidenhain.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/writer.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::controls::heidenhain {
namespace {

/// Rows of the preset table that set-ups get; row 0 is the datum that is set by hand. The table has more:
/// default, unsourced.
constexpr std::size_t kPresets = 99;

/// "PRESET1" to "PRESET99".
struct PresetNames {
  static constexpr std::size_t kLongest = kPreset.size() + 2;
  std::array<char, kPresets * kLongest> text{};
  std::array<std::size_t, kPresets> size{};
  constexpr PresetNames() {
    for (std::size_t i = 0; i < kPresets; ++i) {
      std::size_t at = i * kLongest;
      for (const char c : kPreset) text[at++] = c;
      const std::size_t n = i + 1;
      if (n >= 10) text[at++] = static_cast<char>('0' + n / 10);
      text[at++] = static_cast<char>('0' + n % 10);
      size[i] = at - i * kLongest;
    }
  }
};
constexpr PresetNames kNames;

constexpr std::array<std::string_view, kPresets> kOffsets = [] {
  std::array<std::string_view, kPresets> out;
  for (std::size_t i = 0; i < kPresets; ++i)
    out[i] = std::string_view(kNames.text.data() + i * PresetNames::kLongest, kNames.size[i]);
  return out;
}();

Status takes_the_decimals(const model::Plan& plan) {
  const int decimals = plan.machine.control.decimals;
  if (decimals >= 0 && decimals <= kMostDecimals) return {};
  return fail({.code = "OUT-CONTROL",
               .message = "machine '" + plan.machine.id + "' states " + std::to_string(decimals) +
                          " decimals; this control takes 0 to " + std::to_string(kMostDecimals),
               .expected = "0 to " + std::to_string(kMostDecimals) + " decimals",
               .hint = "state decimals of that range under the machine's control, 3 for example"});
}

/// Without an exponent, as people and controls write lengths; what is smaller than any has one.
std::string digits_of(double mm) {
  constexpr int kDecimals = 12;
  const std::string text = trimmed(mm, kDecimals);
  return text == "0" && mm != 0.0 ? shortest(mm) : text;
}

/// That of the machine, and of each step that has its own, as they are written.
Status rounds_by_a_tolerance(const model::Plan& plan) {
  const int decimals = plan.machine.control.decimals;
  const double tolerance = plan.machine.control.path_tolerance_mm;
  const std::string exact = "; programs of this control have no word for the exact path";
  if (!(rounded(tolerance, decimals) > 0.0))
    return fail({.code = "OUT-CONTROL",
                 .message = "machine '" + plan.machine.id + "' states path_tolerance_mm " +
                            digits_of(tolerance) + exact,
                 .expected = "a path tolerance above 0 mm",
                 .hint = "state path_tolerance_mm under the machine's control, 0.01 mm for example"});
  for (const model::StepResult& step : plan.steps) {
    const double own = step.contour_tolerance_mm;
    if (!(own > 0.0) || rounded(own, decimals) > 0.0) continue;
    return fail(
        {.code = "OUT-CONTROL",
         .message = "the contour tolerance of " + digits_of(own) + " mm is 0 with the machine's " +
                    std::to_string(decimals) + " decimals" + exact,
         .path = model::step_id(plan, step),
         .expected = "a contour tolerance of " + trimmed(std::pow(10.0, -decimals), decimals) + " mm or more",
         .hint = "state a larger contour tolerance for the step, or more decimals, " +
                 std::to_string(kMostDecimals) + " at most, under the machine's control"});
  }
  return {};
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  if (auto ok = gcode::options_right(plan); !ok) return tl::unexpected(ok.error());
  if (auto ok = takes_the_decimals(plan); !ok) return tl::unexpected(ok.error());
  if (auto ok = rounds_by_a_tolerance(plan); !ok) return tl::unexpected(ok.error());
  gcode::Words words = words_of(plan);
  words.work_offsets = kOffsets;
  words.pockets = kDialect.pockets;
  return gcode::write(plan, words, condemned, job);
}

}  // namespace

constinit const Dialect kDialect{
    .id = "heidenhain",
    .name = "Heidenhain TNC 640",
    .program = {"heidenhain", ".h", "text/plain"},
    .tool_table = {},
    .work_offsets = kOffsets,
    // TNC 640 (34059x-05), user's manual ISO programming, 1/2015: tool numbers 0 to 32767 (5.2); input format
    // and unit of TNC functions (19.3): radius, feed, CP for helices. Look-ahead: of its predecessor, the
    // iTNC 530; time for a block: default, unsourced.
    .conformance = {.largest_tool_number = 32767,
                    .look_ahead_moves = 1024,
                    .axes = 5,
                    .work_offsets = kPresets,
                    .block_time_s = 0.0005,
                    .largest_radius_mm = 99999.9999,
                    .largest_feed_mm_min = 99999.999},
    .decimals = 3,
    .write_program = &write_program,
    .pockets = &kPockets,
};

}  // namespace capstan::controls::heidenhain
