#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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

/// The generic face mills of 45 degrees on an open face in C45, the quickest first.
std::vector<model::Candidate> faced(double length_mm, double width_mm, double depth_mm = 0.5) {
  Job job;
  std::vector<model::Cutter> mills = generic_library().value();
  std::erase_if(mills, [](const auto& c) { return !c.id.starts_with("generic/face_mill_45/"); });
  ToolRequirement r;
  r.classes = {CutterClass::kFacemill};
  Preferences p;
  p.depth_mm = depth_mm;
  p.width_mm = width_mm;
  p.face_mm = length_mm;
  p.volume_mm3 = length_mm * width_mm * p.depth_mm;
  return select(r, mills, find_material("C45", shipped_materials().value(), job).value(),
                load_machine("generic_vmc", job).value(), p)
      .ranked;
}

double seconds_of(const std::vector<model::Candidate>& ranked, const std::string& id) {
  for (const auto& c : ranked) {
    if (c.cutter.id == id) return c.estimated_s;
  }
  ADD_FAILURE() << id;
  return 0.0;
}

// A pass begins and ends with the cutter beside the face: 14 + 40 mm are half of 68 + 40 mm.
TEST(Estimate, CountsWhatAFaceMillGoesBesideTheFace) {
  const std::string id = "generic/face_mill_45/40";
  EXPECT_NEAR(2.0 * seconds_of(faced(14.0, 12.0), id), seconds_of(faced(68.0, 12.0), id), 1e-5);
}

TEST(Estimate, TakesTheSmallestFaceMillThatCoversANarrowFace) {
  EXPECT_EQ(faced(14.0, 12.0).front().cutter.id, "generic/face_mill_45/40");
  EXPECT_EQ(faced(100.0, 26.0).front().cutter.id, "generic/face_mill_45/40");
}

// 80 mm are one pass of 100 mm, and two or three of any smaller one.
TEST(Estimate, TakesTheFaceMillThatCoversAWideFaceInOnePass) {
  EXPECT_EQ(faced(120.0, 80.0).front().cutter.id, "generic/face_mill_45/100");
  const auto ranked = faced(120.0, 80.0);
  EXPECT_GT(seconds_of(ranked, "generic/face_mill_45/80"), seconds_of(ranked, "generic/face_mill_45/100"));
}

// One pass of 80 mm by the 100 mm mill asks the spindle's whole torque at a depth of some 0.5 mm: deeper, a
// little less feed does as well, and no second level is gone.
TEST(Estimate, OfAFaceTakesLessFeedWhereASecondLevelWouldTakeLonger) {
  double last = 0.0;
  for (const double depth : {0.45, 0.5, 0.55, 0.6}) {
    const double now = seconds_of(faced(120.0, 80.0, depth), "generic/face_mill_45/100");
    // Of the force, depth times feed to the power of 1 - mc, with mc at most 0.3.
    if (last > 0.0) {
      EXPECT_LE(now, last * std::pow(depth / (depth - 0.05), 1.0 / 0.7) * 1.01) << depth;
    }
    last = now;
  }
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
