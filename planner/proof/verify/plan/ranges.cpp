#include <cmath>
#include <set>

#include "planner/model/plan/cutter/cutter_faults.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/range/ranges.h"
#include "planner/proof/verify/plan/plan_checks.h"

// Values that a plan's file states, against what they can be at all. A plan may come back from somebody's
// editor: a specific force below zero, or an efficiency of nothing, makes every limit that is computed with
// it hold. The ranges are those that readers of data files ask (model/plan/range/ranges.h).

namespace capstan::verify {
namespace {

namespace range = model::range;

class Ranges {
 public:
  explicit Ranges(Findings& out) : out_(out) {}

  void of(const std::string& owner) { owner_ = owner; }
  void within(const std::string& what, double v, const model::Range& wanted) {
    if (!wanted.holds(v)) say(what + " is " + model::value_text(v) + "; it must be " + to_text(wanted));
  }
  /// 0 stands for "not known".
  void known(const std::string& what, double v, const model::Range& wanted) {
    if (v != 0.0) within(what, v, wanted);
  }
  void point(const std::string& what, const geometry::Vec3& p) {
    for (const double v : {p.x, p.y, p.z}) within(what, v, range::kPositionMm);
  }
  void finite(const std::string& what, double v) {
    if (!std::isfinite(v)) say(what + " is not a finite number");
  }
  void say(const std::string& what) {
    out_.error(1, "CHK-RANGE", {Findings::kWhole, "", -1},
               owner_ + ": " + what + ": correct it in the plan's file");
  }

