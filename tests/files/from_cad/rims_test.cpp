// Chamfers and rounds of edges of CAD parts: which become one feature, and which stay planes.

#include "planner/files/from_cad/rims.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "planner/files/from_cad/from_cad.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/not_recognised.h"
#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/exchange/brep/support.h"

namespace capstan::testing {
namespace {

using exchange::testing::StepPart;
using geometry::Vec2;
using geometry::Vec3;
using model::TypeId;

class CadRims : public ::testing::Test {
 protected:
  void SetUp() override {
    if (exchange::testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
  }
  exchange::Brep shape(const std::string& step) {
    exchange::BrepLimits limits;
    limits.helper = exchange::testing::helper();
    auto brep = exchange::read_brep_bytes(step, "part.step", limits, job_);
    EXPECT_TRUE(brep) << (brep ? "" : brep.error().message);
    return brep ? *std::move(brep) : exchange::Brep{};
  }
  Result<model::Plan> planned(const std::string& step) {
    return from_cad::plan_of_part(shape(step), "part.step", {}, job_);
  }
  Job job_;
};

/// Why features are not planned, one behind the other.
std::string reasons(const model::Plan& plan) {
  std::string out;
  for (const auto& [feature, why] : model::not_recognised(plan)) out += why + "\n";
  return out;
}

/// A block of 40 x 30 x 20 mm whose upper edges are bevelled, each by `mm` of its top (below, right, above,
/// left in plan) and the same depth.
std::string bevelled(const std::array<double, 4>& mm, double depth_mm) {
  StepPart step;
  const auto [low, right, high, left] = mm;
  std::vector<Vec3> corners;
  for (const double z : {0.0, 20.0 - depth_mm})
    for (const Vec2 p : {Vec2{0, 0}, Vec2{40, 0}, Vec2{40, 30}, Vec2{0, 30}})
      corners.push_back({p.x, p.y, z});
  for (const Vec2 p :
       {Vec2{left, low}, Vec2{40 - right, low}, Vec2{40 - right, 30 - high}, Vec2{left, 30 - high}})
    corners.push_back({p.x, p.y, 20});
  std::vector<std::vector<int>> faces{{0, 3, 2, 1}, {8, 9, 10, 11}};
  for (const int at : {0, 4})
    for (int i = 0; i < 4; ++i) faces.push_back({at + i, at + (i + 1) % 4, at + 4 + (i + 1) % 4, at + 4 + i});
  step.product({step.solid(step.flat_faces(corners, faces), "block")}, step.context("mm"));
  return step.text();
}

TEST_F(CadRims, BevelsAllRoundABlockAreOneChamferOfItsOutline) {
  const auto plan = planned(bevelled({2, 2, 2, 2}, 2));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(reasons(*plan), "");
  const auto& chamfers = plan->model.all(TypeId::kChamfer);
  ASSERT_EQ(chamfers.size(), 1U);
  const auto s = model::shapes_of(plan->model, model::Ref<model::ManufacturingFeature>(chamfers.front()));
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->front().frame.z, (Vec3{0, 0, 1}));
  EXPECT_NEAR(s->front().chamfer_width_mm, 2.0, 1e-6);
  EXPECT_NEAR(s->front().chamfer_angle_rad, std::numbers::pi / 4, 1e-6);
}

TEST_F(CadRims, BevelsThatOneMillDoesNotMakeAreFaced) {
  // Steeper on one side than on the others; of 10 mm; of 2 x 1 mm.
  for (const auto& part :
       {bevelled({2, 2, 2, 1}, 2), bevelled({10, 10, 10, 10}, 10), bevelled({2, 2, 2, 2}, 1)}) {
    const auto plan = planned(part);
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_TRUE(plan->model.all(TypeId::kChamfer).empty());
    EXPECT_EQ(plan->model.all_below(TypeId::kTwo5dManufacturingFeature).size(), 4U);
    EXPECT_EQ(reasons(*plan), "");
  }
}

TEST_F(CadRims, TheFacesOfARimThatIsNoneAreChamfersOfTheirOwn) {
  const exchange::Brep brep = shape(bevelled({2, 2, 2, 2}, 2));
  const from_cad::Part part(brep, 0, {{0, 0, 0}, {40, 30, 20}});
  const auto found = recognise::recognise(brep, 0);
  ASSERT_EQ(found.features.size(), 1U);
  const recognise::Feature& rim = found.features.front();
  EXPECT_TRUE(rim.rim);
  EXPECT_EQ(rim.type, TypeId::kChamfer);
  EXPECT_EQ(rim.access, (Vec3{0, 0, 1}));
  const auto apart = from_cad::faces_apart(part, rim);
  ASSERT_EQ(apart.size(), 4U);
  for (const auto& f : apart) {
    EXPECT_FALSE(f.rim);
    EXPECT_NEAR(f.access.z, std::sqrt(0.5), 1e-9);
  }
}

}  // namespace
}  // namespace capstan::testing
