#include "planner/making/piece/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/making/piece/demands.h"
#include "planner/model/features/in_piece.h"
#include "planner/model/nouns/all.h"

namespace capstan::piece {
namespace {

using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

/// A raw piece of 100 x 100 x 20 mm, its top at z = 0, and features in it.
struct Plate {
  model::Plan plan;
  Shapes shapes;
  Piece piece{plan, shapes};
  Plate() { plan.stock.box = {{0, 0, -20}, {100, 100, 0}}; }

  const FeatureShape& add(ShapeKind kind, Vec3 top, double x, double y, double depth,
                          bool from_below = false) {
    FeatureShape s;
    s.kind = kind;
    s.member = static_cast<int>(shapes.all.size());
    s.frame.origin = top;
    if (from_below) {
      s.frame.z = {0, 0, -1};
      s.frame.y = {0, -1, 0};
    }
    s.depth_mm = depth;
    s.area = s.reach = geometry::rectangle({-0.5 * x, -0.5 * y}, {0.5 * x, 0.5 * y});
    shapes.all.push_back(s);
    return shapes.all.back();
  }
};

TEST(Thickness, IsWhatStaysToTheSidesAndTheBottomOfTheRawPiece) {
  Plate p;
  const Thickness t = thickness_beside(p.piece, p.add(ShapeKind::kPocket, {50, 30, 0}, 40, 50, 15));
  EXPECT_DOUBLE_EQ(t.wall_mm.value_or(0), 5.0) << "30 less half of 50";
  EXPECT_DOUBLE_EQ(t.floor_mm.value_or(0), 5.0);
}

TEST(Thickness, LeavesOutAnOpenSide) {
  Plate p;
  const Thickness t = thickness_beside(p.piece, p.add(ShapeKind::kPocket, {50, 25, 0}, 40, 50, 15));
  EXPECT_DOUBLE_EQ(t.wall_mm.value_or(0), 30.0) << "y = 0 is open; 50 less half of 40 stays beside";
}

TEST(Thickness, ARoundedCornerBesideAnOpenSideIsNoThinWall) {
  Plate p;
  FeatureShape s = p.add(ShapeKind::kPocket, {50, 20, 0}, 40, 50, 15);  // runs out over y = 0 by 5 mm
  // Corners of 10 mm, in small pieces: some of them end just inside the raw piece's side.
  geometry::Loop loop;
  for (int corner = 0; corner < 4; ++corner) {
    const double cx = corner == 0 || corner == 3 ? 10 : -10, cy = corner < 2 ? 15 : -15;
    for (int k = 0; k <= 30; ++k) {
      const double a = 1.5707963267948966 * (corner + k / 30.0);
      loop.push_back({cx + 10 * std::cos(a), cy + 10 * std::sin(a)});
    }
  }
  s.area = s.reach = geometry::Region{{loop}};
  EXPECT_NEAR(thickness_beside(p.piece, s).wall_mm.value_or(0), 30.0, 1e-6) << "50 less half of 40";
}

TEST(Thickness, IsTheWallBetweenTwoPocketsAtOverlappingDepths) {
  Plate p;
  p.add(ShapeKind::kPocket, {30, 50, 0}, 30, 40, 10);
  p.add(ShapeKind::kPocket, {62, 50, 0}, 30, 40, 6);
  EXPECT_NEAR(thickness_beside(p.piece, p.shapes.all[0]).wall_mm.value_or(0), 2.0, 1e-9);
  EXPECT_NEAR(thickness_beside(p.piece, p.shapes.all[1]).wall_mm.value_or(0), 2.0, 1e-9);
  // One that begins below the other's floor stands beside nothing.
  p.shapes.all[1].frame.origin.z = -11.0;
  EXPECT_DOUBLE_EQ(thickness_beside(p.piece, p.shapes.all[0]).wall_mm.value_or(0), 15.0);
}

TEST(Thickness, SeesWhatIsCutFromTheOtherSide) {
  Plate p;
  p.add(ShapeKind::kPocket, {50, 50, 0}, 40, 40, 8);
  p.add(ShapeKind::kPocket, {50, 50, -20}, 40, 40, 9, true);
  EXPECT_NEAR(thickness_beside(p.piece, p.shapes.all[0]).floor_mm.value_or(0), 3.0, 1e-9);
  EXPECT_NEAR(thickness_beside(p.piece, p.shapes.all[1]).floor_mm.value_or(0), 3.0, 1e-9);
  p.shapes.all[1].frame.origin.x = 95;
  EXPECT_NEAR(thickness_beside(p.piece, p.shapes.all[0]).floor_mm.value_or(0), 12.0, 1e-9) << "not below it";
}

TEST(Thickness, OfWhatGoesThroughHasNoFloor) {
  Plate p;
  p.add(ShapeKind::kPocket, {50, 50, 0}, 40, 40, 20);
  p.shapes.all[0].through = true;
  EXPECT_FALSE(thickness_beside(p.piece, p.shapes.all[0]).floor_mm);
}

TEST(Context, TakesGeneralFlatnessOfAFaceThatStatesNone) {
  Plate p;
  Demands demands;
  demands.general = *model::parse_general("ISO 2768-mH");
  p.add(ShapeKind::kFace, {50, 50, 0}, 100, 80, 1);
  EXPECT_EQ(context_of(p.piece, demands, {}, {p.shapes.all[0]}).quality.form_mm, 0.1) << "up to 100 mm";
}

TEST(Face, ThatCrossesABossOfAnotherFeatureIsRefused) {
  Plate plate;
  plate.add(ShapeKind::kPocket, {50, 50, 0}, 80, 80, 10);
  // A boss 20 x 20 in the middle of the pocket, as high as the raw piece.
  plate.shapes.all.back().islands.push_back({geometry::rectangle({-10, -10}, {10, 10}), 0.0});
  plate.shapes.all.back().feature = {model::TypeId::kClosedPocket, 0};
  FeatureShape face;
  face.feature = {model::TypeId::kPlanarFace, 0};
  face.kind = ShapeKind::kFace;
  face.depth_mm = 4.0;
  face.area = geometry::rectangle({0, 0}, {100, 50});  // through the middle of the boss
  const std::string why = crosses_a_wall(plate.piece, face);
  EXPECT_NE(why.find("4 mm above the face's floor"), std::string::npos) << why;
  face.area = geometry::rectangle({0, 0}, {100, 40});  // up to the boss
  EXPECT_EQ(crosses_a_wall(plate.piece, face), "");
  face.area = geometry::rectangle({0, 0}, {100, 100});  // over all of it: the boss is faced
  EXPECT_EQ(crosses_a_wall(plate.piece, face), "");
}

/// Many shapes from above, below and a side, some leaning by a little, of sizes from a hole to a face over
/// all.
void add_many(Plate& p, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  for (int i = 0; i < count; ++i) {
    const bool below = i % 5 == 0;
    const double large = i % 40 == 7 ? 8.0 : 1.0;
    p.add(i % 2 == 0 ? ShapeKind::kPocket : ShapeKind::kHole,
          {between(5, 95), between(5, 95), below ? -20.0 : between(-6, 0)}, large * between(0.5, 6),
          large * between(0.5, 6), between(0.5, 14), below);
    FeatureShape& s = p.shapes.all.back();
    if (s.kind == ShapeKind::kHole) s.diameter.nominal_mm = between(1, 6);
    const double lean = i % 7 == 3 ? 5e-4 : i % 11 == 4 ? 0.5 : 0.0;
    s.frame = compose(
        s.frame,
        geometry::Placement{
            {}, {std::cos(lean), 0, std::sin(lean)}, {0, 1, 0}, {-std::sin(lean), 0, std::cos(lean)}});
  }
  p.add(ShapeKind::kFace, {50, 50, 0}, 100, 100, 1);
  p.shapes.all.back().area = p.shapes.all.back().reach = geometry::rectangle({-50, -50}, {50, 50});
}

TEST(ThicknessProperty, IsThatOfAllPairsWhereNeighboursAreLookedUp) {
  int walls = 0, floors = 0, clear = 0;
  for (const int count : {1, 2, 60, 300}) {
    Plate p;
    add_many(p, count, static_cast<unsigned>(count));
    std::vector<Thickness> of_all_pairs;
    std::vector<std::optional<double>> clear_of_all;
    for (const FeatureShape& s : p.shapes.all) {
      of_all_pairs.push_back(thickness_beside(p.piece, s));
      clear_of_all.push_back(clear_beside(p.piece, s));
    }
    p.shapes.near_all = Neighbours(p.shapes.all);
    for (std::size_t i = 0; i < p.shapes.all.size(); ++i) {
      const Thickness t = thickness_beside(p.piece, p.shapes.all[i]);
      EXPECT_EQ(t.wall_mm, of_all_pairs[i].wall_mm) << "shape " << i << " of " << count;
      EXPECT_EQ(t.floor_mm, of_all_pairs[i].floor_mm) << "shape " << i << " of " << count;
      EXPECT_EQ(clear_beside(p.piece, p.shapes.all[i]), clear_of_all[i]) << "shape " << i << " of " << count;
      walls += t.wall_mm.has_value();
      floors += t.floor_mm.has_value();
      clear += clear_of_all[i].has_value();
    }
  }
  EXPECT_GT(walls, 200);
  EXPECT_GT(floors, 100);
  EXPECT_GT(clear, 20);
}

TEST(Thickness, IsKnownAmongThousandsOfHoles) {
  Plate p;
  p.plan.stock.box = {{0, 0, -20}, {1000, 1000, 0}};
  for (int i = 0; i < 2500; ++i)
    p.add(ShapeKind::kHole, {10.0 + 20.0 * (i % 50), 10.0 + 20.0 * (i / 50), 0}, 6, 8, 10);
  p.shapes.near_all = Neighbours(p.shapes.all);
  EXPECT_DOUBLE_EQ(thickness_beside(p.piece, p.shapes.all[1225]).wall_mm.value_or(0), 12.0) << "20 less 8";
}

TEST(Around, HoldsTheAreaWhereverItLies) {
  Plate p;
  FeatureShape s = p.add(ShapeKind::kPocket, {10, 20, -3}, 6, 8, 2);
  s.area = geometry::rectangle({1, 1}, {7, 9});
  const Around ball = around(s);
  EXPECT_DOUBLE_EQ(ball.radius_mm, 5.0) << "half the diagonal of 6 x 8";
  EXPECT_EQ(ball.centre, (Vec3{14, 25, -3}));
}

/// A plate with a face over all of what its file states as raw piece: x 10 .. 90, y 20 .. 80.
struct FacedPlate : Plate {
  FacedPlate() {
    model::CartesianPoint corner;
    corner.coordinates = {{10, 20, -20}, true};
    model::Axis2Placement3d at;
    at.location = plan.model.add(corner);
    model::Block block;
    block.position = plan.model.add(at);
    block.x = 80.0;
    block.y = 60.0;
    block.z = 20.0;
    model::Workpiece w;
    w.its_bounding_geometry = plan.model.add(block);
    plan.model.add(w);
  }

  /// Whether a face from y = 20 up, as wide as the file's piece, ends at a wall.
  bool walled(double y) {
    FeatureShape face = add(ShapeKind::kFace, {50, 20 + 0.5 * y, 0}, 80, y, 1);
    face.open = true;
    face.reach = geometry::rectangle({-500, -500}, {500, 500});
    stop_at_walls(piece, face);
    return model::stops_at_walls(face);
  }
};

// Whoever saws a larger piece does not make a larger part: what stands beside the face is scrap, no wall.
TEST(PartBox, IsTheRawPieceOfTheFileWhereALargerOneIsCut) {
  FacedPlate p;
  const geometry::Box3 part = part_box(p.piece);
  EXPECT_DOUBLE_EQ(part.lo.x, 10.0);
  EXPECT_DOUBLE_EQ(part.hi.y, 80.0);
  EXPECT_FALSE(p.walled(60));
}

TEST(PartBox, StillHasTheWallsOfTheFilesOwnPiece) {
  FacedPlate p;
  EXPECT_TRUE(p.walled(40));
}

}  // namespace
}  // namespace capstan::piece
