#include "planner/physics/mechanics/loads/edge_loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::mechanics {
namespace {

TEST(EdgeLoads, KeepAClimbingToothAtItsEntryWhereItsChipIsThickest) {
  constexpr int kArcs = 200;
  for (int i = 1; i < kArcs; ++i) {
    // One of four teeth at most is in the cut; its lag is none, or as good as none.
    Pieces all;
    all.count = 1;
    Piece& p = all.item[0];
    p.depth = p.edge = 2.0;
    p.radius = 5.0;
    p.from = 0.5 * std::numbers::pi + 0.0071 * i;
    p.to = std::numbers::pi;
    p.lag_high = i % 2 == 0 ? 0.0 : 9e-7 * i / kArcs;
    ForceLaw law;
    law.kienzle.mc = 0.25;
    Tooth tooth;
    tooth.teeth = 4;
    const double at_entry = p.radius * p.depth * std::pow(std::sin(p.from), 1.0 - law.kienzle.mc);
    EXPECT_NEAR(edge_loads(all, law, tooth).peak.torque_nmm, at_entry, 1e-8 * at_entry) << i;
  }
}

}  // namespace
}  // namespace capstan::mechanics
