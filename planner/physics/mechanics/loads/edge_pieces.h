#pragma once

#include <array>
#include <cstddef>

#include "planner/physics/mechanics/loads/section.h"

/// The edge of a cutter in a section, in pieces of one inclination and one radius. Of this room.
namespace capstan::mechanics {

inline constexpr std::size_t kCornerPieces = 4;  ///< Gauss points along a corner

/// A piece of the edge with one kappa and one radius, over its own arc.
struct Piece {
  double depth = 0.0, edge = 0.0;  // dz, dS
  double radius = 0.0;
  double sin_kappa = 1.0, cos_kappa = 0.0;
  double lag_low = 0.0, lag_high = 0.0;
  double from = 0.0, to = 0.0;
};

struct Pieces {
  std::array<Piece, kCornerPieces + 1> item;
  std::size_t count = 0;
  double area = 0.0;       // per unit of feed: sum of dz times width
  double edge_arc = 0.0;   // sum of dS times arc
  double max_chip = 0.0;   // largest sin(a) sin(kappa)
  double front_sin = 0.0;  // largest sin(a)
};

/// Depth and arc of the front half; what is missing of them is made up from the area.
struct Contact {
  double ap = 0.0;
  ImmersionArc arc;
};

/// The depth and arc of a section's contact.
[[nodiscard]] Contact contact_of(const Section& section, double cutting_diameter_mm);

/// The pieces of edge that a strip meets. A corner or ball does not reach a strip at the rim of the full
/// radius, and meets less than its area where it reaches a part: there the strip is widened, first towards
/// the axis, until the edge sweeps the area that is known to be removed.
[[nodiscard]] Pieces met_by(const Section& section, const Contact& contact, const Tooth& tooth);

}  // namespace capstan::mechanics
