#include "planner/making/given/tool_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "tooling/library/cutters/complete.h"

namespace capstan::given {
namespace {

using model::AnyRef;
using model::Cutter;

/// The spindle speed that the file itself gives in a technology, 1/min; 0: none, or planning chose it.
double given_rpm(const model::Plan& plan, AnyRef technology, double diameter_mm) {
  const auto* t = plan.model.get<model::MillingTechnology>(technology);
  if (t == nullptr) return 0.0;
  const auto given = [&](const char* attribute) {
    return !model::by_planning(plan.ledger.find(technology, attribute));
  };
  // Of both the spindle's is used, as reading says.
  if (t->spindle && (given("spindle") || (t->cutspeed && given("cutspeed")))) return std::abs(*t->spindle);
  if (t->cutspeed && given("cutspeed") && diameter_mm > 0.0)
    return std::abs(*t->cutspeed) / (std::numbers::pi * diameter_mm);
  return 0.0;
}

/// The fastest that the file gives to an operation with this tool, m/min; 0: it gives none.
double given_speed(const model::Plan& plan, AnyRef tool, double diameter_mm) {
  double rpm = 0.0;
  for (const AnyRef r : plan.model.all_below(model::TypeId::kMachiningOperation)) {
    const auto* op = plan.model.get<model::MachiningOperation>(r);
    if (op == nullptr || AnyRef(op->its_tool) != tool) continue;
    rpm = std::max(rpm, given_rpm(plan, op->its_technology, diameter_mm));
  }
  return std::numbers::pi * diameter_mm * rpm / 1000.0;
}

}  // namespace

tooling::ToolMaterialHints hints_of(const model::Plan& plan, const draft::StepDraft& step,
                                    const Cutter& cutter, const std::vector<Cutter>& library,
                                    const ToolMaterialWish& wish) {
  tooling::ToolMaterialHints out;
  out.material = &plan.material;
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op != nullptr) out.vc_m_min = given_speed(plan, op->its_tool, cutter.cutting_diameter_mm);
  if (const Cutter* loaded = stating_material(library, cutter)) {
    out.settled = loaded->substrate;
    out.settled_by = "stated: of the loaded tool T" + std::to_string(loaded->pocket);
    return out;
  }
  if (wish.assumed) {
    out.settled = wish.assumed;
    out.settled_by = tooling::settled_source(wish.assumed_by);
    return out;
  }
  // Of two tools that the file gives one name, the second is called "name~2": which of them this is, the name
  // does not say.
  const bool twins = std::any_of(wish.of_plan.begin(), wish.of_plan.end(),
                                 [&](const auto& a) { return a.tool.starts_with(cutter.id + "~"); });
  for (const model::AssumedToolMaterial& a : wish.of_plan) {
    if (a.settled || twins || a.tool != cutter.id) continue;
    out.settled = a.substrate;
    out.settled_by = tooling::assumed_source(a.substrate, a.why);
  }
  return out;
}

void assume_materials(std::vector<Cutter>& library, const ToolMaterialWish& wish) {
  if (!wish.assumed) return;
  for (Cutter& c : library) {
    if (!tooling::material_is_assumed(c)) continue;
    c.substrate = *wish.assumed;
    for (auto& [field, source] : c.sources) {
      if (field == "substrate") source = tooling::settled_source(wish.assumed_by);
    }
  }
}

std::vector<model::Provenance> assumed_materials_of(const model::Plan& plan, Job& job) {
  std::vector<model::Provenance> out;
  std::array<std::string, 2> taken;  // by Substrate
  std::size_t count = 0;
  for (const Cutter& c : plan.cutters) {
    if (c.cutter_class == model::CutterClass::kTouchProbe || !tooling::material_is_assumed(c)) continue;
    const std::string why = tooling::reason_of_source(*tooling::source_of(c, "substrate"));
    const bool settled = !tooling::material_is_open(c);
    out.push_back(model::provenance_of({c.id, c.substrate, why, settled}));
    if (settled) continue;
    std::string& names = taken.at(static_cast<std::size_t>(c.substrate));
    names += (names.empty() ? "'" : "; '") + c.id + "': " + why;
    ++count;
  }
  if (count == 0) return out;
  std::string told;
  for (const auto s : {model::Substrate::kCarbide, model::Substrate::kHss}) {
    const std::string& names = taken.at(static_cast<std::size_t>(s));
    if (!names.empty())
      told += (told.empty() ? "" : ". Taken as ") + std::string(model::to_text(s)) + ": " + names;
  }
  // Carbide that is assumed may break a tool; HSS only costs time.
  const bool risky = !taken.at(static_cast<std::size_t>(model::Substrate::kCarbide)).empty();
  job.report({.code = "PIP-TOOL-MATERIAL",
              .severity = risky ? Severity::kWarning : Severity::kNote,
              .message = "nobody states what " +
                         (count == 1 ? std::string("one tool is") : std::to_string(count) + " tools are") +
                         " made of. Taken as " + told +
                         ". HSS at the speed of carbide burns, and carbide at that of HSS costs hours",
              .file = plan.file_name,
              .hint = "settle it with --assume tool-material=carbide or tool-material=hss, or state "
                      "its_material of the cutting edge, or the material in the list of tools"});
  return out;
}

}  // namespace capstan::given
