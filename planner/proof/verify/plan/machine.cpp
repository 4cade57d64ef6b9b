#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/form/limits.h"

// What a plan (or the part's file) says that a machine must have, against the machine.

namespace capstan::verify {
namespace {

using model::Machine;
using model::MachineParameters;

/// Rounding of what was stated, and of curves: power and torque of a point follow from each other with few
/// digits.
constexpr double kSlack = 1e-4;

struct Figure {
  int property;
  const char* code;
  const char* what;
  double needed, has;
  const char* unit;
};

std::string with_unit(double v, const char* unit) {
  const std::string u(unit);
  return plain(v) + (u.empty() ? "" : " " + u);
}

void refuse(const Figure& f, const Machine& m, Findings& findings) {
  if (!(f.needed > f.has * (1.0 + kSlack) + kSlack)) return;
  findings.error(f.property, f.code, {Findings::kWhole, "", -1},
                 std::string("the plan needs ") + f.what + " of " + with_unit(f.needed, f.unit) +
                     "; the machine '" + m.id + "' has " + with_unit(f.has, f.unit),
                 f.needed);
}

/// Of the gear in use.
struct Top {
  double rpm = 0.0, power_w = 0.0, torque_nm = 0.0;
};
Top top_of(const Machine& m) {
  Top t;
  t.rpm = m.spindle.rpm_max;
  for (const auto& p : m.spindle.curve) {
    t.power_w = std::max(t.power_w, p.power_w);
    t.torque_nm = std::max(t.torque_nm, p.torque_nm);
  }
  return t;
}

double travel_of(const Machine& m, std::string_view axis) {
  for (const auto& a : m.axes) {
    if (a.name == axis) return a.travel_max_mm - a.travel_min_mm;
  }
  return 0.0;
}

void check_travel(const model::Plan& plan, const MachineParameters& p, Findings& findings) {
  const Machine& m = plan.machine;
  for (const auto ref : p.axis_travel.items) {
    const auto* t = plan.model.get<model::MachineAxisTravel>(ref);
    if (t == nullptr) continue;
    const std::string axis = t->axis_identifier.value_or("");
    const bool linear = axis == "X" || axis == "Y" || axis == "Z";
    if (!linear) {
      if (t->travel_distance.value_or(0.0) > 0.0 || t->travel_angle.value_or(0.0) > 0.0)
        findings.error(22, "CHK-MACHINE-AXIS", {Findings::kWhole, "", -1},
                       "the plan needs an axis '" + axis + "'; the machine '" + m.id + "' has X, Y and Z");
      continue;
    }
    const std::string what = "a travel in " + axis;
    refuse(
        {22, "CHK-MACHINE-TRAVEL", what.c_str(), t->travel_distance.value_or(0.0), travel_of(m, axis), "mm"},
        m, findings);
  }
  for (const auto& [what, needed, axis] : {std::tuple{"a work volume's length", p.work_volume_length, "X"},
                                           std::tuple{"a work volume's width", p.work_volume_width, "Y"},
                                           std::tuple{"a work volume's height", p.work_volume_height, "Z"}}) {
    refuse({22, "CHK-MACHINE-VOLUME", what, needed.value_or(0.0), travel_of(m, axis), "mm"}, m, findings);
  }
}

void check_one(const model::Plan& plan, const MachineParameters& p, Findings& findings) {
  const Machine& m = plan.machine;
  const Top top = top_of(m);
  const double feed =
      std::max({m.axes[0].feed_max_mm_min, m.axes[1].feed_max_mm_min, m.axes[2].feed_max_mm_min});
  refuse({18, "CHK-MACHINE-FEED", "a feed", p.feedrate.value_or(0.0), feed, "mm/min"}, m, findings);
  refuse(
      {16, "CHK-MACHINE-SPEED", "a spindle speed", std::abs(p.spindle_speed.value_or(0.0)), top.rpm, "1/min"},
      m, findings);
  if (!m.spindle.curve.empty()) {
    refuse({17, "CHK-MACHINE-POWER", "a spindle power", p.spindle_power.value_or(0.0), top.power_w, "W"}, m,
           findings);
    refuse(
        {17, "CHK-MACHINE-TORQUE", "a spindle torque", p.spindle_torque.value_or(0.0), top.torque_nm, "Nm"},
        m, findings);
  }
  const auto count = [](const model::Integer& n) { return static_cast<double>(n.value_or(0)); };
  refuse({22, "CHK-MACHINE-AXES", "a number of axes", count(p.number_of_control_axis),
          static_cast<double>(m.abilities.control_axes), ""},
         m, findings);
  refuse({22, "CHK-MACHINE-AXES", "a number of axes at once", count(p.number_of_simultaneous_axis),
          static_cast<double>(m.abilities.simultaneous_axes), ""},
         m, findings);
  // An accuracy is a figure that must be small.
  const double accuracy = m.abilities.positioning_accuracy_mm;
  if (p.positioning_accuracy.value_or(0.0) > 0.0 && accuracy > *p.positioning_accuracy + kSlack)
    findings.error(22, "CHK-MACHINE-ACCURACY", {Findings::kWhole, "", -1},
                   "the plan needs a positioning accuracy of " + mm(*p.positioning_accuracy) +
                       "; the machine '" + m.id + "' has " + mm(accuracy));
  if (p.table_indexing.value_or(false) && !m.abilities.table_indexing)
    findings.error(22, "CHK-MACHINE-INDEXING", {Findings::kWhole, "", -1},
                   "the plan needs an indexing table; the machine '" + m.id + "' has none");
  if (m.abilities.table_length_mm > 0.0)
    refuse({22, "CHK-MACHINE-TABLE", "a table's length", p.table_length.value_or(0.0),
            m.abilities.table_length_mm, "mm"},
           m, findings);
  if (m.abilities.table_width_mm > 0.0)
    refuse({22, "CHK-MACHINE-TABLE", "a table's width", p.table_width.value_or(0.0),
            m.abilities.table_width_mm, "mm"},
           m, findings);
  check_travel(plan, p, findings);
}

bool taps(const model::Plan& plan, const model::StepResult& step) {
  if (step.path && std::find(step.path->role.begin(), step.path->role.end(), model::MoveRole::kTap) !=
                       step.path->role.end())
    return true;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  return ws != nullptr && plan.model.get<model::Tapping>(ws->its_operation) != nullptr;
}

void check_steps(const model::Plan& plan, Findings& findings) {
  const Machine& m = plan.machine;
  std::set<std::string> seen;
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& s = plan.steps[i];
    const Findings::Where at{i + 1, ids[i], -1};
    if (!m.abilities.rigid_tapping && taps(plan, s))
      findings.error(22, "CHK-MACHINE-TAPPING", at,
                     "the step taps with the feed bound to the spindle; the machine '" + m.id +
                         "' does not synchronise them");
    const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
    // Lengths are judged for each tool of the plan among the tools.
    if (c != nullptr && seen.insert(c->id).second)
      check_tool_size({"tool " + c->id, 0.0, c->cutting_diameter_mm}, m, at, findings);
  }
}

/// What holds for sizes and places that state nothing of their own; depths never do. The plan's provenance
/// says it, by the operator's word or the file's, else the workpiece. Classes of ISO 2768 are not read: the
/// finest of them is 0.1 mm wide. 0: nothing.
double general_width(const model::Plan& plan) {
  constexpr std::string_view kBetween = "+-";
  for (const model::Provenance& row : plan.provenance) {
    if (row.what != "general tolerance") continue;
    const std::string_view value = row.value;
    if (value.find("2768") != std::string_view::npos) return 0.0;
    const bool both_ways = value.find(kBetween) != std::string_view::npos;
    const auto last = value.find_last_of(both_ways ? "-" : " ");
    const auto read = parse_double(value.substr(last == std::string_view::npos ? 0 : last + 1));
    return read.value_or(0.0) * (both_ways ? 2.0 : 1.0);
  }
  const auto* piece = workpiece_of(plan);
  return piece == nullptr ? 0.0 : 2.0 * general_tolerance_of(*piece).value_or(0.0);
}

/// The widths of tolerances that the axes must keep: sizes but for holes, whose diameter is their tool's,
/// zones of location, and what holds where nothing is stated.
class Tightest {
 public:
  explicit Tightest(const model::Plan& plan) {
    std::vector<model::AnyRef> roots;
    for (const model::StepResult& s : plan.steps) {
      const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
      if (ws != nullptr) roots.emplace_back(ws->its_feature);
    }
    if (!roots.empty()) add(general_width(plan), "what states no tolerance of its own");
    const std::vector<model::AnyRef> all = model::reachable(plan.model, roots);
    std::set<model::AnyRef> bores;
    for (const model::AnyRef r : all) {
      if (const auto* hole = plan.model.get<model::RoundHole>(r)) bores.insert(hole->diameter);
    }
    for (const model::AnyRef r : all) {
      const auto* size = plan.model.get<model::TolerancedLengthMeasure>(r);
      if (size == nullptr || bores.contains(r)) continue;
      const volumes::Limits l = volumes::limits_of(plan.model, r);
      // A size that cannot be read is reported where its feature is planned.
      if (l.given) add(l.width(), "a size of " + mm(l.nominal_mm));
    }
    const auto zones = volumes::location_zones(plan.model);
    for (const model::StepResult& s : plan.steps) {
      const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
      const auto zone = ws == nullptr ? zones.end() : zones.find(ws->its_feature);
      if (zone != zones.end()) add(zone->second, "a location of step '" + model::step_id(plan, s) + "'");
    }
  }
  double width_mm = 1e300;
  std::string what;

