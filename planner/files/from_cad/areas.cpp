#include "planner/files/from_cad/areas.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "planner/files/from_cad/drawn.h"
#include "planner/model/features/shape/open_reach.h"
#include "planner/model/nouns/profile.h"

namespace capstan::from_cad {
namespace {

using geometry::Loop;
using geometry::Region;

/// How far past an open side a feature goes, at least; and where it is entered elsewhere: half the side,
/// which is the widest that fits between its walls, and a little more, mm; no mill of the shipped libraries
/// needs more than the most. Default, unsourced.
constexpr double kLeastPastMm = 1.0;
constexpr double kMostPastMm = 16.0;
/// A round wall that ends along the raw piece's side (of this cosine at least) goes on along it and then
/// leads away at this angle. A mill of radius kMostPastMm that keeps off there touches the wall up to its
/// end: so far the corner between the two keeps it off. Derived.
constexpr double kAlongSide = 0.9998;
constexpr double kAwayRad = 10.0 * std::numbers::pi / 180.0;
const double kOnAlongMm = kMostPastMm * std::tan(0.5 * kAwayRad), kAwayMm = kMostPastMm * std::tan(kAwayRad);

Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }
Vec2 right_of(Vec2 d) { return {d.y, -d.x}; }

/// Runs of walls, and of open sides, round a boundary: alternately, beginning with walls.
std::vector<std::vector<Piece>> runs(const std::vector<Piece>& outer) {
  const std::size_t n = outer.size();
  std::size_t first = 0;
  while (first < n && !(outer[first].open == false && outer[(first + n - 1) % n].open)) ++first;
  if (first == n) return {outer};
  std::vector<std::vector<Piece>> out;
  for (std::size_t k = 0; k < n; ++k) {
    const Piece& p = outer[(first + k) % n];
    if (out.empty() || out.back().front().open != p.open) out.emplace_back();
    out.back().push_back(p);
  }
  return out;
}

/// Sheer, and open all round, or beside one arc that bulges: the tool goes round what stands.
bool is_contour(const Room& room, const Drawn& d) {
  if (room.contour) return true;
  if ((!room.through && !room.sheer) || d.outer.empty()) return false;
  if (std::all_of(d.outer.begin(), d.outer.end(), [](const Piece& p) { return p.open; })) return true;
  const auto sides = runs(d.outer);
  return sides.size() == 2 && sides[0].size() == 1 && sides[0][0].sweep_rad < 0.0;
}

class Maker {
 public:
  Maker(const Room& room, const Drawn& d, model::Model& m, Ref<model::Workpiece> piece, std::string number)
      : room_(room), d_(d), m_(m), nouns_(m), piece_(piece), number_(std::move(number)) {}

  AnyRef make() {
    if (room_.contour) return outside();
    if (!room_.stands.empty()) return face(over_all(), d_.islands);
    if (d_.outer.empty()) return {};
    const auto sides = runs(d_.outer);
    const bool walls = std::any_of(d_.outer.begin(), d_.outer.end(), [](const Piece& p) { return !p.open; });
    const bool open = std::any_of(d_.outer.begin(), d_.outer.end(), [](const Piece& p) { return p.open; });
    if (!open) return closed_pocket();
    if (!walls) return d_.islands.empty() ? face(over_all(), {}) : face(d_.outer, d_.islands);
    if (sides.size() == 2) {
      const auto& wall = sides[0];
      if (wall.size() == 1 && lies_beside(wall[0])) return step(wall[0]);
      return open_pocket(wall, sides[1]);
    }
    if (sides.size() == 4 && d_.islands.empty()) {
      if (const auto slot = straight_slot(sides)) return *slot;
    }
    return open_on_more_sides(sides);
  }

 private:
  template <class T>
  T feature(const std::string& name, const geometry::Placement& at) {
    T f;
    f.its_id = name + " " + number_;
    f.its_workpiece = piece_;
    f.its_operations.given = true;
    f.feature_placement = nouns_.placement(at);
    f.depth = nouns_.depth(d_.depth_mm);
    return f;
  }
  template <class T>
  T feature(const std::string& name) {
    return feature<T>(name, d_.at);
  }

