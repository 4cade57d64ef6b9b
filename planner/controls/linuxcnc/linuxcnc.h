#pragma once

#include <string>

#include "planner/controls/dialect.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::linuxcnc {

/// LinuxCNC 2.9: its programs as `gcode::write` says them.
///
/// Path    `G64 P` with the tolerance, `G61` without one.
/// Top     of Z by `G53 G0 Z`.
/// Tapping `G33.1`, which turns the spindle round by itself.
/// Holes   with `cycles: feature`: `G81`, `G82`, `G85`, `G89`, `G86` where the spindle stops at the bottom;
///         `G83` and `G73` where the pecks are equal from R on.
/// Stops   `(MSG, ...)`, then `M0`.
/// Source  LinuxCNC 2.9 manual, G-code reference and "RS274/NGC".
extern const Dialect kDialect;

/// The tool table (.tbl) of the program: `T1 P1 Z+50.000000 D+18.000000 ;description`, by tool number.
/// Units  mm (LINEAR_UNITS = mm of the machine's ini file).
/// A tool that came from the machine's tool table has its words of it again, number for number: pocket,
/// offsets of all axes, diameter (but for a boring tool, which is set anew). Of another, Z is the functional
/// length, D the diameter, P the tool number.
[[nodiscard]] std::string write_tool_table(const model::Plan& plan);

}  // namespace capstan::controls::linuxcnc
