#include <cmath>
#include <map>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/plan/plan_checks.h"

// Facts that stand twice in a plan, against each other: a tool is an object of the part's file and an entry
// of the plan's list, speed and feed stand in technology and step, the cutting speed follows from speed and
// diameter. Where the two differ somebody edited one of them, and the program is written of the other.

namespace capstan::verify {
namespace {

/// What a conversion of units and the rounding of both leave apart. Derived: files hold at least nine digits.
constexpr double kApart = 1e-6;

class Twice {
 public:
  Twice(const model::Plan& plan, Findings& out) : plan_(plan), out_(out) {}

  void step(const model::StepResult& s, std::size_t order, const std::string& id) {
    at_ = {order + 1, id, -1};
    const model::Cutter* c = model::find_cutter(plan_, s.cutter_id);
    if (c == nullptr) return;  // said elsewhere
    const double rpm = std::abs(s.spindle_rpm);
    if (s.vc_m_min > 0.0)
      same("the cutting speed", s.vc_m_min, "m/min by speed and diameter",
           std::numbers::pi * c->cutting_diameter_mm * rpm / 1000.0);
    if (s.fz_mm > 0.0 && rpm > 0.0 && c->teeth > 0)
      same("the feed per tooth", s.fz_mm, "mm by feed, speed and teeth", s.feed_mm_min / rpm / c->teeth);
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(s.step);
    const auto* op = ws == nullptr ? nullptr : plan_.model.get<model::MachiningOperation>(ws->its_operation);
    if (op == nullptr) return;
    technology(s, *op, rpm);
    if (const auto* tool = plan_.model.get<model::MillingCuttingTool>(op->its_tool)) body(*tool, *c);
  }

 private:
  void same(const char* what, double stated, const char* by, double other) {
    if (!std::isfinite(stated) || !std::isfinite(other)) return;  // said elsewhere
    if (std::abs(stated - other) <= kApart * std::max(1.0, std::abs(other))) return;
    differs(std::string(what) + " is " + plain(stated) + ", but " + plain(other) + " " + by);
  }
  void differs(const std::string& what) {
    out_.error(1, "CHK-TWICE", at_, what + ": one of them was edited; correct it, or plan again");
  }

  /// Whether the step's path is the plan's own, not one that another system stated with its own feeds.
  [[nodiscard]] bool own_path(const model::StepResult& s, const model::Operation& op) const {
    const auto* list = plan_.model.get<model::ToolpathList>(op.its_toolpath);
    if (list == nullptr) return true;
    for (const auto& item : list->its_list.items) {
      const auto* t = plan_.model.get<model::CutterLocationTrajectory>(item);
      if (t != nullptr && t->path == s.path) return true;
    }
    return false;
  }

  void technology(const model::StepResult& s, const model::MachiningOperation& op, double rpm) {
    const auto* t = plan_.model.get<model::MillingTechnology>(op.its_technology);
    if (t == nullptr) return;
    if (t->spindle) same("the spindle's speed", rpm, "1/min in its technology", std::abs(*t->spindle));
    if (t->feedrate && own_path(s, op))
      same("the feed", s.feed_mm_min, "mm/min in its technology", *t->feedrate);
  }

  void body(const model::MillingCuttingTool& tool, const model::Cutter& c) {
    // Files name tools as they like: one without a name gets one, and the second of a name a number behind
    // it.
    const std::string named = tool.its_id.value_or("");
    if (!named.empty() && named != c.id && !c.id.starts_with(named + "~"))
      differs("its tool is '" + c.id + "' in the step, and '" + *tool.its_id + "' in its operation");
    // A table that was loaded since has measured it.
    if (tool.overall_assembly_length && !c.table_line)
      same("the tool's length", c.functional_length_mm, "mm in its operation", *tool.overall_assembly_length);
    const auto* usage = plan_.model.get<model::ToolUsage>(tool.its_usage);
    if (usage != nullptr && usage->its_position && *usage->its_position != std::to_string(c.pocket))
      differs("its tool has number " + std::to_string(c.pocket) + " in the plan's list, and " +
              *usage->its_position + " in its operation");
    const auto* b = plan_.model.get<model::MillingToolBody>(tool.its_tool_body);
    if (b == nullptr) return;
    if (b->number_of_teeth)
      same("the number of teeth", c.teeth, "in its operation", static_cast<double>(*b->number_of_teeth));
    const auto* size = plan_.model.get<model::MillingToolDimension>(b->dimension);
    if (size == nullptr) return;
    if (size->diameter)
      same("the tool's diameter", c.cutting_diameter_mm, "mm in its operation", *size->diameter);
    if (size->cutting_edge_length)
      same("the length of the flutes", c.maximum_depth_of_cut_mm, "mm in its operation",
           *size->cutting_edge_length);
  }

  const model::Plan& plan_;
  Findings& out_;
  Findings::Where at_;
};

/// Power is torque times speed.
void check_curve(const model::Plan& plan, const std::vector<model::SpindlePoint>& curve, Findings& out) {
  // Data sheets round both; a slip of a digit or of a unit is more. Default, unsourced.
  constexpr double kRounded = 0.05;
  for (const model::SpindlePoint& p : curve) {
    if (!std::isfinite(p.rpm) || !(p.torque_nm > 0.0) || !(p.power_w > 0.0)) continue;
    const double power = p.torque_nm * 2.0 * std::numbers::pi * p.rpm / 60.0;
    if (std::abs(power - p.power_w) <= kRounded * power) continue;
    out.error(1, "CHK-TWICE", {Findings::kWhole, "", -1},
              "machine '" + plan.machine.id + "': at " + plain(p.rpm) + " 1/min its curve states " +
                  plain(p.power_w) + " W, but " + plain(p.torque_nm) + " Nm are " + plain(power) +
                  " W: correct the one that is wrong");
  }
}

/// A step names its tool by its id: two tools of one id are one tool with two sizes.
void check_names(const model::Plan& plan, Findings& out) {
  std::map<std::string, const model::Cutter*> known;
  for (const model::Cutter& c : plan.cutters) {
    const auto [it, fresh] = known.emplace(c.id, &c);
    if (fresh) continue;
    const model::Cutter& other = *it->second;
    const std::string what = other.stick_out_mm != c.stick_out_mm
                                 ? "sticks out " + mm(other.stick_out_mm) + " in one place and " +
                                       mm(c.stick_out_mm) + " in another"
                                 : "is listed twice";
    out.error(1, "CHK-TWICE", {Findings::kWhole, "", -1},
              "tool '" + c.id + "' " + what + ": keep one of them, or give the other a name of its own");
  }
}

}  // namespace

void check_twice(const model::Plan& plan, Findings& findings) {
  check_names(plan, findings);
  Twice twice(plan, findings);
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) twice.step(plan.steps[i], i, ids[i]);
  check_curve(plan, plan.machine.spindle.curve, findings);
  for (const model::SpindleGear& g : plan.machine.spindle.gears) {
    check_curve(plan, g.curve, findings);
    check_curve(plan, g.curve_s6, findings);
  }
}

}  // namespace capstan::verify
