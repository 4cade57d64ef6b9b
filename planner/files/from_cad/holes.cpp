#include "planner/files/from_cad/holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/features/tip_angle.h"
#include "planner/model/nouns/profile.h"

namespace capstan::from_cad {
namespace {

using exchange::Carrier;

/// Places on the rim of a bore at which what stands above it is looked for. Default, unsourced: a part that
/// reaches over a rim covers more than an eighth of it.
constexpr int kRim = 16;
/// So far within its rim, mm and as a share of the radius: beyond the chords of the mesh.
constexpr double kWithinMm = 0.03;
constexpr double kWithin = 0.02;
/// The full angle of a sharper point has no tip_angle that is read back.
constexpr double kSharpestTip = model::kHalfTipDegrees * std::numbers::pi / 180.0;

bool same(double a, double b) { return std::abs(a - b) < kLevelMm; }

std::vector<Vec2> rim(Vec2 centre, double radius_mm) {
  std::vector<Vec2> out{centre};
  const double r = std::max(0.0, radius_mm * (1.0 - kWithin) - kWithinMm);
  for (int i = 0; i < kRim; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kRim;
    out.push_back(centre + r * Vec2{std::cos(a), std::sin(a)});
  }
  return out;
}

/// A fillet about the axis.
struct Fillet {
  double hi = 0.0, lo = 0.0, radius_mm = 0.0, wall_radius_mm = 0.0;
};

/// Bores of one radius, one behind the other, are one: a gap between two ears is no shelf.
void join_bores(std::vector<Bore>& bores) {
  std::vector<Bore> out;
  for (const Bore& b : bores) {
    if (!out.empty() && !b.cone() && !out.back().cone() && same(b.top_radius_mm, out.back().top_radius_mm)) {
      out.back().bottom_mm = std::min(out.back().bottom_mm, b.bottom_mm);
    } else {
      out.push_back(b);
    }
  }
  bores = std::move(out);
}

struct Sections {
  std::vector<Bore> bores;  ///< from the mouth inwards, heights along the frame's z
  HoleEnd end = HoleEnd::kThrough;
  double tip_angle_rad = 0.0, end_radius_mm = 0.0, lowest_mm = 0.0;
  std::vector<std::uint32_t> fillets;  ///< faces at the bottom of the last bore, ascending
};

std::optional<Sections> sections_of(const Part& part, const recognise::Feature& feature,
                                    const geometry::Placement& frame, std::string& why) {
  Sections out;
  std::optional<double> floor;  ///< the lowest plane that looks up
  std::vector<Fillet> fillets;
  for (const std::uint32_t f : feature.faces) {
    const exchange::Face& face = part.brep().faces[f];
    const auto [lo, hi] = part.span(frame, {f});
    switch (face.carrier) {
      case Carrier::kCylinder: {
        const auto known = std::find_if(out.bores.begin(), out.bores.end(), [&](const Bore& b) {
          return !b.cone() && same(b.top_radius_mm, face.radius) && lo < b.top_mm + kLevelMm &&
                 hi > b.bottom_mm - kLevelMm;
        });
        if (known == out.bores.end()) {
          out.bores.push_back({hi, lo, face.radius, face.radius});
        } else {
          known->top_mm = std::max(known->top_mm, hi);
          known->bottom_mm = std::min(known->bottom_mm, lo);
        }
        break;
      }
      case Carrier::kCone: {
        const double base = dot(face.point, frame.z);
        const double slope = std::tan(face.half_angle) * (dot(face.axis, frame.z) > 0.0 ? 1.0 : -1.0);
        const double at_lo = std::max(0.0, face.radius + (lo - base) * slope);
        const double at_hi = std::max(0.0, face.radius + (hi - base) * slope);
        if (at_lo < 0.02 * at_hi) {
          out.end = HoleEnd::kConical;
          out.tip_angle_rad = 2.0 * face.half_angle;
        } else if (std::none_of(out.bores.begin(), out.bores.end(), [&](const Bore& b) {
                     return b.cone() && same(b.top_mm, hi) && same(b.bottom_mm, lo);
                   })) {
          out.bores.push_back({hi, lo, at_hi, at_lo});
        }
        break;
      }
      case Carrier::kPlane:
        if (dot(normal_of(face), frame.z) > 0.5) {
          floor = floor ? std::min(*floor, lo) : lo;
        }
        break;
      case Carrier::kSphere:
        out.end = HoleEnd::kSpherical;
        out.end_radius_mm = face.radius;
        out.lowest_mm = lo;
        break;
      case Carrier::kTorus:
        out.fillets.push_back(f);
        fillets.push_back({hi, lo, face.minor_radius, face.radius + face.minor_radius});
        break;
      default:
        why = "one of its faces is no plane, cylinder, cone, sphere or torus";
        return std::nullopt;
    }
  }
  if (out.bores.empty()) {
    why = "it has no cylinder";
    return std::nullopt;
  }
  std::stable_sort(out.bores.begin(), out.bores.end(),
                   [](const Bore& a, const Bore& b) { return a.top_mm > b.top_mm; });
  join_bores(out.bores);
  Bore& last = out.bores.back();
  for (const Fillet& f : fillets) {
    if (!floor) {
      why = "a fillet of " + trimmed(f.radius_mm, 3) + " mm ends its wall, but it has no flat bottom";
      return std::nullopt;
    }
    const bool at_bottom = same(f.lo, *floor) && same(f.hi, last.bottom_mm) &&
                           same(f.wall_radius_mm, last.bottom_radius_mm) &&
                           (out.end == HoleEnd::kThrough || out.end == HoleEnd::kRounded) &&
                           same(f.radius_mm, fillets.front().radius_mm);
    if (!at_bottom) {
      why = "it has a fillet of " + trimmed(f.radius_mm, 3) +
            " mm between its bores; a fillet is written at the bottom of the last bore only";
      return std::nullopt;
    }
    out.end = HoleEnd::kRounded;
    out.end_radius_mm = f.radius_mm;
  }
  if (out.end == HoleEnd::kThrough && floor && same(*floor, last.bottom_mm)) out.end = HoleEnd::kFlat;
  if (out.end == HoleEnd::kRounded) last.bottom_mm = *floor;
  if (out.end == HoleEnd::kConical && out.tip_angle_rad <= kSharpestTip + 1e-6) {
    why = "its conical bottom has a point of " + trimmed(out.tip_angle_rad * 180.0 / std::numbers::pi, 2) +
          " degrees; a tip_angle of " + trimmed(model::kHalfTipDegrees, 0) +
          " degrees or less is read as another angle";
    return std::nullopt;
  }
  return out;
}

/// Whether nothing of the part stands above a disc. `but`: faces that are not looked at, a fillet at its rim.
bool free_above(const Part& part, const geometry::Placement& frame, Vec2 centre, double radius_mm,
                double z_mm, const std::vector<std::uint32_t>& but = {}) {
  const Cleared& c = part.cleared(frame, z_mm, but);
  const auto points = rim(centre, radius_mm);
  return std::all_of(points.begin(), points.end(),
                     [&](Vec2 p) { return room_at(c, p) >= 0 || !geometry::contains(c.raw, p); });
}

/// Takes the cone at the far end of a hole that goes through, as it is where both mouths are chamfered. The
/// bore above it goes on to the end.
std::optional<Bore> take_far_cone(Sections& s) {
  if (s.end != HoleEnd::kThrough || s.bores.size() < 2) return std::nullopt;
  const Bore last = s.bores.back();
  Bore& before = s.bores[s.bores.size() - 2];
  if (!(last.bottom_radius_mm > last.top_radius_mm + kLevelMm) || before.cone() ||
      !same(before.bottom_radius_mm, last.top_radius_mm))
    return std::nullopt;
  before.bottom_mm = last.bottom_mm;
  s.bores.pop_back();
  return last;
}

/// The cone at the far end of a hole, made from there over the hole that is there.
Hole far_hole(const geometry::Placement& frame, Vec2 centre, const Bore& cone) {
  Hole out;
  out.frame = Part::frame_along(-1.0 * frame.z);
  out.frame.origin = frame.to_parent({centre.x, centre.y, cone.bottom_mm});
  out.bores = {{0.0, -cone.height_mm(), cone.bottom_radius_mm, cone.top_radius_mm}};
  out.end = HoleEnd::kFlat;
  return out;
}

/// Whether a hole removes a place of the workpiece.
bool clears(const Hole& hole, Vec3 at) {
  const Vec3 p = hole.frame.to_local(at);
  return std::any_of(hole.bores.begin(), hole.bores.end(), [&](const Bore& b) {
    return p.z < b.top_mm && p.z > b.bottom_mm && norm(xy(p)) < b.bottom_radius_mm;
  });
}

}  // namespace

bool Bore::cone() const { return std::abs(top_radius_mm - bottom_radius_mm) > kLevelMm; }

double Bore::height_mm() const { return top_mm - bottom_mm; }

std::optional<Hole> hole_of(const Part& part, const recognise::Feature& feature, std::string& why) {
  Vec3 on_axis;
  for (const std::uint32_t f : feature.faces) {
    if (part.brep().faces[f].carrier == Carrier::kCylinder) on_axis = part.brep().faces[f].point;
  }
  std::vector<Vec3> sides{feature.access};
  if (feature.through) sides.push_back(-1.0 * feature.access);
  for (const Vec3 side : sides) {
    const geometry::Placement frame = Part::frame_along(side);
    std::string fault;
    auto s = sections_of(part, feature, frame, fault);
    const auto say = [&why](const std::string& reason) {
      if (why.empty()) why = reason;  // that of the first side, which recognition chose
    };
    if (!s) {
      say(fault);
      continue;
    }
    const Vec2 centre = xy(frame.to_local(on_axis));
    const auto far = take_far_cone(*s);
    bool narrows = true;
    bool free = true;
    for (std::size_t i = 0; i < s->bores.size(); ++i) {
      const Bore& b = s->bores[i];
      narrows = narrows && b.bottom_radius_mm < b.top_radius_mm + kLevelMm;
      // What follows a cone takes up its lower radius; cones stand at the mouth alone.
      if (b.cone()) narrows = narrows && i == 0 && s->bores.size() > 1;
      if (i > 0) narrows = narrows && b.top_radius_mm < s->bores[i - 1].bottom_radius_mm + kLevelMm;
      if (i > 0 && s->bores[0].cone() && i == 1)
        narrows = narrows && same(b.top_radius_mm, s->bores[0].bottom_radius_mm);
      const bool rounded = s->end == HoleEnd::kRounded && i + 1 == s->bores.size();
      free = free && free_above(part, frame, centre, b.bottom_radius_mm, b.bottom_mm,
                                rounded ? s->fillets : std::vector<std::uint32_t>{});
    }
    if (!narrows) {
      say("it widens below its mouth, or has a cone that is not at its mouth");
      continue;
    }
    if (!free) {
      say("the part itself stands above it: no tool comes to it along its axis");
      continue;
    }
    Hole out;
    out.frame = frame;
    const double mouth = s->bores.front().top_mm;
    out.frame.origin = frame.to_parent({centre.x, centre.y, mouth});
    out.bores = s->bores;
    for (Bore& b : out.bores) {
      b.top_mm -= mouth;
      b.bottom_mm -= mouth;
    }
    out.end = s->end;
    out.tip_angle_rad = s->tip_angle_rad;
    out.end_radius_mm = s->end_radius_mm;
    out.lowest_mm = s->lowest_mm - mouth;
    out.faces = feature.faces;
    if (!far) return out;
    Hole cone = far_hole(frame, centre, *far);
    cone.faces = feature.faces;
    const geometry::Placement below = Part::frame_along(cone.frame.z);
    const Vec3 end = below.to_local(cone.frame.origin);
    const bool reached = free_above(part, below, xy(end), far->top_radius_mm, end.z - far->height_mm());
    out.far = std::make_shared<const Hole>(std::move(cone));
    if (reached) return out;
    say("the part itself stands below the cone at its far end");
  }
  return std::nullopt;
}

void raise(const Part& part, const std::vector<Room>& rooms, Hole& hole) {
  const geometry::Placement frame = Part::frame_along(hole.frame.z);
  const Vec3 at = frame.to_local(hole.frame.origin);
  const double top = part.raw_span(frame).second;
  if (top - at.z < kLevelMm || hole.bores.front().cone()) return;  // a cone ends at its mouth
  const std::vector<Vec2> points = rim(xy(at), hole.bores.front().top_radius_mm);
  constexpr int kHeights = 8;
  const auto cleared = [&](Vec2 p, double z) {
    const Vec3 place = frame.to_parent({p.x, p.y, z});
    return std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) { return clears(r, place); });
  };
  bool all = true;
  for (int i = 0; i < kHeights && all; ++i) {
    const double z = at.z + kLevelMm + (top - at.z - 2.0 * kLevelMm) * i / (kHeights - 1);
    all = std::all_of(points.begin(), points.end(), [&](Vec2 p) { return cleared(p, z); });
  }
  if (all) return;
  double to = top;
  for (const Room& r : rooms) {
    if (!(r.frame.z == frame.z) || r.level_mm < at.z || r.level_mm > to) continue;
    if (std::all_of(points.begin(), points.end(), [&](Vec2 p) { return geometry::contains(r.area, p); }))
      to = r.level_mm;
  }
  const double by = to - at.z;
  hole.frame.origin = hole.frame.origin + by * hole.frame.z;
  for (Bore& b : hole.bores) {
    b.top_mm -= by;
    b.bottom_mm -= by;
  }
  hole.bores.front().top_mm = 0.0;
  hole.lowest_mm -= by;
}

