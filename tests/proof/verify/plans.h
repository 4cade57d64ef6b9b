#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"

/// Small plans and programs that are right, to plant faults in.
///
///     raw piece  100 x 100 x 50, its top at z = 0, security plane at z = 10
///     T1         end mill 10, cuts to the centre        step "pocket": 40 x 40 x 10 about (50, 50)
///     T2         twist drill 8, 118 degrees             step "drill":  8, 20 deep, conical bottom, at (15,
///     15) T3         reamer                                 (added by `with_reamer`)
namespace capstan::verify::testing {

using model::MoveRole;

inline constexpr double kPoint = 118.0 / 180.0 * std::numbers::pi;

class PlanMaker {
 public:
  model::Plan plan;

  model::Ref<model::CartesianPoint> point(double x, double y, double z) {
    model::CartesianPoint p;
    p.coordinates = {{x, y, z}, true};
    return plan.model.add(p);
  }
  model::Ref<model::Axis2Placement3d> at(double x, double y, double z) {
    model::Axis2Placement3d p;
    p.location = point(x, y, z);
    return plan.model.add(p);
  }
  model::Ref<model::Plane> depth(double d) {
    model::Plane p;
    p.position = at(0, 0, -d);
    return plan.model.add(p);
  }
  model::Ref<model::TolerancedLengthMeasure> length(double v) {
    model::TolerancedLengthMeasure t;
    t.theoretical_size = v;
    return plan.model.add(t);
  }
  model::Ref<model::ClosedPocket> pocket(const char* id, double x, double y, double size, double d) {
    model::RectangularClosedProfile r;
    r.profile_length = length(size);
    r.profile_width = length(size);
    model::ClosedPocket p;
    p.its_id = id;
    p.feature_placement = at(x, y, 0);
    p.depth = depth(d);
    p.bottom_condition = plan.model.add(model::PlanarPocketBottomCondition{});
    p.feature_boundary = plan.model.add(r);
    p.orthogonal_radius = length(5);
    return plan.model.add(p);
  }
  model::Ref<model::RoundHole> hole(const char* id, double x, double y, double diameter, double d) {
    model::ConicalHoleBottom c;
    c.tip_angle = kPoint;
    model::RoundHole h;
    h.its_id = id;
    h.feature_placement = at(x, y, 0);
    h.depth = depth(d);
    h.diameter = length(diameter);
    h.bottom_condition = plan.model.add(c);
    return plan.model.add(h);
  }
  model::Ref<model::PlanarFace> face(const char* id, double d) {
    model::RectangularClosedProfile r;
    r.profile_length = length(100);
    r.profile_width = length(100);
    model::PlanarFace f;
    f.its_id = id;
    f.feature_placement = at(50, 50, 0);
    f.depth = depth(d);
    f.face_boundary = plan.model.add(r);
    return plan.model.add(f);
  }

