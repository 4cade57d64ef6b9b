#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/region/area/crossing.h"
#include "planner/making/toolpath/region/patterns.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

namespace {

/// Tracks of a ring's loops, in the sense that the job asks for.
std::vector<Track> tracks_of(const Region& piece, Loops which, bool natural, bool wall) {
  std::vector<Track> out;
  for (const auto& loop : piece.loops) {
    const bool island = geometry::signed_area(loop) < 0.0;
    if (which == (island ? Loops::kOutside : Loops::kIslands)) continue;
    Track t = track_of(loop, wall ? kFitTolerance : kInnerChord);
    out.push_back(natural ? std::move(t) : reversed(t));
  }
  return out;
}

struct Lead {
  Track track;  ///< turned to where the arc meets it
  Vec2 from, centre;
  Track past;  ///< the beginning of the track once more; empty: the wall is left where it was met
  Vec2 to, leaving_centre;
  bool clockwise = false;
};

bool arc_inside(const Level& level, Vec2 centre, Vec2 a, Vec2 b) {
  // A quarter turn, by chords that stay within a hundredth of its radius.
  Vec2 last = a;
  for (int i = 1; i <= 6; ++i) {
    const double t = i / 6.0;
    const Vec2 chord = (1.0 - t) * (a - centre) + t * (b - centre);
    const Vec2 p = centre + (norm(a - centre) / norm(chord)) * chord;
    if (!level.inside.contains(last, p)) return false;
    last = p;
  }
  return true;
}

/// The arc that leaves a track at a point, which is not its end; false where it meets something.
bool leaves_at(const Level& level, const Track& track, double radius, bool natural, Lead& out) {
  const Vec2 t = direction_at(track.start, track.segments.front(), 0.0);
  const Vec2 n = natural ? left_of(t) : -1.0 * left_of(t);  // away from the wall
  out.leaving_centre = track.start + radius * n;
  out.to = out.leaving_centre + radius * t;
  return arc_inside(level, out.leaving_centre, track.start, out.to);
}

bool lead_at(const Level& level, const Track& track, const Spot& spot, double radius, bool natural,
             double overlap_mm, Lead& out) {
  out.track = begun_at(track, spot);
  if (out.track.segments.empty()) return false;
  const Vec2 t = direction_at(out.track.start, out.track.segments.front(), 0.0);
  const Vec2 n = natural ? left_of(t) : -1.0 * left_of(t);
  out.centre = out.track.start + radius * n;
  out.from = out.centre - radius * t;
  out.clockwise = !natural;
  if (!arc_inside(level, out.centre, out.from, out.track.start)) return false;
  const bool closed = norm(out.track.end() - out.track.start) < kSmallestArc;
  if (closed && overlap_mm < length_of(out.track)) {
    const Track later = begun_at(out.track, at_length(out.track, overlap_mm));
    if (!later.segments.empty() && leaves_at(level, later, radius, natural, out)) {
      out.past = part_of(out.track, 0.0, overlap_mm);
      return true;
    }
  }
  out.past = {};
  return leaves_at(level, out.track, radius, natural, out);
}

/// Summary of the places of the outer ring that are nearest to one point of the inner ring. Their stripe must
/// be no wider than a pass can cut, or be the wedge of a plain corner; else a limb of the area has ended
/// between the rings.
struct Corner {
  double allowed = 0.0;   ///< width of stripe that is cut in any case
  double wedge = 0.0;     ///< from the inner corner to the outer one, if both are plain corners
  double farthest = 0.0;  ///< seen
  [[nodiscard]] bool simple() const {
    return farthest <= allowed || std::abs(farthest - wedge) <= 0.03 * wedge;
  }
};

/// Distance between the corners of two rings where the inner one has a corner of this angle.
double wedge_at(const Track& a, const Spot& spot, double ring_step) {
  const std::size_t n = a.segments.size();
  const auto begin = [&](std::size_t k) { return k == 0 ? a.start : a.segments[k - 1].to; };
  std::size_t in = spot.segment;
  std::size_t out = spot.segment;
  if (norm(spot.point - begin(spot.segment)) < 1e-6)
    in = (spot.segment + n - 1) % n;
  else if (norm(spot.point - a.segments[spot.segment].to) < 1e-6)
    out = (spot.segment + 1) % n;
  const Vec2 d0 = direction_at(begin(in), a.segments[in], in == out ? spot.t : 1.0);
  const Vec2 d1 = direction_at(begin(out), a.segments[out], in == out ? spot.t : 0.0);
  const double half_turn = 0.5 * std::atan2(std::abs(cross(d0, d1)), dot(d0, d1));
  return ring_step / std::max(std::cos(half_turn), 1e-6);
}

/// One turn round the track while moving from one ring to the other; empty if that would leave the centres or
/// spread the passes too far.
std::vector<Vec2> melted(const LevelCutter& c, const Level& level, const Track& a, const Track& b,
                         double ring_step) {
  constexpr double kChord = 0.004;
  constexpr std::size_t kMostWork = 20'000'000;  // places times segments; beyond, rings do
  const auto corners = points_of(b, kChord);
  std::vector<Vec2> outer;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 d = corners[i + 1] - corners[i];
    const int n = std::max(1, static_cast<int>(std::ceil(norm(d) / (0.25 * c.radius_mm))));
    for (int k = 0; k < n; ++k) outer.push_back(corners[i] + (static_cast<double>(k) / n) * d);
  }
  outer.push_back(b.start);
  if (a.segments.empty() || outer.size() * a.segments.size() > kMostWork) return {};
  double length = 0.0;
  for (std::size_t i = 1; i < outer.size(); ++i) length += norm(outer[i] - outer[i - 1]);
  if (!(length > 0.0)) return {};
  std::vector<Vec2> out = {a.start};
  double s = 0.0;
  Vec2 before = a.start;
  Corner corner{
      .allowed = 1.9 * c.radius_mm, .wedge = wedge_at(a, nearest(a, a.start), ring_step), .farthest = 0.0};
  for (std::size_t i = 1; i < outer.size(); ++i) {
    const double step = norm(outer[i] - outer[i - 1]);
    s += step;
    const Spot spot = nearest(a, outer[i]);
    const Vec2 p = spot.point;
    // A jump means that the ring is no simple copy of its neighbour.
    if (norm(p - before) > 2.0 * step + 0.5 * c.step_mm) return {};
    if (norm(p - before) > 1e-9) {
      if (!corner.simple()) return {};
      corner = Corner{.allowed = 1.9 * c.radius_mm, .wedge = wedge_at(a, spot, ring_step), .farthest = 0.0};
    }
    corner.farthest = std::max(corner.farthest, spot.distance_mm);
    before = p;
    const double u = i + 1 == outer.size() ? 1.0 : s / length;
    const Vec2 x = (1.0 - u) * p + u * outer[i];
    if (!level.inside.contains(out.back(), x)) return {};
    out.push_back(x);
  }
  if (!corner.simple()) return {};
  return out;
}

