#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/finish/mask.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::toolpath::freeform {

/// What a wider ball leaves for a smaller one, square to the surface, at each place of the tip of the smaller
/// one: 0 where the wider one touches the surface at the same point. It is at least what stays there, and no
/// more than `stock` (null: not known) has there, as exactly as its cells tell. Infinity where the wider one
/// meets no surface and no stock is known, so that nothing tells what it leaves. Shape  of `grid`, in mm; 0
/// where the grid has no place.
[[nodiscard]] std::vector<double> left_by_wider(const DropGrid& grid, const DropCutter& drop,
                                                const MillEnd& cutter, const MillEnd& wider,
                                                const stock::HeightMap* stock, Job& job);

/// Where more than `limit_mm` is left.
[[nodiscard]] Mask more_than(const DropGrid& grid, const std::vector<double>& left_mm, double limit_mm);

/// Where a task's stock stands on the surface raised by the allowance, square to it, at the places at which a
/// ball touches it, and two places around: what lies at its height already is not gone over. Nothing where it
/// stands all over, or nearly so. Needs  a stock.
[[nodiscard]] std::optional<Mask> where_stock_stands(const DropGrid& grid, const DropCutter& drop,
                                                     const MillEnd& ball, const FreeformJob& task, Job& job);

}  // namespace capstan::toolpath::freeform
