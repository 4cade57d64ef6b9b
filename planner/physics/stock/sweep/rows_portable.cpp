#include "planner/physics/stock/sweep/rows.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace capstan::stock::rows {
namespace {
constexpr int kWidth = 4;
#include "planner/physics/stock/sweep/lanes.h"
// Formulas in lanes, then the loops.
#include "planner/physics/stock/sweep/rows_cells.h"
// The loops over rows.
#include "planner/physics/stock/sweep/rows_kernel.h"
}  // namespace

Kernel portable() { return sweep_rows; }

}  // namespace capstan::stock::rows