/// Of the radius to each side of the centre: what a pass is counted on to clear; default, unsourced.
constexpr double kWithin = 0.99;
/// Of the radius: a narrower flat is none, and the end's round is what clears.
constexpr double kLeastFlat = 0.1;
/// Rings are no farther apart, in widths to one side: corners of a right angle are cleared by steps up to
/// 1 + sin(45 degrees) of them (rings.h), rounded down.
constexpr double kWidest = 1.7;

/// Of the distance of rings: what begins so near to a loop is entered from it; default, unsourced.
constexpr double kBeside = 1.1;

class Contours {
 public:
  Contours(LevelCutter& cutter, const Level& level, const ContourOptions& options)
      : c_(cutter), level_(level), o_(options) {
    if (o_.outside_in) o_.lead_arcs = false;
  }

  Status run() {
    if (o_.wall_only) return walls();
    // The rings see to it that nothing stays between them; a spiral runs between two of them, where it is
    // kept to the radius. A corner radius narrows the flat part of the end.
    const double flat = c_.radius_mm - c_.task.cutter.corner_radius_mm;
    double cover = kWithin * c_.radius_mm;
    if (flat > kLeastFlat * c_.radius_mm) cover = std::min(cover, flat);
    const double step = std::min(c_.step_mm, (o_.spiral ? 1.0 : kWidest) * cover);
    if (step < c_.step_mm - 1e-9) {
      c_.note("TPA-CHANGED", "step-over " + trimmed(step, 2) + " mm instead of " + trimmed(c_.step_mm, 2) +
                                 " mm, or ridges would stay between the rings");
    }
    step_ = step;
    all_ = c_.rings_of(level_.centres, step, cover);
    done_.assign(all_.size(), {});
    for (const Turn& turn : order()) {
      inwards_ = turn.inwards;
      if (auto ok = ring(turn.ring, turn.loops); !ok) return ok;
    }
    flush();
    return {};
  }