  /// As it is drawn, round corners too: a radius beside the profile is a pocket's to state.
  Ref<model::ClosedProfile> profile(const std::vector<Piece>& pieces) {
    const bool round = std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.arc(); });
    double none = 0.0;
    if (!round || pieces.size() == 1) return nouns_.closed_profile(pieces, none);
    model::GeneralClosedProfile drawn;
    drawn.closed_profile_shape = nouns_.curve(pieces, true);
    return m_.add(drawn);
  }

  model::RefList<model::Boss> bosses(const std::vector<std::vector<Piece>>& islands) {
    model::RefList<model::Boss> out;
    out.given = true;
    for (const auto& outline : islands) {
      auto boss = feature<model::Boss>("BOSS");
      boss.its_id = "BOSS " + number_ + "." + std::to_string(out.size() + 1);
      std::vector<Piece> round = outline;
      std::reverse(round.begin(), round.end());
      for (Piece& p : round) {
        std::swap(p.from, p.to);
        p.sweep_rad = -p.sweep_rad;
      }
      boss.its_boundary = profile(round);
      if (d_.island_feet) boss.fillet_radius = nouns_.length(room_.blend_radius_mm);
      out.push_back(m_.add(boss));
    }
    return out;
  }

  Ref<model::PocketBottomCondition> bottom() {
    if (room_.through) return m_.add(model::ThroughPocketBottomCondition{});
    return m_.add(model::PlanarPocketBottomCondition{});
  }

  void radii(model::Pocket& f, double corner_mm) {
    if (corner_mm > 0.0) f.orthogonal_radius = nouns_.length(corner_mm);
    if (d_.wall_feet) f.planar_radius = nouns_.length(room_.blend_radius_mm);
  }

  AnyRef closed_pocket() {
    auto f = feature<model::ClosedPocket>("POCKET");
    double corner = 0.0;
    f.feature_boundary = nouns_.closed_profile(d_.outer, corner);
    f.its_boss = bosses(d_.islands);
    f.bottom_condition = bottom();
    radii(f, corner);
    if (room_.slope_rad > 0.0) f.slope = room_.slope_rad;
    return m_.add(f);
  }

  /// The direction of a piece where it ends, or begins.
  static Vec2 heading(const Piece& p, bool at_end) {
    if (!p.arc()) return unit(p.to - p.from);
    const Vec2 out = unit((at_end ? p.to : p.from) - p.centre);
    return p.sweep_rad > 0.0 ? Vec2{-out.y, out.x} : Vec2{out.y, -out.x};
  }

  /// An open side so far outside the raw piece: its corners in order, and what leads to the first from the
  /// wall before it and from the last to the wall behind it.
  struct Past {
    std::vector<Vec2> leads_out, corners, leads_in;
  };
  /// Whether a wall that leaves an area goes on along the side that it ends at, away from the area's mouth
  /// there.
  static bool runs_along(Vec2 wall, Vec2 inwards) { return dot(wall, inwards) < -kAlongSide; }

  /// `before` and `after` are the walls that meet it: where one leans over it, the side's end goes on in the
  /// wall's line, so that a mill makes the wall to its end; where a round wall ends along the raw piece's
  /// side, it goes on along that and then away from it, so that a mill rolls round the wall to its end and
  /// does not run along the side.
  static Past past(const std::vector<Piece>& run, double mm, const Piece& before, const Piece& after) {
    const std::size_t n = run.size();
    const auto along = [&](std::size_t i) { return unit(run[i].to - run[i].from); };
    const auto end = [&](Vec2 from, Vec2 wall, Vec2 side, Vec2 inwards) {
      const Vec2 outwards = right_of(side);
      const double sine = dot(wall, outwards);
      const bool leans = dot(wall, inwards) < -recognise::kSameAngleRad && sine > model::shape::kLeastMouthSine;
      if (!runs_along(wall, inwards))
        return std::vector<Vec2>{from + (leans ? (mm / sine) * wall : mm * outwards)};
      const Vec2 on = -1.0 * inwards, first = from + kOnAlongMm * on;
      std::vector<Vec2> out{first, first + kMostPastMm * on + kAwayMm * outwards};
      if (mm > kAwayMm) out.push_back(first + kMostPastMm * on + mm * outwards);
      return out;
    };
    Past out;
    out.leads_out = end(run[0].from, heading(before, true), along(0), along(0));
    out.leads_in = end(run[n - 1].to, -1.0 * heading(after, false), along(n - 1), -1.0 * along(n - 1));
    std::reverse(out.leads_in.begin(), out.leads_in.end());
    out.corners.push_back(out.leads_out.back());
    out.leads_out.pop_back();
    for (std::size_t i = 1; i < n; ++i) {
      const Vec2 a = right_of(along(i - 1)), b = right_of(along(i));
      out.corners.push_back(run[i].from + (mm / std::max(0.5, 1.0 + dot(a, b))) * (a + b));
    }
    out.corners.push_back(out.leads_in.front());
    out.leads_in.erase(out.leads_in.begin());
    return out;
  }

  AnyRef open_pocket(const std::vector<Piece>& wall, const std::vector<Piece>& mouth) {
    auto f = feature<model::OpenPocket>("OPEN POCKET");
    // A side that ends on the raw piece's would leave a film by rounding: it goes on past it.
    const Past sides = past(mouth, kLeastPastMm, wall.back(), wall.front());
    const std::vector<Vec2>& beyond = sides.corners;
    const auto line = [](Vec2 from, Vec2 to) { return Piece{from, to, {}, 0.0, 0.0, false}; };
    std::vector<Piece> walls;
    const auto go = [&](Vec2 from, const std::vector<Vec2>& by, Vec2 to) {
      for (const Vec2 p : by) {
        walls.push_back(line(from, p));
        from = p;
      }
      walls.push_back(line(from, to));
    };
    go(beyond.back(), sides.leads_in, wall.front().from);
    walls.insert(walls.end(), wall.begin(), wall.end());
    go(wall.back().to, sides.leads_out, beyond.front());
    std::vector<Piece> open;
    for (std::size_t i = 0; i + 1 < beyond.size(); ++i) open.push_back(line(beyond[i], beyond[i + 1]));
    f.open_boundary = nouns_.open_profile(walls);
    f.wall_boundary = nouns_.open_profile(open);
    f.its_boss = bosses(d_.islands);
    f.bottom_condition = bottom();
    radii(f, 0.0);
    return m_.add(f);
  }

  /// Whether all of the area lies square beside a straight wall, as a step does.
  [[nodiscard]] bool lies_beside(const Piece& wall) const {
    if (wall.arc()) return false;
    const Vec2 d = unit(wall.to - wall.from);
    return std::all_of(d_.outer.begin(), d_.outer.end(), [&](const Piece& p) {
      const double along = dot(p.from - wall.from, d);
      return along > -kLevelMm && along < norm(wall.to - wall.from) + kLevelMm;
    });
  }

  /// The area lies on the left of its boundary, a step on the right of its path.
  AnyRef step(const Piece& wall) {
    auto f = feature<model::Step>("STEP");
    const Vec2 d = unit(wall.from - wall.to);
    model::LinearPath path;
    const Vec2 begin = wall.to - kLeastPastMm * d;
    path.placement = nouns_.placement({.origin = {begin.x, begin.y, 0.0}});
    path.distance = nouns_.length(norm(wall.to - wall.from) + 2.0 * kLeastPastMm);
    path.its_direction = nouns_.direction({d.x, d.y, 0.0});
    f.open_boundary = m_.add(path);
    // ISO 10303-238 demands the profile of a step's wall, also where it has no fillet.
    model::VeeProfile vee;
    vee.profile_angle = std::numbers::pi / 2.0;
    vee.profile_radius = nouns_.length(d_.wall_feet ? room_.blend_radius_mm : 0.0);
    vee.tilt_angle = 0.0;
    f.wall_boundary = m_.add(vee);
    f.its_boss = bosses(d_.islands);
    return m_.add(f);
  }

  /// Two straight walls, parallel, open at both ends.
  std::optional<AnyRef> straight_slot(const std::vector<std::vector<Piece>>& sides) {
    if (sides[0].size() != 1 || sides[2].size() != 1 || sides[0][0].arc() || sides[2][0].arc())
      return std::nullopt;
    const Vec2 d = unit(sides[0][0].to - sides[0][0].from);
    const Vec2 back = unit(sides[2][0].to - sides[2][0].from);
    if (std::abs(cross(d, back)) > recognise::kSameAngleRad || dot(d, back) > 0.0) return std::nullopt;
    const Vec2 left{-d.y, d.x};
    const double width = dot(sides[2][0].from - sides[0][0].from, left);
    double lo = 1e300, hi = -1e300;
    for (const Piece& p : d_.outer) {
      lo = std::min(lo, dot(p.from, d));
      hi = std::max(hi, dot(p.from, d));
    }
    lo -= kLeastPastMm;
    hi += kLeastPastMm;
    const double middle = dot(sides[0][0].from, left) + 0.5 * width;
    const Vec2 from = lo * d + middle * left;
    geometry::Placement at = d_.at;  // its course begins at its placement
    at.origin = d_.at.to_parent({from.x, from.y, 0.0});
    auto f = feature<model::Slot>("SLOT", at);
    model::LinearPath path;
    path.distance = nouns_.length(hi - lo);
    path.its_direction = nouns_.direction({d.x, d.y, 0.0});
    f.course_of_travel = m_.add(path);
    model::SquareUProfile section;
    section.width = nouns_.length(width);
    section.first_radius = section.second_radius = nouns_.length(d_.wall_feet ? room_.blend_radius_mm : 0.0);
    section.first_angle = section.second_angle = std::numbers::pi / 2.0;
    f.swept_shape = m_.add(section);
    for (int i = 0; i < 2; ++i) f.end_conditions.push_back(m_.add(model::OpenSlotEndType{}));
    return m_.add(f);
  }

  /// A rectangle over all of the raw piece: what is open all round goes on past it, also where it leans.
  [[nodiscard]] std::vector<Piece> over_all() const {
    const Vec2 more{kLeastPastMm, kLeastPastMm};
    return pieces_of(geometry::rectangle(d_.around.lo - more, d_.around.hi + more).loops.front(), {}, {},
                     d_.chord_mm);
  }

  AnyRef face(const std::vector<Piece>& boundary, const std::vector<std::vector<Piece>>& islands) {
    auto f = feature<model::PlanarFace>("FACE");
    geometry::Box2 box;
    for (const Piece& p : boundary) {
      box.lo = {std::min(box.lo.x, p.from.x), std::min(box.lo.y, p.from.y)};
      box.hi = {std::max(box.hi.x, p.from.x), std::max(box.hi.y, p.from.y)};
    }
    model::LinearPath path;
    path.distance = nouns_.length(box.hi.y - box.lo.y);
    path.its_direction = nouns_.direction({0.0, 1.0, 0.0});
    f.course_of_travel = m_.add(path);
    model::NumericParameter size;
    size.parameter_name = "profile length";
    size.its_parameter_value = box.hi.x - box.lo.x;
    size.its_parameter_unit = "mm";
    model::LinearProfile across;
    across.profile_length = m_.add(size);
    f.removal_boundary = m_.add(across);
    f.face_boundary = profile(boundary);
    f.its_boss = bosses(islands);
    return m_.add(f);
  }

  /// Walls and open sides by turns: an open pocket that is entered by the widest of its open sides, and goes
  /// on past the raw piece at the others.
  AnyRef open_on_more_sides(const std::vector<std::vector<Piece>>& sides) {
    const auto width = [](const std::vector<Piece>& run) { return norm(run.back().to - run.front().from); };
    std::size_t mouth = 1;
    for (std::size_t i = 3; i < sides.size(); i += 2) {
      if (width(sides[i]) > width(sides[mouth])) mouth = i;
    }
    std::vector<Piece> wall;
    const auto go = [&](Vec2 to) {
      const Vec2 from = wall.back().to;
      wall.push_back({from, to, {}, 0.0, 0.0, false});
    };
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const auto& run = sides[(mouth + k) % sides.size()];
      if (!run.front().open) {
        wall.insert(wall.end(), run.begin(), run.end());
        continue;
      }
      const std::size_t at = (mouth + k) % sides.size();
      const Piece& before = sides[(at + sides.size() - 1) % sides.size()].back();
      const Piece& after = sides[(at + 1) % sides.size()].front();
      double mm = std::min(kMostPastMm, 0.5 * width(run) + kLeastPastMm);
      // The strip behind what leads away is as wide as any mill.
      if (runs_along(heading(before, true), unit(run.front().to - run.front().from)) ||
          runs_along(-1.0 * heading(after, false), unit(run.back().from - run.back().to)))
        mm = kAwayMm + 2.0 * kMostPastMm;
      const Past over = past(run, mm, before, after);
      for (const auto* points : {&over.leads_out, &over.corners, &over.leads_in})
        for (const Vec2 p : *points) go(p);
      go(run.back().to);
    }
    return open_pocket(wall, sides[mouth]);
  }

  /// The whole contour of what stands down to the underside of the raw piece.
  AnyRef outside() {
    const Region stands = geometry::subtract(d_.raw, d_.area);
    const auto parts = geometry::pieces(stands);
    Loop loop;
    for (const Loop& l : parts.empty() ? std::vector<Loop>{} : parts.front().loops) {
      if (geometry::signed_area(l) > 0.0) loop = l;
    }
    const auto round = pieces_of(loop, geometry::Region{}, d_.walls, d_.chord_mm, d_.flats);
    if (round.empty()) return {};
    auto f = feature<model::GeneralOutsideProfile>("OUTSIDE");
    model::LinearPath swept;
    swept.distance = nouns_.length(d_.depth_mm);
    swept.its_direction = nouns_.direction({0.0, 0.0, -1.0});
    f.profile_swept_shape = m_.add(swept);
    f.feature_boundary = Ref<model::Profile>(AnyRef(profile(round)));
    return m_.add(f);
  }

  const Room& room_;
  const Drawn& d_;
  model::Model& m_;
  Nouns nouns_;
  Ref<model::Workpiece> piece_;
  std::string number_;
};

