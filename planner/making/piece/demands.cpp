#include "planner/making/piece/demands.h"

#include <algorithm>

#include "planner/ground/base/number.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/making/piece/surroundings.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::piece {
namespace {

using geometry::Box2;
using model::FeatureShape;
using model::Model;
using model::ShapeKind;

/// Adds the general tolerance's flatness (over the longer side of a face) and perpendicularity (over the
/// depth of walls) where the feature states none.
void take_general(const model::GeneralTolerance& g, const FeatureShape& s, model::Quality& q) {
  if (s.area.empty()) return;
  const Box2 box = geometry::bounds(s.area);
  const double x = box.hi.x - box.lo.x, y = box.hi.y - box.lo.y;
  if (!q.form_mm && s.kind == ShapeKind::kFace) q.form_mm = model::general_flatness(g, std::max(x, y));
  if (!q.orientation_mm && model::has(s.kind, model::ShapeTrait::kWalled))
    q.orientation_mm = model::general_perpendicularity(g, std::max(s.depth_mm, 1.0));
}

/// Warns of tolerance zones of 0 (at maximum material): their width is what the finished size leaves unused,
/// which the file does not state.
void warn_of_zero_zones(const Model& m, const model::Attribution& attribution, Job& job) {
  for (const AnyRef r : m.all_below(model::TypeId::kGeometricTolerance)) {
    const auto& value = m.at<model::GeometricTolerance>(r).tolerance_value;
    if (value && *value > 0.0) continue;
    std::string of;
    for (const AnyRef f : attribution.features(r)) {
      const auto* feature = m.get<model::ManufacturingFeature>(f);
      if (feature != nullptr) of += (of.empty() ? " of '" : ", '") + feature->its_id.value_or("") + "'";
    }
    job.warn("PIP-REQUIREMENT",
             std::string(model::noun_type(r.type).keyword) + of +
                 (value ? " has a zone of 0, which depends on the finished size" : " has no value") +
                 ": not planned for; " +
                 (value ? "state a tolerance of the size that holds it" : "state its value"));
  }
}

}  // namespace

Result<Demands> demands_of(const model::Plan& plan, const std::string& general_tolerance,
                           double edge_break_mm, int batch, Job& job) {
  const Model& m = plan.model;
  Demands out;
  out.edge_break_mm = std::max(0.0, edge_break_mm);
  out.batch = std::max(1, batch);
  if (!general_tolerance.empty()) {
    auto g = model::parse_general(general_tolerance);
    if (!g) return tl::unexpected(g.error());
    out.general = *std::move(g);
    out.general_from = "named by the user";
  } else {
    for (const AnyRef piece : m.all(model::TypeId::kWorkpiece)) {
      auto g = model::general_tolerance_of(m, Ref<model::Workpiece>(piece));
      if (!g) {
        job.warn(g.error().code, g.error().message + "; taken as not stated");
      } else if (*g) {
        out.general = **g;
        out.general_from = "the file";
        break;
      }
    }
  }
  const model::Attribution attribution(m);
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature))
    out.qualities[f] = attribution.quality(f);
  out.ties = model::ties_of(m, attribution);
  std::string lost;
  for (const auto& l : attribution.lost()) lost += (lost.empty() ? "" : "; ") + l.text;
  if (!lost.empty()) {
    job.warn("PIP-REQUIREMENT",
             counted(attribution.lost().size(), "tolerance or texture names", "tolerances or textures name") +
                 " faces or elements that no feature has, not planned for: " + lost);
  }
  warn_of_zero_zones(m, attribution, job);
  return out;
}

rules::Context context_of(const Piece& piece, const Demands& demands, AnyRef feature,
                          const std::vector<FeatureShape>& shapes) {
  const model::Plan& plan = piece.plan;
  rules::Context c;
  c.material = plan.material;
  c.general = demands.general;
  if (const auto* named = plan.model.get<model::ManufacturingFeature>(feature)) {
    if (const auto* of = plan.model.get<model::Workpiece>(named->its_workpiece))
      c.global_tolerance_mm = model::global_tolerance_of(*of);
  }
  if (const auto it = demands.qualities.find(feature); it != demands.qualities.end()) c.quality = it->second;
  if (demands.general) take_general(*demands.general, shapes.front(), c.quality);
  c.stock_above_mm = stock_above(piece, shapes.front());
  c.has_coolant = plan.machine.has_flood || plan.machine.has_mist;
  c.has_through_coolant = plan.machine.has_through;
  c.abilities = plan.machine.abilities;
  c.batch = demands.batch;
  c.edge_break_mm = demands.edge_break_mm;
  const Thickness thinnest = thinnest_beside(piece, shapes);
  c.wall_thickness_mm = thinnest.wall_mm;
  c.floor_thickness_mm = thinnest.floor_mm;
  c.between_ends_mm = between_ends(piece, shapes.front());
  c.sharp_corner_mm = sharp_corner_of(piece, shapes.front());
  c.clear_radius_mm = least_clear_beside(piece, shapes);
  return c;
}

}  // namespace capstan::piece
