#include "planner/making/toolpath/section/section_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/section/section.h"
#include "planner/making/toolpath/section/spine.h"

namespace capstan::toolpath {

using geometry::Vec2;
using model::CutterClass;
using model::MoveRole;
using model::TypeId;

namespace {

/// Largest height of the ridges after finishing, mm. Default, unsourced.
constexpr double kScallop = 0.01;
/// Largest height of the steps that a flat cutter leaves in finishing a leaning or round wall, square to the
/// wall, mm. Default, unsourced.
constexpr double kFinishStep = 0.35;
/// The same of roughing before a round cutter, of the diameter: as high as those of freeform roughing at 45
/// degrees. Default, unsourced.
constexpr double kRoughStep = 0.18;
/// Allowance for the finishing passes where no earlier step has roughed, mm. Default, unsourced.
constexpr double kOwnAllowance = 0.3;
/// Depth of the levels of that roughing, in diameters, if none is given. Default, unsourced.
constexpr double kOwnLevel = 0.25;
constexpr double kTellRest = 0.01;  ///< mm

constexpr double kCrumb = 0.02;  ///< mm, of a path's pieces; default, unsourced

/// A place on the track, moved to the nearest end of a segment when it is almost there: no crumbs of arcs.
Spot snapped(const Track& t, Spot s) {
  const Vec2 from = s.segment == 0 ? t.start : t.segments[s.segment - 1].to;
  const double l = length_of(from, t.segments[s.segment]);
  if (s.t * l < kCrumb) {
    s.t = 0.0;
    s.point = from;
  } else if ((1.0 - s.t) * l < kCrumb) {
    s.t = 1.0;
    s.point = t.segments[s.segment].to;
  }
  return s;
}
double length_to(const Track& t, const Spot& s) {
  Vec2 at = t.start;
  double sum = 0.0;
  for (std::size_t i = 0; i < s.segment; ++i) {
    sum += length_of(at, t.segments[i]);
    at = t.segments[i].to;
  }
  return sum + s.t * length_of(at, t.segments[s.segment]);
}
Track begun_near(const Track& t, Vec2 p) { return begun_at(t, snapped(t, nearest(t, p))); }

class SectionCutter {
 public:
  SectionCutter(const PathJob& task, Job& job, const WorkArea& area, Section section, Spine spine)
      : task_(task),
        area_(area),
        section_(std::move(section)),
        spine_(std::move(spine)),
        writer_(task),
        cutter_(task_, area_, writer_, job),
        tip_{0.5 * task.cutter.cutting_diameter_mm, task.cutter.corner_radius_mm},
        zero_z_(area.top_z_mm - section_.depth_mm),
        right_(walls_on_right(task)) {}

  Result<GeneratedPath> run() {
    const bool rounds = model::finishes_walls(task_.operation) && tip_.corner_mm > 0.0;
    Status ok;
    if (!rounds) {
      ok = clear(task_.allowance_side_mm, task_.allowance_bottom_mm, level_step(), true);
    } else {
      if (!task_.left_on_side_mm) {
        cutter_.warn("TPA-ROUGH", "no roughing step before it; it roughs in levels first");
        const double own = kOwnLevel * 2.0 * tip_.radius_mm;
        const double step = task_.axial_depth_mm > 0.0 ? std::min(task_.axial_depth_mm, own) : own;
        ok = clear(std::max(kOwnAllowance, task_.allowance_side_mm),
                   std::max(kOwnAllowance, task_.allowance_bottom_mm), step, false);
      }
      if (ok) ok = finish();
    }
    if (!ok) return tl::unexpected(ok.error());
    if (!writer_.begun()) return no_fit();
    GeneratedPath out = writer_.finish();
    out.levels_z_mm = heights_;
    return out;
  }

