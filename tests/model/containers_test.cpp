#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/model/features/raw_piece.h"
#include "planner/model/nouns/arena/standing.h"
#include "tests/model/maker.h"

// Where the elements of compounds and patterns stand; every coordinate is worked out by hand.

namespace capstan::model {
namespace {

using geometry::Vec3;

constexpr double kSame = 1e-9;

struct Bench : Maker {
  /// A raw piece from the origin down: x 0..along, y 0..across, z -thick..0.
  void raw(double along, double across, double thick) {
    Block b;
    b.position = at(0, 0, -thick);
    b.x = along;
    b.y = across;
    b.z = thick;
    Workpiece w;
    w.its_bounding_geometry = m.add(b);
    m.add(w);
  }
  Ref<CompoundFeature> compound(Ref<Axis2Placement3d> where, const std::vector<AnyRef>& elements) {
    CompoundFeature c;
    c.its_id = "C";
    c.feature_placement = where;
    for (const AnyRef e : elements) c.elements.items.push_back(e);
    return m.add(c);
  }
  Ref<GeneralPattern> general(Ref<Axis2Placement3d> where, AnyRef base,
                              const std::vector<Ref<Axis2Placement3d>>& locations) {
    GeneralPattern g;
    g.its_id = "G";
    g.feature_placement = where;
    g.replicate_base_feature = Ref<Two5dManufacturingFeature>(base);
    for (const auto& l : locations) g.replicate_locations.push_back(l);
    return m.add(g);
  }
  std::vector<FeatureShape> shapes(AnyRef f) {
    auto s = shapes_of(m, Ref<ManufacturingFeature>(f));
    EXPECT_TRUE(s) << (s ? "" : s.error().message);
    return s ? *std::move(s) : std::vector<FeatureShape>{};
  }
  /// "100,50,0 100,20,0": where the members stand.
  std::string places(AnyRef f) {
    std::string out;
    for (const FeatureShape& s : shapes(f)) {
      char text[96];
      const auto round = [](double v) { return std::abs(v) < 1e-9 ? 0.0 : v; };
      std::snprintf(text, sizeof text, "%s%.6g,%.6g,%.6g", out.empty() ? "" : " ", round(s.frame.origin.x),
                    round(s.frame.origin.y), round(s.frame.origin.z));
      out += text;
    }
    return out;
  }
};

TEST(Compound, PlacesItsElementsRelativeToItself) {
  Bench k;
  const auto hole = k.hole(0, 0, 8, 10);
  const auto beside = k.hole(20, 0, 6, 10);
  const auto c = k.compound(k.at(100, 50, 0), {hole, beside});
  EXPECT_EQ(k.places(c), "100,50,0 120,50,0");
  EXPECT_TRUE(k.shapes(c).front().assumptions.empty());
}

TEST(Compound, TurnsItsElementsWithItself) {
  Bench k;
  // x along the workpiece's y: (20, 0) in the compound is (100, 70) in the workpiece.
  const auto c = k.compound(k.at(100, 50, 0, 0, 1), {k.hole(20, 0, 6, 10)});
  EXPECT_EQ(k.places(c), "100,70,0");
  EXPECT_LT(norm(k.shapes(c).front().frame.x - Vec3{0, 1, 0}), kSame);
}

TEST(Compound, AnElementAskedForAloneStandsWhereItsCompoundPutsIt) {
  Bench k;
  const auto hole = k.hole(20, 0, 8, 10);
  k.compound(k.at(100, 50, 0), {hole});
  EXPECT_EQ(k.places(hole), "120,50,0");
  EXPECT_EQ(k.shapes(hole).front().feature, AnyRef(hole));
}

TEST(Compound, ItsFrameIsThatOfItsElementsCoordinates) {
  Bench k;
  const auto hole = k.hole(20, 0, 8, 10);
  const auto c = k.compound(k.at(100, 50, 0), {hole});
  const auto frame = coordinates_of(k.m, hole);
  ASSERT_TRUE(frame);
  EXPECT_LT(norm(frame->origin - Vec3{100, 50, 0}), kSame);
  EXPECT_EQ(*coordinates_of(k.m, c), geometry::Placement{});
}

TEST(Compound, AnElementListedTwiceStandsInBoth) {
  Bench k;
  const auto hole = k.hole(0, 0, 8, 10);
  k.compound(k.at(100, 50, 0), {hole});
  k.compound(k.at(30, 20, 0), {hole});
  EXPECT_EQ(k.places(hole), "100,50,0 30,20,0");
}

TEST(Compound, SaysWhichElementEachOfItsShapesIs) {
  Bench k;
  const auto wide = k.hole(0, 0, 12, 4);
  const auto drilled = k.hole(0, 0, 8, 10);
  const auto c = k.compound(k.at(0, 0, 0), {wide, drilled});
  const auto g = k.general(k.at(100, 50, 0), c, {k.at(0, -30, 0)});
  const auto s = k.shapes(g);
  ASSERT_EQ(s.size(), 4u);
  EXPECT_EQ(s[1].made_of, (std::vector<AnyRef>{c, drilled}));
  EXPECT_EQ(s[2].made_of, (std::vector<AnyRef>{c, wide}));
  EXPECT_EQ(s[2].feature, AnyRef(g));
}

TEST(GeneralPattern, HasItsBaseWhereThePatternPutsItAndOneMoreAtEachLocation) {
  Bench k;
  const auto base = k.hole(0, 0, 8, 10);
  const auto g = k.general(k.at(130, 120, 0), base, {k.at(0, -60, 0)});
  EXPECT_EQ(k.places(g), "130,120,0 130,60,0");
  EXPECT_EQ(k.places(base), "130,120,0");
}

TEST(GeneralPattern, ALocationThatIsTakenIsNotMadeTwice) {
  Bench k;
  const auto g = k.general(k.at(130, 120, 0), k.hole(0, 0, 8, 10),
                           {k.at(0, -60, 0), k.at(0, 0, 0), k.at(0, -60, 0), k.at(10, 0, 0)});
  EXPECT_EQ(k.places(g), "130,120,0 130,60,0 140,120,0");
}

TEST(GeneralPattern, APocketTurnedInItsPlaceIsASecondOne) {
  Bench k;
  const auto g = k.general(k.at(60, 60, 0), k.pocket(0, 0, 40, 10, 5), {k.at(0, 0, 0, 0, 1), k.at(0, 0, 0)});
  const auto s = k.shapes(g);
  ASSERT_EQ(s.size(), 2u);
  EXPECT_LT(norm(s[1].frame.x - Vec3{0, 1, 0}), kSame);
}

TEST(GeneralPattern, OfACompoundKeepsItsElementsApartFromEachOther) {
  Bench k;
  const auto c = k.compound(k.at(5, 0, 0), {k.hole(0, 0, 8, 10), k.hole(10, 0, 6, 10)});
  // A location is the base's frame: at (0, -30) the compound begins at (100, 20), its second hole 10 further.
  const auto g = k.general(k.at(100, 50, 0), c, {k.at(0, -30, 0)});
  EXPECT_EQ(k.places(g), "105,50,0 115,50,0 100,20,0 110,20,0");
}

TEST(RectangularPattern, CountsFromItsBaseInItsOwnPlacement) {
  Bench k;
  RectangularPattern p;
  p.feature_placement = k.at(100, 50, 0);
  p.replicate_base_feature = k.hole(5, 5, 6, 12);
  p.spacing = k.length(20);
  p.its_direction = k.direction(1, 0, 0);
  p.number_of_columns = 2;
  p.number_of_rows = 2;
  p.row_spacing = k.length(15);
  p.row_layout_direction = k.direction(0, 1, 0);
  EXPECT_EQ(k.places(k.m.add(p)), "105,55,0 125,55,0 105,70,0 125,70,0");
}

Ref<CircularPattern> circle_of_four(Bench& k, double base_x) {
  CircularPattern p;
  p.feature_placement = k.at(100, 50, 0);
  p.replicate_base_feature = k.hole(base_x, 0, 6, 12);
  p.angle_increment = std::numbers::pi / 2;
  p.number_of_feature = 4;
  return k.m.add(p);
}

TEST(CircularPattern, TurnsItsBaseAboutItsOwnPlacement) {
  Bench k;
  EXPECT_EQ(k.places(circle_of_four(k, 20)), "120,50,0 100,70,0 80,50,0 100,30,0");
}

TEST(CircularPattern, ABaseOnTheAxisIsMovedOutToTheStatedCircleAndItIsSaid) {
  Bench k;
  const auto p = circle_of_four(k, 0);
  k.m.at<CircularPattern>(p).base_feature_diameter = k.length(40);
  EXPECT_EQ(k.places(p), "120,50,0 100,70,0 80,50,0 100,30,0");
  ASSERT_EQ(k.shapes(p).front().assumptions.size(), 1u);
  EXPECT_NE(k.shapes(p).front().assumptions[0].find("base_feature_diameter, 40 mm"), std::string::npos);
}

TEST(Containers, AreReadAsWorkpieceCoordinatesOnlyWhereTheStandardsReadingLeavesThePiece) {
  Bench k;
  k.raw(260, 180, 50);
  // Relative: X320 Y180, on a piece of 260 x 180. In workpiece coordinates: X160 Y90.
  const auto c = k.compound(k.at(160, 90, 0), {k.hole(160, 90, 8, 10)});
  EXPECT_EQ(k.places(c), "160,90,0");
  ASSERT_EQ(k.shapes(c).front().assumptions.size(), 1u);
  EXPECT_EQ(
      k.shapes(c).front().assumptions[0],
      "placement of its elements read as workpiece coordinates: relative to the compound they would lie at "
      "X320 Y180, outside the piece");
}

TEST(Containers, WhereBothReadingsArePossibleTheStandardsIsTaken) {
  Bench k;
  k.raw(260, 180, 50);
  const auto c = k.compound(k.at(60, 40, 0), {k.hole(50, 40, 8, 10)});
  EXPECT_EQ(k.places(c), "110,80,0");
  EXPECT_TRUE(k.shapes(c).front().assumptions.empty());
}

TEST(Containers, WhereBothArePossibleAndAnElementRepeatsThePlacementItIsSaid) {
  Bench k;
  k.raw(260, 180, 50);
  const auto c = k.compound(k.at(60, 40, 0), {k.hole(60, 40, 8, 10)});
  EXPECT_EQ(k.places(c), "120,80,0");
  ASSERT_EQ(k.shapes(c).front().assumptions.size(), 1u);
  EXPECT_EQ(k.shapes(c).front().assumptions[0],
            "its elements repeat its placement; read relative to it, as the standard has it, at X120 Y80; in "
            "workpiece coordinates that would be X60 Y40");
}

TEST(Containers, WhereNeitherReadingIsPossibleTheStandardsIsTaken) {
  Bench k;
  k.raw(260, 180, 50);
  // One of the two elements would be at X-300 in the workpiece.
  const auto c = k.compound(k.at(160, 90, 0), {k.hole(160, 90, 8, 10), k.hole(-300, 0, 8, 10)});
  EXPECT_EQ(k.places(c), "320,180,0 -140,90,0");
  EXPECT_TRUE(k.shapes(c).front().assumptions.empty());
}

TEST(Containers, WithoutARawPieceThePlainFeaturesSayWhereThePieceIs) {
  Bench k;
  k.pocket(130, 90, 260, 180, 5);
  const auto c = k.compound(k.at(160, 90, 0), {k.hole(160, 90, 8, 10)});
  EXPECT_EQ(k.places(c), "160,90,0");
}

TEST(Containers, AHeightThatWouldBeStatedTwiceIsToldByTheTopOfThePiece) {
  Bench k;
  Block b;
  b.x = 200;
  b.y = 200;
  b.z = 20;
  Workpiece w;
  w.its_bounding_geometry = k.m.add(b);
  k.m.add(w);
  RoundHole h;
  h.feature_placement = k.at(50, 50, 20);
  h.depth = k.depth(-30);
  h.diameter = k.length(8);
  h.bottom_condition = k.m.add(ThroughBottomCondition{});
  const auto c = k.compound(k.at(50, 50, 20), {k.m.add(h)});
  EXPECT_EQ(k.places(c), "50,50,20");
}

TEST(Containers, NestedOnesMayAllBeStatedInWorkpieceCoordinates) {
  Bench k;
  k.raw(260, 180, 50);
  const auto hole = k.hole(130, 120, 8, 10);
  const auto c = k.compound(k.at(130, 120, 0), {hole});
  // The location stays relative: (130, 120) + (0, -60).
  const auto g = k.general(k.at(130, 120, 0), c, {k.at(0, -60, 0)});
  EXPECT_EQ(k.places(g), "130,120,0 130,60,0");
  EXPECT_EQ(k.places(hole), "130,120,0");
  EXPECT_FALSE(k.shapes(g).front().assumptions.empty());
}

TEST(Containers, LocationsMayBeStatedInWorkpieceCoordinatesToo) {
  Bench k;
  k.raw(260, 180, 50);
  // Relative: (260, 180), on the piece's corner; in workpiece coordinates (130, 60).
  const auto g = k.general(k.at(130, 130, 0), k.hole(130, 130, 8, 10), {k.at(130, 60, 0)});
  EXPECT_EQ(k.places(g), "130,130,0 130,60,0");
}

TEST(Containers, ABossStaysInItsPocketWhereverTheCompoundPutsBoth) {
  Bench k;
  const auto pocket = k.pocket(30, 20, 60, 40, 5);
  const auto boss = k.boss(35, 20, 10, 8, 5);
  k.m.at<ClosedPocket>(pocket).its_boss.push_back(boss);
  const auto c = k.compound(k.at(100, 50, 0), {pocket});
  const auto s = k.shapes(c);
  ASSERT_EQ(s.size(), 1u);
  EXPECT_LT(norm(s[0].frame.origin - Vec3{130, 70, 0}), kSame);
  ASSERT_EQ(s[0].islands.size(), 1u);
  // The boss is 5 mm right of the pocket's middle, 10 wide: 0 to 10 in the pocket's frame.
  const auto box = geometry::bounds(s[0].islands[0].area);
  EXPECT_NEAR(box.lo.x, 0.0, 1e-6);
  EXPECT_NEAR(box.hi.x, 10.0, 1e-6);
  EXPECT_EQ(k.places(boss), "135,70,0");
}

TEST(Containers, AThreadIsWhereItsHoleIs) {
  Bench k;
  const auto hole = k.hole(0, 0, 8.5, 20);
  CatalogueThread t;
  t.its_id = "M10";
  t.applied_shape.items.push_back(hole);
  t.major_diameter = 10.0;
  NumericParameter per_mm;
  per_mm.its_parameter_value = 1 / 1.5;
  t.number_of_threads = k.m.add(per_mm);
  const auto beside = k.m.add(t);
  const auto c = k.compound(k.at(100, 50, 0), {hole, beside});
  EXPECT_EQ(k.places(c), "100,50,0 100,50,0");
  EXPECT_EQ(k.places(beside), "100,50,0");
}

TEST(Containers, AnEdgeOfAPatternIsOnEachOfItsHoles) {
  Bench k;
  const auto g = k.general(k.at(100, 50, 0), k.hole(0, 0, 8, 20), {k.at(0, -30, 0)});
  Chamfer e;
  e.first_feature = Ref<MachiningFeature>(AnyRef(g));
  e.first_offset_amount = k.length(1);
  e.angle_to_plane = std::numbers::pi / 4;
  EXPECT_EQ(k.places(k.m.add(e)), "100,50,0 100,20,0");
}

TEST(Containers, APatternOfItselfIsRefused) {
  Bench k;
  const auto g = k.general(k.at(1, 0, 0), {}, {k.at(5, 0, 0)});
  k.m.at<GeneralPattern>(g).replicate_base_feature = Ref<Two5dManufacturingFeature>(AnyRef(g));
  EXPECT_FALSE(shapes_of(k.m, g));
}

TEST(Containers, NestedPatternsThatWouldBeMillionsOfCopiesAreRefused) {
  Bench k;
  AnyRef inner = k.hole(0, 0, 1, 1);
  for (int i = 0; i < 3; ++i) {
    CircularPattern p;
    p.feature_placement = k.at(1, 0, 0);
    p.replicate_base_feature = Ref<Two5dManufacturingFeature>(inner);
    p.number_of_feature = 1000;
    p.angle_increment = 0.001;
    inner = k.m.add(p);
  }
  EXPECT_FALSE(shapes_of(k.m, Ref<ManufacturingFeature>(inner)));
}

// A drill of 120 degrees leaves a flank of 30 degrees against the plane, half of its point has 60.
TEST(ConicalBottom, IsThePointOfADrillHoweverItsAngleIsStated) {
  const double degree = std::numbers::pi / 180.0;
  const std::pair<double, double> flank_of[] = {{30, 30}, {60, 30}, {120, 30}, {70, 20}, {140, 20},
                                                {20, 20}, {45, 45}, {90, 45},  {59, 31}, {118, 31}};
  for (const auto& [stated, flank] : flank_of) {
    Bench k;
    const auto hole = k.hole(0, 0, 10, 10);
    ConicalHoleBottom c;
    c.tip_angle = stated * degree;
    k.m.get<RoundHole>(hole)->bottom_condition = k.m.add(c);
    const auto s = k.only(hole);
    EXPECT_NEAR(s.bottom_angle_rad / degree, flank, 1e-9) << stated;
    EXPECT_EQ(s.assumptions.empty(), stated >= 90) << stated;
  }
}

TEST(GlobalTolerance, ThatIsHardlyMeantIsNotUsed) {
  Workpiece w;
  EXPECT_FALSE(global_tolerance_of(w));
  w.global_tolerance = 0.1;
  EXPECT_EQ(global_tolerance_of(w), 0.1);
  w.global_tolerance = 50.0;
  EXPECT_FALSE(global_tolerance_of(w));
  w.global_tolerance = 0.0;
  EXPECT_FALSE(global_tolerance_of(w));
}

}  // namespace
}  // namespace capstan::model
