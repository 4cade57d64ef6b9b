#pragma once

#include "planner/making/optimise/cut.h"

/// Cost of a cut: time, edges, and the earning of the machine's time. Used in this room only.
namespace capstan::optimise {

/// Dimensions and rates of a cut, and its thickest chip.
struct CutPoint {
  double ap_mm = 0.0, ae_mm = 0.0, n_rpm = 0.0, feed_mm_min = 0.0;
};

/// Cutting time of an edge. The material's life law for the cutter's substrate where it has one, at its
/// median less one standard deviation of the scatter (five edges of six last longer); else Taylor's law
/// through the cutter's life (mechanics::kLifeAtTableMin) at the table's speed.
///
///     T = T0 (v / v0)^(-1/n) (h / h0)^(-1/p) (a / a0)^(-1/q) exp(-scatter)
///
/// h is the feed per tooth, a the axial depth (drills: half the diameter).
[[nodiscard]] double edge_life_min(const CutQuestion& q, const CutPoint& at);

/// Time per removed volume (drilling family: per depth), min/mm3 or min/mm: cutting and, of a milling cut
/// whose area is known, changing levels.
[[nodiscard]] double time_of(const CutQuestion& q, const CutPoint& at);

/// The value that the Aim minimises, per volume or depth.
[[nodiscard]] double objective_of(const CutQuestion& q, const CutPoint& at);

/// The same without the cost of edges; never more than objective_of.
[[nodiscard]] double objective_without_edges(const CutQuestion& q, const CutPoint& at);

}  // namespace capstan::optimise
