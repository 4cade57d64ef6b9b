#pragma once

#include <utility>

#include "planner/making/optimise/cut.h"

/// Cuts that the tests ask for: sizes of common tools and machines.
namespace capstan::optimise::questions {

/// A 10 mm carbide end mill with four teeth in mild steel on a small machining centre: torque up to 1500
/// 1/min, then 5.5 kW.
inline CutQuestion roughing() {
  CutQuestion q;
  auto& c = q.cutter;
  c.id = "mill";
  c.cutting_diameter_mm = c.shank_diameter_mm = 10.0;
  c.maximum_depth_of_cut_mm = 22.0;
  c.stick_out_mm = 35.0;
  c.teeth = 4;
  c.helix_rad = 0.52;
  c.fz_max_mm = 0.12;
  q.material.kc11_n_mm2 = 1800.0;
  q.material.mc = 0.2;
  q.material.kc_uncertainty = 0.3;
  auto& m = q.machine;
  m.spindle.rpm_min = 60.0;
  m.spindle.rpm_max = 8000.0;
  m.spindle.curve = {{60.0, 220.0, 35.0}, {1500.0, 5500.0, 35.0}, {8000.0, 5500.0, 0.0}};
  m.spindle.efficiency = 0.85;
  m.tool_change_s = 6.0;
  m.cost_per_hour = 72.0;
  for (auto& a : m.axes) a.feed_max_mm_min = 10000.0;
  q.vc_start_m_min = 120.0;
  q.fz_start_mm = 0.06;
  q.depth_mm = 12.0;
  q.width_mm = 60.0;
  return q;
}

/// The same with a spindle that holds it back at every speed.
inline CutQuestion weak_spindle() {
  CutQuestion q = roughing();
  q.machine.spindle.curve = {{60.0, 15.0, 2.4}, {1500.0, 375.0, 2.4}, {8000.0, 375.0, 0.0}};
  return q;
}

inline CutQuestion finishing() {
  CutQuestion q = roughing();
  q.kind = CutKind::kFinish;
  q.width_mm = 0.3;
  q.deflection_limit_mm = 0.02;
  return q;
}

inline CutQuestion drilling() {
  CutQuestion q = roughing();
  q.kind = CutKind::kAxial;
  q.cutter.id = "drill";
  q.cutter.cutter_class = model::CutterClass::kTwistDrill;
  q.cutter.substrate = model::Substrate::kHss;
  q.cutter.teeth = 2;
  q.cutter.fz_max_mm = 0.0;
  q.cutter.point_angle_rad = 2.06;
  q.vc_start_m_min = 25.0;
  q.fz_start_mm = 0.1;
  return q;
}

}  // namespace capstan::optimise::questions
