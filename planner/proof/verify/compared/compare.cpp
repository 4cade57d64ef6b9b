#include "planner/proof/verify/compared/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/volumes/number_text.h"

// The planner's shapes against the own reading, place by place. A place counts only where either reading says
// the same all round it, as far as the two may differ: surfaces that lie within the tolerance of each other
// never disagree, whatever their slope.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

namespace {

/// Whether the section of a slot is wider below than above, so that its floor cannot be seen from the top.
bool undercut(const FeatureShape& s) {
  for (std::size_t i = 1; i < s.slot_profile.size(); ++i) {
    if (s.slot_profile[i].y < s.slot_profile[i - 1].y - 1e-9) return true;
  }
  return false;
}

/// By the section of the shape: half as wide as it says at that height.
bool in_section(const FeatureShape& s, Vec3 p) {
  if (p.z < -s.depth_mm) return false;
  const double height = p.z + s.depth_mm;
  const Vec2 q = xy(p);
  Vec2 foot = s.spine.front();
  for (std::size_t i = 1; i < s.spine.size(); ++i) {
    const Vec2 a = s.spine[i - 1], d = s.spine[i] - a;
    const Vec2 near = a + std::clamp(dot(q - a, d) / dot(d, d), 0.0, 1.0) * d;
    if (norm(q - near) < norm(q - foot)) foot = near;
  }
  const auto& w = s.slot_profile;
  double half = w.back().y;
  for (std::size_t i = 1; i < w.size(); ++i) {
    if (height > w[i].x) continue;
    const double rise = w[i].x - w[i - 1].x;
    half = rise > 0.0 ? w[i - 1].y + (height - w[i - 1].x) / rise * (w[i].y - w[i - 1].y) : w[i - 1].y;
    break;
  }
  const double off = norm(q - foot), mouth = 0.99 * w.back().y;
  if (off > half) return false;
  return geometry::contains(s.area, off > mouth ? foot + (mouth / off) * (q - foot) : q);
}

/// What the planner's shapes hold and where, so that a place is asked of few.
class Shapes {
 public:
  explicit Shapes(const std::vector<FeatureShape>& shapes) {
    for (const FeatureShape& s : shapes) {
      if (s.kind == ShapeKind::kToolpath || s.kind == ShapeKind::kFreeform) continue;
      Box3 box, there;
      const auto area = geometry::bounds(s.area);
      double grow = s.chamfer_width_mm + s.round_radius_mm + s.depth_mm * std::tan(std::abs(s.slope_rad));
      for (const Vec2 w : s.slot_profile) grow = std::max(grow, w.y);
      grow = std::max(grow, 0.5 * std::max(s.diameter.nominal_mm, s.bottom_diameter_mm) + kAgreeMm);
      const double tip = s.bottom == model::HoleBottom::kConical
                             ? 0.5 * s.bottom_diameter_mm * std::tan(s.bottom_angle_rad)
                             : 0.0;
      box.add({area.lo.x - grow, area.lo.y - grow, s.through ? -1e6 : -s.depth_mm - tip - kAgreeMm});
      box.add({area.hi.x + grow, area.hi.y + grow, kAgreeMm});
      for (int i = 0; i < 8; ++i)
        there.add(s.frame.to_parent({(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                                     (i & 4) != 0 ? box.hi.z : box.lo.z}));
      if (!s.area.empty()) items_.push_back({&s, there});
    }
  }
  [[nodiscard]] bool remove(Vec3 p) const {
    return std::any_of(items_.begin(), items_.end(), [&](const auto& i) {
      const Box3& b = i.second;
      return p.x >= b.lo.x && p.x <= b.hi.x && p.y >= b.lo.y && p.y <= b.hi.y && p.z >= b.lo.z &&
             p.z <= b.hi.z && removes(*i.first, p);
    });
  }

 private:
  std::vector<std::pair<const FeatureShape*, Box3>> items_;
};

/// The own reading, the same way.
class Own {
 public:
  explicit Own(const Reading& r) {
    for (const Solid& s : r.solids) {
      const Box3 box = s.box();
      Box3 there;
      for (int i = 0; i < 8; ++i)
        there.add(s.frame.to_parent({(i & 1) != 0 ? box.hi.x + kAgreeMm : box.lo.x - kAgreeMm,
                                     (i & 2) != 0 ? box.hi.y + kAgreeMm : box.lo.y - kAgreeMm,
                                     (i & 4) != 0 ? box.hi.z : box.lo.z}));
      const auto* area = std::get_if<Area>(&s.form);
      items_.push_back({&s, there, area != nullptr && (area->around || area->only_mm > 0.0)});
    }
  }
  [[nodiscard]] PointState at(Vec3 p) const {
    PointState out = PointState::kStays;
    for (const auto& [s, b, wide] : items_) {
      if (!wide &&
          (p.x < b.lo.x || p.x > b.hi.x || p.y < b.lo.y || p.y > b.hi.y || p.z < b.lo.z || p.z > b.hi.z))
        continue;
      const PointState said = s->at(s->frame.to_local(p));
      if (said == PointState::kRemoved) return said;
      if (said == PointState::kNotStated) out = said;
    }
    return out;
  }

