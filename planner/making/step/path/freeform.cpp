#include "planner/making/step/path/freeform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/making/piece/mesh/rim.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/making/step/path/surface_rest.h"
#include "planner/making/toolpath/freeform/freeform.h"

namespace capstan::step {
namespace {

using draft::StepDraft;
using piece::SurfaceForm;

constexpr double kScallopMm = 0.01;        // where the file states no scallop height; default, unsourced
constexpr double kChordMm = 0.01;          // where the file states no chordal tolerance; default, unsourced
constexpr double kRoughAllowanceMm = 0.5;  // left by roughing when no rule says otherwise; default, unsourced
constexpr double kSemiAllowanceMm = 0.2;   // left by a semi-finish, likewise; default, unsourced

/// How much deeper than what was left for it a step that finishes a surface may bite: a last ball that is
/// left 0.2 mm then meets 0.4 mm at most. Default, unsourced.
constexpr double kMostBite = 2.0;
constexpr double kLevelStep = 0.5;  // of the diameter, over a level floor; default, unsourced

/// Height of the ridges that a freeform operation may leave.
double scallop_of(const model::Model& m, model::AnyRef operation) {
  const auto* op = m.get<model::FreeformOperation>(operation);
  const auto* s = op != nullptr ? m.get<model::FreeformStrategy>(op->its_machining_strategy) : nullptr;
  const auto* t = s != nullptr ? m.get<model::Tolerances>(s->its_milling_tolerances) : nullptr;
  return t != nullptr ? t->scallop_height.value_or(kScallopMm) : kScallopMm;
}

/// Where the axis of a finishing cutter may go: as far beyond the mesh as a slope that falls to its rim
/// needs, on those sides where no material of the raw piece stands, or it has been cut away.
geometry::Region over_its_rim(const geometry::Mesh& mesh, const model::Cutter& c, const geometry::Box3& raw,
                              bool beside_is_cut, double scallop_mm) {
  constexpr double kSameMm = 0.02;  // of coordinates, as SurfaceForm has it; default, unsourced
  const double radius = 0.5 * c.cutting_diameter_mm;
  geometry::Box2 out = piece::box_of_axis(mesh, radius, model::end_radius_mm(c), scallop_mm);
  const geometry::Box3 own = geometry::bounds(mesh);
  if (!beside_is_cut) {
    if (raw.lo.x < own.lo.x - kSameMm) out.lo.x = own.lo.x;
    if (raw.lo.y < own.lo.y - kSameMm) out.lo.y = own.lo.y;
    if (raw.hi.x > own.hi.x + kSameMm) out.hi.x = own.hi.x;
    if (raw.hi.y > own.hi.y + kSameMm) out.hi.y = own.hi.y;
  }
  return geometry::rectangle(out.lo, out.hi);
}

/// Distance between passes over level ground of a mill with a corner that leaves cusps no higher than this.
/// Source  derived: two equal circles, as scallop_stepover.
double low_cusps_mm(const model::Cutter& c, double cusp_mm) {
  const double r = model::end_radius_mm(c);
  const double h = std::min(cusp_mm, r);
  return c.cutting_diameter_mm - 2.0 * r + 2.0 * std::sqrt(h * (2.0 * r - h));
}

/// The first finish of the same feature after a step that `f` holds for; null: there is none.
template <class F>
const StepDraft* finish_after(const model::Model& m, const std::vector<StepDraft>& steps,
                              const StepDraft& step, const F& f) {
  auto at = std::find_if(steps.begin(), steps.end(), [&](const StepDraft& s) { return s.step == step.step; });
  if (at == steps.end()) return nullptr;
  at = std::find_if(at + 1, steps.end(), [&](const StepDraft& s) {
    return s.feature == step.feature && m.holds<model::FreeformFinishMilling>(s.operation) && f(s);
  });
  return at != steps.end() ? &*at : nullptr;
}

}  // namespace

// The nouns of a freeform operation have no place for it: of one that was read, that it is not the last says
// so. A finish is a semi-finish when a finer one of the same feature follows.
double freeform_allowance(const model::Model& m, const std::vector<StepDraft>& steps, const StepDraft& step) {
  if (!m.holds<model::FreeformOperation>(step.operation)) return 0.0;
  if (step.proposed) return step.proposal.allowance_side_mm;
  if (m.holds<model::FreeformRoughMilling>(step.operation)) return kRoughAllowanceMm;
  const double own = scallop_of(m, step.operation);
  const auto* finer =
      finish_after(m, steps, step, [&](const StepDraft& s) { return scallop_of(m, s.operation) < own; });
  return finer != nullptr ? kSemiAllowanceMm : 0.0;
}

std::optional<double> left_by_next_mm(const PlanSoFar& p, const StepDraft& step) {
  const model::Model& m = p.plan.model;
  const auto* next = finish_after(m, p.steps, step, [](const StepDraft&) { return true; });
  if (next == nullptr) return std::nullopt;
  return freeform_allowance(m, p.steps, *next);
}

geometry::Mesh mesh_in_setup(const PlanSoFar& p, std::size_t setup) {
  geometry::Mesh out = *p.plan.target_mesh;
  for (geometry::Vec3& v : out.vertices) v = p.setups[setup].workpiece.to_parent(v);
  return out;
}

std::optional<double> most_for_next_mm(const PlanSoFar& p, const StepDraft& step) {
  const auto next = left_by_next_mm(p, step);
  if (!next) return std::nullopt;
  return kMostBite * freeform_allowance(p.plan.model, p.steps, step) + *next;
}

std::optional<TooMuch> too_much_for_next(const PlanSoFar& p, const StepDraft& step,
                                         const stock::HeightMap& map) {
  constexpr double kSteepest = 1.7320508;  // tangent of 60 degrees
  const std::optional<double> next = left_by_next_mm(p, step);
  if (!next) return std::nullopt;
  TooMuch out;
  const double own = freeform_allowance(p.plan.model, p.steps, step);
  out.most_mm = kMostBite * own;
  const geometry::Mesh mesh = mesh_in_setup(p, step.setup);
  const stock::HeightMap part = stock::from_mesh(mesh, geometry::bounds(mesh).lo.z - 1.0, map.cell_mm);
  double places = 0.0, beyond = 0.0;
  for (int iy = 1; iy + 1 < part.ny; ++iy) {
    for (int ix = 1; ix + 1 < part.nx; ++ix) {
      const auto z = [&](int dx, int dy) { return static_cast<double>(part.at(ix + dx, iy + dy).top_mm); };
      if (std::min({z(0, 0), z(1, 0), z(-1, 0), z(0, 1), z(0, -1)}) <= 0.0) continue;  // beside the mesh
      const double slope = std::hypot(z(1, 0) - z(-1, 0), z(0, 1) - z(0, -1)) / (2.0 * part.cell_mm);
      if (slope > kSteepest) continue;
      places += 1.0;
      const double stands = stock::height_at(map, {part.x_of(ix), part.y_of(iy)}) - part.origin.z - z(0, 0);
      // One height stands for all of a cell, over which the surface rises.
      const double by_cell = 0.5 * part.cell_mm * slope;
      const double bite = (stands - by_cell) / std::sqrt(1.0 + slope * slope) - *next;
      out.deepest_mm = std::max(out.deepest_mm, bite);
      if (bite <= out.most_mm) continue;
      beyond += 1.0;
      out.mm3 += (bite - out.most_mm) * std::sqrt(1.0 + slope * slope) * part.cell_mm * part.cell_mm;
    }
  }
  out.share = places > 0.0 ? beyond / places : 0.0;
  return out;
}

void shape_from_mesh(const PlanSoFar& p, const StepDraft& step, toolpath::PathJob& job) {
  if (job.shape.kind != model::ShapeKind::kFreeform || !p.plan.target_mesh) return;
  const auto box = geometry::bounds(mesh_in_setup(p, step.setup));
  const auto local = transformed(box, inverse(job.feature_in_setup));
  job.shape.area = geometry::rectangle(geometry::xy(local.lo), geometry::xy(local.hi));
  job.shape.depth_mm = job.feature_in_setup.origin.z - box.lo.z;
}

Result<toolpath::GeneratedPath> freeform_path(const PlanSoFar& p, const StepDraft& step,
                                              const toolpath::PathJob& path, const optimise::CutAnswer& cut,
                                              const stock::HeightMap& map, Job& job) {
  if (!p.plan.target_mesh) {
    return fail("PIP-SURFACE",
                "the surface of a freeform feature is only planned when it is given as a mesh (STL)");
  }
  const geometry::Mesh mesh = mesh_in_setup(p, step.setup);
  const bool rough = p.plan.model.holds<model::FreeformRoughMilling>(step.operation);
  toolpath::freeform::FreeformJob f;
  f.surface = &mesh;
  f.cutter = step.cutter;
  f.stock = &map;
  f.top_z_mm = path.start_z_mm;
  f.bottom_z_mm = geometry::bounds(mesh).lo.z;
  f.security_z_mm = path.security_z_mm;
  f.clearance_mm = path.clearance_mm;
  f.ramp_angle_rad = path.ramp_angle_rad;
  f.avoid = path.avoid;
  f.tolerance_mm = kChordMm;
  f.scallop_mm = kScallopMm;
  const auto* op = p.plan.model.get<model::FreeformOperation>(step.operation);
  if (const auto* s = p.plan.model.get<model::FreeformStrategy>(op->its_machining_strategy)) {
    if (const auto* t = p.plan.model.get<model::Tolerances>(s->its_milling_tolerances)) {
      f.tolerance_mm = t->chordal_tolerance.value_or(kChordMm);
      f.scallop_mm = t->scallop_height.value_or(kScallopMm);
    }
    if (s->stepover) f.stepover_mm = *s->stepover;
    f.to_and_fro = s->pathmode.value_or(model::PathmodeType::kZigzag) == model::PathmodeType::kZigzag;
  }
  f.allowance_mm = freeform_allowance(p.plan.model, p.steps, step);
  if (rough) {
    f.axial_depth_mm = cut.ap_mm;
    f.stepover_mm = std::min(cut.ae_mm, step.cutter.cutting_diameter_mm);
    if (const auto next = left_by_next_mm(p, step)) f.terrace_mm = (kMostBite - 1.0) * f.allowance_mm + *next;
  }
  const geometry::Box3& raw = p.setups[step.setup].stock;
  const bool levels = draft::cuts_levels(p.plan.model, step);
  const SurfaceForm form = piece::surface_form(mesh, raw);
  if (!rough && !levels) f.area = over_its_rim(mesh, step.cutter, raw, form.walls, f.scallop_mm);
  if (form.walls && (rough || levels)) {
    // Around the solid all goes, down to the underside; the cutter comes from beside the raw piece.
    constexpr double kBesideMm = 1.0;
    f.area = geometry::offset_sharp(geometry::rectangle(geometry::xy(raw.lo), geometry::xy(raw.hi)),
                                    0.5 * step.cutter.cutting_diameter_mm + kBesideMm);
    f.beside_is_free = true;
    f.bottom_z_mm = std::min(f.bottom_z_mm, raw.lo.z);
    f.floors_z_mm = form.floors_mm;
  }
  if (levels) {
    f.axial_depth_mm = cut.ap_mm;
    f.stepover_mm = kLevelStep * step.cutter.cutting_diameter_mm;
    f.left_mm = kRoughAllowanceMm;
  }
  std::optional<SurfaceRest> rest;
  if (roughed_before(p, step) != nullptr) rest = surface_rest(p, step, map);
  if (rest) {
    f.may_stay = &rest->may_stay;
    f.stepover_mm = std::min(f.stepover_mm, low_cusps_mm(step.cutter, 0.5 * f.terrace_mm));
    if (f.area.empty()) f.area = over_its_rim(mesh, step.cutter, raw, form.walls, f.scallop_mm);
  }
  auto made = rough || levels ? toolpath::freeform::rough(f, job) : toolpath::freeform::finish(f, job);
  if (!made) return tl::unexpected(made.error());
  toolpath::GeneratedPath out;
  out.path = std::move(made->path);
  out.levels_z_mm = std::move(made->levels_z_mm);
  out.feed_factor.assign(out.path.size(), 1.0);
  out.speed_factor.assign(out.path.size(), 1.0);
  out.dwell_s.assign(out.path.size(), 0.0);
  return out;
}

}  // namespace capstan::step
