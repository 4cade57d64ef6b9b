#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/program/tool_table.h"

namespace capstan::verify::linuxcnc {

/// Longest line, without its end. Source: LinuxCNC 2.9, its interpreter says "Command too long" from 253 on.
inline constexpr std::size_t kLineCap = 252;

/// Reads RS274/NGC as LinuxCNC does, as far as programs without parameters go: comments, N, G0-G4, G17,
/// G20, G21, G33.1, G38.2, G40-G42, G43, G43.1, G49, G53, G54-G59.3, G61, G64, G73, G80-G89, G90, G91, G91.1,
/// G93-G95, G98, G99, M0-M9, M30, M60. Cycles are expanded into moves, kCycleBlockCap of them at most. What
/// is beyond that (parameters, expressions, O-words, other planes) becomes a fault, and reading goes on. So
/// does a block that LinuxCNC refuses or reads otherwise (block_rules.cpp).
///
/// `shop_codes`, `through_coolant`: what the machine's file says of M100 to M199, programs of the shop
/// (ground/vocabulary/control_options.h).
///
/// Cost    linear in the text. No recursion.
/// Source  LinuxCNC 2.9 manual, "G-codes" and "RS274/NGC code overview".
[[nodiscard]] Program read_program(std::string_view text, std::string_view shop_codes = {},
                                   std::string_view through_coolant = {});

/// Reads programs of Mach3, whose interpreter is of NIST's RS274/NGC as LinuxCNC's is, by what the machine's
/// file says of it (options `dwell`, `line_length`, `shop_codes`). What it does otherwise: G64 has no P and
/// rounds as its settings say; the unit of P is a setting; G31 ends at a touch; arcs have the centre of G90.1
/// or G91.1, a setting where neither stands; G85 and G89 come out at feed to where the cycle ends. G33.1,
/// G43.1, G59.1 to G59.3, G61.1, M60 and `;` are not of it; G73, G83 and G84, which its settings and plugins
/// decide, are not followed.
///
/// Cost    linear in the text. No recursion.
/// Source  Using Mach3Mill, revision 1.84, as others quote it (comments, G4, G64, G90.1, G91.1, M6); NIST
///         RS274/NGC 3 (cycles; emc.sourceforge.net/Handbook).
[[nodiscard]] Program read_mach3(std::string_view text, const model::Machine& machine);

/// LinuxCNC's tool table as LinuxCNC reads it: a line per tool of words T, P, Z, D and others, a comment
/// after `;`. Units   as written, taken as mm. Source  LinuxCNC 2.9 manual, "Tool table format".
[[nodiscard]] ToolTable read_tool_table(std::string_view text);

/// LinuxCNC's work offsets in the order of their numbers. A copy on purpose:
/// tests/door/service/controls_test.cpp holds it against the writer's.
inline constexpr std::array<std::string_view, 9> kWorkOffsets = {"G54", "G55",   "G56",   "G57",  "G58",
                                                                 "G59", "G59.1", "G59.2", "G59.3"};

/// Mach3's, of those that have a code of their own.
inline constexpr std::array<std::string_view, 6> kMach3Offsets = {"G54", "G55", "G56", "G57", "G58", "G59"};
/// What is taken where the machine's file says nothing.
inline constexpr std::string_view kMach3Options = "dwell=seconds line_length=200 shop_codes=";

/// Source  LinuxCNC 2.9 manual, "O-codes", "Named parameters" and "G64".
inline constexpr std::array kSigns{
    Sign{.of = Sign::Of::kOWord, .what = "an O-word"},
    Sign{.of = Sign::Of::kText, .text = "#<", .what = "#<...>, a named parameter"},
    Sign{.text = "G64", .what = "a path tolerance", .other = "P"},
};

}  // namespace capstan::verify::linuxcnc