 private:
  [[nodiscard]] tl::unexpected<Diagnostic> no_fit() const {
    return fail({.code = "TPA-NO-FIT",
                 .message = "cutter " + task_.cutter.id + " (" + trimmed(2.0 * tip_.radius_mm, 3) +
                            " mm) is wider than its slot at every height",
                 .path = task_.shape.name,
                 .hint = "use a smaller cutter"});
  }

  [[nodiscard]] double level_step() const {
    if (task_.multiple_passes.has_value() && !*task_.multiple_passes) return 0.0;
    return task_.axial_depth_mm;
  }

  /// Levels between which the steps on the wall stay small: far apart on steep walls, close on shallow ones.
  /// `terrace`: their height against the wall, mm.
  [[nodiscard]] std::vector<double> fine_levels(const Tip& thick, double rise, double end,
                                                double terrace) const {
    std::vector<double> out;
    double from = task_.start_z_mm;
    const double most = level_step() > 0.0 ? level_step() : 1e300;
    while (from - end > 1e-6) {
      const double wide = widest_at(section_, thick, from - zero_z_ - rise);
      const auto step_at = [&](double fall) {
        const double side = wide - std::max(0.0, widest_at(section_, thick, from - fall - zero_z_ - rise));
        return fall * side / std::hypot(fall, side);
      };
      double hi = std::min(most, from - end);
      double lo = std::min(hi, terrace);  // a step is never higher than the fall
      if (step_at(hi) <= terrace) {
        lo = hi;
      } else {
        for (int i = 0; i < 40; ++i) {
          const double mid = 0.5 * (lo + hi);
          (step_at(mid) <= terrace ? lo : hi) = mid;
        }
      }
      from = from - lo < end + 0.02 ? end : from - lo;
      out.push_back(from);
    }
    return out;
  }

  /// Levels from above, everything within the section that the cutter reaches, from the middle outwards.
  Status clear(double side, double bottom, double step, bool tell) {
    const Tip thick{tip_.radius_mm + side, tip_.corner_mm > 0.0 ? tip_.corner_mm + side : 0.0};
    // Over a round or leaning wall the allowance also applies upright; a larger one counts from the lowest
    // point.
    const double rise = std::min(side, bottom);
    const double lowest = std::max(drop(section_, thick, 0.0) + rise, bottom);
    if (tell && lowest > bottom + side + kTellRest) {
      cutter_.warn("TPA-REST", "cutter " + task_.cutter.id + " (" + trimmed(2.0 * tip_.radius_mm, 3) +
                                   " mm) is wider than its slot at the bottom: " + trimmed(lowest, 3) +
                                   " mm remain; use a narrower cutter");
    }
    const double end = zero_z_ + lowest;
    // What roughing leaves for a round cutter is even: levels as deep as may be where the wall is steep.
    const bool finishes = model::finishes_walls(task_.operation);
    const double terrace = finishes ? kFinishStep : kRoughStep * 2.0 * tip_.radius_mm;
    const bool fine = finishes ? tip_.corner_mm <= 0.0 : side > 0.0;
    const auto zs =
        fine ? fine_levels(thick, rise, end, terrace) : levels(area_, task_.start_z_mm, end, step, 0.0);
    if (zs.empty() && lowest >= section_.depth_mm - 1e-6) return no_fit();
    if (zs.empty()) {
      return fail({.code = "TPA-DEPTH",
                   .message = task_.shape.name + ": cutter " + task_.cutter.id + " reaches nothing below Z" +
                              trimmed(task_.start_z_mm, 3) + "; use a narrower one",
                   .path = task_.shape.name});
    }
    // A hole is narrowest at its bottom: what roughed that has cleared all above but the wall.
    const bool walls_only = spine_.line.size() == 1 && section_.floor &&
                            model::finishes_walls(task_.operation) && task_.left_on_side_mm.has_value();
    double from = task_.start_z_mm;
    for (const double z : zs) {
      const double wide = widest_at(section_, thick, z - zero_z_ - rise);
      if (wide < 0.0) continue;
      if (auto ok = walls_only && z > end + 1e-9 ? wall(z, from, wide) : level(z, from, wide); !ok) return ok;
      heights_.push_back(z);
      from = z;
    }
    return {};
  }

