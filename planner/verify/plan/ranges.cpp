#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "planner/verify/plan/plan_checks.h"

// Values that a plan's file states, against what they can be at all. A plan may come back from somebody's
// editor: a specific force below zero, or an efficiency of nothing, makes every limit that is computed with
// it hold.

namespace capstan::verify {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr int kMostDecimals = 9;

class Ranges {
 public:
  explicit Ranges(Findings& out) : out_(out) {}

  void of(const std::string& owner) { owner_ = owner; }
  void within(const char* what, double v, double lo, double hi) {
    if (std::isfinite(v) && v >= lo && v <= hi) return;
    const std::string range = hi >= kAny ? plain(lo) + " or more" : plain(lo) + " to " + plain(hi);
    say(what, v, range);
  }
  void not_negative(const char* what, double v) { within(what, v, 0.0, kAny); }
  void share(const char* what, double v) {
    if (!(v > 0.0 && v <= 1.0)) say(what, v, "above zero, and 1 at most");
  }
  void above_zero(const char* what, double v) {
    if (!(std::isfinite(v) && v > 0.0)) say(what, v, "above zero");
  }

 private:
  void say(const char* what, double v, const std::string& range) {
    out_.error(1, "CHK-RANGE", {Findings::kWhole, "", -1},
               owner_ + ": " + what + " is " + plain(v) + "; it must be " + range +
                   ": correct it in the plan's file");
  }
  Findings& out_;
  std::string owner_;
};

void check_curve(Ranges& r, const std::vector<model::SpindlePoint>& curve) {
  double last = -1.0;
  for (const model::SpindlePoint& p : curve) {
    r.not_negative("the spindle curve's power", p.power_w);
    r.not_negative("the spindle curve's torque", p.torque_nm);
    r.within("the spindle curve's speed", p.rpm, std::max(0.0, last), kAny);
    last = p.rpm;
  }
}

void check_shop(const model::Machine& m, Ranges& r) {
  r.of("machine '" + m.id + "'");
  for (const model::LinearAxis& a : m.axes) {
    if (a.travel_min_mm != 0.0 || a.travel_max_mm != 0.0)
      r.above_zero(("the travel of axis " + a.name).c_str(), a.travel_max_mm - a.travel_min_mm);
    r.not_negative("a rapid's speed", a.rapid_mm_min);
    r.not_negative("an axis' greatest feed", a.feed_max_mm_min);
    r.not_negative("an acceleration", a.acceleration_mm_s2);
    if (a.jerk_mm_s3) r.above_zero("a jerk", *a.jerk_mm_s3);
  }
  const model::Spindle& s = m.spindle;
  r.not_negative("the spindle's least speed", s.rpm_min);
  r.within("the spindle's greatest speed", s.rpm_max, s.rpm_min, kAny);
  r.share("the spindle's efficiency", s.efficiency);
  r.not_negative("the spindle's time to come up to speed", s.spin_up_s);
  check_curve(r, s.curve);
  for (const model::SpindleGear& g : s.gears) {
    r.within("a gear's greatest speed", g.rpm_max, std::max(0.0, g.rpm_min), kAny);
    check_curve(r, g.curve);
    check_curve(r, g.curve_s6);
  }
  r.not_negative("the number of pockets", m.magazine_pockets);
  r.not_negative("the greatest diameter of a tool", m.tool_diameter_max_mm);
  r.not_negative("the greatest length of a tool", m.tool_length_max_mm);
  r.not_negative("the time of a tool change", m.tool_change_s);
  r.not_negative("the cost of an hour", m.cost_per_hour);
  r.within("the decimals of lengths", m.control.decimals, 0.0, kMostDecimals);
  r.within("the decimals of feeds", m.control.feed_decimals, 0.0, kMostDecimals);
  r.not_negative("the path tolerance", m.control.path_tolerance_mm);
  r.not_negative("the least time of a block", m.control.block_time_s);
  r.above_zero("the greatest feed override", m.abilities.feed_override_max);
}

void check_cutter(const model::Cutter& c, Ranges& r) {
  r.of("tool '" + c.id + "'");
  r.above_zero("the cutting diameter", c.cutting_diameter_mm);
  const std::pair<const char*, double> lengths[] = {{"the corner radius", c.corner_radius_mm},
                                                    {"the tip's diameter", c.tip_diameter_mm},
                                                    {"the greatest depth of cut", c.maximum_depth_of_cut_mm},
                                                    {"the usable length", c.usable_length_mm},
                                                    {"the stick-out", c.stick_out_mm},
                                                    {"the functional length", c.functional_length_mm},
                                                    {"the shank's diameter", c.shank_diameter_mm},
                                                    {"the holder's diameter", c.holder_diameter_mm},
                                                    {"the pitch", c.thread_pitch_mm},
                                                    {"the greatest speed", c.maximum_speed_rpm},
                                                    {"the life", c.life_min},
                                                    {"the life used", c.life_used_min},
                                                    {"the price", c.price},
                                                    {"the least chip", c.fz_min_mm},
                                                    {"the neck's diameter", c.neck_diameter_mm},
                                                    {"the neck's length", c.neck_length_mm},
                                                    {"the cutting width", c.cutting_width_mm},
                                                    {"the thread's size", c.thread_size_mm},
                                                    {"the runout", c.runout_mm}};
  for (const auto& [what, v] : lengths) r.not_negative(what, v);
  if (c.fz_max_mm != 0.0) r.within("the greatest chip", c.fz_max_mm, c.fz_min_mm, kAny);
  r.not_negative("the number of teeth", c.teeth);
  r.within("the point's angle", c.point_angle_rad, 0.0, std::numbers::pi);
  r.within("the greatest ramp", c.maximum_ramp_angle_rad, 0.0, 0.5 * std::numbers::pi);
  for (const model::HolderSegment& h : c.holder) {
    r.not_negative("the height of a part of the holder", h.height_mm);
    r.not_negative("a diameter of the holder", h.lower_diameter_mm);
    r.not_negative("a diameter of the holder", h.upper_diameter_mm);
  }
}

}  // namespace

