#include <algorithm>
#include <cmath>
#include <map>

#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify {
namespace {

constexpr double kEqualMm = 1e-6;

bool known_offset(const model::Machine& machine, const std::string& name) {
  const auto known = work_offsets_of(machine.control.dialect);
  return std::find(known.begin(), known.end(), name) != known.end();
}

void check_cutter(const model::Plan& plan, const model::Cutter& c, Findings& findings) {
  const Findings::Where whole{0, "", -1};
  for (const double v : {c.cutting_diameter_mm, c.corner_radius_mm, c.point_angle_rad,
                         c.maximum_depth_of_cut_mm, c.stick_out_mm, c.functional_length_mm}) {
    if (!std::isfinite(v))
      findings.error(1, "CHK-NUMBER", whole,
                     "tool " + c.id + " has a size that is no number: correct it in the tool library");
  }
  if (!(c.cutting_diameter_mm > 0.0))
    findings.error(4, "CHK-TOOL", whole,
                   "tool " + c.id + " has no cutting diameter: state it in the tool library");
  const int pockets = plan.machine.magazine_pockets;
  // One pocket is the spindle itself: tools are changed by hand, and numbers are free.
  const int at = model::magazine_pocket(c);
  if (c.pocket <= 0 || (pockets > 1 && at > pockets)) {
    findings.error(4, "CHK-TOOL", whole,
                   "tool " + c.id + " is in pocket " + std::to_string(at) + "; the magazine has " +
                       std::to_string(pockets) + ": load it into one of these");
  }
  const double longest = plan.machine.tool_length_max_mm;
  if (longest > 0.0 && c.functional_length_mm > longest) {
    findings.error(6, "CHK-TOOL-LENGTH", whole,
                   "tool " + c.id + " is " + mm(c.functional_length_mm) + " long; the machine takes " +
                       mm(longest) + " at most: check the unit of its length");
  }
  if (c.functional_length_mm > 0.0 && c.stick_out_mm > c.functional_length_mm + kEqualMm) {
    findings.error(6, "CHK-TOOL-LENGTH", whole,
                   "tool " + c.id + " sticks out " + mm(c.stick_out_mm) +
                       ", more than its whole length from the gage " + "line, " + mm(c.functional_length_mm) +
                       ": check the unit of its length");
  }
}

}  // namespace

void check_tools(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings) {
  const Findings::Where whole{0, "", -1};
  const DialectReader* reader = reader_of(plan.machine.control.dialect);
  const ControlWords words = reader != nullptr ? reader->words : ControlWords{};
  std::map<int, std::string> pockets;
  std::map<int, const model::Cutter*> places;
  for (const model::Cutter& c : plan.cutters) {
    check_cutter(plan, c, findings);
    // One pocket of the magazine holds one tool, whatever its number.
    const int place = model::magazine_pocket(c);
    const auto [held, free] = places.emplace(place, &c);
    if (!free && place > 0 && plan.machine.magazine_pockets > 1 && held->second->pocket != c.pocket) {
      findings.error(4, "CHK-TOOL", whole,
                     "tools " + held->second->id + " and " + c.id + " are both in pocket " +
                         std::to_string(place) + " of the magazine: give one of them another P");
    }
    const auto [it, fresh] = pockets.emplace(c.pocket, c.id);
    if (!fresh && c.pocket > 0) {
      findings.error(5, "CHK-TOOL-NUMBER", whole,
                     "tools " + it->second + " and " + c.id + " share number " + std::to_string(c.pocket) +
                         ", and with it one length offset: give one of them another");
    }
  }
  for (std::size_t i = 0; i < plan.setups.size(); ++i) {
    if (!known_offset(plan.machine, plan.setups[i].work_offset)) {
      findings.error(3, "CHK-WORK-OFFSET", whole,
                     "set-up " + std::to_string(i + 1) + " has the work offset \"" +
                         plan.setups[i].work_offset + "\", which no control has");
    }
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StepMoves& s = steps[i];
    const Findings::Where at{s.order + 1, s.id, -1};
    if (s.cutter == nullptr)
      findings.error(
          4, "CHK-TOOL", at,
          "its tool \"" + s.planned->cutter_id + "\" is not among the plan's tools: plan it again");
    else if (const std::string fault = model::offset_fault(*s.cutter); !fault.empty())
      findings.error(6, "CHK-TOOL-OFFSET", at,
                     fault + ", and " + length_of(words, s.cutter->pocket) +
                         " would take that for its length: measure it and enter its length");
    if (s.setup >= plan.setups.size()) {
      findings.error(3, "CHK-WORK-OFFSET", at, "its set-up is not among the plan's: plan it again");
      continue;
    }
    const double security = plan.setups[s.setup].security_z_mm;
    const bool last = i + 1 == steps.size();
    const bool changes = !last && (steps[i + 1].cutter != s.cutter || steps[i + 1].setup != s.setup);
    const Move& end = s.moves.back();
    if (end.to.z < security - kEqualMm && (last || changes)) {
      const std::string text =
          "the path ends at z = " + plain(end.to.z) + ", below the security plane at " + plain(security);
      if (last) findings.error(32, "CHK-END", {s.order + 1, s.id, end.where}, text);
      if (changes)
        findings.error(7, "CHK-TOOL-CHANGE", {s.order + 1, s.id, end.where}, text + ", before a tool change");
    }
    const Move& first = s.moves.front();
    const bool after_change = i == 0 || steps[i - 1].cutter != s.cutter || steps[i - 1].setup != s.setup;
    if (after_change && first.to.z < security - kEqualMm) {
      findings.error(8, "CHK-START", {s.order + 1, s.id, 0},
                     "the path starts at z = " + plain(first.to.z) + ", below the security plane at " +
                         plain(security) + ", where the length offset must act already");
    }
    // The link to the next path of the same tool crosses at the security plane only from there.
    if (!last && !changes && end.to.z < security - kEqualMm) {
      const Move& next = steps[i + 1].moves.front();
      if (norm(xy(next.to) - xy(end.to)) > kEqualMm) {
        findings.error(9, "CHK-LINK", {s.order + 1, s.id, end.where},
                       "the path ends at z = " + plain(end.to.z) + ", below the security plane at " +
                           plain(security) + ", and the next one starts elsewhere");
      }
    }
  }
}

/// An edge of HSS at the speed of carbide burns within seconds, and breaks. That a tool is HSS may be wrong,
/// too, but harms nothing.
void check_tool_materials(const model::Plan& plan, Findings& findings) {
  std::string tools;
  for (const model::AssumedToolMaterial& a : model::assumed_tool_materials(plan)) {
    const model::Cutter* c = model::find_cutter(plan, a.tool);
    if (a.settled || c == nullptr || c->substrate != model::Substrate::kCarbide) continue;
    tools += (tools.empty() ? "" : ", ") + ("'" + a.tool) + "' (T" + std::to_string(c->pocket) + ")";
  }
  if (tools.empty()) return;
  findings.warn(16, "CHK-TOOL-MATERIAL", {Findings::kWhole, "", -1},
                "that these tools are carbide is assumed, and speeds and stiffness are of carbide: " + tools +
                    "; look at them before the program runs; --assume tool-material=carbide or =hss settles "
                    "it");
}

}  // namespace capstan::verify
