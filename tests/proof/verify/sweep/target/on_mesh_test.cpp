#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "planner/model/plan/corner_rest.h"
#include "planner/proof/verify/sweep/target/corners.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "tests/proof/verify/plans.h"

namespace capstan::verify {
namespace {

using geometry::Vec3;

constexpr double kLean = 70.0 / 180.0 * std::numbers::pi;
constexpr double kFoot = 10.0, kDeep = 10.0, kLong = 50.0, kWide = 20.0;

/// Height of a wall that rises at 70 degrees from x = 10 at z = -10 to z = 0, this much too thick.
double height_at(double x, double too_thick_mm) {
  const double wall = -kDeep + (x - kFoot) * std::tan(kLean) + too_thick_mm / std::cos(kLean);
  return std::clamp(wall, -kDeep, 0.0);
}

/// The sheet of floor, wall and top, and a pocket in the top that the mesh does not show where it is wanted.
struct Part {
  testing::PlanMaker k = testing::empty_plan();
  PartShapes shapes;
  Asked asked;

  explicit Part(bool pocket) {
    k.plan.stock.box = {{0, 0, -20}, {kLong, kWide, 0}};
    if (pocket) (void)k.pocket("P", 35, 10, 12, 5);
    shapes = shapes_of_part(k.plan);
    auto mesh = std::make_shared<geometry::Mesh>();
    const double head = kFoot + kDeep / std::tan(kLean);
    for (const double y : {0.0, kWide}) {
      for (const Vec3 p : {Vec3{0, y, -kDeep}, Vec3{kFoot, y, -kDeep}, Vec3{head, y, 0}, Vec3{kLong, y, 0}})
        mesh->vertices.push_back(p);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      mesh->triangles.push_back({i, i + 1, i + 5});
      mesh->triangles.push_back({i, i + 5, i + 4});
    }
    k.plan.target_mesh = mesh;
    PartShapes::Entry e;
    e.feature = k.plan.model.add(model::RegionProjection{});
    e.shapes.emplace_back();
    e.shapes.front().feature = e.feature;
    e.shapes.front().kind = model::ShapeKind::kFreeform;
    asked.feature = e.feature;
    asked.side_mm = asked.bottom_mm = asked.ridges_mm = 0.0;
    shapes.entries.push_back(e);
  }
  /// What is found of the surface, its wall this much too thick.
  [[nodiscard]] bool is_left(double too_thick_mm) const {
    Target target(k.plan, shapes, 0);
    Grid grid({0, 0}, {kLong, kWide}, 0.2, 1000000);
    target.fill(grid);
    for (int iy = 0; iy < grid.ny(); ++iy) {
      for (int ix = 0; ix < grid.nx(); ++ix)
        grid.stock[grid.index(ix, iy)] = height_at(grid.centre(ix, iy).x, too_thick_mm);
    }
    Findings findings;
    target.left(grid, {asked}, {asked}, false, findings);
    const auto found = findings.take();
    return std::any_of(found.begin(), found.end(),
                       [](const model::Finding& f) { return f.code == "CHK-LEFT"; });
  }
};

// Allowed are 0.025 mm square to it: along z 0.016 mm are 0.047 there.
TEST(LeftOnMesh, OnASteepWallIsFoundAsItStandsSquareToIt) {
  const Part part(false);
  EXPECT_FALSE(part.is_left(0.0));
  EXPECT_FALSE(part.is_left(0.016));
  EXPECT_TRUE(part.is_left(0.1));
}

/// The steps of a plan that finish the surface, and what is found where the foot of the wall keeps a fillet.
struct Fillet {
  Part part{false};

  [[nodiscard]] std::vector<model::Finding> found(double radius, double recorded_mm = 0.0) {
    if (recorded_mm > 0.0) {
      part.shapes.entries.back().shapes.front().name = "S";
      part.asked.ball_mm = recorded_mm;
      part.k.plan.provenance.push_back(model::provenance_of({"S", 3.0, recorded_mm, "a test"}));
    }
    Target target(part.k.plan, part.shapes, 0);
    Grid grid({0, 0}, {kLong, kWide}, 0.1, 4000000);
    target.fill(grid);
    // A ball of this radius on floor and wall: its middle is r tan(90 - 70 / 2 degrees) from the foot.
    const double from_foot = radius * std::tan(0.5 * kLean);
    for (int iy = 0; iy < grid.ny(); ++iy) {
      for (int ix = 0; ix < grid.nx(); ++ix) {
        const double x = grid.centre(ix, iy).x, d = x - (kFoot - from_foot);
        double z = height_at(x, 0.0);
        if (d > 0.0 && d < radius * std::sin(kLean))
          z = std::max(z, -kDeep + radius - std::sqrt(radius * radius - d * d));
        grid.stock[grid.index(ix, iy)] = z;
      }
    }
    Findings findings;
    target.left(grid, {part.asked}, {part.asked}, false, findings);
    return findings.take();
  }
  static bool has(const std::vector<model::Finding>& all, const std::string& code) {
    return std::any_of(all.begin(), all.end(), [&](const model::Finding& f) { return f.code == code; });
  }
};

// The mesh draws the foot sharp, so 3 mm may stay there as in an unstated corner: a radius of 4 mm is too
// much.
TEST(LeftOnMesh, InACreaseThatStatesNoRadiusMayBeWhatNoBallOfThreeMillimetresReaches) {
  const auto three = Fillet().found(3.0);
  EXPECT_FALSE(Fillet::has(three, "CHK-LEFT"));
  EXPECT_TRUE(Fillet::has(three, "CHK-REST"));
  EXPECT_TRUE(Fillet::has(Fillet().found(4.0), "CHK-LEFT"));
}

TEST(LeftOnMesh, OfARecordedRadiusMayBeThatAndNoMore) {
  const auto recorded = Fillet().found(5.0, 5.0);
  EXPECT_FALSE(Fillet::has(recorded, "CHK-LEFT"));
  EXPECT_TRUE(Fillet::has(recorded, "CHK-REST"));
  EXPECT_TRUE(Fillet::has(Fillet().found(6.0, 5.0), "CHK-LEFT"));
}

TEST(LeftOnMesh, ARecordOfARadiusWiderThanTheLastBallIsAFault) {
  Part part(false);
  part.shapes.entries.back().shapes.front().name = "S";
  part.asked.ball_mm = 4.0;
  for (const double radius : {4.0, 5.0}) {
    part.k.plan.provenance = {model::provenance_of({"S", 3.0, radius, "a test"})};
    Findings findings;
    check_corner_records(part.k.plan, part.shapes, {part.asked}, false, findings);
    EXPECT_EQ(Fillet::has(findings.take(), "CHK-REST-RECORD"), radius > 4.0) << radius;
  }
}

// The pocket was not cut: what stands in it lies on the mesh, but not on the part.
TEST(LeftOnMesh, InAFeatureThatTheMeshDoesNotShowIsFound) {
  const Part part(true);
  EXPECT_TRUE(part.is_left(0.0));
}

}  // namespace
}  // namespace capstan::verify
