#pragma once

#include <numbers>

/// Numbers that several kinds of path take where nobody says one. Of this room.
namespace capstan::toolpath {

/// Steepest ramp, rad, however steep the cutter may go; default, unsourced: what makers of solid end mills
/// commonly allow.
inline constexpr double kUsualRamp = 3.0 * std::numbers::pi / 180.0;
/// Between the cutter and the material beside it, where it must be in the air, mm; default, unsourced.
inline constexpr double kAirBeside = 0.2;
/// Between the cutter and the raw piece before a pass begins and behind its open end, mm; default, unsourced.
inline constexpr double kAirBeyond = 1.0;
/// A cutter that differs from what it cuts (a slot's width or height, a hole) by this at most is as large,
/// mm; default, unsourced.
inline constexpr double kSameSize = 0.02;

}  // namespace capstan::toolpath