  template <class Operation>
  model::StepResult& step(const char* id, model::Ref<model::ManufacturingFeature> feature, const char* cutter,
                          model::CutterPath path, double feed, double rpm) {
    model::MachiningWorkingstep ws;
    ws.its_id = id;
    ws.its_feature = feature;
    ws.its_operation = plan.model.add(Operation{});
    model::StepResult s;
    s.step = plan.model.add(ws);
    s.cutter_id = cutter;
    s.feed_mm_min = feed;
    s.spindle_rpm = rpm;
    s.flood = true;
    const std::size_t n = path.size();
    model::FeedSchedule f{std::vector<double>(n, feed), std::vector<double>(n, rpm),
                          std::vector<double>(n, 0.0)};
    s.path = std::make_shared<model::CutterPath>(std::move(path));
    s.schedule = std::make_shared<model::FeedSchedule>(std::move(f));
    plan.steps.push_back(std::move(s));
    return plan.steps.back();
  }
};

inline model::Machine machine() {
  model::Machine m;
  for (std::size_t i = 0; i < 3; ++i) {
    model::LinearAxis& a = m.axes[i];
    a.name = std::string(1, static_cast<char>('X' + i));
    a.travel_min_mm = i == 2 ? -400.0 : 0.0;
    a.travel_max_mm = i == 2 ? 0.0 : 500.0;
    a.rapid_mm_min = 20000;
    a.feed_max_mm_min = 10000;
    a.acceleration_mm_s2 = 3000;
  }
  m.spindle.rpm_min = 50;
  m.spindle.rpm_max = 12000;
  m.spindle.curve = {{1000, 7500, 71.6}, {12000, 7500, 5.97}};
  m.spindle.efficiency = 0.8;
  m.magazine_pockets = 20;
  m.tool_length_max_mm = 300;
  return m;
}

inline model::Cutter endmill() {
  model::Cutter c;
  c.id = "em10";
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = 10;
  c.maximum_depth_of_cut_mm = 22;
  c.shank_diameter_mm = 10;
  c.stick_out_mm = 40;
  c.holder_diameter_mm = 30;
  c.functional_length_mm = 100;
  c.teeth = 4;
  c.centre_cutting = true;
  c.maximum_ramp_angle_rad = 0.1;
  c.maximum_speed_rpm = 10000;
  c.pocket = 1;
  return c;
}

inline model::Cutter drill() {
  model::Cutter c;
  c.id = "d8";
  c.cutter_class = model::CutterClass::kTwistDrill;
  c.cutting_diameter_mm = 8;
  c.point_angle_rad = kPoint;
  c.maximum_depth_of_cut_mm = 53;
  c.shank_diameter_mm = 8;
  c.stick_out_mm = 70;
  c.holder_diameter_mm = 30;
  c.functional_length_mm = 130;
  c.teeth = 2;
  c.pocket = 2;
  return c;
}

inline model::CutterPath pocket_path() {
  model::CutterPath p;
  p.start({50, 50, 10});
  p.rapid({50, 50, 2});
  for (const double z : {-5.0, -10.0}) {
    if (z < -5.0) p.line({50, 50, -5}, MoveRole::kLink);
    p.line({50, 50, z}, MoveRole::kPlunge);
    for (const double h : {4.0, 8.0, 12.0, 15.0}) {
      p.line({50 - h, 50 - h, z}, MoveRole::kCut);
      p.line({50 + h, 50 - h, z}, MoveRole::kCut);
      p.line({50 + h, 50 + h, z}, MoveRole::kCut);
      p.line({50 - h, 50 + h, z}, MoveRole::kCut);
      p.line({50 - h, 50 - h, z}, MoveRole::kCut);
    }
  }
  p.rapid({35, 35, 10}, MoveRole::kRetract);
  return p;
}

/// How far the drill's point runs ahead of its full diameter.
inline double point_length() { return 4.0 / std::tan(0.5 * kPoint); }

inline model::CutterPath drill_path() {
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 2});
  p.line({15, 15, -20 - point_length()}, MoveRole::kDrill);
  p.rapid({15, 15, 10}, MoveRole::kRetract);
  return p;
}

inline PlanMaker empty_plan() {
  PlanMaker k;
  model::Workpiece w;
  w.its_id = "part";
  model::WorkpieceSetup ws;
  ws.its_workpiece = k.plan.model.add(w);
  ws.its_origin = k.at(0, 0, 0);
  model::Setup s;
  s.its_id = "setup";
  s.its_workpiece_setup.push_back(k.plan.model.add(ws));
  k.plan.setups.push_back({k.plan.model.add(s), "G54", 10.0});
  k.plan.stock.box.add({0, 0, -50});
  k.plan.stock.box.add({100, 100, 0});
  k.plan.machine = machine();
  k.plan.material.id = "steel";
  k.plan.material.iso_group = "P";
  k.plan.material.kc11_n_mm2 = 1700;
  k.plan.material.mc = 0.25;
  k.plan.cutters = {endmill(), drill()};
  return k;
}

inline PlanMaker good_plan() {
  PlanMaker k = empty_plan();
  k.step<model::BottomAndSideRoughMilling>("pocket", k.pocket("P", 50, 50, 40, 10), "em10", pocket_path(),
                                           600, 3000);
  k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", drill_path(), 225, 1500);
  return k;
}

