#include "planner/making/toolpath/region/adaptive/adaptive.h"

#include <algorithm>
#include <set>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/region/patterns.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

namespace {

/// Lift of the cutter over a floor that it moves across without cutting, mm; default, unsourced.
constexpr double kLift = 0.3;
/// More than this part of the radius is slotting, not clearing.
constexpr double kMostRadial = 0.95;
constexpr double kSameHeight = 1e-9;
constexpr double kDeeper = 1e-6;      // mm
constexpr double kHoleSlack = 0.05;   // mm
constexpr double kSameGround = 0.01;  // mm2

Bite bite_of(const PathJob& task) {
  Bite b;
  b.radius_mm = 0.5 * task.cutter.cutting_diameter_mm;
  b.radial_mm = std::min(stepover_of(task), kMostRadial * b.radius_mm);
  // A corner radius leaves ridges between passes further apart than the flat of the end.
  const double flat = b.radius_mm - task.cutter.corner_radius_mm;
  if (flat > 0.1 * b.radius_mm) b.radial_mm = std::min(b.radial_mm, flat);
  b.blind_mm = std::clamp(0.02 * b.radial_mm, 0.002, 0.01);
  b.chord_mm = 0.5 * b.blind_mm;
  return b;
}

tl::unexpected<Diagnostic> refused(const PathJob& task, const std::string& why) {
  return fail("TPA-UNSUPPORTED", about(task) + "no path of constant engagement: " + why);
}

Region mirrored(const Region& r) {
  Region out = r;
  for (auto& loop : out.loops) {
    for (Vec2& p : loop) p.x = -p.x;
    std::reverse(loop.begin(), loop.end());
  }
  return out;
}

Track mirrored(Track t) {
  t.start.x = -t.start.x;
  for (Segment& s : t.segments) {
    s.to.x = -s.to.x;
    s.centre.x = -s.centre.x;
    if (s.bend != Bend::kStraight) s.bend = s.bend == Bend::kCw ? Bend::kCcw : Bend::kCw;
  }
  return t;
}

/// Whether a hole is cleared at a height: by the moves from `first` on that run there or below, and by all moves
/// before that went deeper, as a bore for later levels does. Each move is taken by itself, once for each place,
/// and only until the hole is gone: a helix as one line, many times over itself, takes its turns squared.
bool cleared_at(const model::CutterPath& path, std::size_t first, double z_mm, double radius, double chord,
                const Region& hole) {
  Region rest = hole;
  const auto box = geometry::bounds(hole);
  std::set<std::array<long long, 7>> seen;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double low = i < first ? z_mm - kDeeper : z_mm + kSameHeight;
    if (path.z[i] > low) continue;
    poll();
    const Vec2 from = path.z[i - 1] > low ? xy(path.point(i)) : xy(path.point(i - 1)), to = xy(path.point(i));
    const bool arc = path.z[i - 1] <= low && model::is_arc(path.kind[i]);
    const double reach = radius + (arc ? model::move_length(path, i) : 0.0);
    if (std::max(from.x, to.x) + reach < box.lo.x || std::min(from.x, to.x) - reach > box.hi.x ||
        std::max(from.y, to.y) + reach < box.lo.y || std::min(from.y, to.y) - reach > box.hi.y)
      continue;
    const auto whole = [](double v) { return std::llround(v * 1e6); };
    if (!seen.insert({whole(from.x), whole(from.y), whole(to.x), whole(to.y), arc ? whole(path.cx[i]) : 0,
                      arc ? whole(path.cy[i]) : 0, arc ? static_cast<long long>(path.kind[i]) : -1})
             .second)
      continue;
    std::vector<Vec2> line{from};
    const double length = model::move_length(path, i);
    const int n = arc ? std::max(1, static_cast<int>(std::ceil(length / (0.02 * radius)))) : 1;
    for (int k = 1; k <= n; ++k) {
      const Vec2 p = arc ? xy(model::point_on_move(path, i, static_cast<double>(k) / n)) : to;
      if (norm(p - line.back()) > 0.0) line.push_back(p);
    }
    rest = geometry::subtract(rest, line.size() == 1 ? geometry::disc(from, radius, chord)
                                                     : geometry::stroke(line, radius, true, chord));
    if (geometry::area(rest) <= kSameGround) return true;
  }
  return false;
}