void check_ranges(const model::Plan& plan, Findings& findings) {
  Ranges r(findings);
  check_shop(plan.machine, r);
  std::set<std::string> used;
  for (const auto& s : plan.steps) used.insert(s.cutter_id);
  for (const model::Cutter& c : plan.cutters) {
    if (used.contains(c.id)) check_cutter(c, r);
  }
  r.of("material '" + plan.material.id + "'");
  if (!plan.material.id.empty()) {
    r.above_zero("the specific cutting force kc11", plan.material.kc11_n_mm2);
    r.within("the exponent mc", plan.material.mc, 0.0, 1.0);
  }
  r.of("the raw piece");
  const geometry::Box3& box = plan.stock.box;
  if (std::isfinite(box.lo.x) && std::isfinite(box.hi.x) && !plan.steps.empty()) {
    r.above_zero("its size along X", box.hi.x - box.lo.x);
    r.above_zero("its size along Y", box.hi.y - box.lo.y);
    r.above_zero("its size along Z", box.hi.z - box.lo.z);
  }
  for (const auto& s : plan.steps) {
    r.of("step '" + model::step_id(plan, s) + "'");
    r.not_negative("the depth of cut", s.axial_depth_mm);
    r.not_negative("the width of cut", s.radial_depth_mm);
    r.not_negative("the cutting speed", s.vc_m_min);
    r.not_negative("the feed per tooth", s.fz_mm);
    r.not_negative("the feed", s.feed_mm_min);
    r.not_negative("the time of cutting", s.cutting_s);
    r.not_negative("the time of rapids", s.rapid_s);
    r.not_negative("the contour tolerance", s.contour_tolerance_mm);
    r.not_negative("the path's deviation", s.path_deviation_mm);
  }
}

}  // namespace capstan::verify