bool same_area(const Region& a, const Region& b) {
  return geometry::area(geometry::subtract(a, b)) < kSpeckMm2 &&
         geometry::area(geometry::subtract(b, a)) < kSpeckMm2;
}

/// One room takes over what another is made of.
void take(Room& to, const Room& from) {
  std::vector<std::uint32_t> faces;
  std::set_union(to.faces.begin(), to.faces.end(), from.faces.begin(), from.faces.end(),
                 std::back_inserter(faces));
  to.faces = std::move(faces);
  to.recognised.insert(to.recognised.end(), from.recognised.begin(), from.recognised.end());
  to.blend_radius_mm = std::max(to.blend_radius_mm, from.blend_radius_mm);
}

}  // namespace

std::vector<Room> rooms_of(const Part& part, const recognise::Feature& feature, const Way& way) {
  std::vector<Room> out;
  const auto [lowest, highest] = part.raw_span(way.frame);
  for (const double level : way.levels_mm) {
    const Cleared& c = part.cleared(way.frame, level, way.blends);
    std::vector<bool> wanted(c.rooms.size(), false);
    for (const std::uint32_t f : feature.faces) {
      if (std::binary_search(way.blends.begin(), way.blends.end(), f)) continue;
      for (const Part::Spot& s : part.spots(f)) {
        const bool floor = dot(s.normal, way.frame.z) > 0.5;
        const Vec3 at = way.frame.to_local(floor ? s.at : s.at + kInFrontMm * s.normal);
        if (floor && std::abs(at.z - level) > kLevelMm) continue;
        const int room = room_at(c, xy(at));
        if (room >= 0) wanted[static_cast<std::size_t>(room)] = true;
      }
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!wanted[i]) continue;
      Room room;
      room.frame = way.frame;
      room.level_mm = level;
      room.top_mm = highest;
      room.through = level < lowest + kLevelMm;
      room.no_floor = way.no_floor;
      room.sheer =
          way.no_floor &&
          geometry::area(all_of(c)) - geometry::area(all_of(part.cleared(way.frame, lowest, {}))) < kSpeckMm2;
      room.raw = c.raw;
      room.area = c.rooms[i];
      room.blends = way.blends;
      room.blend_radius_mm = way.blend_radius_mm;
      room.slope_rad = way.slope_rad;
      room.faces = feature.faces;
      out.push_back(std::move(room));
    }
  }
  return out;
}

