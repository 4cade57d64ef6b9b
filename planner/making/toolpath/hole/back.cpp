#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/link/path_writer.h"
#include "planner/making/toolpath/refuse.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/model/plan/clearances.h"

// Counterbores and countersinks at the far end of a hole, milled on circles from above.

namespace capstan::toolpath {

using geometry::Vec2;
using geometry::Vec3;
using model::CutterClass;
using model::MoveRole;

namespace {

constexpr double kSidePart = 0.25;  ///< of the head's diameter: most that a circle takes; default, unsourced
constexpr double kHeightPart = 0.25;  ///< of the head's height: most that a level takes; default, unsourced
constexpr std::size_t kMost = 400;    ///< circles or levels

/// The head, and where the cutter stands for the last level.
struct Back {
  double head_mm = 0.0, height_mm = 0.0, neck_mm = 0.0;
  double aside_mm = 0.0;  ///< of the last circle
  double low_z = 0.0, high_z = 0.0;
};

/// How far off the middle the last circle is, mm.
double aside_of(const PathJob& task) {
  const double widest = task.cutter.cutter_class == CutterClass::kBackCountersink
                            ? task.shape.bottom_diameter_mm
                            : task.shape.diameter.middle() - 2.0 * task.allowance_side_mm;
  return 0.5 * (widest - task.cutter.cutting_diameter_mm);
}

Result<Back> sized(const PathJob& task) {
  const auto& c = task.cutter;
  const auto& s = task.shape;
  Back b{c.cutting_diameter_mm, c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm,
         c.neck_diameter_mm, aside_of(task)};
  if (!(b.height_mm > 0.0))
    return refuse(task, "TPA-TOOL",
                  "cutter " + c.id + ": the height of its head is missing; state its cutting width");
  if (!(b.neck_mm > 0.0 && b.neck_mm < b.head_mm))
    return refuse(task, "TPA-TOOL",
                  "cutter " + c.id + ": its neck diameter is missing or not below its " +
                      trimmed(b.head_mm, 3) + " mm; state it (the hole above is " +
                      trimmed(task.hole_above_mm, 3) + " mm)");
  const double top = task.feature_in_setup.origin.z;
  const double bottom = top - s.depth_mm;
  const double half = 0.5 * s.diameter.middle();
  if (c.cutter_class == CutterClass::kBackCountersink) {
    const double wide = 0.5 * s.bottom_diameter_mm;
    const double lean = std::atan2(wide - half, s.depth_mm);
    if (!s.through)
      return refuse(task, "TPA-TOOL",
                    "the head of cutter " + c.id + ", " + trimmed(b.height_mm, 3) +
                        " mm high, needs air below the cone; mill it from the other side");
    if (std::abs(0.5 * c.point_angle_rad - lean) > 0.01)
      return refuse(task, "TPA-TOOL",
                    "its cone of " + trimmed(2.0 * lean * 180.0 / std::numbers::pi, 2) +
                        " degrees needs a back countersink of that angle");
    const double cone = 0.5 * (b.head_mm - b.neck_mm) / std::tan(0.5 * c.point_angle_rad);
    if (cone > b.height_mm + 1e-9 || cone < s.depth_mm - 1e-9)
      return refuse(task, "TPA-NO-FIT",
                    "the cutter's cone is " + trimmed(cone, 3) + " mm high, the hole's " +
                        trimmed(s.depth_mm, 3) + " mm, the head " + trimmed(b.height_mm, 3) + " mm");
    b.low_z = b.high_z = bottom - (b.height_mm - cone);
  } else {
    b.high_z = top - b.height_mm;
    // From below: the first level takes the lowest part, the rest of the head hangs in the air below.
    const double low = s.through ? bottom + back_cut(task).ap_mm - b.height_mm : bottom;
    b.low_z = std::min(low + task.allowance_bottom_mm, b.high_z);
    if (!s.through && b.high_z < bottom - 1e-6)
      return refuse(task, "TPA-NO-FIT",
                    "the cutter's head is " + trimmed(b.height_mm, 3) + " mm high, the room below the hole " +
                        trimmed(s.depth_mm, 3) + " mm");
  }
  return b;
}

/// Whether head and neck pass the narrow hole; what would, when not.
Status passes(const PathJob& task, const Back& b) {
  const double hole = task.hole_above_mm;
  if (!(b.aside_mm > 0.0))
    return refuse(task, "TPA-NO-FIT",
                  "the head of cutter " + task.cutter.id + ", " + trimmed(b.head_mm, 3) +
                      " mm, is not smaller than what it mills, " +
                      trimmed(std::max(task.shape.diameter.middle(), task.shape.bottom_diameter_mm), 3) +
                      " mm; use a smaller one");
  const double room = 0.5 * (hole - b.neck_mm) - model::kNeckClearMm;
  if (b.head_mm <= hole - 2.0 * model::kHeadClearMm + 1e-9 && b.aside_mm <= room + 1e-9) return {};
  const double most = hole - 2.0 * model::kHeadClearMm;
  const double neck =
      hole - 2.0 * model::kNeckClearMm - 2.0 * b.aside_mm - b.head_mm + std::min(b.head_mm, most);
  return fail({.code = "TPA-NO-FIT",
               .message = task.shape.name + ": the cutter " + task.cutter.id + " with a head of " +
                          trimmed(b.head_mm, 3) + " mm and a neck of " + trimmed(b.neck_mm, 3) +
                          " mm does not mill it through the hole of " + trimmed(hole, 3) + " mm",
               .path = task.shape.name,
               .hint = neck > 0.0 ? "a head of " + trimmed(std::min(b.head_mm, most), 3) +
                                        " mm on a neck of at most " + trimmed(neck, 3) + " mm would"
                                  : "no neck is thin enough: turn the piece over"});
}

}  // namespace

BackCut back_cut(const PathJob& task) {
  const auto& c = task.cutter;
  const double head = c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm;
  const double ae = kSidePart * c.cutting_diameter_mm;
  // A cone's cut is a triangle: half as deep in the mean. Above a bottom the whole head cuts at once.
  if (c.cutter_class == CutterClass::kBackCountersink) return {0.5 * task.shape.depth_mm, ae};
  return {task.shape.through ? kHeightPart * head : head, ae};
}

double last_circle_mm(const PathJob& task, double bent_mm) {
  const double r = 0.5 * task.cutter.cutting_diameter_mm;
  const double aside = aside_of(task);
  if (!(aside > 0.0)) return 0.0;
  const double w = std::max(0.5 * task.hole_above_mm, r + aside - kLastSide) - bent_mm;
  const double flat = 0.5 * (w * w - aside * aside - r * r) / aside;
  return std::clamp(r - flat, 0.0, 2.0 * r);
}

bool cuts_from_below(const PathJob& task) {
  return task.cutter.cutter_class == CutterClass::kTSlotMill ||
         task.cutter.cutter_class == CutterClass::kBackCountersink;
}

Result<GeneratedPath> back_path(const PathJob& task, Job&) {
  if (!(task.hole_above_mm > 0.0))
    return refuse(task, "TPA-ENTRY", "a cutter with a neck needs a narrower hole above to go down by");
  const auto b = sized(task);
  if (!b) return tl::unexpected(b.error());
  if (auto ok = passes(task, *b); !ok) return tl::unexpected(ok.error());
  const BackCut most = back_cut(task);
  // Circles whose contact angle is that of a straight cut of the width allowed: the next centre e follows
  // from the wall w that the last one left by w^2 = e^2 + R^2 + 2 e (R - ae). The last takes kLastSide.
  std::vector<double> circles;
  const double r = 0.5 * b->head_mm;
  double wall = 0.5 * task.hole_above_mm;
  const double rough = b->aside_mm - kLastSide;
  while (wall < rough + r - 1e-9) {
    const double flat = r - most.ae_mm;
    const double e = -flat + std::sqrt(flat * flat - r * r + wall * wall);
    if (circles.size() >= kMost || !(e > (circles.empty() ? 0.0 : circles.back() + 1e-6)))
      return refuse(task, "TPA-NO-FIT",
                    "the cutter's head of " + trimmed(b->head_mm, 3) +
                        " mm is too small for what it mills: it takes more than " + std::to_string(kMost) +
                        " circles; take a larger one");
    circles.push_back(std::min(e, rough));
    wall = circles.back() + r;
  }
  circles.push_back(b->aside_mm);
  const double rise = b->high_z - b->low_z;
  const double levels_most = rise / most.ap_mm;
  if (!(levels_most <= kMost))
    return refuse(task, "TPA-NO-FIT",
                  "the cutter takes levels of " + trimmed(most.ap_mm, 3) + " mm in a height of " +
                      trimmed(rise, 3) + " mm, which are more than " + std::to_string(kMost) +
                      "; take one with a higher head");
  const int levels = static_cast<int>(std::ceil(levels_most - 1e-9));
  const bool cw = !walls_on_right(task);
  const Vec2 c = xy(task.feature_in_setup.origin);
  PathWriter w(task);
  GeneratedPath out;
  std::vector<double> heights;
  w.over(c);
  w.descend(b->low_z, b->low_z);
  for (int i = 0; i <= levels; ++i) {
    const double z = levels > 0 ? b->low_z + rise * i / levels : b->high_z;
    if (i > 0) w.line({c.x, c.y, z}, MoveRole::kLink);
    for (std::size_t k = 0; k < circles.size(); ++k) {
      const double e = circles[k];
      const bool last = k + 1 == circles.size();
      w.factors(last ? task.last_share.value_or(1.0) : 1.0, 1.0);
      // Out on a half circle, round, and back to the middle on another: the wall is met and left along it.
      w.arc({c.x + e, c.y, z}, {c.x + 0.5 * e, c.y}, cw, MoveRole::kCut);
      w.arc({c.x - e, c.y, z}, c, cw, MoveRole::kCut);
      w.arc({c.x + e, c.y, z}, c, cw, MoveRole::kCut);
      w.arc({c.x, c.y, z}, {c.x + 0.5 * e, c.y}, cw, last ? MoveRole::kRetract : MoveRole::kCut);
    }
    w.factors(1.0, 1.0);
    heights.push_back(z);
  }
  // Up through the narrow hole at feed, in its middle.
  w.line({c.x, c.y, task.start_z_mm + task.clearance_mm}, MoveRole::kRetract);
  out = w.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
