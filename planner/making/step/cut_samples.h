#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "planner/making/optimise/feeds.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"

// Cross sections as feeds ask for them, measured or brought by a file.

namespace capstan::step {

/// Samples of a measured path. A section that is no rectangle (a wall and a floor at once) becomes one that
/// is as deep and as wide, with the same area counted twice.
///
/// No section is wider than the cutter at its depth (for a ball or a bull nose: where the contact ends),
/// because the cutter is a disc that is moved, on arcs as on lines.
///
/// On a way down, the area beyond that over its depth is cut by the cutter's end (CutSample::end_mm2): where
/// a ramp or helix first touches, the depth is 0 and the area is that of the whole end. On a level way, the
/// area beyond depth times width means that the cut is deeper than was measured.
[[nodiscard]] std::vector<optimise::CutSample> samples_of(const engagement::Measurement& measured,
                                                          const model::CutterPath& path,
                                                          const model::Cutter& cutter);

/// Of the seven numbers alone, no simulation: depth ADmax, width RDmax, and the arc of contact from the width
/// about Xmaxofs on the cutter's diameter,
///
///     entry = acos(-x1 / R), exit = acos(-x2 / R)    x1, x2 = Xmaxofs -+ RDmax / 2, within +-R
///
/// A sample ends at its own point and begins at the point before on the same move. It takes the larger values
/// of the two points, because the numbers of a polyline change evenly between them.
/// Source  AP238 edition 2, 4.2.379.4; chord geometry.
/// Widths are bounded as those of a measured path.
[[nodiscard]] std::vector<optimise::CutSample> samples_of(const model::SectionSeries& series,
                                                          const model::CutterPath& path,
                                                          const model::Cutter& cutter);

/// Why a section series is impossible, in words, with the first place of it; nothing if it is possible. Each
/// of the seven numbers must be finite, none of ADmax, RDmax and CSA below 0, ADmax within the cutting
/// length, RDmax within the diameter, and the offsets within the cutter. The area must lie within what the
/// cutter meets there: the disc when it moves along its axis, the profile otherwise, and in level straight
/// moves ADmax x RDmax. On arcs the edge goes farther than the centre by the cutter's radius over the arc's.
[[nodiscard]] std::optional<std::string> impossible(const model::SectionSeries& series,
                                                    const model::CutterPath& path, double cutting_diameter_mm,
                                                    double cutting_length_mm);

/// Both means of depth and width, weighed by what is removed, where they are apart; nothing where they agree.
[[nodiscard]] std::optional<std::string> extents_contradict(const model::SectionSeries& stated,
                                                            const model::SectionSeries& measured,
                                                            double cutting_diameter_mm);

/// Sections that a file states, compared with those measured along the path.
struct SectionsCompared {
  std::vector<optimise::CutSample> samples;  ///< the file's; measured ones where those are larger
  std::size_t contradictions = 0;            ///< places where both differ by more than the tolerance
  std::string worst;                         ///< the place and both numbers
};

/// Tolerance of a comparison: a part of the larger area, and of depth times diameter. Twice and more what
/// measuring on a coarse map may be off; default, unsourced.
inline constexpr double kSectionsTolerance = 0.15;
inline constexpr double kSectionsFloor = 0.03;
inline constexpr double kRingFloor = std::numbers::pi / 60.0;  ///< of the diameter squared; derived
/// Of the diameter, for mean depth and width. Default, unsourced.
inline constexpr double kExtentsFloor = 0.1;

[[nodiscard]] SectionsCompared compared(const std::vector<optimise::CutSample>& stated,
                                        const std::vector<optimise::CutSample>& measured,
                                        double cutting_diameter_mm);

}  // namespace capstan::step