 private:
  struct Item {
    const Solid* solid;
    Box3 box;
    bool wide;  ///< it says something of places outside its box
  };
  std::vector<Item> items_;
};

std::array<Vec3, 6> round_about(Vec3 p, double by) {
  return {p + Vec3{by, 0, 0},  p + Vec3{-by, 0, 0}, p + Vec3{0, by, 0},
          p + Vec3{0, -by, 0}, p + Vec3{0, 0, by},  p + Vec3{0, 0, -by}};
}

/// Places through a shape of the planner's: what it has and the file does not is nowhere near the file's.
std::vector<Vec3> places_of(const FeatureShape& s, const std::vector<Solid>& own) {
  std::vector<Vec3> out;
  if (s.area.empty()) return out;
  auto b = geometry::bounds(s.area);
  // What is drawn out over the edges of the piece is looked at near to the own reading only.
  if (s.kind == ShapeKind::kStep || s.kind == ShapeKind::kOutside) {
    geometry::Box2 near;
    for (const Solid& o : own) {
      const Vec3 p = s.frame.to_local(o.frame.origin);
      near.lo = {std::min(near.lo.x, p.x - kSaidBeside), std::min(near.lo.y, p.y - kSaidBeside)};
      near.hi = {std::max(near.hi.x, p.x + kSaidBeside), std::max(near.hi.y, p.y + kSaidBeside)};
    }
    if (near.lo.x < near.hi.x) b = near;
  }
  constexpr int kGrid = 5;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      for (const double z : {-0.05, -0.55, -0.95, -1.05})
        out.push_back(s.frame.to_parent({b.lo.x + (b.hi.x - b.lo.x) * (i + 0.5) / kGrid,
                                         b.lo.y + (b.hi.y - b.lo.y) * (k + 0.5) / kGrid, z * s.depth_mm}));
    }
  }
  return out;
}

std::string place(Vec3 p) { return "X" + plain(p.x) + " Y" + plain(p.y) + " Z" + plain(p.z); }

std::string told(const Reading& own, Vec3 p) {
  const Solid* best = nullptr;
  double near = 1e300;
  for (const Solid& s : own.solids) {
    const Box3 box = s.box();
    const Vec3 q = s.frame.to_local(p);
    const double d = std::max(
        {box.lo.x - q.x, q.x - box.hi.x, box.lo.y - q.y, q.y - box.hi.y, box.lo.z - q.z, q.z - box.hi.z});
    if (d < near) {
      near = d;
      best = &s;
    }
  }
  if (best == nullptr) return "nothing";
  return std::string(model::noun_type(best->noun.type).keyword) + " at " + place(best->frame.origin) + ", " +
         mm(best->depth_mm) + " deep";
}

std::string told(const std::vector<FeatureShape>& shapes, Vec3 p) {
  const FeatureShape* best = nullptr;
  double near = 1e300;
  for (const FeatureShape& s : shapes) {
    if (s.area.empty()) continue;
    const auto b = geometry::bounds(s.area);
    const Vec3 q = s.frame.to_local(p);
    const double d =
        std::max({b.lo.x - q.x, q.x - b.hi.x, b.lo.y - q.y, q.y - b.hi.y, q.z, -s.depth_mm - q.z});
    if (d < near) {
      near = d;
      best = &s;
    }
  }
  if (best == nullptr) return "nothing";
  return std::string(model::to_text(best->kind)) + " at " + place(best->frame.origin) + ", " +
         mm(best->depth_mm) + " deep";
}

/// Sizes that are no volume of their own: threads, and the radius between wall and floor.
std::optional<std::string> other_sizes(const Reading& own, const std::vector<FeatureShape>& planner) {
  const auto differ = [](double a, double b) { return std::abs(a - b) > 0.5 * kAgreeMm; };
  for (const FeatureShape& s : planner) {
    if (s.kind == ShapeKind::kThread) {
      for (const Solid& o : own.solids) {
        const auto* b = std::get_if<Bore>(&o.form);
        if (b == nullptr) continue;
        if (differ(b->thread_major_mm, s.thread_major_mm) || differ(b->thread_depth_mm, s.thread_depth_mm))
          return "its thread is " + mm(b->thread_major_mm) + " wide and " + mm(b->thread_depth_mm) +
                 " long by the file, " + mm(s.thread_major_mm) + " and " + mm(s.thread_depth_mm) +
                 " by the planner's reading";
        if (differ(b->thread_pitch_mm, s.thread_pitch_mm) || b->left_hand != s.thread_left_hand)
          return "its thread has a pitch of " + mm(b->thread_pitch_mm) +
                 (b->left_hand ? ", left-hand," : ", right-hand,") + " by the file, and of " +
                 mm(s.thread_pitch_mm) + (s.thread_left_hand ? ", left-hand," : ", right-hand,") +
                 " by the planner's reading";
      }
    }
  }
  if (own.solids.size() == 1 && planner.size() == 1 && planner[0].kind != ShapeKind::kThread) {
    double foot = -1.0;
    if (const auto* a = std::get_if<Area>(&own.solids[0].form)) {
      foot = a->foot_radius_mm;
      for (const Standing& s : a->standing) foot = std::max(foot, s.foot_radius_mm);
    }
    if (const auto* g = std::get_if<Groove>(&own.solids[0].form)) foot = g->foot_radius_mm;
    if (foot >= 0.0 && differ(foot, model::largest_fillet_mm(planner[0])))
      return "the radius between its walls and its floor is " + mm(foot) + " by the file, " +
             mm(model::largest_fillet_mm(planner[0])) + " by the planner's reading";
  }
  return std::nullopt;
}