 private:
  Findings& out_;
  std::string owner_;
};

void check_curve(Ranges& r, const std::vector<model::SpindlePoint>& curve) {
  double last = 0.0;
  for (const model::SpindlePoint& p : curve) {
    r.within("the spindle curve's power", p.power_w, range::kPowerW);
    r.within("the spindle curve's torque", p.torque_nm, range::kTorqueNm);
    r.within("the spindle curve's speed", p.rpm,
             {std::max(range::kCurveRpm.least, last), range::kCurveRpm.most});
    last = p.rpm;
  }
}

void check_axis(const model::LinearAxis& a, Ranges& r) {
  r.within("the travel of axis " + a.name, a.travel_min_mm, range::kAxisPositionMm);
  r.within("the travel of axis " + a.name, a.travel_max_mm, range::kAxisPositionMm);
  if (a.travel_min_mm != 0.0 || a.travel_max_mm != 0.0)
    r.within("the travel of axis " + a.name, a.travel_max_mm - a.travel_min_mm, range::kTravelMm);
  r.known("a rapid's speed", a.rapid_mm_min, range::kAxisSpeedMmMin);
  r.known("an axis' greatest feed", a.feed_max_mm_min, range::kAxisSpeedMmMin);
  r.known("an acceleration", a.acceleration_mm_s2, range::kAccelerationMmS2);
  if (a.jerk_mm_s3) r.within("a jerk", *a.jerk_mm_s3, range::kJerkMmS3);
}

void check_machine(const model::Machine& m, Ranges& r) {
  r.of("machine '" + m.id + "'");
  for (const model::LinearAxis& a : m.axes) check_axis(a, r);
  const model::Spindle& s = m.spindle;
  r.within("the spindle's least speed", s.rpm_min, range::kSpindleRpm);
  r.within("the spindle's greatest speed", s.rpm_max, {std::max(0.0, s.rpm_min), range::kSpindleRpm.most});
  r.within("the spindle's efficiency", s.efficiency, range::kEfficiency);
  r.within("the spindle's time to come up to speed", s.spin_up_s, range::kSpinUpS);
  check_curve(r, s.curve);
  for (const model::SpindleGear& g : s.gears) {
    r.within("a gear's least speed", g.rpm_min, range::kSpindleRpm);
    r.within("a gear's greatest speed", g.rpm_max, {std::max(0.0, g.rpm_min), range::kSpindleRpm.most});
    check_curve(r, g.curve);
    check_curve(r, g.curve_s6);
  }
  r.within("the number of pockets", m.magazine_pockets, range::kPockets);
  r.known("the greatest diameter of a tool", m.tool_diameter_max_mm, range::kMagazineMm);
  r.known("the greatest length of a tool", m.tool_length_max_mm, range::kMagazineMm);
  r.within("the time of a tool change", m.tool_change_s, range::kToolChangeS);
  r.within("the cost of an hour", m.cost_per_hour, range::kCost);
  r.within("the decimals of lengths", m.control.decimals, range::kDecimals);
  r.within("the decimals of feeds", m.control.feed_decimals, range::kDecimals);
  r.within("the path tolerance", m.control.path_tolerance_mm, range::kPathToleranceMm);
  r.within("the least time of a block", m.control.block_time_s, range::kBlockTimeS);
  const model::MachineAbilities& a = m.abilities;
  r.within("the greatest feed override", a.feed_override_max, range::kFeedOverride);
  r.within("the number of axes", a.control_axes, range::kAxes);
  r.within("the number of axes at once", a.simultaneous_axes, {1.0, static_cast<double>(a.control_axes)});
  r.within("the accuracy of positioning", a.positioning_accuracy_mm, range::kAccuracyMm);
  r.within("the table's length", a.table_length_mm, range::kTableMm);
  r.within("the table's width", a.table_width_mm, range::kTableMm);
  r.within("the pressure through the spindle", a.through_pressure_bar, range::kPressureBar);
  r.within("the greatest mass of a tool", a.magazine_mass_max_kg, range::kMassKg);
  for (const model::ToolPointMode& mode : m.modes) {
    r.within("the frequency of a mode", mode.frequency_hz, range::kModeHz);
    r.within("the damping of a mode", mode.damping_ratio, range::kDamping);
    r.within("the stiffness of a mode", mode.stiffness_n_mm, range::kStiffnessNMm);
    if (mode.direction != "x" && mode.direction != "y")
      r.say("the direction of a mode is '" + mode.direction + "'; it must be x or y");
  }
}

void check_cutter(const model::Cutter& c, Ranges& r) {
  r.of("tool '" + c.id + "'");
  for (const std::string& fault : model::faults_of(c)) r.say(fault);
  // A library may not know it; a path was planned with it.
  if (c.cutter_class != model::CutterClass::kTouchProbe && !(c.stick_out_mm > 0.0))
    r.say("it does not stick out of its holder");
  r.within("the cutting diameter", c.cutting_diameter_mm, range::kToolDiameterMm);
  if (c.fz_max_mm != 0.0)
    r.within("the greatest chip", c.fz_max_mm, {c.fz_min_mm, range::kToolLengthMm.most});
  r.known("the number of teeth", c.teeth, range::kTeeth);
  for (const model::CuttingPreset& p : c.presets) {
    r.within("the speed of a start value", p.vc_m_min, range::kCuttingSpeedMMin);
    r.within("the feed of a start value", p.fz_mm, range::kFeedPerToothMm);
  }
  for (const model::SisterTool& s : c.sisters)
    r.within("the life left of a sister", s.life_left_min,
             {-range::kToolLifeMin.most, range::kToolLifeMin.most});
}

void check_material(const model::WorkMaterial& m, Ranges& r) {
  if (m.id.empty()) return;
  r.of("material '" + m.id + "'");
  r.within("the specific cutting force kc11", m.kc11_n_mm2, range::kKc11NMm2);
  r.within("the exponent mc", m.mc, range::kMc);
  r.known("the speed for HSS", m.vc_hss_m_min, range::kVcHssMMin);
  r.known("the speed for carbide", m.vc_carbide_m_min, range::kVcCarbideMMin);
  r.within("the tensile strength", m.tensile_strength_n_mm2, range::kStrengthNMm2);
  r.within("the hardness", m.hardness_hb, range::kHardnessHb);
  r.within("the uncertainty of kc11", m.kc_uncertainty, range::kKcUncertainty);
  for (const model::MechanisticSet& s : m.mechanistic) {
    r.within("a coefficient ktc", s.ktc_n_mm2, range::kKtcNMm2);
    r.within("a coefficient krc", s.krc_n_mm2, range::kKrcNMm2);
    r.within("a coefficient kac", s.kac_n_mm2, range::kKrcNMm2);
    for (const double v : {s.kte_n_mm, s.kre_n_mm, s.kae_n_mm})
      r.within("a coefficient of the edge", v, range::kEdgeNMm);
    r.within("the uncertainty of a set", s.uncertainty, range::kSetUncertainty);
  }
  for (const model::ToolLifeLaw& l : m.life) {
    r.within("the speed of a life law", l.v0_m_min, range::kLifeSpeedMMin);
    r.within("the life of a life law", l.life_min, range::kLifeMin);
    r.within("the exponent n of a life law", l.n, range::kTaylorN);
    r.within("the exponent p of a life law", l.p, range::kTaylorPq);
    r.within("the exponent q of a life law", l.q, range::kTaylorPq);
    r.within("the scatter of a life law", l.scatter, range::kLifeScatter);
    if (l.p > 0.0) r.within("the chip of a life law", l.h0_mm, range::kLifeChipMm);
    if (l.q > 0.0) r.within("the depth of a life law", l.a0_mm, range::kLifeDepthMm);
  }
}

void check_stock(const model::Plan& plan, Ranges& r) {
  r.of("the raw piece");
  const model::Stock& s = plan.stock;
  const geometry::Vec3 size = s.box.hi - s.box.lo;
  // A box that nobody has given a point yet is infinite, inside out.
  if (!plan.steps.empty() && (std::isfinite(s.box.lo.x) || std::isfinite(s.box.hi.x))) {
    r.point("a corner", s.box.lo);
    r.point("a corner", s.box.hi);
    r.within("its size along X", size.x, range::kRawPieceMm);
    r.within("its size along Y", size.y, range::kRawPieceMm);
    r.within("its size along Z", size.z, range::kRawPieceMm);
  }
  if (s.cylinder_radius_mm) r.within("its radius", *s.cylinder_radius_mm, range::kRawPieceMm);
}

void check_setup(const model::SetupResult& s, std::size_t number, Ranges& r) {
  r.of("set-up " + std::to_string(number));
  r.within("the security plane", s.security_z_mm, range::kPositionMm);
  const model::Workholding& h = s.holding;
  r.point("the datum", h.pickup);
  r.known("the clearance", h.clearance_mm, range::kClearanceMm);
  r.within("the holding force", h.holding_force_n, range::kHoldingForceN);
  for (const model::FixtureSolid& solid : h.solids) {
    r.of("set-up " + std::to_string(number) + ", '" + solid.id + "'");
    for (const geometry::Vec2& p : solid.outline) r.point("a corner", {p.x, p.y, solid.bottom_mm});
    r.within("the top", solid.top_mm, range::kPositionMm);
    r.within("the height", solid.top_mm - solid.bottom_mm, range::kFixtureMm);
  }
}

void check_step(const model::StepResult& s, Ranges& r) {
  r.within("the depth of cut", s.axial_depth_mm, range::kDepthMm);
  r.within("the width of cut", s.radial_depth_mm, range::kDepthMm);
  r.within("the cutting speed", s.vc_m_min, range::kCuttingSpeedMMin);
  r.within("the feed per tooth", s.fz_mm, range::kFeedPerToothMm);
  r.within("the spindle's speed", std::abs(s.spindle_rpm), range::kSpindleRpm);
  r.within("the feed", s.feed_mm_min, range::kFeedMmMin);
  r.within("the time of cutting", s.cutting_s, range::kStepTimeS);
  r.within("the time of rapids", s.rapid_s, range::kStepTimeS);
  r.within("the contour tolerance", s.contour_tolerance_mm, range::kContourMm);
  r.within("the path's deviation", s.path_deviation_mm, range::kContourMm);
  const model::StepLoads& l = s.loads;
  constexpr model::Range kLoad{0.0, 1e12};
  for (const auto& [what, v] :
       {std::pair{"the peak force", l.peak_force_n}, std::pair{"the torque", l.torque_nm},
        std::pair{"the power", l.power_w}, std::pair{"the deflection", l.deflection_mm},
        std::pair{"the chip's thickness", l.chip_thickness_mm},
        std::pair{"the rate of removal", l.mrr_mm3_min}, std::pair{"the surface", l.surface_rz_mm},
        std::pair{"the tool's life", l.tool_life_min}, std::pair{"the margin of forces", l.force_margin}})
    r.within(what, v, kLoad);
  r.finite("the error of the wall", l.wall_error_mm);
}

}  // namespace

void check_ranges(const model::Plan& plan, Findings& findings) {
  Ranges r(findings);
  check_machine(plan.machine, r);
  std::set<std::string> used;
  for (const auto& s : plan.steps) used.insert(s.cutter_id);
  for (const model::Cutter& c : plan.cutters) {
    if (used.contains(c.id)) check_cutter(c, r);
  }
  check_material(plan.material, r);
  check_stock(plan, r);
  for (std::size_t i = 0; i < plan.setups.size(); ++i) check_setup(plan.setups[i], i + 1, r);
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    r.of("step '" + ids[i] + "'");
    check_step(plan.steps[i], r);
  }
}

}  // namespace capstan::verify
