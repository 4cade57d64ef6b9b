#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/optimise/cut.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

namespace capstan::optimise {

/// How the cutter is engaged somewhere along a move; what feeds are chosen from.
///
/// Frame  angles as in mechanics/force/immersion.h: 0 at the left of the feed, pi at its right, in the sense
/// of
///        rotation.
struct CutSample {
  std::uint32_t move = 0;
  double ap_mm = 0.0, ae_mm = 0.0;
  bool plunge = false;
  double at_mm = 0.0;    ///< where on the move the sample's step ends
  double step_mm = 0.0;  ///< length of path that it represents
  double entry_rad = 0.0, exit_rad = 0.0;
  double csa_mm2 = 0.0;
  double top_mm = 0.0;   ///< highest contact above the tip; 0: not known, the depth counts from the tip
  double end_mm2 = 0.0;  ///< part of the area that no flank sweeps: the cutter's end cuts it on the way down.
                         ///< Of a plunge: area below the end where the step is deepest, on a level top; on an
                         ///< uneven one the mean over the length in contact; 0: csa_mm2
  double end_slope = 0.0;       ///< slope of the end's way down, per length of path
  double chip_over_feed = 0.0;  ///< thickest chip over the feed per tooth, as measured; 0: not measured
};

/// Feed of a plunge as a fraction of the step's feed, at most, for cutters that may do it; and so, of that
/// feed per tooth, the thickest chip that the edges of a cutter's end take on any way down. Default,
/// unsourced (handbooks give a third to a half).
inline constexpr double kPlungeFraction = 0.3;
/// Feed of moves through air that may not be rapids (close above material): at least this, mm/min, as far as
/// the axes go. Default, unsourced.
inline constexpr double kAirFeedMmMin = 3000.0;
/// Below this share of the step's feed nothing is scheduled, nor below the thinnest chip that the cutter
/// takes (least_feed_mm_min): an edge rubs there. Default, unsourced.
inline constexpr double kLeastFeedShare = 0.04;
/// Neighbouring moves whose feeds lie within this ratio share the lower one. Default, unsourced: it costs
/// about half of it in time and keeps F words and its_speed curves few.
inline constexpr double kGroupRatio = 0.03;

/// Share of depth times width from which a cross section counts as the whole rectangle. Default, unsourced.
inline constexpr double kWholeSection = 0.95;

struct FeedQuestion {
  CutQuestion cut;           ///< limits, cutter, material, machine
  double n_rpm = 0.0;        ///< of the step; positive clockwise, negative counter-clockwise
  double feed_mm_min = 0.0;  ///< of the step: plunges are a fraction of it, finishing never exceeds it
  bool adapt = true;         ///< false: a given feed is executed as given; factors above 1 do not count
  bool constant = false;     ///< one feed for all cutting moves: the largest within every section's limits
  std::vector<double> feed_factor, speed_factor, dwell_s;  ///< of the path's moves
  std::vector<CutSample> samples;                          ///< in order of moves
  double known_to_mm = 0.0;  ///< to what length along the path it is known where samples begin and end
  double group_ratio = kGroupRatio;
  bool explain = true;  ///< fill `held_by`: costs about ten more schedules
};

/// The feed at which the cutter's teeth take its thinnest chip where they are in the cut with all their feed
/// (mechanics::least_chip_mm): thinner ones rub anywhere.
[[nodiscard]] double least_feed_mm_min(const CutQuestion& q, double n_rpm);

struct FeedAnswer {
  model::FeedSchedule schedule;
  model::StepLoads peak;                       ///< over all samples at the scheduled feed
  std::vector<model::LimitAlongPath> held_by;  ///< which limits hold the feed, largest share first
  double worst_excess = -1.0;                  ///< > 0: some sample exceeds a limit even at the least feed
  model::ExceededLimit worst;  ///< which limit that is, and where; unset while nothing exceeds
};

/// The feeds that classes of cuts allow, by the question and the cut itself: equal pockets, and the ways of
/// clearing one, have them in common. Bounded: what was asked about longest ago goes first.
class KnownFeeds {
 public:
  class Classes;
  KnownFeeds();
  /// Those of one question at the step's feed. Valid until `of` is called again.
  [[nodiscard]] Classes& of(const CutQuestion& question, double feed_mm_min);

