#include <algorithm>

#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"
#include "planner/model/resolve.h"
#include "planner/model/shape/build.h"

// Bosses stand, whichever feature is cut around them. A feature lists the bosses that stand in it (its_boss);
// a boss that is a feature of its own, in the same workpiece, stands in others, too: in every face and every
// outside of another contour that is cut lower than the boss's top beside it, and in every pocket and step
// whose area holds the whole of it. What is cut into a boss from its top, or across it, is not affected.

namespace capstan::model::shape {

namespace {

constexpr double kLower = 1e-6;  ///< mm
constexpr double kSpeck = 1e-3;  ///< mm2: less is the rounding of outlines

/// The bosses that the feature lists itself.
std::vector<AnyRef> listed(const Model& m, AnyRef feature) {
  std::vector<AnyRef> out;
  const auto take = [&](const auto& items) { out.insert(out.end(), items.begin(), items.end()); };
  if (const auto* f = m.get<Pocket>(feature)) take(f->its_boss.items);
  if (const auto* f = m.get<PlanarFace>(feature)) take(f->its_boss.items);
  if (const auto* f = m.get<Step>(feature)) take(f->its_boss.items);
  return out;
}

bool stands_in(const FeatureShape& s, const geometry::Region& boss) {
  if (s.kind == ShapeKind::kFace || s.kind == ShapeKind::kOutside) {
    geometry::Region cut = s.area;
    for (const Island& i : s.islands) cut = geometry::subtract(cut, i.area);
    return geometry::area(geometry::intersect(cut, boss)) > kSpeck;
  }
  return geometry::area(geometry::subtract(boss, s.area)) <= kSpeck;
}

}  // namespace

void spare_bosses(const Model& m, AnyRef feature, Shapes& shapes) {
  const std::vector<AnyRef> all = m.all(TypeId::kBoss);
  if (all.empty()) return;
  const std::vector<AnyRef> own = listed(m, feature);
  const auto* self = m.get<ManufacturingFeature>(feature);
  for (const AnyRef b : all) {
    if (b == feature || std::find(own.begin(), own.end(), b) != own.end()) continue;
    const auto* noun = m.get<Boss>(b);
    if (self != nullptr && self->its_workpiece.set() && noun->its_workpiece.set() &&
        self->its_workpiece != noun->its_workpiece)
      continue;
    std::optional<std::pair<geometry::Placement, geometry::Region>> known;
    double height = 0.0;
    for (FeatureShape& s : shapes) {
      if (s.kind != ShapeKind::kFace && s.kind != ShapeKind::kOutside && s.kind != ShapeKind::kPocket &&
          s.kind != ShapeKind::kStep)
        continue;
      if (!known) {
        auto shape = base(m, b, true);
        if (!shape) break;  // what a boss lacks is said where it is planned itself
        const auto area = closed_area(m, noun->its_boundary, *shape);
        if (!area) break;
        known.emplace(shape->frame, *area);
        height = shape->depth_mm;
      }
      const geometry::Placement rel = compose(inverse(s.frame), known->first);
      if (std::abs(rel.z.z - 1.0) > kLower) continue;
      const double top = rel.origin.z, foot = top - height;
      if (top <= -s.depth_mm + kLower || foot >= -kLower) continue;
      const geometry::Region area = moved(rel, known->second);
      if (!stands_in(s, area)) continue;
      s.islands.push_back({area, top});
      s.reach = geometry::subtract(s.reach, area);
    }
  }
}

}  // namespace capstan::model::shape
