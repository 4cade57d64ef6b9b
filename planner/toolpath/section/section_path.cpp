#include "planner/toolpath/section/section_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "planner/toolpath/region/patterns.h"
#include "planner/toolpath/section/section.h"
#include "planner/toolpath/section/spine.h"

namespace capstan::toolpath {

using geometry::Vec2;
using model::CutterClass;
using model::MoveRole;
using model::TypeId;

namespace {

/// Height of the ridges that finishing leaves, mm. Default, unsourced.
constexpr double kScallop = 0.01;
/// Levels of a flat cutter that finishes a leaning or round wall, mm. Default, unsourced.
constexpr double kFinishLevel = 0.5;
/// What is left for the finishing passes where no earlier step has roughed, mm. Default, unsourced.
constexpr double kOwnAllowance = 0.3;
/// Levels of that roughing by the diameter, where no depth is given. Default, unsourced.
constexpr double kOwnLevel = 0.25;
constexpr double kUsualRamp = 3.0 * std::numbers::pi / 180.0;  // default, unsourced
constexpr double kLeastU = 0.02;    ///< mm; nearer to the middle a track is the middle itself
constexpr double kTellRest = 0.01;  ///< mm

bool finishes(TypeId op) {
  return op == TypeId::kBottomAndSideFinishMilling || op == TypeId::kSideFinishMilling;
}

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
    const bool rounds = finishes(task_.operation) && tip_.corner_mm > 0.0;
    Status ok;
    if (!rounds) {
      ok = clear(task_.allowance_side_mm, task_.allowance_bottom_mm, level_step(), true);
    } else {
      if (!task_.left_on_side_mm) {
        cutter_.warn("TPA-ROUGH", "no earlier step has roughed it; this one clears it in levels first");
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
                 .message = "the cutter " + task_.cutter.id + " does not fit into the section of " +
                            task_.shape.name + " at any height",
                 .path = task_.shape.name,
                 .hint = "a smaller cutter would"});
  }

  [[nodiscard]] double level_step() const {
    if (task_.multiple_passes.has_value() && !*task_.multiple_passes) return 0.0;
    const double asked = task_.axial_depth_mm;
    if (!finishes(task_.operation)) return asked;
    return asked > 0.0 ? std::min(asked, kFinishLevel) : kFinishLevel;
  }

  /// Levels from above, everything within the section that the cutter reaches, from the middle outwards.
  Status clear(double side, double bottom, double step, bool tell) {
    const Tip thick{tip_.radius_mm + side, tip_.corner_mm > 0.0 ? tip_.corner_mm + side : 0.0};
    const double lowest = std::max(drop(section_, thick, 0.0) + bottom, bottom);
    if (tell && lowest > bottom + side + kTellRest) {
      cutter_.warn("TPA-REST", "the cutter " + task_.cutter.id + " stays " + trimmed(lowest, 3) +
                                   " mm above the bottom: it is wider than the section there");
    }
    const double end = zero_z_ + lowest;
    const auto zs = levels(area_, task_.start_z_mm, end, step, 0.0);
    if (zs.empty() && lowest >= section_.depth_mm - 1e-6) return no_fit();
    if (zs.empty()) {
      return fail({.code = "TPA-DEPTH",
                   .message = task_.shape.name + ": the cutter " + task_.cutter.id +
                              " reaches nothing below " + trimmed(task_.start_z_mm, 3) + " mm",
                   .path = task_.shape.name});
    }
    double from = task_.start_z_mm;
    for (const double z : zs) {
      const double wide = widest_at(section_, thick, z - zero_z_ - bottom);
      if (wide < 0.0) continue;
      if (auto ok = level(z, from, wide); !ok) return ok;
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
      if (t.closed) t = begun_at(t, nearest(t, spine_.line.front()));
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
    if (t.closed) t = begun_at(t, nearest(t, here));
    writer_.line({t.start.x, t.start.y, z}, MoveRole::kCut);
    writer_.follow(t, z, MoveRole::kCut);
    return {};
  }

  Status finish() {
    const Tip thick{tip_.radius_mm + task_.allowance_side_mm, tip_.corner_mm + task_.allowance_side_mm};
    const Finishing all = finishing(section_, thick, kScallop, task_.axial_depth_mm);
    cutter_.job.note("TPA-DEFAULT", task_.shape.name + ": finished to ridges of " + trimmed(kScallop, 3) +
                                        " mm at most (default, unsourced)");
    if (all.rest_mm > kTellRest) {
      cutter_.warn("TPA-REST", "the cutter's radius of " + trimmed(tip_.corner_mm, 3) + " mm leaves up to " +
                                   trimmed(all.rest_mm, 3) + " mm in the corners of the section");
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
    if (t.closed) t = begun_at(t, nearest(t, here));
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

  /// Down along a track by no more than the ramp angle, then once around from there.
  Status sink(const Track& t, double z) {
    const double fall = writer_.at().z - z;
    const double most = task_.cutter.maximum_ramp_angle_rad;
    const double length = length_of(t);
    if (fall > 1e-9 && !(most > 0.0) && !task_.cutter.centre_cutting) {
      return fail({.code = "TPA-ENTRY",
                   .message = task_.shape.name + ": the cutter " + task_.cutter.id +
                              " may neither ramp nor plunge from pass to pass",
                   .path = task_.shape.name});
    }
    const bool ramps = fall > 1e-9 && most > 0.0 && (t.closed || fall <= length * std::tan(most));
    if (!ramps) {
      if (fall > 1e-9 && !task_.cutter.centre_cutting)
        return fail({.code = "TPA-ENTRY",
                     .message = task_.shape.name + ": too short for the cutter's ramp",
                     .path = task_.shape.name});
      writer_.descend(z, writer_.at().z);
      writer_.follow(t, z, MoveRole::kCut);
      return {};
    }
    if (!t.closed) {
      writer_.follow_down(t, z, MoveRole::kRamp);
      writer_.follow(reversed(t), z, MoveRole::kCut);
      return {};
    }
    const double run = fall / std::tan(std::min(most, kUsualRamp));
    const double top = writer_.at().z;
    const int rounds = std::min(1000, static_cast<int>(std::floor(run / length)));
    for (int i = 1; i <= rounds; ++i)
      writer_.follow_down(t, top - fall * (i * length / run), MoveRole::kRamp);
    const double rest = run - rounds * length;
    const Track part = part_of(t, 0.0, rest);
    if (rest > 1e-6 && !part.segments.empty()) {
      writer_.follow_down(part, z, MoveRole::kRamp);
      writer_.follow(begun_at(t, at_length(t, rest)), z, MoveRole::kCut);
    } else {
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

bool mills_sections(const model::Cutter& c) {
  return c.cutter_class == CutterClass::kEndmill || c.cutter_class == CutterClass::kBullnoseEndmill ||
         c.cutter_class == CutterClass::kBallEndmill || c.cutter_class == CutterClass::kFacemill;
}

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
