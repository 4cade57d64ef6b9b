#include "planner/making/toolpath/region/area/level.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/defaults.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostTurns = 5'000;
constexpr double kSameHeight = 1e-6;  // mm
constexpr double kAirPiece = 0.25;    // of the radius: how finely ways beside the piece are told
constexpr double kMostAirPieces = 4'000;

std::vector<Vec2> air_points(const WorkArea& w, const Region& centres, const Inside& material,
                             double radius) {
  std::vector<Vec2> out;
  if (!w.open) return out;
  for (const auto& loop : centres.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 d = loop[(i + 1) % loop.size()] - a;
      const int n = std::clamp(static_cast<int>(norm(d) / (0.5 * radius)), 1, 200);
      for (int k = 0; k < n; ++k) {
        const Vec2 p = a + (static_cast<double>(k) / n) * d;
        if (material.clear_of(p, radius + kAirBeside)) out.push_back(p);
      }
    }
  }
  return out;
}

/// Whether two tracks are one, piece by piece.
bool same(const Track& a, const Track& b) {
  return a.closed == b.closed && a.start == b.start && a.segments.size() == b.segments.size() &&
         std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(),
                    [](const Segment& x, const Segment& y) { return x.to == y.to && x.bend == y.bend; });
}

}  // namespace

HelixRadii helix_radii(const model::Cutter& c) {
  constexpr double kUsual = 0.9;                               // of the flat; default, unsourced
  constexpr double kLeast = 0.2, kLeastBesideTheCentre = 0.5;  // of the cutter's radius
  const double radius = 0.5 * c.cutting_diameter_mm;
  const double flat = std::max(radius - c.corner_radius_mm, 0.5 * radius);
  return {.least = (c.centre_cutting ? kLeast : kLeastBesideTheCentre) * radius,
          .usual = kUsual * flat,
          .most = flat};
}

double stepover_of(const PathJob& task) {
  const double d = task.cutter.cutting_diameter_mm;
  if (task.radial_depth_mm > 0.0) return std::min(task.radial_depth_mm, d);
  if (task.overlap && *task.overlap >= 0.0 && *task.overlap < 1.0) return (1.0 - *task.overlap) * d;
  return 0.5 * d;
}

Level::Level(const PathJob& task, const WorkArea& w, double tip_z, double material_z, double allowance)
    : z_mm(tip_z),
      from_mm(material_z),
      above_mm(material_z),
      allowance_mm(allowance),
      centres(centres_at(w, task.cutter, tip_z, allowance, task.allowance_bottom_mm)),
      inside(inset(centres, -kInsideSlack, 0.25 * kInsideSlack)),
      material(w.material),
      air(air_points(w, centres, material, 0.5 * task.cutter.cutting_diameter_mm)) {}

LevelCutter::LevelCutter(const PathJob& t, const WorkArea& a, PathWriter& w, Job& j)
    : task(t),
      area(a),
      writer(w),
      job(j),
      radius_mm(0.5 * t.cutter.cutting_diameter_mm),
      step_mm(stepover_of(t)) {}

const std::vector<Ring>& LevelCutter::rings_of(const geometry::Region& centres, double apart_mm,
                                               double cover_mm) {
  if (centres.loops != ringed_.loops || apart_mm != ringed_apart_mm_ || cover_mm != ringed_cover_mm_) {
    rings_ = rings(centres, apart_mm, cover_mm);
    ringed_ = centres;
    ringed_apart_mm_ = apart_mm;
    ringed_cover_mm_ = cover_mm;
  }
  return rings_;
}

void LevelCutter::warn(const std::string& code, const std::string& message) {
  tell(Severity::kWarning, code, message);
}

void LevelCutter::note(const std::string& code, const std::string& message) {
  tell(Severity::kNote, code, message);
}

void LevelCutter::tell(Severity severity, const std::string& code, const std::string& message) {
  for (const auto& d : said) {
    if (d.code == code && d.message == message) return;
  }
  said.push_back({.code = code, .severity = severity, .message = message});
  job.report({.code = code, .severity = severity, .message = about(task) + message});
}