  /// Distances from the middle at one level, from inside.
  [[nodiscard]] std::vector<double> distances(double wide) const {
    std::vector<double> out;
    const bool point = spine_.line.size() == 1;
    const double step =
        std::min(stepover_of(task_), std::max(tip_.radius_mm - tip_.corner_mm, 0.5 * tip_.radius_mm));
    const int n = std::max(1, static_cast<int>(std::ceil(wide / step - 1e-9)));
    if (!point) out.push_back(0.0);
    if (wide < kLeastU) return out;
    for (int i = 1; i <= n; ++i) out.push_back(wide * i / n);
    return out;
  }

  /// Once around at the wall, from the level before.
  Status wall(double z, double from, double wide) {
    for (const Track& t : tracks_at(spine_, wide, right_)) {
      if (auto ok = writer_.begun() ? pass(t, z) : begin(t, z, from, wide); !ok) return ok;
    }
    return {};
  }

  Status level(double z, double from, double wide) {
    bool first = true;
    for (const double u : distances(wide)) {
      for (const Track& track : tracks_at(spine_, u, right_)) {
        if (auto ok = first ? begin(track, z, from, wide) : step_to(track, z); !ok) return ok;
        first = false;
      }
    }
    return {};
  }

  /// Onto the first track of a level and along it.
  Status begin(Track t, double z, double from, double wide) {
    if (spine_.from_air()) {
      if (t.closed) t = begun_near(t, spine_.line.front());
      writer_.over(t.start);
      writer_.descend(z, z);
      writer_.follow(t, z, MoveRole::kCut);
      return {};
    }
    Level l(task_, area_, z, from, 0.0);
    l.centres = within(spine_, std::max(wide, kLeastU));
    l.inside = Inside(inset(l.centres, -kInsideSlack, 0.25 * kInsideSlack));
    l.air.clear();
    auto in = cutter_.enter(l, t, wide > kLeastU ? &l.centres : nullptr);
    if (!in) return tl::unexpected(in.error());
    writer_.follow(*in, z, MoveRole::kCut);
    return {};
  }

  /// From one track of a level to the next one beside it.
  Status step_to(Track t, double z) {
    const Vec2 here = xy(writer_.at());
    if (t.closed) t = begun_near(t, here);
    writer_.line({t.start.x, t.start.y, z}, MoveRole::kCut);
    writer_.follow(t, z, MoveRole::kCut);
    return {};
  }

  Status finish() {
    const Tip thick{tip_.radius_mm + task_.allowance_side_mm, tip_.corner_mm + task_.allowance_side_mm};
    const Finishing all = finishing(section_, thick, kScallop, task_.axial_depth_mm);
    cutter_.note("TPA-DEFAULT", "ridges of up to " + trimmed(kScallop, 3) + " mm stay (default)");
    if (all.rest_mm > kTellRest) {
      cutter_.warn("TPA-REST", "the corner radius of cutter " + task_.cutter.id + ", " +
                                   trimmed(tip_.corner_mm, 3) + " mm, leaves up to " +
                                   trimmed(all.rest_mm, 3) + " mm in the corners of " + task_.shape.name +
                                   "; finish them with a flat end mill");
    }
    bool first = true;
    double last_z = task_.start_z_mm;
    for (const SectionPass& p : all.passes) {
      const double z = zero_z_ + p.height_mm + task_.allowance_bottom_mm;
      if (z >= task_.start_z_mm - 1e-9) continue;
      const double u = p.u_mm < kLeastU ? 0.0 : p.u_mm;
      const auto tracks = tracks_at(spine_, u, right_);
      for (const Track& t : tracks) {
        if (auto ok = first ? begin(t, z, last_z, u) : pass(t, z); !ok) return ok;
        first = false;
      }
      if (tracks.empty()) to_middle(z);
      heights_.push_back(z);
      last_z = z;
    }
    return {};
  }

