#pragma once

#include <algorithm>

/// The cut of a thread mill in a core hole, as a rectangle of depth and width.
///
/// A thread mill of radius R on a circle of radius r = (major diameter - 2 R) / 2 in a core hole of radius k
/// meets material over the arc from the wall outside to where its circle leaves the core hole,
///
///     cos t = (k^2 - r^2 - R^2) / (2 r R),      ae = R (1 - cos t)
///
/// which is far more than the thread's depth, for the mill nearly fills the hole. One profile is taken as a
/// slot cutter as high as the pitch. Its triangle has flanks of 60 degrees (ISO 68-1) and is at most 0.6134 p
/// deep: its two flanks have the area of 0.71 p times the chip, at chips half as thick, which takes 2^mc
/// times the specific force: 0.82 p for mc of 0.22, 0.87 p for 0.3. On the half circle that leads in, the
/// profile is less deep than on the turn; integrated over the front of the mill, its torque and its largest
/// chip stay below 0.7 of the rectangle's for M3 to M24 and mills of 0.33 to 0.8 of the major diameter. A
/// mill with several profiles has all of them in the cut on its first turn.
///
/// A feed per tooth is that of the edge at the thread's major diameter D; programs and this planner feed the
/// centre, whose circle is smaller:
///
///     centre feed = edge feed (D - d) / D        d = 2 R
///
/// The chip grows with the arc: edge feed per tooth = chip / sin t, of the t and a_e above.
/// Source  Sandvik Coromant, Threading, thread milling formulas: internal thread milling (p. 117).
namespace capstan::mechanics {

/// A thread of this depth, mm. `core_mm`: diameter of the hole that is there.
struct MilledThread {
  double major_mm = 0.0, pitch_mm = 0.0, depth_mm = 0.0, core_mm = 0.0;
};

/// A rectangle of depth and width that no section of a milled inner thread exceeds in force: its cut lies
/// under an overhang and is not measured.
struct ThreadBound {
  double ap_mm = 0.0, ae_mm = 0.0;
  /// Feed of the cutter's centre over that of its edge at the thread's major diameter.
  double centre_share = 1.0;
};

/// `rows_mm`: length of the cutter's teeth; less than two pitches of them are one profile. A mill that is not
/// narrower than the thread cuts with its whole width.
[[nodiscard]] inline ThreadBound thread_bound(double cutter_mm, double rows_mm, const MilledThread& t) {
  const double big = 0.5 * cutter_mm;
  const double ap =
      rows_mm >= 2.0 * t.pitch_mm ? std::max(t.pitch_mm, std::min(rows_mm, t.depth_mm)) : t.pitch_mm;
  const double r = 0.5 * t.major_mm - big, k = 0.5 * t.core_mm;
  if (!(r > 0.0) || !(big > 0.0)) return {ap, cutter_mm};
  const double cosine = std::clamp((k * k - r * r - big * big) / (2.0 * r * big), -1.0, 1.0);
  return {ap, big * (1.0 - cosine), r / (r + big)};
}

}  // namespace capstan::mechanics
