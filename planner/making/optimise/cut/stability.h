#pragma once

#include <optional>

#include "planner/making/optimise/cut.h"

/// Depths without chatter, of this room: from the machine's modes where it has some for the cutter.
namespace capstan::optimise {

/// Whether the machine states modes of the tool point for this cutter, so that lobes rule.
[[nodiscard]] bool has_modes(const CutQuestion& q);

/// The depth that does not chatter in a cut of this width, feed per tooth and speed, up or down milling,
/// whichever allows less; nothing without modes, or where the formulas give none.
[[nodiscard]] std::optional<double> stable_depth(const CutQuestion& q, double ae_mm, double fz_mm,
                                                 double n_rpm);

/// The fastest speed at most `n_rpm` at which `ap_mm` does not chatter, down to a quarter and the spindle's
/// least, in steps of 2 % (the lobes count over such a band); nothing when there is none.
[[nodiscard]] std::optional<double> quiet_speed(const CutQuestion& q, double ap_mm, double ae_mm,
                                                double fz_mm, double n_rpm);

}  // namespace capstan::optimise
