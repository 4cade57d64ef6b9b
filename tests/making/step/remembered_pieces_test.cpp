#include "planner/making/step/path/remembered/pieces.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace capstan::step {
namespace {

using Pieces = std::vector<optimise::PieceEnd>;

TEST(RememberedPieces, AreThoseOfEachMoveInOrderUpToItsEnd) {
  EXPECT_TRUE(are_pieces_of({}, 0));
  EXPECT_TRUE(are_pieces_of({{0, 1.0}, {1, 1.0}}, 2));
  EXPECT_TRUE(are_pieces_of({{0, 1.0}, {1, 0.25}, {1, 0.5}, {1, 1.0}, {2, 0.1}, {2, 1.0}}, 3));
}

TEST(RememberedPieces, AreNoneWhereAMoveIsMissingComesAgainOrIsNotThePathS) {
  EXPECT_FALSE(are_pieces_of({}, 1));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}}, 0));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {2, 1.0}}, 3));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {2, 1.0}, {1, 1.0}}, 3));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 1.0}, {1, 1.0}}, 2));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 1.0}, {2, 1.0}}, 2));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 1.0}}, 3));
}

TEST(RememberedPieces, AreNoneWhereAMoveIsNotEndedOrItsSharesAreNoWayAlongIt) {
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 0.5}}, 2));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 0.5}, {2, 1.0}}, 3));
  EXPECT_FALSE(are_pieces_of({{0, 0.5}, {0, 1.0}, {1, 1.0}}, 2)) << "the start has no length";
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 0.5}, {1, 0.5}, {1, 1.0}}, 2));
  EXPECT_FALSE(are_pieces_of({{0, 1.0}, {1, 0.5}, {1, 0.25}, {1, 1.0}}, 2));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double share : {0.0, -0.5, 1.5, kInf, -kInf, kNan}) {
    const Pieces within{{0, 1.0}, {1, share}, {1, 1.0}}, last{{0, 1.0}, {1, share}};
    EXPECT_FALSE(are_pieces_of(within, 2)) << share;
    EXPECT_FALSE(are_pieces_of(last, 2)) << share;
  }
}

}  // namespace
}  // namespace capstan::step