 private:
  Status walls() {
    for (const Region& piece : geometry::pieces(level_.centres)) {
      for (Track& t : tracks_of(piece, Loops::kAll, natural(), true)) {
        if (o_.lead_arcs && cut_with_leads(c_, level_, t)) continue;
        // Too narrow for arcs: down the wall's own track, as into the solid.
        Level solid = level_;
        solid.from_mm = level_.above_mm;
        auto in = c_.enter(solid, t, nullptr);
        if (!in) return tl::unexpected(in.error());
        c_.follow(level_, *in);
      }
    }
    return {};
  }

  /// A limb of the area is entered from the ring around it, where that saves a way down into the solid which
  /// is longer than the limb's own ring: about so much of the ring around it is then cut as a slot, which
  /// takes up to twice as long (a slot is fed at half: optimise::kDeepestSlotShare).
  [[nodiscard]] std::vector<Turn> order() {
    const bool solid = level_.from_mm - level_.z_mm > kInsideSlack && level_.air.empty();
    const bool may = solid && !o_.outside_in && !o_.spiral && !o_.lead_arcs && !c_.task.cleared_by;
    const double down_mm = may ? c_.way_down_mm(level_) : 0.0;
    std::vector<Turn> out = turns(all_, kBeside * step_, [&](const Ring& limb) {
      double around_mm = 0.0;
      for (const Track& t : tracks_of(limb.piece, Loops::kAll, true, false)) around_mm += length_of(t);
      return may && around_mm < down_mm;
    });
    if (!o_.outside_in) return out;
    std::reverse(out.begin(), out.end());
    for (Turn& turn : out) turn.inwards = true;
    return out;
  }

  /// The sense of a track that has the material on the side that the job asks for.
  [[nodiscard]] bool natural() const { return walls_on_right(c_.task) != inwards_; }

  /// Writes the pending track, which has been reached but not followed yet.
  void flush() {
    if (pending_.segments.empty()) return;
    c_.follow(level_, pending_);
    pending_ = {};
  }

  [[nodiscard]] bool beside(std::size_t i) const {
    if (last_ == kNone) return false;
    return inwards_ ? all_[i].parent == last_ && i != last_ : all_[last_].parent == i && i != last_;
  }

