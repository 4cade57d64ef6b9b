#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

// Bosses stand, whichever feature is cut around them. A feature lists the bosses that stand in it (its_boss);
// a boss that is a feature of its own, in the same workpiece, stands in others, too: in every face and every
// outside of another contour that is cut lower than the boss's top beside it, and in every pocket and step
// whose area holds the whole of it; and in what is cut around the island on which it stands. What is cut into
// a boss from its top, or across it, is not affected.
//
// A boss of a compound or a pattern stands where that puts it, once for each copy. A boss that leans is kept
// clear of by its widest section, whether its contour is drawn at its top or at its foot. One of which only
// the contour is known is kept clear of at all heights; where not even that is known, everything that might
// cut it is refused.

namespace capstan::model::shape {

namespace {

constexpr double kLower = 1e-6;     ///< mm, and the sine of an angle
constexpr double kSpeck = 1e-3;     ///< mm2: less is the rounding of outlines
constexpr double kAnyHeight = 1e6;  ///< mm: of a boss whose height is not known
constexpr double kSteepest = 1.4;   ///< rad: a wall that leans more is none; default, unsourced

/// What of a boss must stay.
struct Standing {
  geometry::Placement frame;  ///< its top, workpiece coordinates; as stated: those of its container
  geometry::Region area;      ///< its contour, in its frame
  geometry::Region widest;    ///< over all its heights
  double height_mm = 0.0;
  double slope_rad = 0.0;
  std::optional<double> foot_mm;  ///< its fillet, where one is stated
};

geometry::Placement own_frame(const Model& m, AnyRef feature) {
  const auto* placed = m.get<Two5dManufacturingFeature>(feature);
  if (placed == nullptr) return {};
  const auto frame = placement_or_identity(m, placed->feature_placement);
  return frame ? *frame : geometry::Placement{};
}

/// A boss as it is stated. Fails where its contour is not known.
Result<Standing> stated(const Model& m, AnyRef boss) {
  auto shape = base(m, boss, false);
  if (!shape) return tl::unexpected(shape.error());
  const auto* noun = m.get<Boss>(boss);
  const auto area = closed_area(m, noun->its_boundary, *shape);
  if (!area) return tl::unexpected(area.error());
  Standing out{shape->frame, *area, *area, kAnyHeight, noun->slope.value_or(0.0), {}};
  const auto foot = foot_of(m, boss);
  if (!foot) return tl::unexpected(foot.error());
  out.foot_mm = *foot;
  const auto depth = depth_of(m, boss);
  const bool known = depth && !depth->tilted && depth->depth_mm >= 0.0;
  if (known) out.height_mm = depth->depth_mm;
  // Drawn from its foot: its top is as much higher.
  if (depth && depth->depth_mm < 0.0) out.frame.origin = out.frame.to_parent({0.0, 0.0, -depth->depth_mm});
  if (!leans(*noun)) return out;
  const double lean = std::abs(out.slope_rad);
  if (!known || !(lean < kSteepest))
    return unsupported(m, boss, "its walls lean, and how wide it is at its foot is not known");
  out.widest = geometry::offset(*area, out.height_mm * std::tan(lean));
  return out;
}

/// Pockets, faces and steps that list it, and itself: whose copies bring copies of the boss.
std::vector<AnyRef> bringers(const Model& m, AnyRef boss) {
  std::vector<AnyRef> out{boss};
  for (const AnyRef h : holders(m, boss)) {
    if (!m.holds<CompoundFeature>(h) && !m.holds<ReplicateFeature>(h)) out.push_back(h);
  }
  return out;
}

/// The outermost compounds and patterns that a feature is in.
std::vector<AnyRef> outermost(const Model& m, AnyRef feature, int upwards = 0) {
  std::vector<AnyRef> out;
  for (const AnyRef h : holders(m, feature)) {
    if (upwards > kNesting || (!m.holds<CompoundFeature>(h) && !m.holds<ReplicateFeature>(h))) continue;
    auto further = outermost(m, h, upwards + 1);
    if (further.empty()) further.push_back(h);
    out.insert(out.end(), further.begin(), further.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Where a boss is when what brings it stands there.
geometry::Placement brought(const Model& m, const geometry::Placement& bringer, AnyRef by,
                            const Standing& boss) {
  return compose(bringer, compose(inverse(own_frame(m, by)), boss.frame));
}

AnyRef leaf(const FeatureShape& s) { return s.made_of.empty() ? s.feature : s.made_of.back(); }

/// The frames of a boss in workpiece coordinates, one for each copy.
Result<std::vector<geometry::Placement>> frames(const Model& m, AnyRef boss, const Standing& as_stated,
                                                const Within& in) {
  std::vector<geometry::Placement> out;
  bool alone = true;
  for (const AnyRef by : bringers(m, boss)) {
    for (const AnyRef top : outermost(m, by)) {
      alone = false;
      const auto shapes = any(m, top, in);
      if (!shapes) return tl::unexpected(shapes.error());
      for (const FeatureShape& s : *shapes) {
        if (leaf(s) == by) out.push_back(brought(m, s.frame, by, as_stated));
      }
    }
  }
  if (alone) out.push_back(as_stated.frame);
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

/// Whether a shape is the boss itself, or has it among its own islands.
bool its_own(const Model& m, const FeatureShape& s, const std::vector<AnyRef>& by, const Standing& as_stated,
             const geometry::Placement& at) {
  const AnyRef maker = leaf(s);
  if (std::find(by.begin(), by.end(), maker) == by.end()) return false;
  const geometry::Placement there = brought(m, s.frame, maker, as_stated);
  return norm(there.origin - at.origin) < kLower && norm(there.x - at.x) < kLower;
}

/// The tops of the islands of what is cut that are as high as the feature: a boss stands on them.
geometry::Region tops_of_islands(const FeatureShape& s) {
  geometry::Region out;
  for (const Island& i : s.islands) {
    if (std::abs(i.top_z_mm) <= kLower) out = geometry::unite(out, i.area);
  }
  return out;
}

void spare(FeatureShape& s, const Standing& boss, const geometry::Placement& at, const std::string& name) {
  const geometry::Placement rel = compose(inverse(s.frame), at);
  if (std::abs(rel.z.z - 1.0) > kLower) return;
  const double top = rel.origin.z, foot = top - boss.height_mm;
  if (top <= -s.depth_mm + kLower) return;
  const geometry::Region drawn = moved(rel, boss.area), stays = moved(rel, boss.widest);
  if (foot >= -kLower) {
    // Passes over the islands' tops, and over what stands on them, go round it and round its fillet. A
    // contour's tops are not passed over.
    if (s.kind == ShapeKind::kOutside || s.islands.empty()) return;
    const geometry::Region on =
        geometry::intersect(geometry::offset_sharp(stays, boss.foot_mm.value_or(0.0)), tops_of_islands(s));
    if (geometry::area(on) > kSpeck) s.islands.push_back({on, top, s.islands.front().foot_radius_mm});
    return;
  }
  if (!stands_in(s, drawn)) return;
  s.islands.push_back({stays, top, boss.foot_mm.value_or(s.bottom_radius_mm)});
  s.reach = geometry::subtract(s.reach, stays);
  if (std::abs(boss.slope_rad) > kLower) {
    s.assumptions.push_back("it keeps clear of " + name + ", whose walls lean by " +
                            trimmed(std::abs(boss.slope_rad) * 180.0 / std::numbers::pi, 2) +
                            " degrees, by its widest section: material stays along these walls");
  }
}

/// Whether a shape would cut into a boss that stands across its axis. Seen from there the boss is no area
/// with a top: the box around it stands for it, which at a right angle is its outline from the side.
bool cuts_across(const FeatureShape& s, const Standing& boss, const geometry::Placement& at) {
  const geometry::Placement rel = compose(inverse(s.frame), at);
  if (std::abs(std::abs(rel.z.z) - 1.0) <= kLower) return false;
  const auto b = geometry::bounds(boss.widest);
  geometry::Box3 box;
  for (const double x : {b.lo.x, b.hi.x}) {
    for (const double y : {b.lo.y, b.hi.y}) {
      for (const double z : {0.0, -boss.height_mm}) box.add(rel.to_parent({x, y, z}));
    }
  }
  if (box.hi.z <= -s.depth_mm + kLower) return false;
  if (s.kind != ShapeKind::kFace && box.lo.z >= -kLower) return false;
  return stands_in(s, geometry::rectangle(geometry::xy(box.lo), geometry::xy(box.hi)));
}

/// Whether it is known, whatever the contour, that the boss ends below what is cut.
bool lies_below(const Model& m, AnyRef boss, const FeatureShape& s) {
  for (const AnyRef by : bringers(m, boss)) {
    if (!outermost(m, by).empty()) return false;
  }
  const auto shape = base(m, boss, true);
  if (!shape) return false;
  const geometry::Placement rel = compose(inverse(s.frame), shape->frame);
  return std::abs(rel.z.z - 1.0) <= kLower && rel.origin.z <= -s.depth_mm + kLower;
}

}  // namespace

Result<std::optional<double>> foot_of(const Model& m, AnyRef boss) {
  const auto* b = m.get<Boss>(boss);
  if (b == nullptr || !b->fillet_radius.set()) return std::optional<double>();
  const auto r = length(m, b->fillet_radius);
  if (!r) return tl::unexpected(r.error());
  if (!(r->nominal_mm >= 0.0)) return unsupported(m, boss, "its fillet_radius is negative");
  return std::optional<double>(r->nominal_mm);
}

bool leans(const Boss& boss) { return std::abs(boss.slope.value_or(0.0)) > kLower; }

Status spare_bosses(const Model& m, AnyRef feature, const Within& in, Shapes& shapes) {
  if (std::none_of(shapes.begin(), shapes.end(),
                   [](const FeatureShape& s) { return has(s.kind, ShapeTrait::kIslands); }))
    return {};
  const auto* self = m.get<ManufacturingFeature>(feature);
  for (const AnyRef b : m.all(TypeId::kBoss)) {
    const auto* noun = m.get<Boss>(b);
    if (self != nullptr && self->its_workpiece.set() && noun->its_workpiece.set() &&
        self->its_workpiece != noun->its_workpiece)
      continue;
    const auto as_stated = stated(m, b);
    const auto at = as_stated ? frames(m, b, *as_stated, in)
                              : Result<std::vector<geometry::Placement>>(tl::unexpected(as_stated.error()));
    const std::vector<AnyRef> by = bringers(m, b);
    for (FeatureShape& s : shapes) {
      if (!has(s.kind, ShapeTrait::kIslands)) continue;
      if (!at) {
        if (lies_below(m, b, s)) continue;
        return fail({.code = "SHP-BOSS",
                     .message = label(m, feature) + " may cut " + label(m, b) +
                                ", and nobody knows where that stands: " + at.error().message,
                     .instance = m.origin(b).instance,
                     .hint = "mend the boss, or take it out of the file"});
      }
      for (const geometry::Placement& there : *at) {
        if (its_own(m, s, by, *as_stated, there)) continue;
        if (cuts_across(s, *as_stated, there)) {
          return fail(
              {.code = "SHP-BOSS",
               .message = label(m, feature) + " cuts into " + label(m, b) + ", which stands at (" +
                          trimmed(there.origin.x, 3) + ", " + trimmed(there.origin.y, 3) + ", " +
                          trimmed(there.origin.z, 3) +
                          ") across its axis: what is cut around a boss from beside it is not planned",
               .instance = m.origin(b).instance,
               .hint = "cut it from the boss's own side, draw it so that it ends beside the boss, or "
                       "take the boss out of the file if it is meant to go"});
        }
        spare(s, *as_stated, there, label(m, b));
      }
    }
  }
  return {};
}

Status add_islands(const Model& m, const RefList<Boss>& bosses, FeatureShape& into) {
  for (std::size_t i = 0; i < bosses.size(); ++i) {
    const auto* b = m.get<Boss>(bosses[i]);
    if (b == nullptr) return unsupported(m, into.feature, "it lists a boss that cannot be read");
    auto shape = base(m, bosses[i], true);
    if (!shape) return tl::unexpected(shape.error());
    const auto area = closed_area(m, b->its_boundary, *shape);
    if (!area) return tl::unexpected(area.error());
    if (leans(*b)) return leaning(m, bosses[i]);
    // From the boss's frame into the feature's: axes must agree, or it is not a 2.5D island.
    const geometry::Placement rel = compose(inverse(into.frame), shape->frame);
    if (std::abs(rel.z.z - 1.0) > kLower)
      return unsupported(m, bosses[i], "its axis is not that of the feature it stands in");
    const double top = rel.origin.z, foot = top - shape->depth_mm;
    const geometry::Region stays = moved(rel, *area);
    const bool across = geometry::area(geometry::intersect(into.area, stays)) > kSpeck;
    if (!across || top <= -into.depth_mm + kLower || foot >= -kLower) {
      return unsupported(m, into.feature,
                         "it lists " + label(m, bosses[i]) + ", which lies outside it, at X" +
                             trimmed(rel.origin.x, 3) + " Y" + trimmed(rel.origin.y, 3) + " Z" +
                             trimmed(top, 3) + " of its frame, " + trimmed(shape->depth_mm, 3) +
                             " mm high: place the boss in the coordinates that the feature is placed in, "
                             "or take it out of the list");
    }
    const auto fillet = foot_of(m, bosses[i]);
    if (!fillet) return tl::unexpected(fillet.error());
    into.islands.push_back({stays, top, fillet->value_or(into.bottom_radius_mm)});
  }
  return {};
}

tl::unexpected<Diagnostic> leaning(const Model& m, AnyRef boss) {
  return unsupported(m, boss,
                     "its walls lean by " +
                         trimmed(std::abs(*m.get<Boss>(boss)->slope) * 180.0 / std::numbers::pi, 2) +
                         " degrees; bosses with upright walls are planned only: model it as a surface");
}

}  // namespace capstan::model::shape
