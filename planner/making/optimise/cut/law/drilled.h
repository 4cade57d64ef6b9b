#pragma once

#include <algorithm>
#include <numbers>
#include <optional>

#include "planner/making/optimise/cut/law/law.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/force/drilling.h"

namespace capstan::optimise {

/// What drilling and reaming share: the cut of a question, and its loads as a step's.

[[nodiscard]] inline mechanics::WorkMaterial work_of(const CutQuestion& q) {
  return {q.material.kc11_n_mm2, q.material.mc};
}

[[nodiscard]] inline mechanics::DrillingCut drilled(const CutQuestion& q, double n_rpm, double feed_mm_min) {
  mechanics::DrillingCut c;
  c.diameter_mm = q.cutter.cutting_diameter_mm;
  c.feed_mm_per_rev = feed_mm_min / n_rpm;
  c.n_rpm = n_rpm;
  c.teeth = teeth_of(q);
  c.point_angle_rad = q.cutter.point_angle_rad > 0.0 ? q.cutter.point_angle_rad : std::numbers::pi;
  if (q.engaged_diameter_mm > 0.0) c.diameter_mm = std::min(c.diameter_mm, q.engaged_diameter_mm);
  c.pre_hole_diameter_mm = q.pre_hole_mm < c.diameter_mm ? q.pre_hole_mm : 0.0;
  return c;
}

template <class Loads>
[[nodiscard]] std::optional<model::StepLoads> as_step(const Loads& l) {
  if (!l) return std::nullopt;
  model::StepLoads out;
  out.peak_force_n = l->thrust_n;
  out.torque_nm = l->torque_nm;
  out.power_w = l->power_w;
  out.chip_thickness_mm = l->chip_thickness_mm;
  out.mrr_mm3_min = l->removal_mm3_min;
  return out;
}

}  // namespace capstan::optimise
