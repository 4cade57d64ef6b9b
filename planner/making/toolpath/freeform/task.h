#pragma once

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/surface_line.h"

namespace capstan::toolpath::freeform {

/// The cutter's end, the task's numbers checked. Fails FRF-CUTTER, FRF-VALUE.
[[nodiscard]] Result<MillEnd> checked_cutter(const FreeformJob& task);
/// Where the axis may go, but for what is to be avoided.
[[nodiscard]] geometry::Region area_of(const FreeformJob& task, const DropCutter& drop);
/// What leads the cutter over the surface as the task says.
[[nodiscard]] Follower follower_of(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter);
/// Ways are probed at points no farther apart than this share of the cutter's radius.
inline constexpr double kProbedShare = 0.25;
/// Where the axis may not go, for what is to be avoided: ways between two points probed outside it keep the
/// cutter's radius from that, too.
[[nodiscard]] geometry::Region kept_out(const FreeformJob& task, const MillEnd& cutter);

}  // namespace capstan::toolpath::freeform
