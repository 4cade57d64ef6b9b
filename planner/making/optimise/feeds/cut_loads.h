#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "planner/ground/vocabulary/limit.h"
#include "planner/making/optimise/feeds.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/bending/wall_error.h"
#include "planner/physics/mechanics/loads/section.h"

/// Loads of one cut at a feed, and the limits of its step. It keeps no result and knows no path.
namespace capstan::optimise::feed {

using model::Limit;
inline constexpr std::size_t kLimits = model::kSectionLimits.size();

/// Loads or limits of a section, in the order of kSectionLimits.
struct Column : std::array<double, kLimits> {
  [[nodiscard]] static constexpr std::size_t at_of(Limit l) {
    std::size_t i = 0;
    while (model::kSectionLimits.at(i) != l) ++i;
    return i;
  }
  [[nodiscard]] double& of(Limit l) { return (*this)[at_of(l)]; }
  [[nodiscard]] double of(Limit l) const { return (*this)[at_of(l)]; }
};

/// One rectangle of material in front of the cutter.
///
/// gain  the edge's feed over the centre's: more than 1 where the path turns about the inside of a corner.
struct Cut {
  double ap_mm = 0.0, entry_rad = 0.0, exit_rad = 0.0, gain = 1.0;
  double csa_mm2 = 0.0;  ///< measured area; 0: depth times width
  double band_mm = 0.0;  ///< as mechanics::Section's
  /// Sine of the measured arc where it is nearest to the front. Wherever the area lies in the arc, no chip is
  /// thicker than this share of the feed per tooth. 0: use the arc of contact of this cut.
  double front_sin = 0.0;
  /// front_sin is the thickest chip over the feed as it was measured, and no chip is thicker.
  bool chip_measured = false;
};

/// One or two: a section that is no rectangle (a wall and a floor at once) counts as two of its area, as deep
/// and as wide. Of a cutter with a corner radius or a ball it is one, as measured: at its rim there is no
/// edge. Of a left-hand cutter angles are mirrored: in mechanics they count in the sense of rotation.
///
/// The area that the end cuts on a slope s (CutSample::end_mm2) is a separate term. It is no width, for no
/// cutter is wider than its diameter. Its chips are thinner than the flank's by the slope, so that they take
/// s^-mc of its specific force. It is counted as the depth of a slot with the same power,
///
///     d ap = end s^-mc / ae                                derived: kc = kc1.1 (s fz)^-mc on the area `end`
struct Cuts {
  std::array<Cut, 2> cut;
  std::size_t n = 0;
};
[[nodiscard]] Cuts cuts_of(const CutSample& sample, const CutQuestion& question);

/// The area that a plunge cuts, seen along the axis, mm2; 0: not known.
[[nodiscard]] inline double plunged_mm2(const CutSample& s) {
  return s.end_mm2 > 0.0 ? s.end_mm2 : std::max(0.0, s.csa_mm2);
}

/// Loads of a cut, the margin included, and the forces by axis.
struct State {
  Column load{};
  mechanics::SectionLoads raw;
  double chip_mm = 0.0;  ///< of the chip itself: what `load` has is for the limit, and more in a deep slot
};

/// A cut with its section made ready for many feeds.
struct ReadyCut {
  Cut cut;
  mechanics::Section section;
  mechanics::SectionAtFeeds loads;
  /// Of a band whose chip is not measured: of the whole strip that it lies in.
  std::optional<mechanics::ThickestChip> strip;
  /// Of the sides on which it makes a wall, where a wall's error is limited.
  std::optional<mechanics::WallAtFeeds> left, right;
};

class CutLoads {
 public:
  /// `feed_mm_min`: the step's. Refers to `q`.
  CutLoads(const CutQuestion& q, double feed_mm_min, double n_rpm);

  /// Nothing outside the formulas' range.
  [[nodiscard]] std::optional<ReadyCut> ready(const Cut& cut) const;
  [[nodiscard]] std::optional<State> at(const ReadyCut& cut, double feed_mm_min) const;

  /// Loads at a feed of the cutter's centre; nothing outside the formulas' range.
  [[nodiscard]] std::optional<State> at(const Cut& cut, double feed_mm_min) const;
  /// Torque and power of plunging into material of this area, seen along the axis; 0, or more than the
  /// cutter's disc: into the solid. The other columns are 0. Drilling's specific force times what is removed:
  ///
  ///     M = kc f A / (2 pi)      derived: of the disc, A = pi D^2 / 4, it is drilling.h's kc f D^2 / 8
  [[nodiscard]] std::optional<State> plunging(double area_mm2, double feed_mm_min) const;

  [[nodiscard]] const Column& limits() const { return limits_; }
  /// Largest and smallest feed that the schedule may use, mm/min.
  [[nodiscard]] double ceiling_mm_min() const { return ceiling_; }
  [[nodiscard]] double floor_mm_min() const { return floor_; }
  /// The feed at which the largest chip is cut where nothing thins it, and no less than the step's, mm/min.
  [[nodiscard]] double whole_chip_mm_min() const { return whole_chip_; }
  [[nodiscard]] double margin() const { return margin_; }
  [[nodiscard]] double rpm() const { return n_; }
  /// Largest feed that keeps every limit, at most `most_mm_min`, mm/min; 0 if none down to the floor does.
  [[nodiscard]] double largest(const Cut& cut, double most_mm_min) const;

 private:
  [[nodiscard]] double surface_um(double fz_mm) const;
  /// Share of the largest chip that is allowed in a deep slot.
  [[nodiscard]] double slot_share(const Cut& cut) const;
  /// False outside the formulas' range.
  [[nodiscard]] bool make_walls_ready(ReadyCut& cut) const;

  const CutQuestion& q_;
  double n_ = 0.0, margin_ = 1.0, compliance_ = 0.0;
  double ceiling_ = 0.0, floor_ = 0.0, whole_chip_ = 0.0;
  mechanics::Tooth tooth_;
  mechanics::ForceLaw law_;
  mechanics::ToolBeam beam_;  ///< empty unless a wall's error is limited
  Column limits_{};
};

/// The largest of load / limit.
[[nodiscard]] double ratio(const Column& load, const Column& limit);

/// True if the limit is finite. An infinite limit means that none is stated; it is never reported.
[[nodiscard]] bool stated(double limit);

}  // namespace capstan::optimise::feed
