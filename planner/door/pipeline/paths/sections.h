#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "planner/making/optimise/feeds.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"

// Cross sections as feeds ask for them, measured or brought by a file; only planner/door/pipeline/*.cpp
// include this.

namespace capstan::pipeline {

/// Of a measured path. A section that is no rectangle (a wall and a floor at once) counts as two of its area:
/// as deep, and as wide.
[[nodiscard]] std::vector<optimise::CutSample> samples_of(const engagement::Measurement& measured);

/// A cutter that goes down on a slope cuts with its end, too: over its depth of contact it removes more than
/// any width of it could, which as a side cut would be a chip many times the feed per tooth. Such sections
/// are told as the slot that removes the same: as wide as the cutter can sweep (more on an arc of radius rho:
/// the outer edge goes farther), and so much deeper. Gives whether there are any.
///
///     ae <= max(D, (rho + R)^2 / (2 rho)),   ap = area / ae        derived: the same volume per length
bool end_cuts_as_slots(std::vector<optimise::CutSample>& samples, const model::CutterPath& path,
                       double cutting_diameter_mm);

/// Of the seven numbers alone, no simulation: depth ADmax, width RDmax, and the arc of contact from the width
/// about Xmaxofs on the cutter's diameter,
///
///     entry = acos(-x1 / R), exit = acos(-x2 / R)    x1, x2 = Xmaxofs -+ RDmax / 2, within +-R
///
/// A step ends where its sample stands and begins at the sample before on the same move; over it the larger
/// of both holds, for between two points of a polyline the numbers change evenly.
/// Source  AP238 edition 2, 4.2.379.4; chord geometry.
[[nodiscard]] std::vector<optimise::CutSample> samples_of(const model::SectionSeries& series,
                                                          const model::CutterPath& path,
                                                          double cutting_diameter_mm);

/// What no section can be, in words, with the first place of it; nothing when all are possible: each of the
/// seven numbers finite, none of ADmax, RDmax and CSA below 0, ADmax within the cutting length, RDmax within
/// the diameter, the offsets within the cutter, and the area within what the cutter meets there: the disc
/// when it moves along its axis, the profile otherwise, and in level straight moves ADmax x RDmax. On arcs
/// the edge goes farther than the centre by the cutter's radius over the arc's.
[[nodiscard]] std::optional<std::string> impossible(const model::SectionSeries& series,
                                                    const model::CutterPath& path, double cutting_diameter_mm,
                                                    double cutting_length_mm);

/// Both means of depth and width, weighed by what is removed, where they are apart; nothing where they agree.
[[nodiscard]] std::optional<std::string> extents_contradict(const model::SectionSeries& stated,
                                                            const model::SectionSeries& measured,
                                                            double cutting_diameter_mm);

/// What a file says of a path's sections, held against what was measured.
struct SectionsCompared {
  std::vector<optimise::CutSample> samples;  ///< the file's; measured ones where those are larger
  std::size_t contradictions = 0;            ///< places where both differ by more than the tolerance
  std::optional<std::size_t> worst_move;
  std::string worst;  ///< the place and both numbers
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

}  // namespace capstan::pipeline
