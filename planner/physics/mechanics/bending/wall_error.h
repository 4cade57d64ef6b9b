#pragma once

#include <array>
#include <cstddef>

#include "planner/ground/base/result.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/loads/section.h"

/// The error that a tool's bending leaves on a wall.
namespace capstan::mechanics {

/// Error of a wall: material left (positive) or cut into the part (negative), mm.
struct WallError {
  static constexpr std::size_t kHeights = 9;
  std::array<double, kHeights> height_mm{};  ///< above the tip, from the lower to the upper end of contact
  std::array<double, kHeights> error_mm{};
  double most_left_mm = 0.0;                ///< largest error_mm, at least 0
  double most_over_mm = 0.0;                ///< smallest error_mm, at most 0
  [[nodiscard]] double largest_mm() const;  ///< the larger of the two by amount, its sign kept
};

/// The side of the feed on which the wall is: up milling makes it at angle 0 (left), down milling at pi.
enum class WallSide { kLeft, kRight };

/// The wall that a section leaves: at each height, the tool's bending normal to the wall at the instant at
/// which an edge generates that height, i.e. passes angle 0 (left) or pi (right); the smoothest path of the
/// edge over all teeth. A static picture: forces far below the first natural frequency.
///
/// The section must reach that side (arc from 0, or to pi); the forces are those of section.h's model at the
/// nominal chip, without runout. Flanks only: heights of a corner radius or a ball count as their own radius.
/// Accuracy  six Gauss points on each tooth's part in the arc: within 1 % of the integral. Of the model: the
/// force's
///           uncertainty (force_law.h) times the beam's.
/// Source    Kline, DeVor & Shareef 1982 ("The prediction of surface accuracy in end milling", J. Eng. Ind.
/// 104)
///           for the principle; integrals derived.
///
/// What does not depend on the feed is integrated once: an error at another feed costs a power.
class WallAtFeeds {
 public:
  /// Fails     MECH-DOMAIN as SectionAtFeeds, or when the arc does not reach the wall.
  [[nodiscard]] static Result<WallAtFeeds> of(const Section& section, const Tooth& tooth, const ForceLaw& law,
                                              WallSide side, const ToolBeam& beam);
  /// Fails     MECH-DOMAIN unless the feed per tooth is positive.
  [[nodiscard]] Result<WallError> at(double fz_mm) const;

 private:
  double exponent_ = 1.0;  ///< of the feed in the part of the error that grows with it
  std::array<double, WallError::kHeights> height_mm_{};
  std::array<double, WallError::kHeights> at_no_feed_mm_{};  ///< of the forces at the edge
  std::array<double, WallError::kHeights> growing_mm_{};     ///< over fz^exponent
};

}  // namespace capstan::mechanics
