#include <algorithm>
#include <map>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/plan/plan_checks.h"

namespace capstan::verify {
namespace {

const model::MillingMachineFunctions* functions_of(const model::Plan& plan, const StepMoves& step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.planned->step);
  const auto* op = ws != nullptr ? plan.model.get<model::MachiningOperation>(ws->its_operation) : nullptr;
  return op != nullptr ? plan.model.get<model::MillingMachineFunctions>(op->its_machine_functions) : nullptr;
}

}  // namespace

void check_coolant(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings) {
  for (const StepMoves& s : steps) {
    if (s.planned == nullptr) continue;
    const Findings::Where at{s.order + 1, s.id, -1};
    const auto& p = *s.planned;
    if (const auto* f = functions_of(plan, s)) {
      const auto asked = [&](bool wanted, bool on, const char* what) {
        if (wanted && !on)
          findings.error(
              29, "CHK-COOLANT", at,
              "its operation asks for " + std::string(what) + ", which the step has off: switch it on");
      };
      asked(f->coolant.value_or(false), p.flood, "flood coolant");
      asked(f->mist.value_or(false), p.mist, "mist");
      asked(f->through_spindle_coolant.value_or(false), p.through, "coolant through the spindle");
    }
    const auto lacks = [&](bool on, bool has, const char* what) {
      if (on && !has)
        findings.error(29, "CHK-COOLANT-MACHINE", at,
                       "the step cuts with " + std::string(what) + "; machine '" + plan.machine.id +
                           "' has none: switch it off, or use another machine");
    };
    lacks(p.flood, plan.machine.has_flood, "flood coolant");
    lacks(p.mist, plan.machine.has_mist, "mist");
    lacks(p.through, plan.machine.has_through, "coolant through the spindle");
    if (p.through && s.cutter != nullptr && !s.cutter->coolant_through)
      findings.warn(29, "CHK-COOLANT-TOOL", at,
                    "the step cuts with coolant through the spindle; tool " + s.cutter->id +
                        " has no channel for it: use one that has, or flood");
  }
}

void check_life(const std::vector<StepMoves>& steps, Findings& findings) {
  std::map<std::string, double> minutes;
  std::map<std::string, bool> said;
  for (const StepMoves& s : steps) {
    if (s.cutter == nullptr || !(s.cutter->life_min > 0.0)) continue;
    double& sum = minutes[s.cutter->id];
    for (const Move& m : s.moves) {
      if (m.kind == model::MoveKind::kRapid || !(m.feed_mm_min > 0.0)) continue;
      const double length = length_of(m);
      if (length < 1e5) sum += length / m.feed_mm_min;  // heights that are not known say nothing
    }
    double left = s.cutter->life_min - s.cutter->life_used_min;
    std::string sisters;
    for (const auto& sister : s.cutter->sisters) {
      left += std::max(0.0, sister.life_left_min);  // a worn sister takes nothing from the others
      sisters += (sisters.empty() ? "; sister tools: " : ", ") + sister.id + " " +
                 plain(sister.life_left_min) + " min";
    }
    if (sum <= left + 1e-6 || said[s.cutter->id]) continue;
    said[s.cutter->id] = true;
    double whole = 0.0;
    for (const StepMoves& other : steps) {
      if (other.cutter != s.cutter) continue;
      for (const Move& m : other.moves) {
        if (m.kind != model::MoveKind::kRapid && m.feed_mm_min > 0.0 && length_of(m) < 1e5)
          whole += length_of(m) / m.feed_mm_min;
      }
    }
    findings.error(30, "CHK-TOOL-LIFE", {s.order + 1, s.id, -1},
                   "tool " + s.cutter->id + " runs out of life in this step: it cuts " + plain(whole) +
                       " min in all; " + plain(left) + " min are left (" + plain(s.cutter->life_used_min) +
                       " of " + plain(s.cutter->life_min) + " min used" + sisters +
                       "): change its edges, or load another");
  }
}

}  // namespace capstan::verify