 private:
  void add(double width, std::string name) {
    if (!(width > 0.0) || width >= width_mm) return;
    width_mm = width;
    what = std::move(name);
  }
};

void check_accuracy(const model::Plan& plan, Findings& findings) {
  const double accuracy = plan.machine.abilities.positioning_accuracy_mm;
  if (!(accuracy > 0.0)) return;
  const Tightest t(plan);
  if (accuracy <= t.width_mm + kSlack) return;
  findings.warn(22, "CHK-MACHINE-TOLERANCE", {Findings::kWhole, "", -1},
                t.what + " has a tolerance " + mm(t.width_mm) + " wide; the machine '" + plan.machine.id +
                    "' positions to " + mm(accuracy));
}

/// The raw piece, as the set-ups lay it, against the table, where that is known, else against the travel; its
/// height against the travel. A long bar may well stand out on both sides: how it is held, and whether it
/// moves clear of what is around the machine, no plan says.
void check_piece(const model::Plan& plan, Findings& findings) {
  const Machine& m = plan.machine;
  std::set<std::size_t> seen;
  for (const model::StepResult& step : plan.steps) {
    if (plan.stock.box.empty() || !seen.insert(step.setup).second) continue;
    const geometry::Vec3 size = placed(plan.stock.box, workpiece_in(plan, step.setup)).size();
    std::string beyond;
    const auto compare = [&](double mm_there, double table_mm, std::string_view axis) {
      const double travel = travel_of(m, axis), room = table_mm > 0.0 ? table_mm : travel;
      if (!(room > 0.0) || mm_there <= room * (1.0 + kSlack) + kSlack) return;
      beyond += (beyond.empty() ? "" : ", ") + mm(mm_there) + " in " + std::string(axis) + ", where " +
                (table_mm > 0.0 ? "the table has " : "the axis travels ") + mm(room);
    };
    compare(size.x, m.abilities.table_length_mm, "X");
    compare(size.y, m.abilities.table_width_mm, "Y");
    compare(size.z, 0.0, "Z");
    if (beyond.empty()) continue;
    findings.unproved(
        Severity::kWarning, 22, "CHK-MACHINE-PIECE", {Findings::kWhole, "", -1},
        "the raw piece is larger than the machine '" + m.id + "': " + beyond +
            "; whether it can be held there and moved is not looked at: state the raw piece as it "
            "is (--stock), or take a larger machine");
    return;
  }
}

}  // namespace

