#pragma once

#include <vector>

#include "planner/physics/mechanics/loads/edge_pieces.h"

/// Forces and torque of all teeth of a section as straight lines over the growth of the chips, so that a feed
/// more costs next to nothing. Of this room.
namespace capstan::mechanics {

/// Forces on the tool and the torque at one moment.
struct Moment {
  ForceVector force;
  double torque_nmm = 0.0;
};

/// The same at a feed: `chip` times a factor that grows with the feed, and the edge's own whatever the feed.
struct MomentAtFeeds {
  Moment chip, edge;
  [[nodiscard]] Moment at(double factor) const {
    return {{factor * chip.force.fx_n + edge.force.fx_n, factor * chip.force.fy_n + edge.force.fy_n,
             factor * chip.force.fz_n + edge.force.fz_n},
            factor * chip.torque_nmm + edge.torque_nmm};
  }
};

/// The largest over all angles: of each component by amount, its sign kept.
struct Peak {
  ForceVector force;
  double plane_sq = 0.0, torque_nmm = 0.0;
  void take(const Moment& m);
};

struct EdgeLoads {
  MomentAtFeeds mean;  ///< over a revolution
  /// By angle of a tooth pitch; empty where the edge has no force of its own, for then one peak serves at all
  /// feeds: `peak`, at the factor 1.
  std::vector<MomentAtFeeds> angles;
  Peak peak;
  [[nodiscard]] Peak peak_at(double factor) const;
};

/// The factor of chips is fz for measured coefficients, kc1.1 fz^(1 - mc) by Kienzle's law.
[[nodiscard]] EdgeLoads edge_loads(const Pieces& all, const ForceLaw& law, const Tooth& tooth);

}  // namespace capstan::mechanics
