#include "planner/making/optimise/cut/law/law.h"
#include "planner/physics/mechanics/force/drilling.h"

namespace capstan::optimise {

AxialLaw tapping_law() {
  return {.name = "tapping",
          .feed_is_pitch = true,
          .loads = [](const CutQuestion& q, double n_rpm, double) -> std::optional<model::StepLoads> {
            const auto l = mechanics::tapping_loads(mechanics::tapping_cut_of(q.cutter, q.pre_hole_mm, n_rpm),
                                                    {q.material.kc11_n_mm2, q.material.mc});
            if (!l) return std::nullopt;
            model::StepLoads out;
            out.torque_nm = l->torque_nm;
            out.power_w = l->power_w;
            out.chip_thickness_mm = l->chip_thickness_mm;
            return out;
          }};
}

}  // namespace capstan::optimise
