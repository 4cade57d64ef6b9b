#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// What stays beside a feature is not cut, whichever feature's steps are near it.

namespace capstan::pipeline {
namespace {

model::Plan planned(const std::string& file) {
  Job job;
  auto in = load_shop({}, job);
  EXPECT_TRUE(in) << (in ? "" : in.error().message);
  const std::string path = capstan::testing::source_dir() + "/tests/door/pipeline/parts/" + file;
  auto plan = read_plan(testing::slurp(path), file, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!in || !plan) return {};
  auto out = bind(*std::move(plan), *in, {}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out ? *std::move(out) : model::Plan{};
}

void expect_sound(const model::Plan& plan) {
  EXPECT_FALSE(plan.steps.empty());
  for (const auto& u : plan.unplanned) ADD_FAILURE() << u.reason;
  Job job;
  for (const auto& f : findings_of(plan, job))
    EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.step << " " << f.message;
}

/// Every hundredth of every move below z, with the cutter's radius.
template <class F>
void each_place_below(const model::Plan& plan, double z, F f) {
  for (const auto& s : plan.steps) {
    const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
    if (c == nullptr || !s.path) continue;
    for (std::size_t i = 1; i < s.path->size(); ++i) {
      for (int k = 0; k <= 100; ++k) {
        const auto p = model::point_on_move(*s.path, i, 0.01 * k);
        if (p.z < z) f(model::step_id(plan, s), p, 0.5 * c->cutting_diameter_mm);
      }
    }
  }
}

TEST(Stands, ABossIsNotCutByTheStepsOfTheBossBesideIt) {
  const model::Plan plan = planned("two_bosses.p21");
  expect_sound(plan);
  // Bosses of 20 x 20 about (25, 30) and (65, 30); 0.1 mm of tolerance on either side of a width: 0.05.
  int near = 0;
  each_place_below(plan, -0.01, [&](const std::string& step, geometry::Vec3 p, double radius) {
    for (const double x : {25.0, 65.0}) {
      const double dx = std::max(0.0, std::abs(p.x - x) - 10.0),
                   dy = std::max(0.0, std::abs(p.y - 30.0) - 10.0);
      near += std::hypot(dx, dy) < radius + 1.0 ? 1 : 0;
      if (std::hypot(dx, dy) < radius - 0.06)
        ADD_FAILURE() << step << " at " << p.x << ", " << p.y << ", " << p.z;
    }
  });
  EXPECT_GT(near, 0);
}

TEST(Stands, AStepThatEndsWithinTheBlockIsNotCutBeyondItsEndAndASlotIsOpenedIntoItsPocket) {
  const model::Plan plan = planned("open_ends.p21");
  expect_sound(plan);
  each_place_below(plan, -0.01, [&](const std::string& step, geometry::Vec3 p, double radius) {
    // The step runs from x = 50 out of the block; in front of it the block stands, from x = 0 and y = 0 on.
    if (!step.starts_with("STEP")) return;
    const double dx = std::max({0.0, p.x - 50.0, -p.x}), dy = std::max(0.0, -p.y);
    if (std::hypot(dx, dy) < radius - 0.06)
      ADD_FAILURE() << step << " at " << p.x << ", " << p.y << ", " << p.z;
  });
}

}  // namespace
}  // namespace capstan::pipeline
