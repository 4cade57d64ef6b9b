#pragma once

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/freeform.h"

namespace capstan::toolpath::freeform {

/// The cutter as a toroid, the task's numbers checked. Fails FRF-CUTTER, FRF-VALUE.
[[nodiscard]] Result<Toroid> checked_cutter(const FreeformJob& task);
/// Where the axis may go.
[[nodiscard]] geometry::Region area_of(const FreeformJob& task, const DropCutter& drop);

}  // namespace capstan::toolpath::freeform
