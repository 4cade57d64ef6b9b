#include "planner/making/step/cut/preferences.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/vocabulary/operation.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/step/cut/drilled_hole.h"
#include "planner/making/step/cut/perimeter.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::step {
namespace {

using model::FeatureShape;
using model::ShapeKind;
using model::TypeId;

/// The allowance that roughing leaves on walls and floors for the finishing pass, mm. Default, unsourced.
constexpr double kLeftOnWalls = 0.5;
/// An island that ends this far below the top or less stands to the top, mm.
constexpr double kTopMm = 1e-6;
/// The least share of a step's whole volume that is estimated: where allowances leave next to nothing, the
/// ways in and out still take time. Default, unsourced.
constexpr double kLeastShare = 0.05;

/// The area at a feature's bottom within the raw piece, without the islands that stand to its top.
geometry::Region cut_area(const piece::Piece& piece, const FeatureShape& s) {
  geometry::Region area = s.area;
  for (const model::Island& i : s.islands) {
    if (i.top_z_mm > -kTopMm) area = geometry::subtract(area, i.area);
  }
  const geometry::Box3 raw = geometry::transformed(piece.plan.stock.box, inverse(s.frame));
  const auto in_raw =
      geometry::intersect(area, geometry::rectangle({raw.lo.x, raw.lo.y}, {raw.hi.x, raw.hi.y}));
  return in_raw.empty() ? area : in_raw;
}

/// Length of a feature's walls: around it, but for what is cut from outside, and around its islands.
double walls_mm(const FeatureShape& s) {
  double out = s.kind == ShapeKind::kOutside ? 0.0 : perimeter(s.area);
  for (const model::Island& i : s.islands) out += perimeter(i.area);
  return out;
}

/// Area that a roughing step cuts between upright walls, its allowance left out, mm2: of rest machining what
/// the wider cutter before left.
double rough_mm2(const piece::Piece& piece, const model::ProposedStep& step, const FeatureShape& s) {
  constexpr double kChord = 0.01;
  const geometry::Region area = cut_area(piece, s);
  const double whole = geometry::area(area) - step.allowance_side_mm * perimeter(area);
  const double wide = step.rest_of_diameter_mm;
  if (!(wide > 0.0)) return whole;
  const geometry::Region stood = geometry::offset(area, -0.5 * wide - step.allowance_side_mm, kChord);
  return whole - geometry::area(geometry::offset(stood, 0.5 * wide, kChord));
}

/// Area of what faces upwards, projected.
double seen_from_above_mm2(const geometry::Mesh& mesh) {
  double out = 0.0;
  for (const auto& t : mesh.triangles) {
    const geometry::Vec3 a = mesh.vertices[t[0]];
    out += std::max(0.0, 0.5 * cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a).z);
  }
  return out;
}

/// The widest hole that goes on below a bore's bottom; 0: none.
double hole_below_mm(const piece::Piece& piece, const FeatureShape& s) {
  double out = 0.0;
  if (piece.shapes.near_all.size() != piece.shapes.all.size()) return out;
  for (const std::size_t i : piece.shapes.near_all.near(piece::around(s), s.frame.z, 0.0)) {
    const FeatureShape& other = piece.shapes.all[i];
    if (goes_on_below(s, other)) out = std::max(out, other.diameter.nominal_mm);
  }
  return out;
}

}  // namespace

tooling::Preferences preferences_of(const piece::Piece& piece, int batch, const model::ProposedStep& step,
                                    const FeatureShape& s) {
  tooling::Preferences p;
  p.batch = batch;
  p.pre_hole_mm = step.start_diameter_mm;
  const double above = piece::stock_above(piece, s);
  const double depth = s.kind == ShapeKind::kFace ? std::max(above, s.depth_mm) : s.depth_mm + above;
  if (model::is_a(step.operation, TypeId::kDrillingTypeOperation)) {
    p.depth_mm = step.depth_mm > 0.0 ? step.depth_mm + above : depth;
    if (step.operation == TypeId::kThreadDrilling) {
      p.bore_mm = s.thread_major_mm;
      p.pitch_mm = s.thread_pitch_mm;
      p.bending_mm = bending_of_finish_mm(
          zone_across_mm(piece.plan.model, s.feature, s, s.diameter.nominal_mm, std::nullopt));
    }
    return p;
  }
  if (s.kind == ShapeKind::kHole) {
    p.bore_mm = s.diameter.middle() - 2.0 * step.allowance_side_mm;
    p.open_below_mm = s.through ? step.start_diameter_mm : hole_below_mm(piece, s);
  }
  if (s.kind == ShapeKind::kFace && s.islands.empty() && !s.area.empty() &&
      model::has(step.operation, model::OperationTrait::kPlane)) {
    const auto b = geometry::bounds(s.area);
    p.width_mm = std::min(b.hi.x - b.lo.x, b.hi.y - b.lo.y);
    if (p.width_mm > 0.0) p.face_mm = geometry::area(s.area) / p.width_mm;
  }
  if (model::is_a(step.operation, TypeId::kPlaneFinishMilling)) {
    p.depth_mm = std::min(depth, kLeftOnWalls);
    p.volume_mm3 = geometry::area(s.area) * p.depth_mm;
    return p;
  }
  if (model::is_a(step.operation, TypeId::kFreeformFinishMilling) && s.kind == ShapeKind::kFreeform &&
      piece.plan.target_mesh) {
    p.passes_mm2 = seen_from_above_mm2(*piece.plan.target_mesh);
    p.ridges_mm = freeform_ridges_mm(step);
  }
  if (model::has(step.operation, model::OperationTrait::kFinishes)) {  // planes have returned
    p.width_mm = kLeftOnWalls;
    p.depth_mm = depth;
    const bool floor = step.operation == TypeId::kBottomAndSideFinishMilling && !s.through;
    if (floor && s.kind != ShapeKind::kHole) p.floor_mm2 = geometry::area(cut_area(piece, s));
    p.volume_mm3 = walls_mm(s) * depth * kLeftOnWalls;
    return p;
  }
  if (!model::has(s.kind, model::ShapeTrait::kClears))
    return p;  // chamfers, rounds, threads: a small volume that is not estimated
  p.depth_mm = depth;
  p.volume_mm3 = geometry::area(cut_area(piece, s)) * depth;
  p.roughs = model::has(step.operation, model::OperationTrait::kRoughs);
  const bool upright = std::abs(s.slope_rad) < 1e-6 && s.slot_profile.empty();
  if (p.roughs && model::has(s.kind, model::ShapeTrait::kWalled) && s.kind != ShapeKind::kHole && upright) {
    p.walled = !(step.rest_of_diameter_mm > 0.0);  // a rest is entered from beside it
    p.depth_mm = std::max(kLeastShare * depth, depth - step.allowance_bottom_mm);
    p.volume_mm3 = std::max(kLeastShare * geometry::area(s.area), rough_mm2(piece, step, s)) * p.depth_mm;
  }
  if (s.kind == ShapeKind::kHole) {
    constexpr double kQuarterPi = 0.78539816339744831;
    const double d = s.diameter.nominal_mm, hole = step.start_diameter_mm;
    p.volume_mm3 = kQuarterPi * std::max(0.0, d * d - hole * hole) * depth;
  }
  return p;
}

double freeform_ridges_mm(const model::ProposedStep& step) {
  constexpr double kFine = 0.01, kShareOfLeft = 0.4;
  const bool semi = model::is_a(step.operation, TypeId::kFreeformFinishMilling);
  return semi ? std::max(kFine, kShareOfLeft * step.allowance_side_mm) : kFine;
}

}  // namespace capstan::step
