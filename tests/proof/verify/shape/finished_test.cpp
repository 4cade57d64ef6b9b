// The finished part against the shape of a CAD file: a block with one pocket, as a mesh made by hand.

#include "planner/proof/verify/shape/finished.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/shape/edges.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "tests/proof/verify/checked.h"
#include "tests/proof/verify/plans.h"

namespace capstan::verify::testing {
namespace {

using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kChord = 0.02;  // more than what the arcs below lose

/// The plan's raw piece with a square pocket about (50, 50): `half` wide to each side, with corners of 5 mm.
AskedShape block_with_pocket(double half, double depth) {
  constexpr int kPieces = 16;  // of a quarter: 0.006 mm
  constexpr double kRadius = 5.0;
  AskedShape out;
  out.file = "block.step";
  out.chord_mm = kChord;
  auto& v = out.mesh.vertices;
  auto& all = out.mesh.triangles;
  const auto corner = [&](Vec3 p) {
    v.push_back(p);
    return static_cast<std::uint32_t>(v.size() - 1);
  };
  AskedShape::Plane top{"#top", {}}, floor{"#floor", {}};
  std::array<AskedShape::Plane, 4> walls{{{"#north", {}}, {"#west", {}}, {"#south", {}}, {"#east", {}}}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, AskedShape::Plane* of = nullptr) {
    if (of != nullptr) of->triangles.push_back(static_cast<std::uint32_t>(all.size()));
    all.push_back({a, b, c});
  };
  const std::array<geometry::Vec2, 4> signs{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  std::array<std::uint32_t, 4> over{}, under{};
  std::vector<std::uint32_t> rim, foot;
  for (std::size_t k = 0; k < 4; ++k) {
    over[k] = corner({50 + 50 * signs[k].x, 50 + 50 * signs[k].y, 0});
    under[k] = corner({50 + 50 * signs[k].x, 50 + 50 * signs[k].y, -50});
    for (int i = 0; i <= kPieces; ++i) {
      const double turn =
          0.5 * std::numbers::pi * (static_cast<double>(k) + static_cast<double>(i) / kPieces);
      const double x = 50 + (half - kRadius) * signs[k].x + kRadius * std::cos(turn);
      const double y = 50 + (half - kRadius) * signs[k].y + kRadius * std::sin(turn);
      rim.push_back(corner({x, y, 0}));
      foot.push_back(corner({x, y, -depth}));
    }
  }
  const std::uint32_t middle = corner({50, 50, -depth});
  for (std::size_t j = 0; j < rim.size(); ++j) {
    const std::size_t next = (j + 1) % rim.size();
    const std::size_t k = j / (kPieces + 1);
    const bool flat = (j + 1) % (kPieces + 1) == 0;
    AskedShape::Plane* wall = flat ? &walls[k] : nullptr;
    add(rim[j], rim[next], foot[j], wall);
    add(rim[next], foot[next], foot[j], wall);
    add(middle, foot[j], foot[next], &floor);
    add(rim[next], rim[j], over[k], &top);
    if (flat) add(rim[next], over[k], over[(k + 1) % 4], &top);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    add(over[k], under[k], over[next]);
    add(over[next], under[k], under[next]);
  }
  add(under[0], under[2], under[1]);
  add(under[0], under[3], under[2]);
  out.planes = {top, floor};
  out.planes.insert(out.planes.end(), walls.begin(), walls.end());
  return out;
}

AskedShape pocketed() { return block_with_pocket(20, 10); }

PlanMaker pocket_plan() {
  PlanMaker k = empty_plan();
  k.step<model::BottomAndSideRoughMilling>("pocket", k.pocket("P", 50, 50, 40, 10), "em10", pocket_path(),
                                           600, 3000);
  return k;
}

ShapeDifference compared(const model::Plan& plan, const AskedShape& shape) {
  Findings unsaid;
  return compare_with_shape(plan, moves_of(plan, unsaid), shape);
}

/// The plan with every place at one coordinate of its path moved to another.
PlanMaker moved(std::vector<double> model::CutterPath::*axis, double from, double to) {
  PlanMaker k = pocket_plan();
  edit_path(k.plan, 0, [&](model::CutterPath& p) {
    for (double& v : p.*axis) v = v == from ? to : v;
  });
  return k;
}

TEST(FinishedShape, APlanThatMakesTheShapeHasNothingLeftAndNothingGouged) {
  const ShapeDifference d = compared(pocket_plan().plan, pocketed());
  // 40 x 40 x 10 less four corners of 5 mm.
  EXPECT_NEAR(d.asked_mm3, 10 * (1600 - (4 - std::numbers::pi) * 25), 0.05 * d.asked_mm3);
  EXPECT_NEAR(d.removed_mm3, d.asked_mm3, 0.005 * d.asked_mm3);
  EXPECT_EQ(d.left_mm3, 0.0);
  EXPECT_EQ(d.gouged_mm3, 0.0);
  EXPECT_GT(d.overlap, 0.999);
  EXPECT_EQ(d.planes, 6U);
  EXPECT_THAT(d.high, IsEmpty());
  EXPECT_THAT(d.low, IsEmpty());
  EXPECT_EQ(d.worst_high_mm, 0.0);
  EXPECT_EQ(d.worst_low_mm, 0.0);
}

TEST(FinishedShape, TheMeshesChordIsPartOfTheTolerance) {
  AskedShape shape = pocketed();
  EXPECT_NEAR(compared(pocket_plan().plan, shape).tolerance_mm, kShapeMm + kChord, 1e-12);
  const PlanMaker deeper = moved(&model::CutterPath::z, -10.0, -10.08);
  EXPECT_THAT(compared(deeper.plan, shape).low, ElementsAre("#floor"));
  shape.chord_mm = 0.05;
  EXPECT_THAT(compared(deeper.plan, shape).low, IsEmpty());
}

TEST(FinishedShape, AFloorTenthOfAMillimetreTooDeepIsMeasured) {
  const ShapeDifference d = compared(moved(&model::CutterPath::z, -10.0, -10.1).plan, pocketed());
  EXPECT_THAT(d.low, ElementsAre("#floor"));
  EXPECT_THAT(d.high, IsEmpty());
  EXPECT_NEAR(d.worst_low_mm, 0.1, 0.006);
  EXPECT_EQ(d.worst_high_mm, 0.0);
}

TEST(FinishedShape, AFloorTenthOfAMillimetreTooHighIsMeasured) {
  const ShapeDifference d = compared(moved(&model::CutterPath::z, -10.0, -9.9).plan, pocketed());
  EXPECT_THAT(d.high, ElementsAre("#floor"));
  EXPECT_THAT(d.low, IsEmpty());
  EXPECT_NEAR(d.worst_high_mm, 0.1, 0.006);
  EXPECT_EQ(d.worst_low_mm, 0.0);
}

TEST(FinishedShape, AWallThatIsCutIntoIsMeasured) {
  const ShapeDifference d = compared(moved(&model::CutterPath::y, 65.0, 65.3).plan, pocketed());
  EXPECT_THAT(d.low, ElementsAre("#north"));
  EXPECT_THAT(d.high, IsEmpty());
  EXPECT_NEAR(d.worst_low_mm, 0.3, 0.006);
}

TEST(FinishedShape, HighAndLowAreMeasuredApart) {
  // The south wall is not reached by 0.2 mm, the north wall is cut into by 0.3 mm.
  PlanMaker k = moved(&model::CutterPath::y, 65.0, 65.3);
  edit_path(k.plan, 0, [](model::CutterPath& p) {
    for (double& y : p.y) y = y == 35.0 ? 35.2 : y;
  });
  const ShapeDifference d = compared(k.plan, pocketed());
  EXPECT_NEAR(d.worst_low_mm, 0.3, 0.006);
  EXPECT_NEAR(d.worst_high_mm, 0.2, 0.006);
}

TEST(FinishedShape, WhatLiesDeepInsideThePartIsFoundWithItsPlace) {
  PlanMaker k = pocket_plan();
  k.step<model::Drilling>("drill", k.hole("H", 15, 15, 8, 20), "d8", drill_path(), 225, 1500);
  const ShapeDifference d = compared(k.plan, pocketed());
  EXPECT_NEAR(d.gouged_mm3, 16 * std::numbers::pi * (20 + point_length() / 3), 60.0);
  // Under the top, the farthest from it and from the walls.
  EXPECT_LT(std::hypot(d.gouge_at.x - 15, d.gouge_at.y - 15), 4.0);
  EXPECT_GT(d.deepest_gouge_mm, 14.0);
  EXPECT_LE(d.deepest_gouge_mm, 19.0);
  EXPECT_EQ(d.left_mm3, 0.0);
}

TEST(FinishedShape, APlaneIsMeasuredNoFartherThanIsSaid) {
  // A thin hole at a place of the floor, between the points of the lattice.
  PlanMaker k = pocket_plan();
  k.plan.cutters[1].cutting_diameter_mm = 0.2;
  const double y = 50.0 + 40.0 / 3.0;
  model::CutterPath p;
  p.start({50, y, 10});
  p.rapid({50, y, 2});
  p.line({50, y, -30}, MoveRole::kDrill);
  p.rapid({50, y, 10}, MoveRole::kRetract);
  k.step<model::Drilling>("drill", k.hole("H", 50, y, 0.2, 30), "d8", p, 225, 1500);
  const AskedShape shape = pocketed();
  EXPECT_EQ(compared(k.plan, shape).worst_low_mm, kFarthestPlaneMm);
  EXPECT_THAT(told(check_shape({}, k.plan, shape)), HasSubstr("3.2 mm or more deep"));
}

TEST(FinishedShape, FindingsSayWhatIsWrong) {
  const AskedShape shape = pocketed();
  const auto right = check_shape({}, pocket_plan().plan, shape);
  ASSERT_EQ(right.size(), 1U) << told(right);
  EXPECT_EQ(right[0].code, "CHK-SHAPE");
  EXPECT_EQ(right[0].severity, Severity::kNote);
  EXPECT_THAT(right[0].message, HasSubstr("6 of 6 plane faces within 0.06 mm"));

  const auto deep = check_shape({}, moved(&model::CutterPath::z, -10.0, -10.1).plan, shape);
  ASSERT_EQ(deep.size(), 2U) << told(deep);
  const model::Finding& deep_said = deep[0].code == "CHK-SHAPE" ? deep[1] : deep[0];
  EXPECT_EQ(deep_said.code, "CHK-SHAPE-GOUGE");
  EXPECT_EQ(deep_said.severity, Severity::kError);
  EXPECT_THAT(deep_said.message, HasSubstr("up to 0.1 mm deep; plane faces cut into: #floor"));

  const auto left = check_shape({}, moved(&model::CutterPath::z, -10.0, -9.9).plan, shape);
  ASSERT_EQ(left.size(), 2U) << told(left);
  const model::Finding& left_said = left[0].code == "CHK-SHAPE" ? left[1] : left[0];
  EXPECT_EQ(left_said.code, kFacesLeft);
  EXPECT_EQ(left_said.severity, Severity::kWarning);
  EXPECT_THAT(left_said.message, HasSubstr("up to 0.1 mm thick; plane faces not reached: #floor"));
}

TEST(FinishedShape, AProgramIsHeldAgainstTheShapeByItsOwnText) {
  const AskedShape shape = pocketed();
  const model::Plan plan = pocket_plan().plan;
  const std::string table = tool_table_of(plan);
  // The plan stays right: only the text is wrong.
  const auto said = [&](const PlanMaker& written) {
    return told(check_shape({"pocket.ngc", program_of(written.plan), table}, plan, shape));
  };
  const std::string right = said(pocket_plan());
  EXPECT_THAT(right, HasSubstr("CHK-SHAPE "));
  EXPECT_EQ(right.find("CHK-SHAPE-"), std::string::npos) << right;
  EXPECT_THAT(said(moved(&model::CutterPath::z, -10.0, -10.1)),
              HasSubstr("up to 0.1 mm deep; plane faces cut into: #floor"));
  EXPECT_THAT(said(moved(&model::CutterPath::z, -10.0, -9.9)),
              HasSubstr("up to 0.1 mm thick; plane faces not reached: #floor"));
  EXPECT_THAT(said(moved(&model::CutterPath::y, 65.0, 65.3)), HasSubstr("plane faces cut into: #north"));
}

// A hole square to a face that leans by 45 degrees: the cells of its set-up do not lie over the points.
class LeaningHole : public ::testing::Test {
 protected:
  LeaningHole() {
    const auto direction = [&](double x, double y, double z) {
      model::Direction d;
      d.direction_ratios = {{x, y, z}, true};
      return k_.plan.model.add(d);
    };
    for (const model::AnyRef at : k_.plan.model.all(model::TypeId::kWorkpieceSetup)) {
      auto* piece = k_.plan.model.get<model::WorkpieceSetup>(at);
      auto* origin = k_.plan.model.get<model::Axis2Placement3d>(piece->its_origin);
      origin->axis = direction(1, 0, 1);
      origin->ref_direction = direction(1, 0, -1);
    }
    const geometry::Placement out = geometry::inverse(workpiece_in(k_.plan, 0));
    shape_ = block_with_pocket(6, 10);
    for (Vec3& v : shape_.mesh.vertices) v = out.to_parent(v);
    shape_.planes = {shape_.planes[1]};  // the floor: nothing else stands in the raw piece
    // Less than 10 mm over the floor, more than 6 mm beside its middle.
    const Vec3 floor = out.to_parent({50, 50, -10});
    k_.plan.stock.box = {floor - Vec3{7, 7, 7}, floor + Vec3{7, 7, 7}};
  }
  void cut_down_to(double z) {
    model::CutterPath p;
    p.start({50, 50, 10});
    p.rapid({50, 50, 2});
    p.line({50, 50, z}, MoveRole::kPlunge);
    for (const auto& [x, y] : {std::pair(49, 49), {51, 49}, {51, 51}, {49, 51}, {49, 49}})
      p.line({static_cast<double>(x), static_cast<double>(y), z}, MoveRole::kCut);
    p.rapid({49, 49, 10}, MoveRole::kRetract);
    k_.step<model::BottomAndSideRoughMilling>("hole", k_.pocket("P", 50, 50, 12, 10), "em10", p, 600, 3000);
  }
  PlanMaker k_ = empty_plan();
  AskedShape shape_;
};

TEST_F(LeaningHole, IsRightWhereItIsMadeRight) {
  cut_down_to(-10);
  const ShapeDifference d = compared(k_.plan, shape_);
  EXPECT_GT(d.removed_mm3, 500.0);
  EXPECT_EQ(d.gouged_mm3, 0.0) << "up to " << d.deepest_gouge_mm << " mm";
  EXPECT_EQ(d.left_mm3, 0.0) << "up to " << d.deepest_left_mm << " mm";
  EXPECT_THAT(d.low, IsEmpty());
  EXPECT_THAT(d.high, IsEmpty());
}

TEST_F(LeaningHole, IsMeasuredWhereItIsTooDeep) {
  cut_down_to(-10.5);
  const ShapeDifference d = compared(k_.plan, shape_);
  // 12 x 12 less four corners of 5 mm, 0.5 deep, less what is within the tolerance.
  EXPECT_NEAR(d.gouged_mm3, (144 - (4 - std::numbers::pi) * 25) * (0.5 - d.tolerance_mm), 6.0);
  EXPECT_NEAR(d.deepest_gouge_mm, 0.5, 0.05);
  EXPECT_NEAR(d.worst_low_mm, 0.5, 0.006);
  EXPECT_EQ(d.left_mm3, 0.0);
}

/// A box as a mesh, its faces with corners of their own.
geometry::Mesh box_mesh(Vec3 lo, Vec3 hi) {
  geometry::Mesh out;
  const auto face = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const Vec3 p : {a, b, c, d}) out.vertices.push_back(p);
    out.triangles.push_back({first, first + 1, first + 2});
    out.triangles.push_back({first, first + 2, first + 3});
  };
  const auto at = [&](int x, int y, int z) {
    return Vec3{x != 0 ? hi.x : lo.x, y != 0 ? hi.y : lo.y, z != 0 ? hi.z : lo.z};
  };
  face(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
  face(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
  face(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
  face(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
  face(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
  face(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
  return out;
}

TEST(SharpEdges, HavePlacesAsFarWithinBothFaces) {
  const auto places = inside_sharp_edges(box_mesh({0, 0, 0}, {40, 30, 20}), 0.15, 100);
  EXPECT_GE(places.size(), 12U);
  EXPECT_LE(places.size(), 100U);
  std::array<int, 3> along{};
  for (const Vec3 p : places) {
    // Of the distances from the three pairs of sides two are 0.15 mm.
    const std::array<double, 3> in{std::min(p.x, 40 - p.x), std::min(p.y, 30 - p.y), std::min(p.z, 20 - p.z)};
    int near = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(in[k] - 0.15) < 1e-9) {
        ++near;
      } else {
        ++along[k];
        EXPECT_GT(in[k], 0.15);
      }
    }
    EXPECT_EQ(near, 2);
  }
  for (const int n : along) EXPECT_GE(n, 4) << "each of four edges";
}

}  // namespace
}  // namespace capstan::verify::testing