  Status pass(Track t, double z) {
    const Vec2 here = spine_.from_air() ? spine_.line.front() : xy(writer_.at());
    if (t.closed) t = begun_near(t, here);
    if (spine_.from_air()) {
      // Both ends of the step lie in the air before the open end.
      writer_.line({t.start.x, t.start.y, writer_.at().z}, MoveRole::kApproach);
      writer_.line({t.start.x, t.start.y, z}, MoveRole::kApproach);
      writer_.follow(t, z, MoveRole::kCut);
      return {};
    }
    // Inwards first, where it is as deep or deeper, then down along the track.
    writer_.line({t.start.x, t.start.y, writer_.at().z}, MoveRole::kCut);
    return sink(t, z);
  }

  /// Down along a track by no more than the usual ramp in the material, then once around from there. A track
  /// that ends and is too short for one way down is gone to and fro along, as often as it takes.
  Status sink(const Track& t, double z) {
    const double fall = writer_.at().z - z;
    const double most = usual_ramp_rad(task_);
    const double length = length_of(t);
    if (fall > 1e-9 && !(most > 0.0) && !task_.cutter.centre_cutting) {
      return fail({.code = "TPA-ENTRY",
                   .message = task_.shape.name + ": the cutter " + task_.cutter.id +
                              " may neither ramp nor plunge from pass to pass",
                   .path = task_.shape.name});
    }
    constexpr int kMostWays = 1000;
    const Descent descent(most, task_.digit_mm);
    const double way_mm = descent.of(t);
    const bool ramps = fall > 1e-9 && way_mm > 0.0 && (t.closed || fall <= kMostWays * way_mm);
    if (!ramps) {
      if (fall > 1e-9 && !task_.cutter.centre_cutting)
        return fail({.code = "TPA-ENTRY",
                     .message = task_.shape.name + ": too short for the cutter's ramp",
                     .path = task_.shape.name});
      writer_.descend(z, writer_.at().z);
      writer_.follow(t, z, MoveRole::kCut);
      return {};
    }
    const double top = writer_.at().z;
    if (!t.closed) {
      const int ways = std::max(1, static_cast<int>(std::ceil(fall / way_mm - 1e-9)));
      for (int i = 1; i <= ways; ++i)
        writer_.follow_down(i % 2 == 1 ? t : reversed(t), i == ways ? z : top - fall * i / ways, descent,
                            MoveRole::kRamp);
      writer_.follow(ways % 2 == 1 ? reversed(t) : t, z, MoveRole::kCut);
      return {};
    }
    const int rounds = std::min(kMostWays, static_cast<int>(std::floor(fall / way_mm)));
    for (int i = 1; i <= rounds; ++i) writer_.follow_down(t, top - i * way_mm, descent, MoveRole::kRamp);
    const double needed = descent.length_for(t, fall - rounds * way_mm);
    Spot down = snapped(t, at_length(t, needed));
    // A crumb before an end may be left out, not a crumb of the way down.
    if (length_to(t, down) < needed) down = snapped(t, at_length(t, std::min(length, needed + kCrumb)));
    const double rest = length_to(t, down);
    if (rest > 1e-6 && rest < length - 1e-6) {
      writer_.follow_down(part_of(t, 0.0, rest), z, descent, MoveRole::kRamp);
      writer_.follow(begun_at(t, down), z, MoveRole::kCut);
    } else {
      if (rest > 1e-6) writer_.follow_down(t, z, descent, MoveRole::kRamp);
      writer_.descend(z, writer_.at().z);
      writer_.follow(t, z, MoveRole::kCut);
    }
    return {};
  }

  /// The last pass of a hole: across its middle, at the height reached.
  void to_middle(double z) {
    const Vec2 c = spine_.line.front();
    if (!writer_.begun()) return;
    writer_.line({c.x, c.y, writer_.at().z}, MoveRole::kCut);
    if (task_.cutter.centre_cutting) writer_.descend(z, writer_.at().z);
  }

