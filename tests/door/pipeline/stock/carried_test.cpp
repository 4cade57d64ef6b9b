#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/planar/planar_stock.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

model::Plan planned_bracket() {
  Job job;
  auto in = load_shop({}, job);
  auto plan = read_plan(testing::slurp(kBracket), "bracket.p21", job);
  EXPECT_TRUE(in && plan);
  auto out = bind(*std::move(plan), *in, {}, job);
  EXPECT_TRUE(out);
  return out ? *std::move(out) : model::Plan{};
}

geometry::Box3 stock_in(const model::Plan& plan, std::size_t setup) {
  const auto frame = verify::workpiece_in(plan, setup);
  const auto& b = plan.stock.box;
  geometry::Box3 out;
  for (const double x : {b.lo.x, b.hi.x}) {
    for (const double y : {b.lo.y, b.hi.y}) {
      for (const double z : {b.lo.z, b.hi.z}) out.add(frame.to_parent({x, y, z}));
    }
  }
  return out;
}

double removed(const model::SectionSeries& s) {
  double sum = 0.0;
  for (const double v : s.removed_mm3) sum += v;
  return sum;
}

// Three accounts of each step: the sections that the plan carries, a map of 0.1 mm, and the volume of the
// exact stock before and after by lines across it, which asks nothing of the sections. Seen from above the
// map may leave slivers beside a helix, so where it is off the volume says so.
TEST(CarriedSections, OfTheBracketAgreeStepByStepWithAFineMapAndWithTheVolumeOfTheStock) {
  const model::Plan plan = planned_bracket();
  constexpr std::size_t kFirst = 0;
  const auto box = stock_in(plan, kFirst);
  auto map = stock::from_box(box, 0.1);
  auto exact = stock::PlanarStock::from_box(box);
  double rest = exact.volume(1e-6);
  double worst_flat = 0.0;
  int steps = 0;
  int flat_steps = 0;
  for (const auto& s : plan.steps) {
    if (s.setup != kFirst) continue;
    const model::Cutter* cutter = model::find_cutter(plan, s.cutter_id);
    ASSERT_TRUE(cutter != nullptr && s.path && s.sections) << model::step_id(plan, s);
    const auto cells = engagement::measure(*s.path, *cutter, map);
    ASSERT_TRUE(cells) << model::step_id(plan, s);
    const double carried = removed(*s.sections);
    const auto profile = model::profile_of(*cutter);
    ASSERT_TRUE(exact.cut(profile, *s.path)) << model::step_id(plan, s);
    const double after = exact.volume(1e-6);
    const double by_volume = rest - after;
    rest = after;
    ++steps;
    EXPECT_NEAR(carried, by_volume, 2e-3 * by_volume + 0.1) << model::step_id(plan, s);
    const bool map_is_off = std::abs(cells->removed_mm3 - by_volume) > std::abs(carried - by_volume);
    if (!map_is_off) {
      EXPECT_NEAR(carried, cells->removed_mm3, 2e-3 * cells->removed_mm3 + 0.5) << model::step_id(plan, s);
    }
    if (!geometry::is_flat(profile)) continue;
    ++flat_steps;
    worst_flat = std::max(worst_flat, std::abs(carried / by_volume - 1.0));
    EXPECT_NEAR(carried, by_volume, 3e-4 * by_volume + 0.03) << model::step_id(plan, s);
  }
  EXPECT_GE(flat_steps, 8);
  EXPECT_GT(steps, flat_steps);
  std::printf("[ figures  ] flat cutters' steps of the bracket: removed volume within %.5f %%\n",
              100.0 * worst_flat);
}

}  // namespace
}  // namespace capstan::pipeline
