#include "planner/making/piece/piece.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/ground/base/number.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/piece/twins.h"
#include "planner/making/piece/workpiece.h"
#include "planner/model/features/raw_piece.h"

// Holes that are stated as through and end inside the piece. The bottom condition is the more reliable
// statement: the drawn depth is often that of a wall that was there before (ISO 14649-11, example 2: 40 mm
// through, beside an outside of 50 mm). Such a hole goes down to the underside of the raw piece, and that is
// reported. If another feature removes material on its axis below, the hole opens into that and ends as
// stated.

namespace capstan::piece {
namespace {

using geometry::Box3;
using model::FeatureShape;

constexpr double kInside = 0.01;  // mm: less is the rounding of a file
constexpr double kSameAxis = 1e-9;

/// Whether a feature takes away something within a thin column, workpiece coordinates.
bool meets(const FeatureShape& s, const Box3& column) {
  if (s.area.empty() || s.kind == model::ShapeKind::kToolpath) return false;
  const auto b = geometry::bounds(s.area);
  const Box3 there = transformed(column, inverse(s.frame));
  return there.hi.x >= b.lo.x && there.lo.x <= b.hi.x && there.hi.y >= b.lo.y && there.lo.y <= b.hi.y &&
         there.hi.z >= -s.depth_mm && there.lo.z <= 0.0;
}

bool open_below(const model::Model& m, const Box3& column) {
  for (const AnyRef f : m.all_below(model::TypeId::kMachiningFeature)) {
    const auto shapes = model::shapes_of(m, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    if (std::any_of(shapes->begin(), shapes->end(), [&](const auto& s) { return meets(s, column); }))
      return true;
  }
  return false;
}

/// Stops shapes at the walls of the piece, and takes through holes down to its underside.
void take_into_piece(const Piece& piece, std::vector<FeatureShape>& shapes) {
  const Box3 part = part_box(piece);
  for (FeatureShape& s : shapes) {
    stop_at_walls(piece, s);
    if (s.kind != model::ShapeKind::kHole || !s.through || s.bottom_diameter_mm != s.diameter.nominal_mm)
      continue;
    const auto& z = s.frame.z;
    if (std::max({std::abs(z.x), std::abs(z.y), std::abs(z.z)}) < 1.0 - kSameAxis) continue;
    const double under = -transformed(part, inverse(s.frame)).lo.z;
    if (under < s.depth_mm + kInside || transformed(part, inverse(s.frame)).hi.z < -s.depth_mm) continue;
    const double raw = -transformed(piece.plan.stock.box, inverse(s.frame)).lo.z;
    Box3 column;
    column.add(s.frame.to_parent({0.0, 0.0, -s.depth_mm - 0.5 * kInside}));
    column.add(s.frame.to_parent({0.0, 0.0, -raw}));
    if (open_below(piece.plan.model, column)) continue;
    s.assumptions.push_back("it goes through, but its depth of " + trimmed(s.depth_mm, 3) + " mm ends " +
                            trimmed(raw - s.depth_mm, 3) +
                            " mm above the underside of the piece: it is cut down to the underside");
    s.depth_mm = raw;
  }
}

}  // namespace

Box3 part_box(const Piece& piece) {
  Box3 out = piece.plan.stock.box;
  const model::Workpiece* made = model::workpiece_of(piece.plan.model, piece.plan.project);
  const auto own =
      made != nullptr ? model::box_of(piece.plan.model, made->its_bounding_geometry) : std::nullopt;
  const double grown = piece.grown_mm;
  if (own && made->its_rawpiece.set()) {
    out = *own;
  } else if (grown > 0.0) {
    out.lo = out.lo + geometry::Vec3{grown, grown, grown};
    out.hi = out.hi - geometry::Vec3{grown, grown, grown};
  } else if (const auto stated =
                 made != nullptr ? model::box_of(piece.plan.model, model::raw_solid(piece.plan.model, *made))
                                 : std::nullopt) {
    // A larger piece than the file's, by --stock: the part is drawn in the file's.
    out.lo = {std::max(out.lo.x, stated->lo.x), std::max(out.lo.y, stated->lo.y),
              std::max(out.lo.z, stated->lo.z)};
    out.hi = {std::min(out.hi.x, stated->hi.x), std::min(out.hi.y, stated->hi.y),
              std::min(out.hi.z, stated->hi.z)};
  }
  return out.empty() ? piece.plan.stock.box : out;
}

StatedShapes stated_shapes(const model::Model& model) {
  StatedShapes out;
  for (const AnyRef f : model.all_below(model::TypeId::kManufacturingFeature))
    out.emplace_hint(out.end(), f, model::shapes_of(model, Ref<model::ManufacturingFeature>(f)));
  return out;
}

Result<std::vector<FeatureShape>> shapes_in_piece(const Piece& piece, AnyRef feature) {
  auto shapes = model::shapes_of(piece.plan.model, Ref<model::ManufacturingFeature>(feature));
  if (shapes) take_into_piece(piece, *shapes);
  return shapes;
}

Shapes shapes_of_all(const model::Plan& plan, StatedShapes stated, double grown_mm, const draft::Bans& bans,
                     Job& job) {
  const model::Model& m = plan.model;
  Shapes out;
  for (const AnyRef f : m.all_below(model::TypeId::kPlanarFace)) {
    if (bans.left_out(f) != nullptr) continue;  // it stays
    if (const auto& s = stated.at(f)) out.faces.insert(out.faces.end(), s->begin(), s->end());
  }
  std::vector<FeatureShape> all;
  for (auto& [feature, s] : stated) {
    if (!s) continue;
    take_into_piece({plan, out, grown_mm}, *s);
    std::move(s->begin(), s->end(), std::back_inserter(all));
  }
  out.all = std::move(all);
  const std::set<AnyRef> parts = model::parts_of_others(m);
  const auto take_whole = [&] {
    out.whole.clear();
    std::copy_if(out.all.begin(), out.all.end(), std::back_inserter(out.whole),
                 [&](const FeatureShape& s) { return !parts.contains(s.feature); });
  };
  const auto is_face = [](const FeatureShape& s) { return s.kind == model::ShapeKind::kFace; };
  if (std::any_of(out.all.begin(), out.all.end(), is_face)) {
    take_whole();  // stop_at_walls needs these, and changes nothing but faces
    for (FeatureShape& s : out.all) stop_at_walls({plan, out, grown_mm}, s);
  }
  take_whole();
  out.near_all = Neighbours(out.all);
  out.near_whole = parts.empty() ? out.near_all : Neighbours(out.whole);
  out.twins = twins_of(out.whole, out.near_whole, job);
  return out;
}

bool alike(const FeatureShape& a, const FeatureShape& b) {
  return model::same_form(a, b) && a.area.loops == b.area.loops && a.frame.z == b.frame.z &&
         a.frame.origin.z == b.frame.origin.z;
}

}  // namespace capstan::piece
