#include "planner/making/given/machine_needs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "planner/physics/mechanics/constants.h"

namespace capstan::given {
namespace {

struct Needs {
  double feed_mm_min = 0.0, rpm = 0.0, power_w = 0.0, torque_nm = 0.0;
  int axes_at_once = 1;
  std::map<std::size_t, geometry::Box3> paths;  ///< by set-up, tool tips
};

/// How many axes a move turns together.
int axes_of(const model::CutterPath& p, std::size_t i) {
  const auto moves = [](double a, double b) { return std::abs(a - b) > 1e-9 ? 1 : 0; };
  const int z = moves(p.z[i], p.z[i - 1]);
  const bool arc = p.kind[i] == model::MoveKind::kArcCw || p.kind[i] == model::MoveKind::kArcCcw;
  return z + (arc ? 2 : moves(p.x[i], p.x[i - 1]) + moves(p.y[i], p.y[i - 1]));
}

void add_path(Needs& n, const model::StepResult& s) {
  const model::CutterPath& p = *s.path;
  geometry::Box3& box = n.paths[s.setup];
  for (std::size_t i = 0; i < p.size(); ++i) {
    box.add({p.x[i], p.y[i], p.z[i]});
    if (i == 0) continue;
    n.axes_at_once = std::max(n.axes_at_once, axes_of(p, i));
    // An arc lies within the circle about its centre.
    if (p.kind[i] != model::MoveKind::kArcCw && p.kind[i] != model::MoveKind::kArcCcw) continue;
    const double r = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
    const double a0 = std::atan2(p.y[i - 1] - p.cy[i], p.x[i - 1] - p.cx[i]);
    const double a1 = std::atan2(p.y[i] - p.cy[i], p.x[i] - p.cx[i]);
    const bool ccw = p.kind[i] == model::MoveKind::kArcCcw;
    double sweep = ccw ? a1 - a0 : a0 - a1;
    if (sweep <= 1e-12) sweep += kRadPerTurn;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double at = 0.25 * kRadPerTurn * quarter;
      double from = ccw ? at - a0 : a0 - at;
      from -= kRadPerTurn * std::floor(from / kRadPerTurn);
      if (from < sweep) box.add({p.cx[i] + r * std::cos(at), p.cy[i] + r * std::sin(at), p.z[i]});
    }
  }
}

Needs needs_of(const model::Plan& plan) {
  Needs n;
  const double e = mechanics::spindle_efficiency(plan.machine.spindle.efficiency);
  for (const model::StepResult& s : plan.steps) {
    if (s.path) add_path(n, s);
    if (s.schedule) {
      for (const double f : s.schedule->feed_mm_min) n.feed_mm_min = std::max(n.feed_mm_min, f);
      for (const double r : s.schedule->spindle_rpm) n.rpm = std::max(n.rpm, std::abs(r));
    }
    n.power_w = std::max(n.power_w, s.loads.power_w / e);
    n.torque_nm = std::max(n.torque_nm, s.loads.torque_nm / e);
  }
  return n;
}

/// Upwards, so that what was needed is never a little more than what is stated.
double up(double v, double step) { return rounded(std::ceil(v / step - 1e-9) * step, 6); }

}  // namespace

void state_machine_needs(model::Plan& plan) {
  model::Model& m = plan.model;
  const auto* project = m.get<model::Project>(plan.project);
  const auto* main = project != nullptr ? m.get<model::Workplan>(project->main_workplan) : nullptr;
  if (main == nullptr || plan.steps.empty()) return;
  const model::AnyRef at = project->main_workplan;
  const auto* decision = plan.ledger.find(at, "its_minimum_machine_params");
  const bool ours = decision != nullptr && decision->binder == model::Binder::kRule;
  if (main->its_minimum_machine_params.set() && !ours) return;
  const Needs n = needs_of(plan);
  geometry::Vec3 span{};
  for (const auto& [setup, box] : n.paths) {
    const auto size = box.size();
    span = {std::max(span.x, size.x), std::max(span.y, size.y), std::max(span.z, size.z)};
  }
  model::MachineParameters p;
  p.feedrate = up(n.feed_mm_min, 0.1);
  p.spindle_speed = up(n.rpm, 0.1);
  if (n.power_w > 0.0) p.spindle_power = up(n.power_w, 0.01);
  if (n.torque_nm > 0.0) p.spindle_torque = up(n.torque_nm, 0.0001);
  p.number_of_control_axis = 3;
  p.number_of_simultaneous_axis = n.axes_at_once;
  p.axis_travel.given = true;
  for (const auto& [name, length] :
       {std::pair{"X", span.x}, std::pair{"Y", span.y}, std::pair{"Z", span.z}}) {
    model::MachineAxisTravel t;
    t.axis_identifier = name;
    t.travel_distance = up(length, 0.001);
    p.axis_travel.push_back(m.add(t));
  }
  p.work_volume_length = up(span.x, 0.001);
  p.work_volume_width = up(span.y, 0.001);
  p.work_volume_height = up(span.z, 0.001);
  const auto made = m.add(p);
  m.get<model::Workplan>(at)->its_minimum_machine_params = made;
  plan.ledger.bind(
      at, "its_minimum_machine_params", model::Binder::kRule,
      {"plan.machine_needs",
       "what the plan uses at most: " + trimmed(*p.feedrate, 1) + " mm/min, " + trimmed(*p.spindle_speed, 1) +
           " 1/min, " + trimmed(n.power_w, 0) + " W and " + trimmed(n.torque_nm, 2) + " Nm at the motor",
       "derived from paths, schedules and loads; lengths of tools are not counted in the travel"});
}

std::vector<model::Cutter> loaded_of(const model::Plan& plan, const std::vector<model::Cutter>& library,
                                     Job& job) {
  std::vector<model::Cutter> cutters = plan.cutters;
  std::string list;
  int missing = 0;
  bool known = false;
  for (const model::Cutter& c : library) known = known || c.loaded;
  for (model::Cutter& c : cutters) {
    c.loaded = std::any_of(library.begin(), library.end(), [&](const model::Cutter& k) {
      return k.id == c.id && k.loaded && k.pocket == c.pocket;
    });
    if (c.loaded) continue;
    ++missing;
    list += (list.empty() ? "" : "; ") + ("T" + std::to_string(c.pocket)) + " " + c.id;
  }
  if (known && missing > 0) job.note("PIP-TO-LOAD", "to load: " + list);
  if (model::changed_by_hand(plan.machine) && cutters.size() > 1)
    job.note("PIP-BY-HAND", "machine '" + plan.machine.id + "' has no tool changer: the " +
                                std::to_string(cutters.size()) + " tools are changed by hand");
  return cutters;
}

}  // namespace capstan::given
