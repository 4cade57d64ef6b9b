#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

/// A touch of the plan that a text makes by the machine's macro (option `probe_macro`).
struct MacroTouch {
  model::AnyRef touch, before;  ///< `before`: the step that it precedes; none: behind the last
  std::size_t setup = 0;
  long first = 0, last = 0;  ///< lines
  long behind = 0;  ///< the first line behind it, and behind macros that follow it, that is not empty
};

/// A text without its macros: readers know no subprograms of the shop.
struct WithoutMacros {
  std::string text;  ///< their lines are empty
  std::vector<MacroTouch> touches;
};

/// Takes out the blocks that say `probe_macro` of one touch of the plan, one behind the other, its places to
/// half a unit of the last decimal, on a Fanuc and a Haas with a decimal point where they are not zero, as
/// their readers want of any length; each touch once. What says another place, or none of the plan, stays,
/// and is for the reader a block that it cannot follow.
[[nodiscard]] WithoutMacros without_macros(std::string_view text, const model::Plan& plan);

/// What the macros that were taken out are held to: 33 they stand before the step that the touch precedes,
/// behind one of its set-up; 31 with the tool at the top of Z, spindle and coolant off, and behind them that
/// again; the step behind has another tool, so that it is called; 9 and 31 the way down at the start and
/// along the touch is clear of all of the raw piece and of what holds it, the probe taken as discs about its
/// ways.
void check_macros(const ProgramCase& c, const std::vector<MacroTouch>& touches, Findings& findings);

}  // namespace capstan::verify
