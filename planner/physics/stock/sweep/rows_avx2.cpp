#include "planner/physics/stock/sweep/rows.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace capstan::stock::rows {

#ifdef __AVX2__
namespace {
constexpr int kWidth = 8;
#include "planner/physics/stock/sweep/lanes.h"
// Formulas in lanes, then the loops.
#include "planner/physics/stock/sweep/rows_cells.h"
// The loops over rows.
#include "planner/physics/stock/sweep/rows_kernel.h"
}  // namespace

Kernel avx2() { return __builtin_cpu_supports("avx2") ? sweep_rows : nullptr; }
#else
Kernel avx2() { return nullptr; }
#endif

}  // namespace capstan::stock::rows
