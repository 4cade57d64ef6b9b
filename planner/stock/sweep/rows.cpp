#include "planner/stock/sweep/rows.h"

namespace capstan::stock::rows {

Kernel best() {
  static const Kernel kernel = avx2() != nullptr ? avx2() : portable();
  return kernel;
}

}  // namespace capstan::stock::rows
