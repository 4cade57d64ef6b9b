#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

/// Of roughing 70 x 50 x 12 mm between walls in C45 with this cutter, s.
double roughing_s(const std::string& id, bool roughs) {
  Job job;
  const auto library = generic_library().value();
  const auto at = std::find_if(library.begin(), library.end(), [&](const auto& c) { return c.id == id; });
  EXPECT_NE(at, library.end());
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.reach_mm = r.depth_of_cut_mm = 1.0;
  r.centre_cutting = true;
  Preferences p;
  p.depth_mm = 12.0;
  p.volume_mm3 = 70.0 * 50.0 * 12.0;
  p.roughs = roughs;
  const auto found = select(r, {*at}, find_material("C45", shipped_materials().value(), job).value(),
                            load_machine("generic_vmc", job).value(), p);
  return found.ranked.at(0).estimated_s;
}

TEST(Estimate, KnowsThatASlenderCutterRoughsInThinLevels) {
  // Stick-outs of 9.6 and 3.2 diameters.
  EXPECT_GT(roughing_s("generic/endmill_4f_neck/2.5", true),
            1.5 * roughing_s("generic/endmill_4f_neck/2.5", false));
  EXPECT_EQ(roughing_s("generic/endmill_4f_short/12", true),
            roughing_s("generic/endmill_4f_short/12", false));
}

TEST(Estimate, CountsTheFloorThatAFinishGoesOver) {
  Job job;
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  Preferences p;
  p.depth_mm = 5.0;
  p.width_mm = 0.3;
  p.volume_mm3 = 200.0 * p.depth_mm * p.width_mm;
  const auto library = generic_library().value();
  const auto steel = find_material("C45", shipped_materials().value(), job).value();
  const auto machine = load_machine("generic_vmc", job).value();
  r.diameter_exact_mm = 10.0;
  const double walls = select(r, library, steel, machine, p).ranked.at(0).estimated_s;
  p.floor_mm2 = 60.0 * 40.0;
  EXPECT_GT(select(r, library, steel, machine, p).ranked.at(0).estimated_s, walls);
}

}  // namespace
}  // namespace capstan::tooling
