#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

namespace {
constexpr double kTipBelow =
    0.5;  ///< mm the tip reaches below the chamfer, so that the cone cuts, not its tip

/// Round what stays of an outside contour, as an upright cutter as wide as the form cutter's tip would go.
Result<GeneratedPath> around_outside(const PathJob& slim, double z_mm, Job& job) {
  PathJob t = slim;
  t.shape.kind = model::ShapeKind::kOutside;
  t.shape.depth_mm = t.feature_in_setup.origin.z - z_mm;
  t.shape.slope_rad = 0.0;
  t.shape.through = false;
  t.operation = model::TypeId::kSideFinishMilling;
  t.allowance_side_mm = t.allowance_bottom_mm = t.axial_depth_mm = 0.0;
  t.left_on_side_mm = t.left_on_bottom_mm = 0.0;
  return outside_path(t, job);
}

/// Direction of travel at a track's end.
geometry::Vec2 direction_at_end(const Track& t) {
  const std::size_t n = t.segments.size();
  return direction_at(n > 1 ? t.segments[n - 2].to : t.start, t.segments.back(), 1.0);
}

/// The half circle between the middle of an opening and a place of a track, where it runs along the track.
struct HalfCircle {
  geometry::Vec2 centre;
  bool clockwise = false;

  HalfCircle(geometry::Vec2 middle, geometry::Vec2 place, geometry::Vec2 along)
      : centre(0.5 * (middle + place)), clockwise(cross(place - centre, along) < 0.0) {}