class Adaptive {
 public:
  Adaptive(LevelCutter& cutter, const Level& level, Clearings& known)
      : c_(cutter),
        level_(level),
        known_(known),
        bite_(bite_of(cutter.task)),
        mirror_(!walls_on_right(cutter.task)) {}

  Status run() {
    for (const Region& piece : geometry::pieces(reached_at_constant_engagement(c_.task, level_.centres))) {
      if (auto ok = cut(piece); !ok) return ok;
    }
    return {};
  }

 private:
  /// Air beside the material, as far as this piece goes.
  [[nodiscard]] Region air(const Region& piece) const {
    if (!c_.area.open) return {};
    const auto box = geometry::bounds(piece);
    const double far = 3.0 * bite_.radius_mm;
    return geometry::subtract(geometry::rectangle(box.lo - Vec2{far, far}, box.hi + Vec2{far, far}),
                              c_.area.material);
  }

  Status cut(const Region& piece) {
    Region cleared = air(piece);
    std::optional<ClearingStart> start;
    const Region outside = geometry::intersect(
        geometry::offset(cleared, -(bite_.radius_mm + kBesideWay), bite_.chord_mm), piece);
    if (geometry::area(outside) < 0.01 * bite_.radius_mm * bite_.radius_mm) {
      auto entered = enter(piece, cleared);
      if (!entered) return tl::unexpected(entered.error());
      start = *entered;
    }
    const auto passes = passes_of(piece, cleared, start);
    if (!passes) {
      const Unreached& left = passes.error();
      return refused(
          c_.task, "about x " + trimmed(left.at.x, 1) + ", y " + trimmed(left.at.y, 1) + " no pass reaches " +
                       trimmed(left.area_mm2, 1) +
                       " mm2 of where the cutter's axis is to go; rings or a cutter of less than " +
                       trimmed(c_.task.cutter.cutting_diameter_mm, 3) + " mm may");
    }
    for (const ClearingPass& p : **passes) write(p);
    return {};
  }

  /// Down the helix in the middle of the piece; `cleared` grows by what it has cleared at this height.
  Result<ClearingStart> enter(const Region& piece, Region& cleared) {
    // Other ways in leave no hole to wind out of: the circle round it would be a slot at the full depth.
    const Approach::Kind asked = c_.task.approach.kind;
    if (asked == Approach::Kind::kPlunge || asked == Approach::Kind::kZigzag)
      return refused(c_.task, "the way in that is given is no helix and no ramp round a hole");
    if (!(c_.task.cutter.maximum_ramp_angle_rad > 0.0))
      return refused(c_.task, "cutter " + c_.task.cutter.id + " does not ramp");
    const Deepest d = deepest(piece);
    const HelixRadii radii = helix_radii(c_.task.cutter);
    const double turn = std::min(radii.usual, d.distance_mm);
    if (turn < radii.least) {
      return refused(c_.task, "a helix of " + trimmed(turn, 2) + " mm is the largest that fits, " +
                                  trimmed(radii.least, 2) + " mm is the least for cutter " + c_.task.cutter.id);
    }
    Track circle{.start = d.point + Vec2{turn, 0.0}, .segments = {}, .closed = true};
    const Bend bend = mirror_ ? Bend::kCw : Bend::kCcw;
    circle.segments.push_back({.to = d.point - Vec2{turn, 0.0}, .centre = d.point, .bend = bend});
    circle.segments.push_back({.to = circle.start, .centre = d.point, .bend = bend});
    const std::size_t before = c_.writer.path().size();
    auto in = c_.enter(level_, circle, &piece);
    if (!in) return tl::unexpected(in.error());
    // The hole to wind out of: the same on every level, whatever the way in was.
    const Region hole = geometry::disc(d.point, turn + bite_.radius_mm - kHoleSlack, bite_.chord_mm);
    if (!cleared_at(c_.writer.path(), before, level_.z_mm, bite_.radius_mm, bite_.chord_mm, hole))
      c_.writer.follow(*in, level_.z_mm, MoveRole::kCut);
    c_.writer.line({circle.start.x, circle.start.y, level_.z_mm}, MoveRole::kCut);
    cleared = geometry::unite(cleared, hole);
    return ClearingStart{circle.start, {0.0, mirror_ ? -1.0 : 1.0}};
  }

