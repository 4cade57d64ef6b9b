#include <gtest/gtest.h>

#include "tooling/library/cutters/generic.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::ToolRequirement;

TEST(Estimate, TakesTheBallWhosePassesOverASurfaceAreDoneFirst) {
  ToolRequirement r;
  r.classes = {CutterClass::kBallEndmill};
  r.reach_mm = 10;
  Preferences p;
  p.ridges_mm = 0.05;
  p.used = {"generic/ball_short/10"};
  Job job;
  const auto library = generic_library().value();
  const auto steel = find_material("mild_steel", shipped_materials().value(), job).value();
  const auto machine = load_machine("generic_vmc", job).value();
  const auto ball = [&](double passes_mm2) {
    p.passes_mm2 = passes_mm2;
    return select(r, library, steel, machine, p).ranked.at(0).cutter.id;
  };
  EXPECT_EQ(ball(60.0 * 40.0), "generic/ball_short/20");
  // What a wider one saves on a small surface is less than its change takes.
  EXPECT_EQ(ball(10.0 * 10.0), "generic/ball_short/10");
}

}  // namespace
}  // namespace capstan::tooling
