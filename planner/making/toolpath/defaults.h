#pragma once

#include <numbers>

/// Default numbers that several kinds of path share. Used in this room only.
namespace capstan::toolpath {

/// Steepest ramp, rad, even for a cutter that allows a steeper one; default, unsourced: what makers of solid
/// end mills commonly allow.
inline constexpr double kUsualRamp = 3.0 * std::numbers::pi / 180.0;
/// Between the cutter and the material beside it, where it must be in the air, mm; default, unsourced.
inline constexpr double kAirBeside = 0.2;
/// Between the cutter and the raw piece before a pass begins and behind its open end, mm; default, unsourced.
inline constexpr double kAirBeyond = 1.0;
/// A cutter that differs from what it cuts (a slot's width or height, a hole) by this at most is as large,
/// mm; default, unsourced.
inline constexpr double kSameSize = 0.02;

}  // namespace capstan::toolpath