  /// Whether the way on it from one point to the one opposite stays where the cutter's centre may be.
  [[nodiscard]] bool stays(const Level& level, geometry::Vec2 from) const {
    constexpr int kPlaces = 16;
    geometry::Vec2 last = from;
    for (int i = 1; i <= kPlaces; ++i) {
      const double a = (clockwise ? -std::numbers::pi : std::numbers::pi) * i / kPlaces;
      const geometry::Vec2 r = from - centre;
      const geometry::Vec2 next = centre + geometry::Vec2{r.x * std::cos(a) - r.y * std::sin(a),
                                                          r.x * std::sin(a) + r.y * std::cos(a)};
      if (!level.inside.contains(last, next)) return false;
      last = next;
    }
    return true;
  }
};

/// Along a closed track from the middle of the opening, where the cutter is, and back to it: on half circles
/// that meet the track and leave it along it, where the opening has room for them. `at` is the track's place
/// nearest to the middle. A round track is left a little past its beginning, any other where it was met.
void round_from_middle(PathWriter& writer, const Level& level, geometry::Vec2 middle, const Track& track,
                       const Spot& at, double past_mm) {
  constexpr double kLeast = 0.05;     // mm: a nearer edge is met straight; default, unsourced
  constexpr double kSquareOn = 0.01;  // rad: then a half circle of 20 mm cuts 1 um into the wall at most
  const double z = level.z_mm;
  const auto cut = [&](geometry::Vec2 to, const HalfCircle& on) {
    writer.arc({to.x, to.y, z}, on.centre, on.clockwise, model::MoveRole::kCut);
  };
  const Track round = begun_at(track, at);
  const geometry::Vec2 place = round.start;
  const bool wide = norm(place - middle) >= kLeast && !round.segments.empty();
  const HalfCircle met(middle, place,
                       wide ? direction_at(place, round.segments.front(), 0.0) : geometry::Vec2{});
  if (!wide || !met.stays(level, middle) || !met.stays(level, place)) {
    writer.line({place.x, place.y, z}, model::MoveRole::kCut);
    writer.follow(round, z, model::MoveRole::kCut);
    writer.line({middle.x, middle.y, z}, model::MoveRole::kCut);
    return;
  }
  cut(place, met);
  writer.follow(round, z, model::MoveRole::kCut);
  const Track past = past_mm < length_of(round) ? part_of(round, 0.0, past_mm) : Track{};
  if (!past.segments.empty()) {
    const geometry::Vec2 end = past.end(), along = direction_at_end(past);
    const HalfCircle left(middle, end, along);
    if (std::abs(dot(end - middle, along)) <= kSquareOn * norm(end - middle) && left.stays(level, end)) {
      writer.follow(past, z, model::MoveRole::kCut);
      cut(middle, left);
      return;
    }
  }
  cut(middle, met);
}

/// Moves along each edge, entered on arcs where these fit. Elsewhere, and in openings narrower than the
/// cutter, it enters from the middle, where the cutter touches nothing. `diameter_mm`: of the whole cutter.
Status along_edges(LevelCutter& c, const Level& level, double diameter_mm) {
  const bool natural = walls_on_right(c.task);
  for (const geometry::Region& piece : geometry::pieces(level.centres)) {
    const Deepest deep = deepest(piece);
    const geometry::Vec2 middle = deep.point;
    const bool narrow = deep.distance_mm + c.radius_mm < 0.5 * diameter_mm;
    for (const auto& loop : piece.loops) {
      const Track track = natural ? track_of(loop) : reversed(track_of(loop));
      if (!narrow && cut_with_leads(c, level, track)) continue;
      const Spot spot = nearest(track, middle);
      if (level.inside.contains(middle, spot.point)) {
        c.writer.over(middle);
        c.writer.descend(level.z_mm, level.z_mm);
        round_from_middle(c.writer, level, middle, track, spot, kPastBeginning * diameter_mm);
        continue;
      }
      auto in = c.enter(level, track, nullptr);
      if (!in) return tl::unexpected(in.error());
      c.writer.follow(*in, level.z_mm, model::MoveRole::kCut);
    }
  }
  return {};
}

/// The tip's radius where it runs along the wall, and its height below the edge.
struct TipAt {
  double radius_mm = 0.0, below_mm = 0.0;
};

std::string degrees(double rad) { return trimmed(rad * 180.0 / std::numbers::pi, 2); }

Result<TipAt> tip_of_cone(const PathJob& task, double below_mm) {
  const auto& s = task.shape;
  const auto refuse = [&](const char* code, const std::string& what) {
    return fail({.code = code, .message = s.name + ": " + what, .path = s.name});
  };
  // The flank's angle against the axis is the complement of the chamfer's against the plane.
  const double half = 0.5 * task.cutter.point_angle_rad;
  if (std::abs(std::tan(half) - 1.0 / std::tan(s.chamfer_angle_rad)) > 1e-3 || !(half > 0.0))
    return refuse("TPA-TOOL", "the cutter's point of " + degrees(2.0 * half) +
                                  " degrees makes no chamfer of " + degrees(s.chamfer_angle_rad) +
                                  " degrees to the plane; take a point of " +
                                  degrees(std::numbers::pi - 2.0 * s.chamfer_angle_rad) + " degrees");
  const double radius = 0.5 * task.cutter.tip_diameter_mm + below_mm * std::tan(half);
  const double needed = radius + s.chamfer_width_mm;
  if (2.0 * needed > task.cutter.cutting_diameter_mm + 1e-9)
    return refuse("TPA-NO-FIT", "the chamfer is wider than the cutter's cone; a cutter of " +
                                    trimmed(2.0 * needed, 2) + " mm would do");
  return TipAt{radius, s.depth_mm + below_mm};
}

Result<TipAt> tip_of_round(const PathJob& task) {
  const auto& s = task.shape;
  const auto& c = task.cutter;
  const auto refuse = [&](const std::string& what) {
    return fail({.code = "TPA-TOOL", .message = s.name + ": " + what, .path = s.name});
  };
  if (c.cutter_class != model::CutterClass::kCornerRoundingMill)
    return refuse("a rounded edge needs a corner rounding mill");
  if (std::abs(c.corner_radius_mm - s.round_radius_mm) > 1e-3)
    return refuse("the cutter's radius of " + trimmed(c.corner_radius_mm, 3) + " mm is not the edge's " +
                  trimmed(s.round_radius_mm, 3) + " mm");
  // What the round leaves of the diameter, whatever is known of the tip.
  const double tip = 0.5 * c.cutting_diameter_mm - c.corner_radius_mm;
  if (!(tip > 0.0))
    return refuse("a cutter of " + trimmed(c.cutting_diameter_mm, 3) +
                  " mm has no tip inside its rounds of " + trimmed(c.corner_radius_mm, 3) + " mm");
  return TipAt{tip, s.round_radius_mm};
}

/// `tip_below_mm` of the chamfer or cone.
Result<GeneratedPath> along_edge(const PathJob& task, double tip_below_mm, Job& job) {
  const auto& s = task.shape;
  const auto refuse = [&](const char* code, const std::string& what) {
    return fail({.code = code, .message = s.name + ": " + what, .path = s.name});
  };
  const bool outside = s.open && s.islands.size() == 1 && std::abs(s.islands.front().top_z_mm) < 1e-9;
  if ((s.open && !outside) || s.area.empty())
    return refuse("TPA-UNSUPPORTED",
                  "only the upper edges of closed pockets, holes and outside contours have paths yet");
  const auto tip =
      s.kind == model::ShapeKind::kEdgeRound ? tip_of_round(task) : tip_of_cone(task, tip_below_mm);
  if (!tip) return tl::unexpected(tip.error());
  auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  const double z = w->top_z_mm - tip->below_mm;
  PathJob slim = task;  // at its tip the cutter is as wide as this
  slim.cutter.cutting_diameter_mm = 2.0 * tip->radius_mm;
  slim.cutter.corner_radius_mm = 0.0;
  if (slim.approach.kind == Approach::Kind::kFree) {
    // Wide enough that the cone or round is clear of the edge where the arc begins.
    slim.approach.kind = Approach::Kind::kTangent;
    slim.approach.radius_mm = 2.0 * s.depth_mm + 2.0 * s.chamfer_width_mm + 0.5;
  }
  if (outside) return around_outside(slim, z, job);
  w->bottom_z_mm = z;
  w->slope_rad = w->bottom_radius_mm = 0.0;
  PathWriter writer(task);
  LevelCutter c(slim, *w, writer, job);
  Level level(slim, *w, z, z, 0.0);
  if (level.centres.empty())
    return refuse("TPA-NO-FIT", "the cutter's tip, " + trimmed(2.0 * tip->radius_mm, 3) +
                                    " mm wide, does not fit inside the edge; take a narrower one");
  level.cleared.emplace(level.centres);
  if (auto ok = along_edges(c, level, task.cutter.cutting_diameter_mm); !ok)
    return tl::unexpected(ok.error());
  GeneratedPath out = writer.finish();
  out.levels_z_mm = {z};
  return out;
}

}  // namespace