/// A reamer in the hole that the drill made 0.2 mm narrower; `rpm_out` while it is withdrawn.
inline void with_reamer(PlanMaker& k, double rpm_out) {
  k.plan.cutters[1].cutting_diameter_mm = 7.8;
  model::Cutter c = drill();
  c.id = "r8";
  c.cutter_class = model::CutterClass::kReamer;
  c.point_angle_rad = 0.0;
  c.teeth = 6;
  c.pocket = 3;
  k.plan.cutters.push_back(c);
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 2});
  p.line({15, 15, -19}, MoveRole::kDrill);
  p.line({15, 15, 2}, MoveRole::kRetract);
  p.rapid({15, 15, 10}, MoveRole::kRetract);
  const auto* drilled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
  auto& s = k.step<model::Reaming>("ream", drilled->its_feature, "r8", p, 150, 300);
  auto f = std::make_shared<model::FeedSchedule>(*s.schedule);
  f->spindle_rpm[3] = f->spindle_rpm[4] = rpm_out;
  s.schedule = f;
}

/// Changes the path of a step in place.
template <class F>
void edit_path(model::Plan& plan, std::size_t step, F f) {
  auto p = std::make_shared<model::CutterPath>(*plan.steps[step].path);
  f(*p);
  plan.steps[step].path = p;
}
template <class F>
void edit_schedule(model::Plan& plan, std::size_t step, F f) {
  auto s = std::make_shared<model::FeedSchedule>(*plan.steps[step].schedule);
  f(*s);
  plan.steps[step].schedule = s;
}

/// A plain program of a plan, one block per move, with four decimals.
inline std::string program_of(const model::Plan& plan) {
  std::string out = "%\n(a part)\nG21 G17 G90 G94 G40 G80 G49\n";
  const auto n4 = [](double v) { return trimmed(v, 4); };
  int loaded = 0;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const auto& s = plan.steps[i];
    const auto& p = *s.path;
    const auto* cutter = model::find_cutter(plan, s.cutter_id);
    out += "(CAPSTAN STEP id=\"" + model::step_id(plan, s) + "\" n=" + std::to_string(i + 1) + ")\n";
    out += "G21 G17 G90 G94 G40 G80\nG64 P0.01\nG54\n";
    const std::string t = std::to_string(cutter->pocket);
    if (cutter->pocket != loaded) out += "M9\nM5\nG53 G0 Z0\nT" + t + " M6\n";
    loaded = cutter->pocket;
    out += "G43 H" + t + "\nS" + n4(s.schedule->spindle_rpm[1]) + " M3\n";
    out += "G0 X" + n4(p.x[0]) + " Y" + n4(p.y[0]) + "\nM8\nG0 Z" + n4(p.z[0]) + "\n";
    for (std::size_t m = 1; m < p.size(); ++m) {
      const std::string xyz = " X" + n4(p.x[m]) + " Y" + n4(p.y[m]) + " Z" + n4(p.z[m]);
      const std::string f = " F" + n4(s.schedule->feed_mm_min[m]);
      const std::string ij = " I" + n4(p.cx[m] - p.x[m - 1]) + " J" + n4(p.cy[m] - p.y[m - 1]);
      switch (p.kind[m]) {
        case model::MoveKind::kRapid:
          out += "G0" + xyz + "\n";
          break;
        case model::MoveKind::kLine:
          out += "G1" + xyz + f + "\n";
          break;
        case model::MoveKind::kArcCw:
          out += "G2" + xyz + ij + f + "\n";
          break;
        case model::MoveKind::kArcCcw:
          out += "G3" + xyz + ij + f + "\n";
          break;
        case model::MoveKind::kDwell:
          out += "G4 P" + n4(s.schedule->dwell_s[m]) + "\n";
          break;
      }
    }
  }
  return out + "M5 M9\nG53 G0 Z0\nM30\n%\n";
}

inline std::string tool_table_of(const model::Plan& plan) {
  std::string out;
  for (const auto& c : plan.cutters) {
    const std::string t = std::to_string(c.pocket);
    out += "T" + t + " P" + t + " Z+" + fixed(c.functional_length_mm, 6) + " D+" +
           fixed(c.cutting_diameter_mm, 6) + " ;" + c.id + "\n";
  }
  return out;
}

/// The text with `from`'s first occurrence replaced; empty when it is not there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) return {};
  return text.replace(at, from.size(), to);
}

}  // namespace capstan::verify::testing
