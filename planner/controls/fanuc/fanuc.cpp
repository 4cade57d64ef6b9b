#include "planner/controls/fanuc/fanuc.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/writer.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::fanuc {
namespace {

constexpr std::size_t kPlain = 6;  // G54 to G59
constexpr std::array<std::string_view, kPlain> kOffsets = {"G54", "G55", "G56", "G57", "G58", "G59"};

/// The names of the plain offsets, and of `More` beyond them: "G54.1P1", "G54.1P2", ...
template <std::size_t More>
struct OffsetNames {
  static constexpr std::size_t kLongest = 8;
  std::array<char, More * kLongest> text{};
  std::array<std::size_t, More> length{};

  constexpr explicit OffsetNames(std::string_view code) {
    for (std::size_t i = 0; i < More; ++i) {
      std::size_t n = 0;
      const auto put = [&](char c) { text[i * kLongest + n++] = c; };
      for (const char c : code) put(c);
      if (i + 1 >= 10) put(static_cast<char>('0' + (i + 1) / 10));
      put(static_cast<char>('0' + (i + 1) % 10));
      length[i] = n;
    }
  }
  [[nodiscard]] constexpr std::array<std::string_view, kPlain + More> all() const {
    std::array<std::string_view, kPlain + More> out{};
    for (std::size_t i = 0; i < kPlain; ++i) out[i] = kOffsets[i];
    for (std::size_t i = 0; i < More; ++i) out[kPlain + i] = {text.data() + i * kLongest, length[i]};
    return out;
  }
};

// FANUC B-63844EN/02, 7.2.3: G54.1 P1 to P48; Haas: G154 P1 to P99.
constexpr OffsetNames<48> kFanucNames("G54.1P");
constexpr OffsetNames<99> kHaasNames("G154P");
constexpr auto kFanucOffsets = kFanucNames.all();
constexpr auto kHaasOffsets = kHaasNames.all();

/// Whether the machine has the work offsets of all set-ups.
Status has_offsets(const model::Plan& plan) {
  const auto more = static_cast<std::size_t>(model::control_number(plan.machine, "extended_offsets", 0.0));
  for (std::size_t i = 0; i < plan.setups.size(); ++i) {
    const std::string& name = plan.setups[i].work_offset;
    const std::size_t p = name.find('P');
    if (p == std::string::npos) continue;
    const auto number = parse_double(name.substr(p + 1));
    if (number && *number <= static_cast<double>(more)) continue;
    return fail(
        {.code = "OUT-SETUP",
         .message = "set-up " + std::to_string(i + 1) + " has the work offset " + name + "; machine '" +
                    plan.machine.id + "' has " + std::to_string(more) + " beyond G59",
         .hint = "state 'extended_offsets' under the machine's control if it has them, or split the part"});
  }
  return {};
}

Result<std::string> write(const model::Plan& plan, std::span<const std::string_view> offsets, Job& job,
                          const std::vector<model::Condemnation>& condemned) {
  if (auto ok = gcode::options_right(plan); !ok) return tl::unexpected(ok.error());
  if (auto ok = has_offsets(plan); !ok) return tl::unexpected(ok.error());
  gcode::Words words = words_of(plan.machine);
  words.work_offsets = offsets;
  return gcode::write(plan, words, condemned, job);
}

Result<std::string> write_fanuc(const model::Plan& plan, Job& job,
                                const std::vector<model::Condemnation>& condemned) {
  return write(plan, kFanucOffsets, job, condemned);
}
Result<std::string> write_haas(const model::Plan& plan, Job& job,
                               const std::vector<model::Condemnation>& condemned) {
  return write(plan, kHaasOffsets, job, condemned);
}

/// Both controls read files of one kind.
constexpr FileKind kProgramFile{"fanuc", ".nc", "text/x-gcode"};

}  // namespace

constinit const Dialect kFanuc{
    .id = "fanuc",
    .name = "Fanuc",
    .program = kProgramFile,
    .tool_table = {},
    .work_offsets = kFanucOffsets,
    // T of four digits: FANUC B-63844EN/02, 10.1. No word says how far corners are rounded. Look-ahead of AI
    // advanced preview: default, unsourced.
    .conformance = {.path_tolerance = false, .largest_tool_number = 9999, .look_ahead_moves = 15},
    .decimals = 3,  // increment system IS-B, 0.001 mm: B-63844EN/02, 2.3
    .write_program = &write_fanuc,
};

constinit const Dialect kHaas{
    .id = "haas",
    .name = "Haas",
    .program = kProgramFile,
    .tool_table = {},
    .work_offsets = kHaasOffsets,
    // Look-ahead: default, unsourced.
    .conformance = {.largest_tool_number = 200, .look_ahead_moves = 80},
    .decimals = 3,
    .write_program = &write_haas,
};

}  // namespace capstan::controls::fanuc