Result<GeneratedPath> edge_path(const PathJob& task, Job& job) { return along_edge(task, kTipBelow, job); }

Result<GeneratedPath> broken_edge_path(const PathJob& task, Job& job) {
  PathJob edge = task;
  auto& s = edge.shape;
  if (!(task.axial_depth_mm > 0.0)) {
    return fail({.code = "TPA-DEPTH",
                 .message = s.name + ": the edge break has no size; state axial_cutting_depth",
                 .path = s.name});
  }
  if (s.kind == model::ShapeKind::kHole)
    s.area = s.reach = geometry::disc({0.0, 0.0}, 0.5 * s.diameter.middle());
  s.kind = model::ShapeKind::kChamfer;
  s.chamfer_angle_rad = 0.5 * (M_PI - task.cutter.point_angle_rad);
  s.depth_mm = task.axial_depth_mm;
  s.chamfer_width_mm = s.depth_mm / std::tan(s.chamfer_angle_rad);
  s.through = false;
  edge.axial_depth_mm = 0.0;
  return edge_path(edge, job);
}

// The wall of the hole below is the edge's: the cutter's cone runs along it, its tip below the cone's foot
// where the hole lets it, on the foot where a shoulder stays.
Result<GeneratedPath> cone_of_hole_path(const PathJob& task, Job& job) {
  PathJob edge = task;
  auto& s = edge.shape;
  constexpr double kSame = 1e-3;  // mm: a foot as wide as the hole below
  const double lean = 0.5 * (s.diameter.nominal_mm - s.bottom_diameter_mm) / s.depth_mm;
  const double foot = 0.5 * s.bottom_diameter_mm;
  s.chamfer_width_mm = 0.5 * s.diameter.middle() - task.allowance_side_mm - foot;
  if (!(s.chamfer_width_mm > 0.0)) {
    return fail({.code = "TPA-DEPTH",
                 .message = s.name + ": an allowance of " + trimmed(task.allowance_side_mm, 3) +
                            " mm leaves nothing of the cone to cut",
                 .path = s.name});
  }
  s.depth_mm = s.chamfer_width_mm / lean;
  s.chamfer_angle_rad = std::atan(1.0 / lean);
  s.kind = model::ShapeKind::kChamfer;
  s.area = s.reach = geometry::disc({0.0, 0.0}, foot);
  s.through = false;
  edge.allowance_side_mm = edge.allowance_bottom_mm = 0.0;
  const bool free_below = task.hole_below_mm >= s.bottom_diameter_mm - kSame;
  return along_edge(edge, free_below ? kTipBelow : 0.0, job);
}

}  // namespace capstan::toolpath
