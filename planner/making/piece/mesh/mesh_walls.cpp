#include <algorithm>
#include <cmath>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/model/features/in_piece.h"
#include "rules/facts/passage.h"

// Limits of the upright walls of a mesh on the cutter: it must pass between them, and must leave no more in
// their inside corners than the check allows.
//
// For each level floor, and for the underside of the raw piece, the solid above that height is subtracted
// from a rectangle around the piece. The widest cutter that passes everywhere in the remaining area is found
// as for pockets.

namespace capstan::piece {
namespace {

/// Around the raw piece: what is as wide is no passage. Default, unsourced.
constexpr double kAroundMm = 60.0;
constexpr double kAboveMm = 0.01;  ///< a floor is not higher than itself
constexpr std::size_t kMostNamed = 4;

}  // namespace

double sharp_corner_of(const SurfaceForm& form) {
  double out = 0.0;
  for (const geometry::MeshCorner& c : form.sharp) {
    const double may_stay = model::unstated_corner_mm(c.high - c.low);
    out = out > 0.0 ? std::min(out, may_stay) : may_stay;
  }
  return out;
}

double passage_between(const geometry::Mesh& mesh, const SurfaceForm& form, const geometry::Box3& raw) {
  const geometry::Region around =
      geometry::offset_sharp(geometry::rectangle(geometry::xy(raw.lo), geometry::xy(raw.hi)), kAroundMm);
  std::vector<double> heights = form.floors_mm;
  if (form.curved && form.foot_mm) heights.push_back(*form.foot_mm);
  heights.push_back(std::min(raw.lo.z, geometry::bounds(mesh).lo.z));
  double out = 0.0;
  for (const double z : heights) {
    const geometry::Region solid = geometry::higher_than(mesh, form.inside_out, z + kAboveMm);
    if (solid.empty()) continue;
    const double here = rules::passage_of(geometry::subtract(around, solid), false).narrowest_mm;
    if (here > 0.0 && here < kAroundMm - kAboveMm) out = out > 0.0 ? std::min(out, here) : here;
  }
  return out;
}

void tell_mesh_corners(const model::Plan& plan, const std::vector<draft::StepDraft>& steps, Job& job) {
  if (!plan.target_mesh) return;
  double radius = 1e300;
  for (const model::StepResult& made : plan.steps) {
    for (const draft::StepDraft& step : steps) {
      const bool levels = step.step == made.step && draft::cuts_levels(plan.model, step);
      if (levels) radius = std::min(radius, 0.5 * step.cutter.cutting_diameter_mm);
    }
  }
  if (radius > 1e299) return;
  std::string where;
  std::size_t count = 0;
  for (const geometry::MeshCorner& c : surface_form(*plan.target_mesh, plan.stock.box).sharp) {
    if (++count > kMostNamed) continue;
    where += (where.empty() ? "(" : ", (") + trimmed(c.at.x, 2) + ", " + trimmed(c.at.y, 2) + ", " +
             trimmed(c.high, 2) + ")";
  }
  if (count == 0) return;
  if (count > kMostNamed) where += ", and " + std::to_string(count - kMostNamed) + " more";
  job.warn("PIP-CORNER", std::string("the surface: its inner corner") + (count == 1 ? "" : "s") + " at " +
                             where + (count == 1 ? " is" : " are") + " drawn sharp, and a radius of " +
                             trimmed(radius, 3) +
                             " mm, that of the narrowest mill, stays; broach or erode what must be sharp");
}

}  // namespace capstan::piece