double LevelCutter::gap(const Level& level) const {
  const bool cut = level.from_mm < task.start_z_mm - kSameHeight;
  return std::min(task.clearance_mm, cut ? kAirAbove : kAboveRaw);
}

namespace {

/// The ramp that an approach asks for, rad; 0: none.
double asked_ramp(const Approach& a) {
  const bool ramps = a.kind == Approach::Kind::kRamp || a.kind == Approach::Kind::kHelix ||
                     a.kind == Approach::Kind::kZigzag;
  return ramps ? a.angle_rad : 0.0;
}

}  // namespace

double LevelCutter::steepest() const {
  const double most = task.cutter.maximum_ramp_angle_rad;
  if (!(most > 0.0)) return 0.0;
  const double asked = asked_ramp(task.approach);
  return asked > 0.0 ? std::min({most, asked, 1.5}) : usual_ramp_rad(task);
}

double LevelCutter::ramp_angle() {
  const double most = task.cutter.maximum_ramp_angle_rad, asked = asked_ramp(task.approach);
  if (most > 0.0 && asked > most + 1e-9) {
    warn("TPA-CHANGED", "ramp angle " + trimmed(most * 180.0 / kPi, 2) + " instead of " +
                            trimmed(asked * 180.0 / kPi, 2) + " degrees: cutter " + task.cutter.id +
                            " allows no more");
  }
  return steepest();
}

double LevelCutter::way_down_mm(const Level& level) const {
  const double depth = level.from_mm - level.z_mm, angle = steepest();
  return angle > 0.0 ? depth / std::sin(angle) : depth;
}

void LevelCutter::go_above(const Level& level, Vec2 p) {
  const double z = level.from_mm + std::min(task.clearance_mm, kAboveRaw);
  if (writer.begun() && writer.at().z < writer.rapid_z_mm() - 1e-9 && z < writer.rapid_z_mm()) {
    const Vec2 here = xy(writer.at());
    // Above the level before, within its cleared area: no need to go out.
    if (norm(here - p) <= 6.0 * radius_mm && level.inside.contains(here, p)) {
      if (writer.at().z < z) writer.line({here.x, here.y, z}, MoveRole::kLink);
      writer.line({p.x, p.y, writer.at().z}, MoveRole::kLink);
      return;
    }
  }
  writer.over(p);
}

void LevelCutter::go_cleared(const Level& level, Vec2 p) {
  if (writer.begun() && std::abs(writer.at().z - level.z_mm) < 1e-9 && norm(xy(writer.at()) - p) < 1e-6)
    return;
  go_above(level, p);
  writer.descend(level.z_mm, level.z_mm);
}

bool LevelCutter::cut_to(const Level& level, Vec2 p) {
  if (!writer.begun() || std::abs(writer.at().z - level.z_mm) > 1e-9) return false;
  if (!level.inside.contains(xy(writer.at()), p)) return false;
  writer.line({p.x, p.y, level.z_mm}, MoveRole::kCut);
  return true;
}

bool LevelCutter::follow(const Level& level, const Track& track) {
  const double length = length_of(track);
  const double pieces = std::ceil(length / (kAirPiece * radius_mm));
  const bool open = area.open || task.shape.kind == model::ShapeKind::kOutside;
  if (!open || task.stock.empty() || !(pieces <= kMostAirPieces) || pieces < 1.0) {
    writer.follow(track, level.z_mm, MoveRole::kCut);
    return true;
  }
  const int n = static_cast<int>(pieces);
  const double apart = length / n;
  // An arc is no farther from its chord than half its length.
  const auto beside = [&](int k) {
    const Spot from = at_length(track, k * apart), to = at_length(track, (k + 1) * apart);
    Vec2 last = from.point;
    for (std::size_t s = from.segment; s <= to.segment; ++s) {
      const Vec2 next = s == to.segment ? to.point : track.segments[s].to;
      const double off = track.segments[s].bend == Bend::kStraight ? 0.0 : 0.5 * apart;
      if (!level.material.clear_along(last, next, radius_mm + kAirBeyond + off)) return false;
      last = next;
    }
    return true;
  };
  // Stretches of such ways, long enough to be told apart.
  std::vector<std::pair<double, double>> air;
  for (int k = 0; k < n; ++k) {
    const int from = k;
    while (k < n && beside(k)) ++k;
    if ((k - from) * apart > 2.0 * radius_mm) air.emplace_back(from * apart, k == n ? length : k * apart);
  }
  double written = 0.0;
  for (const auto& [from, to] : air) {
    if (from > written) writer.follow(part_of(track, written, from), level.z_mm, MoveRole::kCut);
    if (to < length) writer.follow(part_of(track, from, to), level.z_mm, MoveRole::kLink);
    written = to;
  }
  if (written < length)
    writer.follow(air.empty() ? track : part_of(track, written, length), level.z_mm, MoveRole::kCut);
  return written < length;
}

