#include "planner/making/optimise/cut/law/drilled.h"

namespace capstan::optimise {

AxialLaw drilling_law() {
  return {.name = "drilling", .loads = [](const CutQuestion& q, double n_rpm, double feed_mm_min) {
            return as_step(mechanics::drilling_loads(drilled(q, n_rpm, feed_mm_min), work_of(q)));
          }};
}

}  // namespace capstan::optimise
