#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/physics/mechanics/holding_constants.h"
#include "planner/proof/verify/plan/plan_checks.h"

// What holds the piece, judged as it is described: solids in one place, a clamp alone, too little force.

namespace capstan::verify {
namespace {

using geometry::Vec2;
using model::FixtureSolid;

constexpr double kTouchMm = 0.05;         // solids may touch this deep; default, unsourced
constexpr std::size_t kMostSolids = 500;  // compared pair by pair

bool convex(const FixtureSolid& s) {
  const auto& o = s.outline;
  if (o.size() < 3) return false;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const Vec2 a = o[(i + 1) % o.size()] - o[i], b = o[(i + 2) % o.size()] - o[(i + 1) % o.size()];
    if (a.x * b.y - a.y * b.x < -1e-9) return false;
  }
  return true;
}

/// How far one outline would have to be moved square to the other's sides to leave it; convex ones.
double depth_across(const FixtureSolid& a, const FixtureSolid& b) {
  double least = 1e300;
  for (std::size_t i = 0; i < a.outline.size(); ++i) {
    const Vec2 side = a.outline[(i + 1) % a.outline.size()] - a.outline[i];
    const double length = norm(side);
    if (!(length > 0.0)) continue;
    const Vec2 out{side.y / length, -side.x / length};
    double nearest = 1e300;
    for (const Vec2 p : b.outline)
      nearest = std::min(nearest, (p.x - a.outline[i].x) * out.x + (p.y - a.outline[i].y) * out.y);
    least = std::min(least, -nearest);
  }
  return least;
}

double overlap(const FixtureSolid& a, const FixtureSolid& b) {
  const double height = std::min(a.top_mm, b.top_mm) - std::max(a.bottom_mm, b.bottom_mm);
  return std::min({height, depth_across(a, b), depth_across(b, a)});
}

/// "clamp 1" of "clamp 1.bolt": the parts of one device may reach into each other.
std::string device(const FixtureSolid& s) { return s.id.substr(0, s.id.find('.')); }

bool grips(const FixtureSolid& s) { return s.presses || s.kind == "clamp"; }

void check_overlap(const model::Workholding& h, const Findings::Where& at, Findings& findings) {
  std::vector<const FixtureSolid*> solids;
  for (const FixtureSolid& s : h.solids) {
    if (grips(s) && convex(s) && solids.size() < kMostSolids) solids.push_back(&s);
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t k = i + 1; k < solids.size(); ++k) {
      const FixtureSolid &a = *solids[i], &b = *solids[k];
      if (device(a) == device(b) && !(a.presses && b.presses)) continue;
      const double deep = overlap(a, b);
      if (deep > kTouchMm)
        findings.error(31, "CHK-HOLD-OVERLAP", at,
                       "'" + a.id + "' and '" + b.id + "' of '" + h.id + "' are in the same place, " +
                           mm(deep) + " into each other: move one of them",
                       deep);
    }
  }
}

void check_alone(const model::Workholding& h, const Findings::Where& at, Findings& findings) {
  const FixtureSolid* only = nullptr;
  for (const FixtureSolid& s : h.solids) {
    if (!s.presses) continue;
    if (only != nullptr) return;
    only = &s;
  }
  if (only == nullptr || only->kind != "clamp") return;
  findings.warn(31, "CHK-HOLD-ALONE", at,
                "'" + only->id + "' of '" + h.id +
                    "' alone holds the piece, which may turn under it: add a second clamp");
}

/// The thrust of a drill goes down into the table, not along it.
bool drills(const model::StepResult& s) {
  if (!s.path) return false;
  return std::any_of(s.path->role.begin(), s.path->role.end(), [](model::MoveRole r) {
    return r == model::MoveRole::kDrill || r == model::MoveRole::kTap;
  });
}

}  // namespace

void check_holding(const model::Plan& plan, Findings& findings) {
  for (std::size_t n = 0; n < plan.setups.size(); ++n) {
    const model::Workholding& h = plan.setups[n].holding;
    const model::StepResult *first = nullptr, *heaviest = nullptr;
    std::size_t first_at = 0, heaviest_at = 0;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const model::StepResult& s = plan.steps[i];
      if (s.setup != n) continue;
      if (first == nullptr) {
        first = &s;
        first_at = i;
      }
      if (drills(s) || (heaviest != nullptr && !(s.loads.peak_force_n > heaviest->loads.peak_force_n)))
        continue;
      heaviest = &s;
      heaviest_at = i;
    }
    if (first == nullptr) continue;
    const Findings::Where at{first_at + 1, model::step_id(plan, *first), -1};
    check_overlap(h, at, findings);
    check_alone(h, at, findings);
    if (heaviest == nullptr || !(h.holding_force_n > 0.0)) continue;
    const double needed = mechanics::kHoldingForceSafety * heaviest->loads.peak_force_n;
    if (needed > h.holding_force_n)
      findings.warn(31, "CHK-HOLD-FORCE", {heaviest_at + 1, model::step_id(plan, *heaviest), -1},
                    "the step cuts with up to " + plain(heaviest->loads.peak_force_n) + " N; '" + h.id +
                        "' holds with " + plain(h.holding_force_n) + " N against sliding, less than " +
                        plain(mechanics::kHoldingForceSafety) +
                        " times that (default): cut less, or hold it with more",
                    needed);
  }
}

}  // namespace capstan::verify
