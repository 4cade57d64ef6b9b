#include "planner/physics/stock/sweep/rows.h"

#ifdef __AVX512VL__
#include <immintrin.h>
#endif

namespace capstan::stock::rows {

#ifdef __AVX512VL__
namespace {
constexpr int kWidth = 8;
#include "planner/physics/stock/sweep/lanes.h"
// Formulas in lanes, then the loops.
#include "planner/physics/stock/sweep/rows_cells.h"
// The loops over rows.
#include "planner/physics/stock/sweep/rows_kernel.h"
}  // namespace

// Still eight lanes: what is gained are masks and registers.
Kernel avx512() {
  return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                 __builtin_cpu_supports("avx512dq")
             ? sweep_rows
             : nullptr;
}
#else
Kernel avx512() { return nullptr; }
#endif

}  // namespace capstan::stock::rows
