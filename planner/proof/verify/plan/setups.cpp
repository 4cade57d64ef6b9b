#include "planner/proof/verify/plan/setups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/nouns.h"

// How set-ups hold the workpiece, by an own reading of SETUP and WORKPIECE_SETUP. A tool stands along Z of
// the program: what is cut in a set-up has its axis there, or is open at both ends and has it upside down.

namespace capstan::verify {
namespace {

using geometry::Placement;
using model::ShapeKind;

constexpr double kUpright = 1.0 - 1e-9;

double degrees_off(const Placement& at) {
  return std::atan2(std::hypot(at.z.x, at.z.y), at.z.z) * 180.0 / std::numbers::pi;
}

bool any_direction(ShapeKind kind) { return kind == ShapeKind::kFreeform || kind == ShapeKind::kToolpath; }

/// Whether a tool along Z can cut it.
bool reached(const volumes::Form& f, const Placement& at) {
  return any_direction(f.kind) || at.z.z >= kUpright || (f.solid.through && at.z.z <= -kUpright);
}

std::string name_of(const model::Setup& s) { return "SETUP '" + s.its_id.value_or("") + "'"; }

/// By what the workpiece stands as it does, for a message.
std::string placed_by(const model::Plan& plan, const model::Setup& s) {
  std::string out;
  const auto add = [&](const std::optional<Placement>& frame, const char* attribute) {
    if (!frame || frame->z.z >= kUpright) return;
    out += (out.empty() ? "" : " and ") + std::string(attribute) + " leans by " +
           trimmed(degrees_off(*frame), 4) + " degrees";
  };
  add(turn_of(plan.model, s), "SETUP.its_origin");
  if (const auto* piece = piece_of(plan, s))
    add(volumes::frame_or_same(plan.model, piece->its_origin), "WORKPIECE_SETUP.its_origin");
  return out.empty() ? out : " (" + out + ")";
}

/// Placements that are none, and offsets that no program of a plan adds.
void check_nouns(const model::Plan& plan, const model::Setup& s, const Findings::Where& at,
                 Findings& findings) {
  const auto unread = [&](const char* attribute) {
    findings.error(3, "CHK-SETUP", at,
                   name_of(s) + ": " + attribute +
                       " is no placement, so that nobody knows how the workpiece lies; correct it");
  };
  if (!turn_of(plan.model, s)) unread("its_origin");
  const auto* piece = piece_of(plan, s);
  if (piece == nullptr) return;
  if (!volumes::frame_or_same(plan.model, piece->its_origin)) unread("WORKPIECE_SETUP.its_origin");
  if (piece->its_offset.set())
    findings.warn(3, "CHK-SETUP-OFFSET", at,
                  name_of(s) +
                      ": WORKPIECE_SETUP.its_offset shifts or turns the workpiece by variables of the "
                      "control, and neither plan nor program does; set the work offset by it");
}

}  // namespace

void check_setups(const model::Plan& plan, const PartShapes& part, Findings& findings) {
  std::set<std::size_t> seen;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& step = plan.steps[i];
    if (step.setup >= plan.setups.size()) continue;
    const auto* s = plan.model.get<model::Setup>(plan.setups[step.setup].setup);
    if (s == nullptr) continue;
    const Findings::Where at{i + 1, model::step_id(plan, step), -1};
    if (seen.insert(step.setup).second) check_nouns(plan, *s, at, findings);
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
    const PartShapes::Entry* e = ws == nullptr ? nullptr : part.find(ws->its_feature);
    if (e == nullptr || e->shapes.empty() || step.path == nullptr) continue;
    const Placement here = workpiece_in(plan, step.setup);
    double least = 180.0;
    bool any = false;
    for (const volumes::Form& f : e->shapes) {
      const Placement there = compose(here, f.frame());
      any = any || reached(f, there);
      least = std::min(least, degrees_off(there));
    }
    if (any) continue;
    findings.error(11, "CHK-SETUP-LEANS", at,
                   "the axis of feature '" + e->shapes.front().name + "' leans " + trimmed(least, 4) +
                       " degrees from the tool's in " + name_of(*s) + placed_by(plan, *s) +
                       ": a tool along Z cannot cut it so; correct the placement, or cut it in a set-up in "
                       "which that axis is up",
                   least);
  }
}

}  // namespace capstan::verify