void end(const Part& part, const std::vector<Room>& rooms, std::vector<Hole>& holes) {
  for (Hole& hole : holes) {
    if (hole.end != HoleEnd::kThrough) continue;
    const Bore& last = hole.bores.back();
    const Vec3 end = hole.frame.to_parent({0.0, 0.0, last.bottom_mm});
    const geometry::Placement below = Part::frame_along(-1.0 * hole.frame.z);
    const Vec3 at = below.to_local(end);
    if (part.raw_span(below).second - at.z < kLevelMm) continue;
    if (free_above(part, below, xy(at), last.bottom_radius_mm, at.z)) continue;
    const Vec3 behind = end - 2.0 * kLevelMm * hole.frame.z;
    const bool open =
        std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) { return clears(r, behind); }) ||
        std::any_of(holes.begin(), holes.end(), [&](const Hole& h) { return clears(h, behind); });
    if (!open) hole.end = HoleEnd::kFlat;
  }
}

namespace {

model::AngleTaper taper_of(const Bore& cone) {
  model::AngleTaper out;
  out.angle = std::atan2(cone.top_radius_mm - cone.bottom_radius_mm, cone.height_mm());
  return out;
}

}  // namespace

AnyRef noun_of(const Hole& hole, model::Model& m, Ref<model::Workpiece> piece, const std::string& number) {
  Nouns nouns(m);
  const auto round = [&](const std::string& name, const geometry::Placement& at, double depth_mm,
                         double radius_mm) {
    model::RoundHole f;
    f.its_id = name;
    f.its_workpiece = piece;
    f.its_operations.given = true;
    f.feature_placement = nouns.placement(at);
    f.depth = nouns.depth(depth_mm);
    f.diameter = nouns.length(2.0 * radius_mm);
    return f;
  };
  const auto last = [&](model::RoundHole& f) {
    switch (hole.end) {
      case HoleEnd::kThrough:
        f.bottom_condition = m.add(model::ThroughBottomCondition{});
        break;
      case HoleEnd::kFlat:
        f.bottom_condition = m.add(model::FlatHoleBottom{});
        break;
      case HoleEnd::kRounded: {
        model::FlatWithRadiusHoleBottom b;
        b.corner_radius = nouns.length(hole.end_radius_mm);
        f.bottom_condition = m.add(b);
        break;
      }
      case HoleEnd::kConical: {
        model::ConicalHoleBottom b;
        b.tip_angle = hole.tip_angle_rad;
        f.bottom_condition = m.add(b);
        break;
      }
      case HoleEnd::kSpherical: {
        model::SphericalHoleBottom b;
        b.radius = nouns.length(hole.end_radius_mm);
        f.bottom_condition = m.add(b);
        break;
      }
    }
  };
  const double deepest = hole.end == HoleEnd::kSpherical ? -hole.lowest_mm : -hole.bores.back().bottom_mm;
  const bool sunk = hole.bores.front().cone();
  const std::string name = "HOLE " + number;
  if (hole.bores.size() == 1) {
    auto f = round(name, hole.frame, deepest, hole.bores.front().top_radius_mm);
    if (sunk) f.change_in_diameter = m.add(taper_of(hole.bores.front()));
    last(f);
    return m.add(f);
  }
  // Elements are placed relative to their compound.
  model::RefList<model::Noun> elements;
  for (std::size_t i = sunk ? 1 : 0; i < hole.bores.size(); ++i) {
    const Bore& b = hole.bores[i];
    const bool end = i + 1 == hole.bores.size();
    // Below a countersink the bore is drawn from the mouth.
    const double top = sunk && i == 1 ? 0.0 : b.top_mm;
    auto f = round(name + "." + std::to_string(elements.size() + 1), {.origin = {0.0, 0.0, top}},
                   top + (end ? deepest : -b.bottom_mm), b.top_radius_mm);
    if (end) {
      last(f);
    } else {
      f.bottom_condition = m.add(model::FlatHoleBottom{});
    }
    elements.push_back(Ref<model::Noun>(AnyRef(m.add(f))));
  }
  if (sunk) {
    const Bore& b = hole.bores.front();
    auto f = round(name + "." + std::to_string(elements.size() + 1), {}, -b.bottom_mm, b.top_radius_mm);
    f.change_in_diameter = m.add(taper_of(b));
    // Of a blind hole the cone ends in the bore: through, it would go on to the underside of the piece.
    if (hole.end == HoleEnd::kThrough)
      f.bottom_condition = m.add(model::ThroughBottomCondition{});
    else
      f.bottom_condition = m.add(model::FlatHoleBottom{});
    elements.push_back(Ref<model::Noun>(AnyRef(m.add(f))));
  }
  const auto compound = [&](auto f) -> AnyRef {
    f.its_id = name;
    f.its_workpiece = piece;
    f.its_operations.given = true;
    f.feature_placement = nouns.placement(hole.frame);
    f.elements = elements;
    return m.add(f);
  };
  return sunk ? compound(model::CountersunkHole{}) : compound(model::CounterboreHole{});
}

}  // namespace capstan::from_cad
