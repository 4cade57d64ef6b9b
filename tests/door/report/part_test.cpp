#include "planner/door/report/part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "planner/door/pipeline/pipeline.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::report {
namespace {

model::Plan read(const std::string& part) {
  Job job;
  auto plan = pipeline::read_plan(testing::slurp(testing::source_dir() + "/examples/" + part), part, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan();
}

/// mm3; a column at the edge stands for half a cell.
double volume(const PartHeights& part, const geometry::Box3& box) {
  double sum = 0.0;
  for (std::size_t j = 0; j < part.ny; ++j) {
    for (std::size_t i = 0; i < part.nx; ++i) {
      const double x = i == 0 || i + 1 == part.nx ? 0.5 : 1.0, y = j == 0 || j + 1 == part.ny ? 0.5 : 1.0;
      sum += x * y * (part.top[j * part.nx + i] - part.bottom[j * part.nx + i]);
    }
  }
  return sum * box.size().x * box.size().y / static_cast<double>((part.nx - 1) * (part.ny - 1));
}

TEST(PartHeights, OfAPocketAreTheBlockLessThePocket) {
  model::Plan plan = read("reference_pocket.p21");
  plan.stock.box = {{0.0, 0.0, -25.0}, {100.0, 80.0, 0.0}};
  const PartHeights part = part_heights(plan);
  ASSERT_EQ(part.nx, kPartColumns + 1);
  ASSERT_EQ(part.top.size(), part.nx * part.ny);
  EXPECT_TRUE(part.beside.empty());
  EXPECT_EQ(part.top[(part.ny / 2) * part.nx + part.nx / 2], -10.0F);
  EXPECT_EQ(part.top[0], 0.0F);
  EXPECT_EQ(*std::max_element(part.bottom.begin(), part.bottom.end()), -25.0F);
  // 60 x 40 x 10 mm with corners of radius 6.
  const double pocket = 10.0 * (60.0 * 40.0 - (4.0 - 3.14159265) * 36.0);
  EXPECT_NEAR(volume(part, plan.stock.box), 100.0 * 80.0 * 25.0 - pocket, 0.02 * pocket);
}

TEST(PartHeights, OfAClosedMeshAreItsUpperAndLowerSurface) {
  model::Plan plan;
  plan.stock.box = {{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}};
  // A tetrahedron that points up.
  plan.target_mesh = std::make_shared<geometry::Mesh>(
      geometry::Mesh{{{-4.0, -4.0, -2.0}, {4.0, -4.0, -2.0}, {0.0, 4.0, -2.0}, {0.0, 0.0, 3.0}},
                     {{{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}, {{0, 2, 1}}}});
  const PartHeights part = part_heights(plan);
  const std::size_t middle = (part.ny / 2) * part.nx + part.nx / 2;
  EXPECT_NEAR(part.top[middle], 3.0, 0.1);
  EXPECT_NEAR(part.bottom[middle], -2.0, 1e-6);
  EXPECT_EQ(part.top[0], part.bottom[0]) << "beside it is nothing";
}

TEST(PartHeights, OfAPlanWithoutRawPieceAreNone) { EXPECT_EQ(part_heights(model::Plan()).nx, 0U); }

TEST(FeatureSolids, AreWhereTheFeatureTakesItsMaterial) {
  const auto solids = feature_solids(read("reference_pocket.p21"));
  ASSERT_EQ(solids.size(), 1U);
  EXPECT_EQ(solids[0].id, "POCKET");
  ASSERT_EQ(solids[0].prisms.size(), 1U);
  geometry::Box3 box;
  for (const geometry::Vec3 p : solids[0].prisms[0].outline) {
    box.add(p);
    box.add(p + solids[0].prisms[0].down);
  }
  EXPECT_NEAR(geometry::norm(box.lo - geometry::Vec3{20.0, 20.0, -10.0}), 0.0, 0.01);
  EXPECT_NEAR(geometry::norm(box.hi - geometry::Vec3{80.0, 60.0, 0.0}), 0.0, 0.01);
}

}  // namespace
}  // namespace capstan::report
