#include "planner/physics/stock/sweep/rows.h"

#include <initializer_list>

namespace capstan::stock::rows {

Kernel best() {
  static const Kernel kernel = [] {
    for (const Kernel k : {avx512(), avx2()}) {
      if (k != nullptr) return k;
    }
    return portable();
  }();
  return kernel;
}

}  // namespace capstan::stock::rows
