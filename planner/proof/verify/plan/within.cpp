#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/form/in_raw.h"

// Planned features against the raw piece, and holes against each other.

namespace capstan::verify {
namespace {

using model::AnyRef;
using model::ShapeKind;
using volumes::Form;
using volumes::kBeyondMm;

std::string where(geometry::Vec3 p) { return "(" + plain(p.x) + ", " + plain(p.y) + ", " + plain(p.z) + ")"; }

/// Why a feature cannot be made of this raw piece; empty when it can.
std::string not_within(const Form& s, const geometry::Box3& stock) {
  if (s.area.empty()) return {};
  const auto b = geometry::bounds(s.area);
  const geometry::Box3 raw = placed(stock, inverse(s.frame()));
  // Steps and outsides are drawn out over the edges of the piece.
  const bool over_edges = s.kind == ShapeKind::kStep || s.kind == ShapeKind::kOutside;
  if (!over_edges && (b.lo.x > raw.hi.x || b.hi.x < raw.lo.x || b.lo.y > raw.hi.y || b.hi.y < raw.lo.y ||
                      -s.depth_mm() > raw.hi.z || raw.lo.z > 0.0)) {
    return "lies wholly outside the raw piece";
  }
  const double deeper = raw.lo.z + s.depth_mm();
  if (!s.solid.through && deeper > kBeyondMm)
    return "ends " + mm(deeper) + " below the underside of the raw piece";
  return {};
}

/// Whether two holes with one axis direction cut into each other's wall.
bool overlap(const Form& a, const Form& b) {
  if (std::abs(std::abs(dot(a.frame().z, b.frame().z)) - 1.0) > 1e-9) return false;
  const geometry::Vec3 local = a.frame().to_local(b.frame().origin);
  const double apart = std::hypot(local.x, local.y);
  const double ra = a.bore()->top_radius_mm, rb = b.bore()->top_radius_mm;
  if (apart >= ra + rb - kBeyondMm || apart <= std::abs(ra - rb) + kBeyondMm) return false;
  const double end = local.z - b.depth_mm() * dot(a.frame().z, b.frame().z);
  return std::max(local.z, end) > -a.depth_mm() + kBeyondMm && std::min(local.z, end) < -kBeyondMm;
}

}  // namespace

void check_within(const model::Plan& plan, const PartShapes& part, Findings& findings) {
  if (plan.stock.box.empty()) return;
  struct Hole {
    const Form* shape;
    const Asked* asked;
  };
  std::vector<Hole> holes;
  const std::vector<Asked> asked = asked_of(plan);
  const volumes::Piece raw{plan.stock.box, plan.stock.cylinder_radius_mm};
  const volumes::Piece whole{part.part, plan.stock.cylinder_radius_mm};
  // The features alone do not tell how thick the part is below a hole.
  const model::Workpiece* piece = workpiece_of(plan);
  const bool stated = piece != nullptr && piece->its_bounding_geometry.set() && !plan.target_mesh;
  const volumes::Piece finished = stated ? whole : raw;
  std::vector<Form> all;
  for (const auto& e : part.entries) {
    if (!e.piece) all.insert(all.end(), e.shapes.begin(), e.shapes.end());
  }
  const auto drills = [&](AnyRef feature) {
    return std::any_of(plan.steps.begin(), plan.steps.end(), [&](const model::StepResult& s) {
      const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
      const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
      return ws != nullptr && c != nullptr && ws->its_feature == feature && sizes_hole(c->cutter_class);
    });
  };
  for (const Asked& a : asked) {
    const PartShapes::Entry* e = part.find(a.feature);
    if (e == nullptr) continue;
    for (const Form& s : e->shapes) {
      if (const std::string why = not_within(s, plan.stock.box); !why.empty()) {
        findings.error(37, "CHK-OUTSIDE", a.where,
                       "feature " + s.name + ", placed at " + where(s.frame().origin) +
                           " of the workpiece, " + why + " (" + where(plan.stock.box.lo) + " to " +
                           where(plan.stock.box.hi) + ")");
      }
      const std::string at =
          "feature " + s.name + ", placed at " + where(s.frame().origin) + " of the workpiece";
      if (const std::string why = volumes::floor_below_part(s, raw, finished); !why.empty())
        findings.error(37, "CHK-OUTSIDE", a.where, at + ": " + why);
      if (drills(a.feature)) {
        if (const std::string why = volumes::cuts_an_edge(s, raw); !why.empty())
          findings.error(37, "CHK-EDGE", a.where, at + ", is drilled, but " + why + "; mill it, or move it");
        if (const std::string why = volumes::point_runs_through(s, raw, finished); !why.empty())
          findings.error(37, "CHK-OUTSIDE", a.where, at + ": " + why);
      }
      double above = 0.0;
      if (!plan.target_mesh && !volumes::buried(s, {}, whole, above).empty()) {
        if (const std::string lid = volumes::buried(s, all, whole, above); !lid.empty())
          findings.error(37, "CHK-BURIED", a.where, at + ", is cut through what stands above it: " + lid,
                         above);
      }
      if (s.kind == ShapeKind::kHole || s.kind == ShapeKind::kThread) holes.push_back({&s, &a});
    }
  }
  for (std::size_t i = 0; i < holes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!overlap(*holes[i].shape, *holes[k].shape)) continue;
      // The one made last meets the other's wall on one side only.
      const Hole& last = holes[i].asked->where.order >= holes[k].asked->where.order ? holes[i] : holes[k];
      const Hole& first = &last == &holes[i] ? holes[k] : holes[i];
      if (!drills(last.asked->feature)) continue;
      findings.error(37, "CHK-OVERLAP", last.asked->where,
                     "hole " + last.shape->name + " at " + where(last.shape->frame().origin) +
                         " runs into the wall of " + first.shape->name + " at " +
                         where(first.shape->frame().origin) +
                         ": a drill is pushed aside there; mill one of them, or move it");
    }
  }
}

}  // namespace capstan::verify
