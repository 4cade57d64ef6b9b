#include "planner/making/step/path/surface_rest.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "planner/model/nouns/all.h"

namespace capstan::step {
namespace {

constexpr double kSide = 40.0, kLevel = -10.0;

/// A level sheet at z = -10, roughed twice with 0.5 mm left and finished: the finish may bite 1 mm.
struct Surface {
  model::Plan plan;
  std::vector<draft::SetupDraft> setups{1};
  std::vector<draft::StepDraft> steps{3};
  piece::Shapes shapes;
  piece::Piece in_raw{plan, shapes};
  piece::Demands demands;
  draft::Recorded recorded;
  std::vector<model::Cutter> library;
  Wishes wishes{.library = library};
  PlanSoFar so_far{plan, setups, steps, in_raw, demands, recorded, wishes};

  explicit Surface(bool proposed) {
    auto mesh = std::make_shared<geometry::Mesh>();
    mesh->vertices = {{0, 0, kLevel}, {kSide, 0, kLevel}, {kSide, kSide, kLevel}, {0, kSide, kLevel}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    plan.target_mesh = mesh;
    plan.stock.box = {{0, 0, -20}, {kSide, kSide, 0}};
    setups.front().stock = plan.stock.box;
    const auto feature = plan.model.add(model::RegionProjection{});
    for (std::size_t i = 0; i < steps.size(); ++i) {
      draft::StepDraft& s = steps[i];
      s.feature = feature;
      if (i < 2) {
        const auto rough = plan.model.add(model::FreeformRoughMilling{});
        s.operation = rough;
      } else {
        const auto finish = plan.model.add(model::FreeformFinishMilling{});
        s.operation = finish;
      }
      s.step = plan.model.add(model::MachiningWorkingstep{});
      s.proposed = proposed;
      s.proposal.allowance_side_mm = i < 2 ? 0.5 : 0.0;
    }
  }
  void keep_first() {
    model::StepResult r;
    r.step = steps.front().step;
    plan.steps.push_back(r);
  }
};

TEST(RoughedBefore, IsTheMillOfTheKeptRoughOfAProposedRest) {
  Surface s(true);
  EXPECT_EQ(roughed_before(s.so_far, s.steps[1]), nullptr) << "the first was left out";
  s.keep_first();
  EXPECT_EQ(roughed_before(s.so_far, s.steps[0]), nullptr);
  EXPECT_EQ(roughed_before(s.so_far, s.steps[1]), &s.steps[0].cutter);
  EXPECT_EQ(roughed_before(s.so_far, s.steps[2]), nullptr) << "it finishes";
}

// A file may rough a surface twice for reasons of its own: its second step roughs all of it.
TEST(RoughedBefore, IsNoneOfAFilesStepsButWhereItsRecordSaysThatRulesProposedBoth) {
  Surface s(false);
  s.keep_first();
  EXPECT_EQ(roughed_before(s.so_far, s.steps[1]), nullptr);
  const auto record = [&](std::size_t i) {
    s.plan.ledger.bind(s.steps[i].step, "its_operation", model::Binder::kRule, {"row", "text", "source"});
  };
  record(1);
  EXPECT_EQ(roughed_before(s.so_far, s.steps[1]), nullptr) << "the file's own rough";
  record(0);
  EXPECT_EQ(roughed_before(s.so_far, s.steps[1]), &s.steps[0].cutter);
}

TEST(SurfaceRest, LetsSmallRestsStayButDeepOnes) {
  const Surface s(true);
  stock::HeightMap map = stock::from_box({{0, 0, -20}, {kSide, kSide, kLevel + 0.5}}, 0.5);
  const auto stand = [&](int x0, int y0, int nx, int ny, double over_mm) {
    for (int y = y0; y < y0 + ny; ++y) {
      for (int x = x0; x < x0 + nx; ++x) {
        const auto top = static_cast<float>(kLevel + over_mm + 20.0);
        map.set(x, y, {top, top, 0.0F});
      }
    }
  };
  stand(10, 10, 8, 8, 1.5);  // 16 mm2, 0.5 mm over what may stay: 8 mm3, not deep
  stand(30, 30, 4, 2, 5.0);  // 2 mm2, 4 mm: 8 mm3, deeper than twice 1 mm
  stand(50, 50, 1, 1, 4.0);  // 0.75 mm3: a cell
  stand(50, 10, 8, 8, 2.0);  // 16 mm3
  const auto rest = surface_rest(s.so_far, s.steps[1], map);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->mm3, 8.0 + 16.0, 1e-3);
  EXPECT_NEAR(rest->deepest_mm, 4.0, 1e-4);
  // Of a try all counts that is left of these, however small, and nothing of the others.
  EXPECT_NEAR(mm3_above(map, rest->may_stay), rest->mm3, 1e-6);
  stand(30, 30, 4, 2, 2.0);
  stand(50, 10, 8, 8, 0.5);
  EXPECT_NEAR(mm3_above(map, rest->may_stay), 2.0, 1e-4);
}

}  // namespace
}  // namespace capstan::step
