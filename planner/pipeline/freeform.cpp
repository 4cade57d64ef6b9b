#include <algorithm>
#include <cmath>

#include "planner/pipeline/steps.h"
#include "planner/toolpath/freeform/freeform.h"

// Freeform steps: a surface given as a mesh, roughed in levels and finished in passes.

namespace capstan::pipeline {
namespace {

constexpr double kScallopMm = 0.01;        // where the file states no scallop height; default, unsourced
constexpr double kChordMm = 0.01;          // where the file states no chordal tolerance; default, unsourced
constexpr double kRoughAllowanceMm = 0.5;  // left by roughing when no rule says otherwise; default, unsourced

}  // namespace

geometry::Mesh mesh_in_setup(const Work& w, std::size_t setup) {
  geometry::Mesh out = *w.plan.target_mesh;
  for (geometry::Vec3& v : out.vertices) v = w.setups[setup].workpiece.to_parent(v);
  return out;
}

void shape_from_mesh(const Work& w, const StepWork& step, toolpath::PathJob& job) {
  if (job.shape.kind != model::ShapeKind::kFreeform || !w.plan.target_mesh) return;
  const auto box = geometry::bounds(mesh_in_setup(w, step.setup));
  const auto local = transformed(box, inverse(job.feature_in_setup));
  job.shape.area = geometry::rectangle(geometry::xy(local.lo), geometry::xy(local.hi));
  job.shape.depth_mm = job.feature_in_setup.origin.z - box.lo.z;
}

Result<toolpath::GeneratedPath> freeform_path(Work& w, const StepWork& step, const toolpath::PathJob& job,
                                              const optimise::CutAnswer& cut, const stock::HeightMap& map) {
  if (!w.plan.target_mesh) {
    return fail("PIP-SURFACE",
                "the surface of a freeform feature is only planned when it is given as a mesh (STL)");
  }
  const geometry::Mesh mesh = mesh_in_setup(w, step.setup);
  const bool rough = w.plan.model.holds<model::FreeformRoughMilling>(step.operation);
  toolpath::freeform::FreeformJob f;
  f.surface = &mesh;
  f.cutter = step.cutter;
  f.stock = &map;
  f.top_z_mm = job.start_z_mm;
  f.bottom_z_mm = geometry::bounds(mesh).lo.z;
  f.security_z_mm = job.security_z_mm;
  f.clearance_mm = job.clearance_mm;
  f.tolerance_mm = kChordMm;
  f.scallop_mm = kScallopMm;
  const auto* op = w.plan.model.get<model::FreeformOperation>(step.operation);
  if (const auto* s = w.plan.model.get<model::FreeformStrategy>(op->its_machining_strategy)) {
    if (const auto* t = w.plan.model.get<model::Tolerances>(s->its_milling_tolerances)) {
      f.tolerance_mm = t->chordal_tolerance.value_or(kChordMm);
      f.scallop_mm = t->scallop_height.value_or(kScallopMm);
    }
    if (s->stepover) f.stepover_mm = *s->stepover;
    f.to_and_fro = s->pathmode.value_or(model::PathmodeType::kZigzag) == model::PathmodeType::kZigzag;
  }
  if (rough) {
    f.allowance_mm = step.proposed ? step.proposal.allowance_side_mm : kRoughAllowanceMm;
    f.axial_depth_mm = cut.ap_mm;
    f.stepover_mm = std::min(cut.ae_mm, step.cutter.cutting_diameter_mm);
  }
  auto made = rough ? toolpath::freeform::rough(f, w.job) : toolpath::freeform::finish(f, w.job);
  if (!made) return tl::unexpected(made.error());
  toolpath::GeneratedPath out;
  out.path = std::move(made->path);
  out.levels_z_mm = std::move(made->levels_z_mm);
  out.feed_factor.assign(out.path.size(), 1.0);
  out.speed_factor.assign(out.path.size(), 1.0);
  out.dwell_s.assign(out.path.size(), 0.0);
  return out;
}

}  // namespace capstan::pipeline
