#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/mesh/mesh_corners.h"
#include "planner/ground/geometry/mesh/mesh_creases.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/model/features/in_piece.h"

// Concave places of a surface, and the ball that they let in.
//
// In a crease of angle d between two facets, a ball of radius R leaves R (1 / cos(d / 2) - 1). Facets too
// narrow for the ball to touch both beside their crease approximate a curve of radius width / d. Source
// derived.

namespace capstan::piece {
namespace {

/// Largest height that a ball may leave in a crease, as the check allows it; default, unsourced.
constexpr double kCreaseMm = 0.02;
/// Radius: below, planning takes smaller cutters than shops use; default, unsourced.
constexpr double kLeastMm = 1.0;

/// What a ball of this radius leaves in a crease, mm.
double left_in(const geometry::MeshCrease& c, double ball_mm) {
  return ball_mm * (1.0 / std::cos(0.5 * c.turn_rad) - 1.0);
}

/// The radius that may stay in a crease that states none; `top_mm`: the height of the mesh.
double may_stay_in(const geometry::MeshCrease& c, double top_mm) {
  return model::unstated_corner_mm(top_mm - std::min(c.a.z, c.b.z));
}

}  // namespace

double surface_radius(const geometry::Mesh& mesh) {
  const double top = geometry::bounds(mesh).hi.z;
  double out = 0.0;
  for (const geometry::MeshCrease& c : geometry::creases(mesh)) {
    const double may_stay = may_stay_in(c, top);
    const double of_crease = kCreaseMm / left_in(c, 1.0), curve = c.curve_mm();
    const double limit =
        std::max(kLeastMm, std::min(curve, curve < may_stay ? of_crease : std::max(of_crease, may_stay)));
    out = out > 0.0 ? std::min(out, limit) : limit;
  }
  return out;
}

std::optional<double> lowest_seen_mm(const geometry::Mesh& mesh, const geometry::Placement& frame) {
  // A closed mesh has as many facets that face up as down; which these are, the sign of its volume says.
  double volume = 0.0;
  bool up = false, down = false;
  const auto normal_of = [&](const std::array<std::uint32_t, 3>& t) {
    const geometry::Vec3 a = mesh.vertices[t[0]];
    return cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
  };
  const geometry::Vec3 middle = mesh.vertices.empty() ? geometry::Vec3{} : mesh.vertices.front();
  for (const auto& t : mesh.triangles) {
    const geometry::Vec3 n = normal_of(t);
    volume += dot(n, mesh.vertices[t[0]] - middle);
    const double z = dot(n, frame.z), least = geometry::kUprightNormal * norm(n);
    up = up || z > least;
    down = down || z < -least;
  }
  const double side = volume < 0.0 ? -1.0 : 1.0;
  std::optional<double> out;
  for (const auto& t : mesh.triangles) {
    const geometry::Vec3 n = normal_of(t);
    const double z = dot(n, frame.z), least = geometry::kUprightNormal * norm(n);
    if (std::abs(z) <= least || (up && down && side * z < 0.0)) continue;
    for (const std::uint32_t v : t) {
      const double here = frame.to_local(mesh.vertices[v]).z;
      out = std::min(out.value_or(here), here);
    }
  }
  return out;
}

double last_ball_mm(const model::Plan& plan, const std::vector<draft::StepDraft>& steps) {
  double out = 0.0;
  for (const draft::StepDraft& step : steps) {
    const bool made = std::any_of(plan.steps.begin(), plan.steps.end(),
                                  [&](const model::StepResult& r) { return r.step == step.step; });
    if (made && plan.model.holds<model::FreeformFinishMilling>(step.operation) &&
        model::has(step.cutter.cutter_class, model::CutterTrait::kBall))
      out = model::end_radius_mm(step.cutter);
  }
  return out;
}

void tell_mesh_creases(const model::Plan& plan, const std::vector<draft::StepDraft>& steps, Job& job) {
  if (!plan.target_mesh) return;
  const double radius = last_ball_mm(plan, steps);
  if (!(radius > 0.0)) return;
  const double top = geometry::bounds(*plan.target_mesh).hi.z;
  double length = 0.0, most = 0.0;
  geometry::Vec3 at;
  for (const geometry::MeshCrease& c : geometry::creases(*plan.target_mesh)) {
    const double left = left_in(c, radius);
    if (c.curve_mm() < may_stay_in(c, top) || left <= kCreaseMm) continue;
    length += norm(c.b - c.a);
    if (left <= most) continue;
    most = left;
    at = 0.5 * (c.a + c.b);
  }
  if (!(length > 0.0)) return;
  job.warn("PIP-CREASE", "the surface: " + trimmed(length, 1) +
                             " mm of its inside creases are drawn sharp, and a radius of " +
                             trimmed(radius, 3) + " mm, that of the last ball, stays: up to " +
                             trimmed(most, 3) + " mm high at (" + trimmed(at.x, 2) + ", " + trimmed(at.y, 2) +
                             ", " + trimmed(at.z, 2) +
                             "); draw the radius that they shall have, or erode what must be sharp");
}

}  // namespace capstan::piece