/// By how much two readings that mean the same may differ, mm.
double agreed(const Reading& own, const std::vector<FeatureShape>& planner) {
  double out = kAgreeMm;
  // A round floor of a slot is 16 chords of a quarter turn in the planner's section.
  for (const FeatureShape& s : planner)
    out = std::max(out, kAgreeMm + s.slot_bottom_radius_mm * (1.0 - std::cos(std::numbers::pi / 64.0)));
  // A slot that ends on an arc is cut off square to the planner's last chord, which leans by half its turn.
  constexpr double kChord = 0.001;
  for (const Solid& s : own.solids) {
    const auto* g = std::get_if<Groove>(&s.form);
    for (std::size_t i = 0; g != nullptr && !g->loop && i < g->course.edges.size(); ++i) {
      const Edge& e = g->course.edges[i];
      if (e.arc()) out = std::max(out, kAgreeMm + g->half_mm * std::sqrt(2.0 * kChord / e.radius_mm));
    }
  }
  return out;
}

}  // namespace

bool removes(const FeatureShape& s, Vec3 p) {
  const Vec3 q = s.frame.to_local(p);
  if (q.z > 0.0) return false;
  if (s.kind == ShapeKind::kToolpath || s.kind == ShapeKind::kFreeform) return false;
  if (model::has(s.kind, model::ShapeTrait::kSwept) && undercut(s)) return in_section(s, q);
  const bool hole = s.kind == ShapeKind::kHole || s.kind == ShapeKind::kThread;
  if (hole && s.bottom_diameter_mm > s.diameter.nominal_mm && q.z > -s.depth_mm) {
    const double share = -q.z / s.depth_mm;
    const double wide = s.diameter.nominal_mm + share * (s.bottom_diameter_mm - s.diameter.nominal_mm);
    return std::hypot(q.x, q.y) <= 0.5 * wide;
  }
  const auto floor = model::floor_at(s, xy(q));
  if (!floor) return false;
  return q.z > *floor || (s.through && *floor <= -s.depth_mm + 1e-9);
}

std::optional<Disagreement> disagreement(const Reading& own, const std::vector<FeatureShape>& planner,
                                         const Box3& raw) {
  if (!own.unread.empty() || own.nothing) return std::nullopt;
  for (const FeatureShape& s : planner) {
    if (s.kind == ShapeKind::kSphericalCap || s.kind == ShapeKind::kRoundedEnd) return std::nullopt;
  }
  if (const auto what = other_sizes(own, planner)) return Disagreement{{}, false, {}, {}, *what};
  const Shapes theirs(planner);
  const Own mine(own);
  const double tolerance = agreed(own, planner);
  const auto differ = [&](Vec3 p) -> std::optional<Disagreement> {
    tick();
    if (!raw.empty() && (p.x < raw.lo.x || p.x > raw.hi.x || p.y < raw.lo.y || p.y > raw.hi.y ||
                         p.z < raw.lo.z || p.z > raw.hi.z))
      return std::nullopt;
    const PointState said = mine.at(p);
    if (said == PointState::kNotStated) return std::nullopt;
    const bool removed = said == PointState::kRemoved;
    if (theirs.remove(p) == removed) return std::nullopt;
    for (const Vec3 q : round_about(p, tolerance)) {
      if (mine.at(q) != said) return std::nullopt;
    }
    for (const Vec3 q : round_about(p, 0.5 * tolerance)) {
      if (theirs.remove(q) == removed) return std::nullopt;
    }
    return Disagreement{p, removed, told(own, p), told(planner, p), {}};
  };
  for (const Solid& s : own.solids) {
    for (const Vec3 p : places_of(s, tolerance)) {
      if (auto d = differ(p)) return d;
    }
  }
  for (const FeatureShape& s : planner) {
    for (const Vec3 p : places_of(s, own.solids)) {
      if (auto d = differ(p)) return d;
    }
  }
  return std::nullopt;
}

}  // namespace capstan::verify::volumes

namespace capstan::verify {

std::vector<PlannersReading> planners_readings(const model::Model& m, const std::set<model::AnyRef>* of) {
  std::vector<PlannersReading> out;
  for (const auto f : m.all_below(model::TypeId::kManufacturingFeature)) {
    if (of != nullptr && !of->contains(f)) continue;
    poll();
    if (auto shapes = model::shapes_of(m, model::Ref<model::ManufacturingFeature>(f)))
      out.push_back({f, *std::move(shapes)});
  }
  return out;
}

}  // namespace capstan::verify