std::optional<Track> LevelCutter::from_outside(const Level& level, const Track& track) {
  if (level.air.empty()) return std::nullopt;
  std::vector<std::pair<double, Vec2>> near;
  near.reserve(level.air.size());
  const Vec2 wish = task.start_point
                        ? xy(task.feature_in_setup.to_parent({task.start_point->x, task.start_point->y, 0.0}))
                        : track.start;
  for (const Vec2 a : level.air) near.emplace_back(norm(a - wish), a);
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (near.size() > 64) near.resize(64);
  for (const auto& [d, a] : near) {
    const Spot spot = track.closed ? nearest(track, a) : Spot{.point = track.start};
    if (!level.inside.contains(a, spot.point)) continue;
    const bool there = norm(a - spot.point) < 2.0 * kInsideSlack;
    writer.over(there ? spot.point : a);
    writer.descend(level.z_mm, level.z_mm);
    // Roughing goes faster through air than a link does.
    const bool link = model::has(task.operation, model::OperationTrait::kFinishes) &&
                      level.material.clear_along(a, spot.point, radius_mm + kAirBeyond);
    if (!there)
      writer.line({spot.point.x, spot.point.y, level.z_mm}, link ? MoveRole::kLink : MoveRole::kCut);
    return track.closed ? begun_at(track, spot) : track;
  }
  return std::nullopt;
}

bool LevelCutter::may_go_down_to(const Level& level, double z) const {
  const double reach = model::reach_of(task.cutter);
  const double deepest = level.from_mm - std::min(task.ramp_depth_mm, reach);
  return z >= deepest - kSameHeight && std::max(task.start_z_mm, level.from_mm) - z <= reach;
}

double LevelCutter::slot_floor(const Level& level) const {
  double out = level.z_mm;
  for (const double z : floors) {
    if (z >= out - kSameHeight) continue;
    if (!may_go_down_to(level, z)) break;
    const Region there = centres_at(area, task.cutter, z, level.allowance_mm, task.allowance_bottom_mm);
    if (there.loops != level.centres.loops) break;
    out = z;
  }
  return out;
}

bool LevelCutter::slotted(const Level& level, const Track& track) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const Slot& s) {
    return s.z_mm <= level.z_mm + kSameHeight && same(s.track, track);
  });
}

double LevelCutter::bore_floor(const Level& level, Vec2 middle, double radius) const {
  double out = level.z_mm;
  for (const double z : floors) {
    if (z >= out - kSameHeight) continue;
    if (!may_go_down_to(level, z)) break;
    const Region there = centres_at(area, task.cutter, z, level.allowance_mm, task.allowance_bottom_mm);
    const bool stays = geometry::contains(there, middle) &&
                       geometry::distance_to_boundary(there, middle) >= radius - kInsideSlack;
    if (!stays) break;
    out = z;
  }
  return out;
}

std::optional<Track> LevelCutter::by_bore(const Level& level, const Track& track, Vec2 middle) {
  for (const Bore& b : bores_) {
    if (b.z_mm > level.z_mm + kSameHeight || norm(b.middle - middle) > 0.5 * radius_mm) continue;
    const Spot spot = track.closed ? nearest(track, b.middle) : Spot{.point = track.start};
    if (!level.inside.contains(b.middle, spot.point)) continue;
    go_cleared(level, b.middle);
    writer.line({spot.point.x, spot.point.y, level.z_mm}, MoveRole::kCut);
    return track.closed ? begun_at(track, spot) : track;
  }
  return std::nullopt;
}