  Status ring(std::size_t i, Loops which) {
    const bool wall = all_[i].depth == 0;
    // A spiral melts one ring into the next by their corners.
    std::vector<Track> tracks =
        tracks_of(o_.spiral ? all_[i].piece : all_[i].followed, which, natural(), wall);
    if (o_.spiral && !inwards_ && beside(i) && tracks.size() == 1 && all_[i].children.size() == 1 &&
        done_[last_].size() == 1 && spiral_onto(tracks.front())) {
      done_[i] = {pending_};
      last_ = i;
      if (wall) flush();
      return {};
    }
    flush();
    const auto& neighbours = inwards_ ? std::vector<std::size_t>{all_[i].parent} : all_[i].children;
    bool entered = false;
    while (!tracks.empty()) {
      const std::size_t k = nearest_track(tracks);
      const Track t = tracks[k];
      tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(k));
      if (auto ok = one(i, t, neighbours, entered, wall); !ok) return ok;
      entered = true;
    }
    last_ = i;
    return {};
  }

  bool spiral_onto(const Track& track) {
    const Vec2 here = xy(c_.writer.at());
    const Track to = begun_at(track, nearest(track, here));
    const auto line = melted(c_, level_, done_[last_].front(), to, step_);
    if (line.empty() || norm(line.front() - here) > 1e-6) return false;
    pending_ = {};
    c_.writer.follow(track_of_line(line, 0.0005), level_.z_mm, MoveRole::kCut);
    pending_ = to;
    return true;
  }

  [[nodiscard]] std::size_t nearest_track(const std::vector<Track>& tracks) const {
    if (!c_.writer.begun()) return 0;
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      const double d = nearest(tracks[k], xy(c_.writer.at())).distance_mm;
      if (d < least - 1e-9) {
        least = d;
        best = k;
      }
    }
    return best;
  }

  void cut(std::size_t i, const Track& t) {
    c_.follow(level_, t);
    done_[i].push_back(t);
  }

  /// From the end of the ring beside it by arcs: there, or a little farther along that ring, where it is cut
  /// already.
  bool cross_onto(std::size_t i, const Track& t) {
    if (done_[last_].empty() || !c_.writer.begun()) return false;
    const Track& ring = done_[last_].back();
    const geometry::Vec3 at = c_.writer.at();
    if (ring.segments.empty() || std::abs(at.z - level_.z_mm) > 1e-9 ||
        norm(xy(at) - ring.start) > kSmallestArc)
      return false;
    const double length = length_of(ring);
    for (const double further : {0.0, 1.0, 2.0}) {
      const double s = further * step_;
      if (s > 0.5 * length) break;
      const Spot leaves = at_length(ring, s);
      const auto over = crossing(leaves.point, direction_at(ring, leaves), t, level_.inside);
      if (!over) continue;
      if (s > 0.0) c_.writer.follow(part_of(ring, 0.0, s), level_.z_mm, MoveRole::kCut);
      c_.writer.follow(over->way, level_.z_mm, MoveRole::kCut);
      cut(i, begun_at(t, over->onto));
      return true;
    }
    return false;
  }

  /// One loop of a ring: from where the cutter is, from a neighbour that is cut already, or into the solid.
  Status one(std::size_t i, const Track& t, const std::vector<std::size_t>& neighbours, bool entered,
             bool wall) {
    if (wall && o_.lead_arcs && (entered || !neighbours.empty()) && !all_[i].children.empty() &&
        cut_with_leads(c_, level_, t)) {
      done_[i].push_back(t);
      return {};
    }
    if (!entered && beside(i) && cross_onto(i, t)) return {};
    if (entered || beside(i)) {
      const Spot spot = nearest(t, xy(c_.writer.at()));
      if (c_.cut_to(level_, spot.point)) {
        cut(i, begun_at(t, spot));
        return {};
      }
    }
    for (const std::size_t n : neighbours) {
      if (n == i) continue;
      for (const Track& d : done_[n]) {
        // A few places of the neighbour, the nearest first.
        const Spot near = nearest(d, t.start);
        for (const Vec2 p : {near.point, d.start, at_length(d, 0.5 * length_of(d)).point}) {
          const Spot spot = nearest(t, p);
          if (!level_.inside.contains(p, spot.point)) continue;
          c_.go_cleared(level_, p);
          if (!c_.cut_to(level_, spot.point)) continue;
          cut(i, begun_at(t, spot));
          return {};
        }
      }
    }
    if (c_.slotted(level_, t)) {
      c_.go_cleared(level_, t.start);
      done_[i].push_back(t);
      return {};
    }
    const bool leaf = all_[i].children.empty() && !inwards_;
    auto in = c_.enter(level_, t, leaf ? &all_[i].piece : nullptr);
    if (!in) return tl::unexpected(in.error());
    if (c_.slotted(level_, t)) {
      done_[i].push_back(*in);
    } else {
      cut(i, *in);
    }
    return {};
  }

  LevelCutter& c_;
  const Level& level_;
  ContourOptions o_;
  bool inwards_ = false;  ///< of the ring at hand
  double step_ = 0.0;
  std::vector<Ring> all_;
  std::vector<std::vector<Track>> done_;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t last_ = kNone;
  Track pending_;
};

}  // namespace

