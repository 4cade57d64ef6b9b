#pragma once

#include <optional>

#include "planner/making/optimise/cut.h"

/// Depths without chatter, of this room: from the machine's modes where it has some for the cutter.
namespace capstan::optimise {

/// Whether the machine states modes of the tool point for this cutter, so that lobes rule.
[[nodiscard]] bool has_modes(const CutQuestion& q);

/// Largest depth without chatter in a cut of this width, feed per tooth and speed, mm: the smaller of up and
/// down milling. Nothing without modes, or where the formulas give no value.
[[nodiscard]] std::optional<double> stable_depth(const CutQuestion& q, double ae_mm, double fz_mm,
                                                 double n_rpm);

/// The fastest speed up to `n_rpm` at which `ap_mm` does not chatter, rpm. Searches down to a quarter and the
/// spindle's lowest speed in steps of 2 %, a band over which the lobes count. Nothing if there is none.
[[nodiscard]] std::optional<double> quiet_speed(const CutQuestion& q, double ap_mm, double ae_mm,
                                                double fz_mm, double n_rpm);

}  // namespace capstan::optimise