  tl::expected<const std::vector<ClearingPass>*, Unreached> passes_of(
      const Region& piece, const Region& cleared, const std::optional<ClearingStart>& start) {
    for (const LevelClearing& k : known_) {
      if (k.centres.loops == piece.loops && k.cleared.loops == cleared.loops &&
          k.entered == start.has_value() && (!start || (k.at == start->at && k.heading == start->heading)))
        return &k.passes;
    }
    std::optional<ClearingStart> from = start;
    if (from && mirror_) {
      from->at.x = -from->at.x;
      from->heading.x = -from->heading.x;
    }
    auto passes = mirror_ ? clearing_passes(mirrored(piece), bite_, mirrored(cleared), from)
                          : clearing_passes(piece, bite_, cleared, from);
    if (!passes) {
      Unreached left = passes.error();
      if (mirror_) left.at.x = -left.at.x;
      return tl::unexpected(left);
    }
    if (mirror_) {
      for (ClearingPass& p : *passes) {
        p.track = mirrored(std::move(p.track));
        for (Vec2& q : p.way) q.x = -q.x;
      }
    }
    LevelClearing k{.centres = piece,
                    .cleared = cleared,
                    .entered = start.has_value(),
                    .at = {},
                    .heading = {},
                    .passes = std::move(*passes)};
    if (start) {
      k.at = start->at;
      k.heading = start->heading;
    }
    known_.push_back(std::move(k));
    return &known_.back().passes;
  }

  void write(const ClearingPass& p) {
    PathWriter& w = c_.writer;
    const double z = level_.z_mm;
    if (p.over) {
      w.over(p.track.start);
      w.descend(z, z);
    } else if (!p.way.empty()) {
      const double above = std::min(z + kLift, w.rapid_z_mm());
      const Vec2 here = xy(w.at());
      w.line({here.x, here.y, above}, MoveRole::kLink);
      for (const Vec2 q : p.way) w.line({q.x, q.y, above}, MoveRole::kLink);
      w.line({p.track.start.x, p.track.start.y, z}, MoveRole::kApproach);
    }
    w.follow(p.track, z, MoveRole::kCut);
  }

  LevelCutter& c_;
  const Level& level_;
  Clearings& known_;
  Bite bite_;
  bool mirror_;
};

}  // namespace

Status may_clear_at_constant_engagement(const PathJob& task, const WorkArea& w) {
  if (model::has(task.operation, model::OperationTrait::kFinishes)) return refused(task, "the step finishes");
  if (task.cleared_by) return refused(task, "only a rest of the area is cut");
  if (w.slope_rad != 0.0) return refused(task, "the walls are drafted");
  if (w.bottom_radius_mm > task.cutter.corner_radius_mm + 1e-6)
    return refused(task, "a round leads from the walls to the bottom");
  return {};
}

Region reached_at_constant_engagement(const PathJob& task, const Region& centres) {
  const double turn = kLeastTurn * 0.5 * task.cutter.cutting_diameter_mm;
  return inset(inset(centres, turn, kWallChord), -turn, kWallChord);
}

Status cut_at_constant_engagement(LevelCutter& cutter, const Level& level, Clearings& known) {
  const double least = kLeastTurn * cutter.radius_mm;
  const Region wide = geometry::offset(geometry::offset(level.centres, -least, 0.01), least + 0.02, 0.01);
  for (const Region& neck : geometry::pieces(geometry::subtract(level.centres, wide))) {
    const auto box = geometry::bounds(neck);
    // The tips of corners are small.
    if (std::max(box.hi.x - box.lo.x, box.hi.y - box.lo.y) < 6.0 * least) continue;
    return refused(cutter.task, "the cutter of " + trimmed(cutter.task.cutter.cutting_diameter_mm, 3) +
                                    " mm cannot turn in a place less than " +
                                    trimmed(2.0 * (least + cutter.radius_mm + level.allowance_mm), 2) +
                                    " mm wide");
  }
  return Adaptive(cutter, level, known).run();
}

}  // namespace capstan::toolpath
