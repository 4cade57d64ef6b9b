#pragma once

#include <vector>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"

namespace capstan::toolpath::freeform {

inline constexpr double kBlocked = 1e300;  ///< height of the tip where the cutter may not be at all

/// Lowest tip heights along one stripe, evenly spaced.
struct Probes {
  double step = 0.0;
  std::vector<double> z;
};

/// A piece of a stripe that one level cuts, u from lo to hi.
struct Pass {
  std::size_t stripe = 0;
  double lo = 0.0, hi = 0.0;
};

/// How deep the tip may go, clear of surface, allowance and a margin.
///
/// Frame  the mesh's. Units mm.
struct Reach {
  const FreeformJob& task;
  const DropCutter& drop;
  MillEnd cutter;
  geometry::Region kept_out;
  double margin_mm = 0.0;
  double spacing_mm = 0.0;  ///< of probes between which a cutter that is clear at them is clear
  double floor_mm = 0.0;    ///< no deeper, also beside the mesh
  double border_mm = 1e-3;  ///< how far within the free side a border is found
  bool beside = false;      ///< beside the mesh the tip may go down to the floor

  /// The lowest height of the tip at p with `share` of the margin; `hint` as that of DropCutter::drop.
  [[nodiscard]] double at(geometry::Vec2 p, std::uint32_t& hint, double share = 1.0) const;
  /// Whether at(p) <= z, which is told sooner.
  [[nodiscard]] bool is_free(geometry::Vec2 p, double z, std::uint32_t& hint, double share = 1.0) const;
  /// The last free place at a level from `free` towards `blocked`.
  [[nodiscard]] geometry::Vec2 border(geometry::Vec2 free, geometry::Vec2 blocked, double z,
                                      std::uint32_t& hint) const;
  /// Whether a straight way at this level is clear with `share` of the margin, between the probes too.
  [[nodiscard]] bool is_free(geometry::Vec2 a, geometry::Vec2 b, double z, double share = 1.0) const;
  [[nodiscard]] std::vector<Probes> along(const Hatch& lines, Job& job) const;
  /// The grid that the borders of levels are read from; how fine it is decides only which borders are seen.
  [[nodiscard]] DropGrid grid(const geometry::Region& area, Job& job) const;
};

}  // namespace capstan::toolpath::freeform