std::optional<Track> LevelCutter::by_helix(const Level& level, const Track& track, const Region& leaf) {
  const double angle = ramp_angle();
  if (angle <= 0.0) return std::nullopt;
  const Deepest d = deepest(leaf);
  if (auto t = by_bore(level, track, d.point)) return t;
  const double room = geometry::distance_to_boundary(level.centres, d.point);
  const HelixRadii radii = helix_radii(task.cutter);
  double r = radii.usual;
  if (task.approach.kind == Approach::Kind::kHelix && task.approach.radius_mm > 0.0) {
    r = std::min(task.approach.radius_mm, radii.most);
    if (r < task.approach.radius_mm - 1e-9)
      warn("TPA-CHANGED", "helix radius " + trimmed(r, 3) + " mm: a core would stay in the given one");
  }
  r = std::min(r, room);
  if (r < radii.least) return std::nullopt;
  const Vec2 start{d.point.x + r, d.point.y};
  const Vec2 other{d.point.x - r, d.point.y};
  const double floor = bore_floor(level, d.point, r);
  const double depth = level.from_mm + gap(level) - floor;
  const double half_pitch = Descent(angle, task.digit_mm).of(kPi * r);
  if (half_pitch <= 0.0) return std::nullopt;
  const int halves = static_cast<int>(std::min(std::ceil(depth / half_pitch), 2.0 * kMostTurns + 1.0));
  if (halves > 2 * kMostTurns) return std::nullopt;
  // The ring must be reached from the helix without leaving the centres.
  const bool odd = halves % 2 == 1;
  const Vec2 end = odd ? other : start;
  const bool bored = floor < level.z_mm - kSameHeight && level.inside.contains(end, d.point);
  const Vec2 from = bored ? d.point : end;
  const Spot spot = track.closed ? nearest(track, from) : Spot{.point = track.start};
  if (!level.inside.contains(from, spot.point)) return std::nullopt;
  go_above(level, start);
  writer.descend(level.from_mm + gap(level), level.from_mm + gap(level));
  const bool cw = (task.cutter.hand == model::Hand::kLeft) == task.climb;
  const double top = writer.at().z;
  for (int i = 1; i <= halves; ++i) {
    const Vec2 to = i % 2 == 1 ? other : start;
    const double z = i == halves ? floor : top - (top - floor) * i / halves;
    writer.arc({to.x, to.y, z}, d.point, cw, MoveRole::kRamp);
  }
  for (const Vec2 to : {odd ? start : other, end}) {
    writer.arc({to.x, to.y, floor}, d.point, cw, MoveRole::kCut);
  }
  bores_.push_back({d.point, floor});
  writer.line({from.x, from.y, level.z_mm}, MoveRole::kLink);  // up in the bore, off its wall
  writer.line({spot.point.x, spot.point.y, level.z_mm}, MoveRole::kCut);
  return track.closed ? begun_at(track, spot) : track;
}

// The loads of a step are reckoned for the depth of a level. Each round of a ramp through several levels
// takes what it falls by over the round before, and so does the round that closes it: none falls by more than
// the deepest of these levels.
Descent LevelCutter::round_by_round(const Level& level, const Track& track, double angle_rad,
                                    double floor) const {
  const Descent steepest(angle_rad, task.digit_mm);
  double most = level.from_mm - level.z_mm, above = level.z_mm;
  for (const double z : floors) {
    if (z >= level.z_mm - kSameHeight || z < floor - kSameHeight) continue;
    most = std::max(most, above - z);
    above = z;
  }
  const double falls = steepest.of(track);
  if (falls <= most) return steepest;
  return {std::atan(std::tan(angle_rad) * most / falls), task.digit_mm};
}