bool walls_on_right(const PathJob& task) {
  // A right-hand cutter climbs with the wall on its right.
  return task.climb != (task.cutter.hand == model::Hand::kLeft);
}

bool cut_with_leads(LevelCutter& cutter, const Level& level, Track track) {
  const bool natural = walls_on_right(cutter.task);
  const bool here_known = cutter.writer.begun();
  std::vector<Spot> spots;
  if (here_known) spots.push_back(nearest(track, xy(cutter.writer.at())));
  Vec2 from = track.start;
  std::vector<std::pair<double, Spot>> by_length;
  for (std::size_t i = 0; i < track.segments.size(); ++i) {
    const Segment& s = track.segments[i];
    by_length.push_back({length_of(from, s),
                         Spot{.segment = i, .t = 0.5, .point = point_at(from, s, 0.5), .distance_mm = 0}});
    from = s.to;
  }
  std::stable_sort(by_length.begin(), by_length.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first + 1e-6; });
  if (by_length.size() > 12) by_length.resize(12);
  for (const auto& [l, s] : by_length) spots.push_back(s);
  double wish = 0.5 * cutter.radius_mm;
  if (cutter.task.approach.kind == Approach::Kind::kTangent && cutter.task.approach.radius_mm > 0.0)
    wish = cutter.task.approach.radius_mm;
  for (const double part : {1.0, 0.5, 0.2}) {
    for (const Spot& s : spots) {
      Lead lead;
      const double overlap = 2.0 * cutter.radius_mm * kPastBeginning;
      if (!lead_at(level, track, s, part * wish, natural, overlap, lead)) continue;
      if (level.cleared && !level.cleared->contains(lead.from)) continue;
      const bool straight = here_known && std::abs(cutter.writer.at().z - level.z_mm) < 1e-9 &&
                            norm(xy(cutter.writer.at()) - lead.from) <= 4.0 * cutter.radius_mm &&
                            level.inside.contains(xy(cutter.writer.at()), lead.from);
      if (straight) {
        cutter.writer.line({lead.from.x, lead.from.y, level.z_mm}, MoveRole::kCut);
      } else if (level.from_mm <= level.z_mm + 1e-9) {
        cutter.go_cleared(level, lead.from);
      } else {
        continue;  // nothing says that the place is free down to here
      }
      const Vec2 p = lead.track.start;
      cutter.writer.arc({p.x, p.y, level.z_mm}, lead.centre, lead.clockwise, MoveRole::kCut);
      if (!cutter.follow(level, lead.track)) return true;
      if (!lead.past.segments.empty() && !cutter.follow(level, lead.past)) return true;
      cutter.writer.arc({lead.to.x, lead.to.y, level.z_mm}, lead.leaving_centre, lead.clockwise,
                        MoveRole::kCut);
      return true;
    }
  }
  return false;
}

Status cut_contours(LevelCutter& cutter, const Level& level, const ContourOptions& options) {
  return Contours(cutter, level, options).run();
}

}  // namespace capstan::toolpath