void settle(std::vector<Room>& rooms) {
  std::vector<Room> out;
  for (Room& room : rooms) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Room& r) {
      return r.frame.z == room.frame.z && std::abs(r.level_mm - room.level_mm) < kLevelMm &&
             same_area(r.area, room.area);
    });
    if (same == out.end()) {
      out.push_back(std::move(room));
      continue;
    }
    take(*same, room);
  }
  for (Room& room : out) {
    for (const Room& above : out) {
      if (!(above.frame.z == room.frame.z) || above.level_mm < room.level_mm + kLevelMm) continue;
      if (above.level_mm < room.top_mm &&
          geometry::area(geometry::subtract(room.area, above.area)) < kSpeckMm2)
        room.top_mm = above.level_mm;
    }
  }
  rooms = std::move(out);
}

void join_contours(const Part& part, std::vector<Room>& rooms) {
  std::vector<Room> out;
  for (Room& room : rooms) {
    room.contour = is_contour(room, drawn(part, room));
    const auto same = std::find_if(out.begin(), out.end(), [&](const Room& r) {
      return room.contour && r.contour && r.frame.z == room.frame.z &&
             std::abs(r.level_mm - room.level_mm) < kLevelMm && std::abs(r.top_mm - room.top_mm) < kLevelMm;
    });
    if (same == out.end()) {
      out.push_back(std::move(room));
      continue;
    }
    same->area = geometry::unite(same->area, room.area);
    take(*same, room);
  }
  rooms = std::move(out);
}

bool clears(const Room& room, Vec3 at) {
  const Vec3 p = room.frame.to_local(at);
  return p.z >= room.level_mm && geometry::contains(room.area, xy(p));
}

AnyRef noun_of(const Part& part, const Room& room, model::Model& m, Ref<model::Workpiece> piece,
               const std::string& number) {
  const Drawn d = drawn(part, room);
  return Maker(room, d, m, piece, number).make();
}

}  // namespace capstan::from_cad