void check_tool_size(const ToolSize& tool, const Machine& m, const Findings::Where& at, Findings& findings) {
  if (m.tool_diameter_max_mm > 0.0 && tool.diameter_mm > m.tool_diameter_max_mm + kSlack)
    findings.error(4, "CHK-MACHINE-TOOL", at,
                   tool.name + " has a diameter of " + mm(tool.diameter_mm) + "; the machine '" + m.id +
                       "' takes " + mm(m.tool_diameter_max_mm) + " at most",
                   tool.diameter_mm);
  if (m.tool_length_max_mm > 0.0 && tool.length_mm > m.tool_length_max_mm + kSlack)
    findings.error(6, "CHK-TOOL-LENGTH", at,
                   tool.name + " is " + mm(tool.length_mm) + " long; the machine '" + m.id + "' takes " +
                       mm(m.tool_length_max_mm) + " at most: check the unit of its length",
                   tool.length_mm);
}

void check_machine(const model::Plan& plan, Findings& findings) {
  check_steps(plan, findings);
  check_piece(plan, findings);
  check_accuracy(plan, findings);
  const std::vector<model::AnyRef> roots = {plan.project};
  for (const model::AnyRef r : model::reachable(plan.model, roots)) {
    const auto* workplan = plan.model.get<model::Workplan>(r);
    if (workplan == nullptr) continue;
    const auto* p = plan.model.get<MachineParameters>(workplan->its_minimum_machine_params);
    if (p != nullptr) check_one(plan, *p, findings);
  }
}

}  // namespace capstan::verify
