#include "planner/making/sequence/precedence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

namespace capstan::sequence {
namespace {

using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// A square feature whose top is at the origin's height.
FeatureShape block(ShapeKind kind, Vec3 origin, double half, double depth) {
  FeatureShape s;
  s.kind = kind;
  s.frame.origin = origin;
  s.depth_mm = depth;
  s.area = s.reach = geometry::rectangle({-half, -half}, {half, half});
  return s;
}
FeatureShape hole(Vec3 origin, double diameter, double depth) {
  FeatureShape s = block(ShapeKind::kHole, origin, 0.5 * diameter, depth);
  s.area = s.reach = geometry::disc({0.0, 0.0}, 0.5 * diameter, 0.01);
  s.diameter.nominal_mm = s.bottom_diameter_mm = diameter;
  return s;
}
FeatureShape through(FeatureShape s) {
  s.through = true;
  return s;
}
/// Turned about x by half a turn, so that it is cut from below.
FeatureShape from_below(FeatureShape s) {
  s.frame.y = {0.0, -1.0, 0.0};
  s.frame.z = kDown;
  return s;
}

Options with_directions(std::vector<Vec3> directions) {
  Options out;
  out.directions = std::move(directions);
  return out;
}
Options with_given(std::size_t before, std::size_t after) {
  Options out;
  out.given = {{before, after}};
  return out;
}
Options with_wishes(std::vector<Wish> wishes) {
  Options out;
  out.wishes = std::move(wishes);
  return out;
}

using Pair = std::tuple<std::size_t, std::size_t, Cause>;
std::vector<Pair> pairs(const std::vector<FeatureShape>& shapes, const Options& options = {}) {
  std::vector<Pair> out;
  for (const FeaturePair& p : geometric_pairs(shapes, access_of(shapes, options)))
    out.emplace_back(p.before, p.after, p.cause);
  return out;
}

// --- From which side ---

TEST(AccessOf, PutsTheDirectionsThatAreWantedFirstAndAtUnitLength) {
  const Access a = access_of(
      {block(ShapeKind::kPocket, {0, 0, 0}, 5, 2), from_below(block(ShapeKind::kPocket, {0, 0, -20}, 5, 2))},
      with_directions({{0, 0, -3}}));
  EXPECT_THAT(a.directions, ElementsAre(kDown, kUp));
  EXPECT_THAT(a.of_feature, ElementsAre(1U, 0U));
}

TEST(AccessOf, TakesAThroughHoleFromTheOtherSideWhereOnlyThatIsThere) {
  const FeatureShape below = from_below(block(ShapeKind::kPocket, {0, 0, -20}, 5, 2));
  const Access a = access_of({through(hole({50, 0, 0}, 6, 20)), below}, {});
  EXPECT_THAT(a.directions, ElementsAre(kDown));
  EXPECT_THAT(a.of_feature, ElementsAre(0U, 0U));
}

TEST(AccessOf, TakesAThroughHoleFromItsOwnSideWhereThatIsThere) {
  const Access a = access_of({through(hole({50, 0, 0}, 6, 20)), block(ShapeKind::kPocket, {0, 0, 0}, 5, 2),
                              from_below(block(ShapeKind::kPocket, {0, 0, -20}, 5, 2))},
                             {});
  EXPECT_THAT(a.directions, ElementsAre(kUp, kDown));
  EXPECT_THAT(a.of_feature, ElementsAre(0U, 0U, 1U));
}

TEST(AccessOf, TakesATaperedOrABlindHoleFromItsOwnSideOnly) {
  FeatureShape tapered = through(hole({50, 0, 0}, 6, 20));
  tapered.bottom_diameter_mm = 5.0;
  const FeatureShape below = from_below(block(ShapeKind::kPocket, {0, 0, -20}, 5, 2));
  for (const FeatureShape& s : {tapered, hole({50, 0, 0}, 6, 8)})
    EXPECT_THAT(access_of({s, below}, {}).directions, ElementsAre(kUp, kDown));
}

// --- What geometry says ---

TEST(GeometricPairs, PutAFaceBeforeWhatBeginsInIt) {
  EXPECT_THAT(pairs({block(ShapeKind::kPocket, {0, 0, 0}, 10, 5), block(ShapeKind::kFace, {0, 0, 2}, 60, 2)}),
              ElementsAre(Pair(1, 0, Cause::kFaceFirst)));
}

TEST(GeometricPairs, PutAPocketBeforeWhatBeginsAtItsFloorOrInItsVolumeAndLeaveWhatLiesBesideOrBelow) {
  const FeatureShape pocket = block(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  const auto of_a_hole_at = [&](Vec3 origin) { return pairs({hole(origin, 6, 8), pocket}); };
  const auto after = ElementsAre(Pair(1, 0, Cause::kLiesIn));
  EXPECT_THAT(of_a_hole_at({0, 0, -5}), after) << "at the floor";
  EXPECT_THAT(of_a_hole_at({0, 0, -3}), after) << "in the volume";
  EXPECT_THAT(of_a_hole_at({0, 0, -5.01}), IsEmpty()) << "below the floor";
  EXPECT_THAT(of_a_hole_at({40, 0, -5}), IsEmpty()) << "beside";
}

TEST(GeometricPairs, CompareAreasAndNotTheBoxesAroundThem) {
  // A round pocket of 20 mm; 9 mm from its axis in x and y lie within its box, and 12.7 mm off its axis.
  FeatureShape round = hole({0, 0, 0}, 20, 5);
  round.kind = ShapeKind::kPocket;
  EXPECT_THAT(pairs({hole({9, 9, -5}, 2, 8), round}), IsEmpty());
  EXPECT_THAT(pairs({hole({9, 0, -5}, 2, 8), round}), ElementsAre(Pair(1, 0, Cause::kLiesIn)));
}

TEST(GeometricPairs, CompareOnlyFeaturesOfOneSide) {
  // Both take the same 5 mm over the hole.
  const FeatureShape above = block(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  const FeatureShape below = from_below(block(ShapeKind::kPocket, {0, 0, -5}, 10, 5));
  EXPECT_THAT(pairs({hole({0, 0, -5}, 6, 8), above}), ElementsAre(Pair(1, 0, Cause::kLiesIn)));
  EXPECT_THAT(pairs({hole({0, 0, -5}, 6, 8), below}), IsEmpty());
}

TEST(GeometricPairs, PutAHoleBeforeTheThreadOnItsAxis) {
  const auto of_a_thread_at = [](Vec3 origin) {
    FeatureShape thread = hole(origin, 6, 6);
    thread.kind = ShapeKind::kThread;
    return pairs({thread, hole({0, 0, 0}, 5, 10)});
  };
  EXPECT_THAT(of_a_thread_at({0, 0, 0}), ElementsAre(Pair(1, 0, Cause::kThread)));
  EXPECT_THAT(of_a_thread_at({0.1, 0, 0}), IsEmpty()) << "another axis";
  EXPECT_THAT(of_a_thread_at({0, 0, -10}), IsEmpty()) << "where the hole ends";
}

TEST(GeometricPairs, PutAFeatureBeforeTheChamferOnItsTopEdge) {
  const FeatureShape pocket = block(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  EXPECT_THAT(pairs({block(ShapeKind::kChamfer, {0, 0, 0}, 10, 1), pocket}),
              ElementsAre(Pair(1, 0, Cause::kEdge)));
  EXPECT_THAT(pairs({block(ShapeKind::kChamfer, {0, 0, -2}, 10, 1), pocket}), IsEmpty()) << "another edge";
  EXPECT_THAT(
      pairs({block(ShapeKind::kChamfer, {0, 0, 0}, 10, 1), block(ShapeKind::kFace, {0, 0, 2}, 60, 2)}),
      ElementsAre(Pair(1, 0, Cause::kFaceFirst)));
}

TEST(GeometricPairs, PutTheShallowerOfTwoFacesThatBeginAtOneHeightFirstWhereTheyOverlap) {
  const FeatureShape whole = block(ShapeKind::kFace, {0, 0, 2}, 50, 2);
  EXPECT_THAT(pairs({block(ShapeKind::kFace, {30, 0, 2}, 30, 6), whole}),
              ElementsAre(Pair(1, 0, Cause::kFaceFirst)));
  EXPECT_THAT(pairs({block(ShapeKind::kFace, {80, 0, 2}, 30, 6), whole}), IsEmpty()) << "side by side";
}

// --- Properties of random parts ---

/// Faces, pockets, holes, threads and chamfers at heights and places that meet often, some from below.
std::vector<FeatureShape> random_shapes(std::mt19937& random, std::size_t n) {
  const auto one_of = [&](int most) { return static_cast<double>(random() % static_cast<unsigned>(most)); };
  std::vector<FeatureShape> out;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 at{7.0 * one_of(8), 7.0 * one_of(8), -2.0 * one_of(4)};
    const double half = 3.0 + 4.0 * one_of(4), depth = 2.0 + 2.0 * one_of(3);
    constexpr ShapeKind kKinds[] = {ShapeKind::kFace, ShapeKind::kPocket, ShapeKind::kHole,
                                    ShapeKind::kThread, ShapeKind::kChamfer};
    const ShapeKind kind = kKinds[random() % std::size(kKinds)];
    FeatureShape s = kind == ShapeKind::kHole || kind == ShapeKind::kThread ? hole(at, half, depth)
                                                                            : block(kind, at, half, depth);
    s.kind = kind;
    out.push_back(random() % 4 == 0 ? from_below(s) : s);
  }
  return out;
}

TEST(GeometricPairsProperty, AreThoseOfEachTwoFeaturesAlone) {
  std::size_t met = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const auto shapes = random_shapes(random, 40);
    const Access access = access_of(shapes, {});
    std::vector<Pair> by_two;
    for (std::size_t a = 0; a < shapes.size(); ++a) {
      for (std::size_t b = a + 1; b < shapes.size(); ++b) {
        const Access two{access.directions, {access.of_feature[a], access.of_feature[b]}};
        for (const FeaturePair& p : geometric_pairs({shapes[a], shapes[b]}, two))
          by_two.emplace_back(p.before == 0 ? a : b, p.before == 0 ? b : a, p.cause);
      }
    }
    std::sort(by_two.begin(), by_two.end());
    EXPECT_EQ(pairs(shapes), by_two) << seed;
    met += by_two.size();
  }
  EXPECT_GT(met, 1000U) << "the parts hardly overlap";
}

TEST(GeometricPairsProperty, NeverPutTwoFeaturesBothWaysAndNeverGoRoundInACircle) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    const auto shapes = random_shapes(random, 40);
    // Taken away one by one what nothing comes before: nothing is left without a circle.
    auto edges = pairs(shapes);
    std::set<std::size_t> left;
    for (std::size_t i = 0; i < shapes.size(); ++i) left.insert(i);
    for (bool taken = true; taken;) {
      taken = false;
      for (auto i = left.begin(); i != left.end();) {
        const bool waits =
            std::any_of(edges.begin(), edges.end(), [&](const Pair& p) { return std::get<1>(p) == *i; });
        if (waits) {
          ++i;
          continue;
        }
        std::erase_if(edges, [&](const Pair& p) { return std::get<0>(p) == *i; });
        i = left.erase(i);
        taken = true;
      }
    }
    EXPECT_THAT(left, IsEmpty()) << seed;
  }
}

TEST(GeometricPairsProperty, DoNotChangeWhereTheWholePartIsTurnedAndMoved) {
  // A quarter turn about x after one about z: lengths and places stay whole numbers.
  const geometry::Placement moved{.origin = {11, -7, 5}, .x = {0, 0, 1}, .y = {-1, 0, 0}, .z = {0, -1, 0}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const auto shapes = random_shapes(random, 40);
    auto elsewhere = shapes;
    for (FeatureShape& s : elsewhere) s.frame = compose(moved, s.frame);
    EXPECT_EQ(pairs(elsewhere), pairs(shapes)) << seed;
  }
}

// --- Steps ---

Item step(std::size_t feature, int in_chain) {
  return {.feature = feature,
          .in_chain = in_chain,
          .name = "f" + std::to_string(feature) + "." + std::to_string(in_chain),
          .cutter_id = {},
          .operation = model::TypeId::kDrilling};
}

struct Precedences {
  std::vector<Precedence> kept, dropped;
};
Precedences precedences(const std::vector<FeatureShape>& shapes, const std::vector<Item>& items,
                        const Options& options = {}) {
  Precedences out;
  out.kept = all_precedences(shapes, items, options, access_of(shapes, options), out.dropped);
  return out;
}
std::vector<Pair> pairs_of(const std::vector<Precedence>& from) {
  std::vector<Pair> out;
  for (const Precedence& p : from) out.emplace_back(p.before, p.after, p.cause);
  return out;
}

/// A hole in a pocket's floor, spotted and drilled; the pocket is roughed and finished. Steps of one feature
/// do not stand in the order of their chain.
struct HoleInPocket {
  std::vector<FeatureShape> shapes{hole({0, 0, -5}, 6, 8), block(ShapeKind::kPocket, {0, 0, 0}, 10, 5)};
  std::vector<Item> items{step(0, 1), step(1, 1), step(0, 0), step(1, 0)};
  static constexpr std::size_t kDrill = 0, kFinish = 1, kSpot = 2, kRough = 3;
};

TEST(AllPrecedences, FollowEachChainAndLeadFromTheLastStepOfOneFeatureToTheFirstOfTheOther) {
  const HoleInPocket p;
  const Precedences found = precedences(p.shapes, p.items);
  EXPECT_THAT(pairs_of(found.kept),
              ElementsAre(Pair(p.kFinish, p.kSpot, Cause::kLiesIn), Pair(p.kSpot, p.kDrill, Cause::kChain),
                          Pair(p.kRough, p.kFinish, Cause::kChain)));
  EXPECT_THAT(found.dropped, IsEmpty());
}

TEST(AllPrecedences, DropWhatGeometrySaysAgainstAGivenOrderOfTheSameFeatures) {
  const HoleInPocket p;
  const Precedences found = precedences(p.shapes, p.items, with_given(p.kDrill, p.kRough));
  EXPECT_THAT(pairs_of(found.kept),
              ElementsAre(Pair(p.kDrill, p.kRough, Cause::kGiven), Pair(p.kSpot, p.kDrill, Cause::kChain),
                          Pair(p.kRough, p.kFinish, Cause::kChain)));
  EXPECT_THAT(pairs_of(found.dropped), ElementsAre(Pair(p.kFinish, p.kSpot, Cause::kLiesIn)));
  EXPECT_EQ(found.kept.front().text, "'f0.1' is given before 'f1.0'");
}

TEST(AllPrecedences, DropAWishThatWouldCloseACircleThroughOthers) {
  // The face before the pocket, the pocket before the hole: the hole before the face cannot be.
  HoleInPocket p;
  p.shapes.push_back(block(ShapeKind::kFace, {0, 0, 2}, 60, 2));
  p.items.push_back(step(2, 0));
  const Precedences found = precedences(p.shapes, p.items, with_wishes({{0, 2, "the hole is a datum"}}));
  EXPECT_THAT(pairs_of(found.dropped), ElementsAre(Pair(p.kDrill, 4, Cause::kDatum)));
  EXPECT_EQ(found.dropped.front().text, "the hole is a datum");
}

TEST(AllPrecedences, KeepTheEarlierOfTwoWishesAgainstEachOther) {
  const std::vector<FeatureShape> apart{hole({0, 0, 0}, 6, 8), hole({40, 0, 0}, 6, 8)};
  const Precedences found =
      precedences(apart, {step(0, 0), step(1, 0)}, with_wishes({{1, 0, "earlier"}, {0, 1, "later"}}));
  EXPECT_THAT(pairs_of(found.kept), ElementsAre(Pair(1, 0, Cause::kDatum)));
  EXPECT_THAT(pairs_of(found.dropped), ElementsAre(Pair(0, 1, Cause::kDatum)));
}

TEST(AllPrecedences, KeepAWishOnceAndLeaveOutWishesOfFeaturesWithoutSteps) {
  const std::vector<FeatureShape> apart{hole({0, 0, 0}, 6, 8), hole({40, 0, 0}, 6, 8),
                                        hole({80, 0, 0}, 6, 8)};
  const Precedences found =
      precedences(apart, {step(0, 0), step(1, 0)},
                  with_wishes({{1, 0, "first"}, {1, 0, "again"}, {2, 0, "no step"}, {0, 0, "itself"}}));
  ASSERT_EQ(found.kept.size(), 1U);
  EXPECT_EQ(found.kept.front(), (Precedence{1, 0, Cause::kDatum, "first"}));
  EXPECT_THAT(found.dropped, IsEmpty());
}

TEST(AllPrecedences, NameTheFeaturesByNameOrByNumber) {
  HoleInPocket p;
  p.shapes[1].name = "P1";
  const Precedences found = precedences(p.shapes, p.items);
  const std::string hole_kind(to_text(ShapeKind::kHole)), pocket_kind(to_text(ShapeKind::kPocket));
  EXPECT_EQ(found.kept[0].text,
            hole_kind + " number 0 begins within or at the floor of " + pocket_kind + " 'P1'");
  EXPECT_EQ(found.kept[1].text, "the chain of " + hole_kind + " number 0");
}

}  // namespace
}  // namespace capstan::sequence