 private:
  struct Shelf;
  std::shared_ptr<std::vector<Shelf>> shelves_;  ///< used last first
};

/// Feed for each move from the sections measured along it: the largest that keeps peak force, tip deflection,
/// torque, power, chip thickness and feed mark within their limits at every sample, uncertainty, wear and the
/// operator's override included. Thin cuts go faster than the step's feed (not in finishing, unless a
/// surface is asked for and bounds them), heavy ones slower. Then:
///
///     v_i^2 <= v_(i+1)^2 + 2 a L_i
///
/// so that each move can be braked within itself to the feed of the next, where the control needs that
/// (ControlRow::brakes_within_a_move), and it arrives at a heavy section slow enough. Last, neighbours
/// within `group_ratio` share the lower feed, and no run of moves asks for more than its fastest move
/// reaches.
///
/// Plunges: a fraction of the step's feed at most, below it what torque and power of drilling allow, into as
/// much as lies below the cutter's end (where no area is known: into the solid). Ramps and helices: what the
/// sections measured along them allow, as in a slot; at most model::Ramp's share of the feed of the largest
/// chip, and no chip of the end's edges (feed per tooth times the sine of the slope) thicker than in a
/// plunge.
///
/// Shape         the schedule has one entry per move of `path`.
/// Determinism   same question, same answer; sections are compared on a grid, rounded to the heavier side.
/// Source        sections: mechanics/loads/section.h; the braking bound: derived.
/// `known`, where it is given, keeps what cuts allow for paths that are asked about later; no answer depends
/// on it.
[[nodiscard]] FeedAnswer feeds(const FeedQuestion& question, const model::CutterPath& path,
                               KnownFeeds* known = nullptr);

/// Where the engagement is constant at this width, the entry cuts as a slot does: its moves, and any other
/// that cuts half the diameter or more, get the speed and at most the feed of a wide cut, as factors of those
/// of the step, which are of a narrow one.
void enter_as_a_slot(FeedQuestion& question, double ae_mm, const model::CutterPath& path);

/// Where a path of wide cuts is a slot for a diameter of its way or more, its moves turn no faster than the
/// table's speed times deep_slot_share of the largest depth met on that way (cut/limits.h), as far down as
/// the spindle goes: as factors of the step's speed. One run of a slot has one speed, the lowest that one of
/// its moves asks for, since a spindle follows no ramp move by move. A step that is all slot has that share
/// in its own speed.
void slow_in_deep_slots(FeedQuestion& question);

/// No piece of a move that has a feed of its own is shorter than this part of the diameter. Default, unsourced.
inline constexpr double kLeastPiece = 0.2;

/// Where a piece of a move ends, as a share of the move's length; 1: at its end.
struct PieceEnd {
  std::uint32_t move = 0;
  double share = 1.0;
  friend bool operator==(const PieceEnd&, const PieceEnd&) = default;
};

/// Splits feed moves (lines and arcs) where the allowed feed of their sections changes. A move has one feed,
/// so that without this a heavy corner at its end would slow all of it. The path itself does not change.
/// Pieces are at least kLeastPiece of the diameter long, and made only where they save time. A heavy place that
/// is shorter takes what it lacks from the faster way beside it.
///
/// Needs   samples and sections of this very path, `at_mm` from the start of each move, steps of samples that
///         do not overlap (but the second rectangle of one step). `sections` may be null.
/// Shape   samples, sections and factors are renumbered with the moves; a dwell stays at the end of the last
///         piece. Gives the pieces of all moves in order.
std::vector<PieceEnd> split_moves(FeedQuestion& question, model::CutterPath& path,
                                  model::SectionSeries* sections, KnownFeeds* known = nullptr);
/// The path with its moves in these pieces. Needs  pieces of all its moves in order.
[[nodiscard]] model::CutterPath in_pieces(const model::CutterPath& path, const std::vector<PieceEnd>& pieces);

/// Relative excess over the limits of a sample at a feed, computed directly: the largest of load / limit - 1.
/// Negative if all limits hold; nothing if the section is outside the formulas' range.
[[nodiscard]] std::optional<double> excess_at(const FeedQuestion& question, const CutSample& sample,
                                              double feed_mm_min);

}  // namespace capstan::optimise
