#include "planner/making/step/cut/thread_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

// A thread mill of radius R on a circle of radius r = (major diameter - 2 R) / 2 in a core hole of radius k
// meets material over the arc from the wall outside to where its circle leaves the core hole,
//
//     cos t = (k^2 - r^2 - R^2) / (2 r R),      ae = R (1 - cos t)
//
// which is far more than the thread's depth, for the mill nearly fills the hole. One profile is taken as a
// slot cutter as high as the pitch. Its triangle has flanks of 60 degrees (ISO 68-1) and is at most 0.6134 p
// deep: its two flanks have the area of 0.71 p times the chip, at chips half as thick, which takes 2^mc times
// the specific force: 0.82 p for mc of 0.22, 0.87 p for 0.3. On the half circle that leads in, the profile is
// less deep than on the turn; integrated over the front of the mill, its torque and its largest chip stay
// below 0.7 of the rectangle's for M3 to M24 and mills of 0.33 to 0.8 of the major diameter. A mill with
// several profiles has all of them in the cut on its first turn.
//
// A feed per tooth is that of the edge at the thread's major diameter D; programs and this planner feed the
// centre, whose circle is smaller:
//
//     centre feed = edge feed (D - d) / D        d = 2 R
//
// The chip grows with the arc: edge feed per tooth = chip / sin t, of the t and a_e above.
// Source  Sandvik Coromant, Threading, thread milling formulas: internal thread milling (p. 117).

namespace capstan::step {

ThreadBound thread_bound(const model::Cutter& cutter, const model::FeatureShape& thread) {
  const double big = 0.5 * cutter.cutting_diameter_mm;
  const double pitch = thread.thread_pitch_mm, rows = cutter.maximum_depth_of_cut_mm;
  const double depth = thread.thread_depth_mm > 0.0 ? thread.thread_depth_mm : thread.depth_mm;
  // Less than two pitches of teeth are one profile.
  const double ap = rows >= 2.0 * pitch ? std::max(pitch, std::min(rows, depth)) : pitch;
  const double r = 0.5 * thread.thread_major_mm - big, k = 0.5 * thread.diameter.nominal_mm;
  if (!(r > 0.0) || !(big > 0.0)) return {ap, cutter.cutting_diameter_mm};
  const double cosine = std::clamp((k * k - r * r - big * big) / (2.0 * r * big), -1.0, 1.0);
  return {ap, big * (1.0 - cosine), r / (r + big)};
}

std::vector<optimise::CutSample> bound_samples(const ThreadBound& bound, const model::CutterPath& path) {
  std::vector<optimise::CutSample> out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool arc = path.kind[i] == model::MoveKind::kArcCw || path.kind[i] == model::MoveKind::kArcCcw;
    if (!arc || path.role[i] != model::MoveRole::kCut) continue;
    const double length = model::move_length(path, i);
    out.push_back({.move = static_cast<std::uint32_t>(i),
                   .ap_mm = bound.ap_mm,
                   .ae_mm = bound.ae_mm,
                   .at_mm = length,
                   .step_mm = length,
                   .csa_mm2 = bound.ap_mm * bound.ae_mm});
  }
  return out;
}

}  // namespace capstan::step