  const PathJob& task_;
  const WorkArea& area_;
  Section section_;
  Spine spine_;
  PathWriter writer_;
  LevelCutter cutter_;
  Tip tip_;
  double zero_z_;  // of the section's height 0
  bool right_;
  std::vector<double> heights_;
};

}  // namespace

Result<GeneratedPath> form_slot_path(const PathJob& task, Job& job) {
  const auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  auto section = slot_section(task.shape);
  if (!section) return tl::unexpected(section.error());
  auto spine = spine_of_slot(task, *w, section->half_width_mm());
  if (!spine) return tl::unexpected(spine.error());
  if (spine->closed || within(*spine, section->half_width_mm()).loops.size() != 1) {
    return fail({.code = "TPA-UNSUPPORTED",
                 .message = task.shape.name +
                            ": a course that closes or crosses itself is cut by a cutter of the "
                            "section's form only",
                 .path = task.shape.name});
  }
  return SectionCutter(task, job, *w, *std::move(section), *std::move(spine)).run();
}

bool is_hole_cutter(const PathJob& task) {
  using model::HoleBottom;
  const auto& s = task.shape;
  const auto& c = task.cutter;
  if (std::abs(c.cutting_diameter_mm - s.diameter.middle()) > kSameSize || task.allowance_side_mm > 0.0)
    return false;
  if (s.bottom_diameter_mm > 0.0 && s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6) return false;
  if (s.bottom == HoleBottom::kSpherical || s.bottom == HoleBottom::kFlatWithRadius)
    return std::abs(c.corner_radius_mm - s.bottom_hole_radius_mm) <= kSameSize;
  if (s.bottom == HoleBottom::kFlat) return c.corner_radius_mm <= kSameSize;
  return s.bottom == HoleBottom::kThrough;
}

Result<GeneratedPath> sunk_path(const PathJob& task, Job&) {
  if (!task.cutter.centre_cutting &&
      task.previous_diameter_mm.value_or(0.0) < task.cutter.cutting_diameter_mm - 1e-6) {
    return fail({.code = "TPA-ENTRY",
                 .message = "the cutter " + task.cutter.id + " is as wide as " + task.shape.name +
                            " and does not cut to its centre",
                 .path = task.shape.name});
  }
  const auto o = task.feature_in_setup.origin;
  double z = o.z - task.shape.depth_mm + task.allowance_bottom_mm;
  if (task.shape.through) z -= task.break_through_mm + task.cutter.corner_radius_mm;
  if (z >= task.start_z_mm - 1e-9) {
    return fail({.code = kNothingToCut,
                 .message = task.shape.name + ": there is nothing to cut below " +
                            trimmed(task.start_z_mm, 3) + " mm",
                 .path = task.shape.name});
  }
  PathWriter writer(task);
  writer.over(xy(o));
  writer.descend(z, task.start_z_mm + std::min(task.clearance_mm, 1.0));
  writer.dwell(task.dwell_s);
  GeneratedPath out = writer.finish();
  out.levels_z_mm = {z};
  return out;
}

Result<GeneratedPath> tapered_hole_path(const PathJob& task, Job& job) {
  auto section = hole_section(task.shape, task.break_through_mm + task.cutter.corner_radius_mm);
  if (!section) return tl::unexpected(section.error());
  PathJob hole = task;
  hole.shape.area = hole.shape.reach = geometry::disc({0.0, 0.0}, section->half_width_mm());
  auto w = work_area(hole);
  if (!w) return tl::unexpected(w.error());
  // An open bottom is part of the section already.
  w->bottom_z_mm = w->top_z_mm - section->depth_mm;
  return SectionCutter(hole, job, *w, *std::move(section), spine_of_hole(hole)).run();
}

}  // namespace capstan::toolpath