std::optional<Track> LevelCutter::by_ramp(const Level& level, const Track& track) {
  const double angle = ramp_angle();
  const double length = length_of(track);
  if (angle <= 0.0 || length <= 0.0) return std::nullopt;
  if (!task.cutter.centre_cutting) {
    // On a track smaller than this a core would stay under the centre that does not cut.
    geometry::Region box{{points_of(track, 0.01)}};
    const auto b = geometry::bounds(box);
    if (std::max(b.hi.x - b.lo.x, b.hi.y - b.lo.y) < radius_mm) return std::nullopt;
  }
  const bool zigzag = !track.closed || task.approach.kind == Approach::Kind::kZigzag;
  const double floor = zigzag ? level.z_mm : slot_floor(level);
  const bool deeper = floor < level.z_mm - kSameHeight;
  const Descent descent = deeper ? round_by_round(level, track, angle, floor) : Descent(angle, task.digit_mm);
  const double depth = level.from_mm + gap(level) - floor;
  const double round_mm = descent.of(track);
  if (depth > kMostTurns * round_mm) return std::nullopt;
  go_above(level, track.start);
  writer.descend(level.from_mm + gap(level), level.from_mm + gap(level));
  const double top = writer.at().z;
  if (zigzag) {
    double leg = std::min(length, std::max(4.0 * radius_mm, depth / std::tan(angle) / 40.0));
    if (task.approach.kind == Approach::Kind::kZigzag && task.approach.width_mm > 0.0)
      leg = std::min(length, task.approach.width_mm);
    const Track there = part_of(track, 0.0, leg);
    const Track back = reversed(there);
    const double legs = std::ceil(depth / descent.of(there));
    if (!(legs <= 2.0 * kMostTurns)) return std::nullopt;
    int n = std::max(2, static_cast<int>(legs));
    n += n % 2;
    for (int i = 1; i <= n; ++i) {
      const double z = i == n ? level.z_mm : top - (top - level.z_mm) * i / n;
      writer.follow_down(i % 2 == 1 ? there : back, z, descent, MoveRole::kRamp);
    }
    return track;
  }
  const int rounds = static_cast<int>(std::floor(depth / round_mm));
  for (int i = 1; i <= rounds; ++i) {
    writer.follow_down(track, top - i * round_mm, descent, MoveRole::kRamp);
  }
  const double rest = descent.length_for(track, depth - rounds * round_mm);
  const Track last = part_of(track, 0.0, rest);
  if (rest > 1e-6 && !last.segments.empty()) writer.follow_down(last, floor, descent, MoveRole::kRamp);
  const Track round = begun_at(track, at_length(track, rest));
  if (deeper) {
    writer.follow(round, floor, MoveRole::kCut);
    slots_.push_back({track, floor});
    const Vec2 here = xy(writer.at());
    writer.line({here.x, here.y, level.z_mm}, MoveRole::kLink);
  }
  return round;
}

Result<Track> LevelCutter::enter(const Level& level, const Track& track, const Region* leaf) {
  using Kind = Approach::Kind;
  if (level.from_mm - level.z_mm <= 1e-9) {
    go_cleared(level, track.start);
    return track;
  }
  if (auto t = from_outside(level, track)) return *t;
  const Kind asked = task.approach.kind;
  const auto plunge = [&] {
    go_above(level, track.start);
    writer.descend(level.z_mm, level.from_mm + gap(level));
    return track;
  };
  if (asked == Kind::kPlunge && task.cutter.centre_cutting) return plunge();
  if (asked == Kind::kPlunge)
    warn("TPA-CHANGED",
         "ramp instead of the given plunge: cutter " + task.cutter.id + " does not cut to its centre");
  const bool ramp_first = asked == Kind::kRamp || asked == Kind::kZigzag;
  if (leaf != nullptr && !ramp_first) {
    if (auto t = by_helix(level, track, *leaf)) return *t;
  }
  if (auto t = by_ramp(level, track)) return *t;
  if (leaf != nullptr && ramp_first) {
    if (auto t = by_helix(level, track, *leaf)) return *t;
  }
  if (task.cutter.centre_cutting) return plunge();
  return fail({.code = "TPA-ENTRY",
               .message = "no entry into " + task.shape.name + ": cutter " + task.cutter.id +
                          " does not cut to its centre, and the place is too narrow for its ramp of " +
                          trimmed(task.cutter.maximum_ramp_angle_rad * 180.0 / kPi, 2) + " degrees",
               .path = task.shape.name,
               .hint = "use a centre-cutting or a smaller cutter, or drill a start hole"});
}

}  // namespace capstan::toolpath
