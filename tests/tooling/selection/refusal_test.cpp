#include <gtest/gtest.h>

#include <algorithm>

#include "tooling/library/cutters/generic.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

// Why a cutter is passed over, where a machinist would want to know it.

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::ToolRequirement;

const std::vector<model::Cutter>& library() {
  static const std::vector<model::Cutter> kLibrary = generic_library().value();
  return kLibrary;
}
model::WorkMaterial material(const std::string& id) {
  Job job;
  return find_material(id, shipped_materials().value(), job).value();
}
model::Machine machine() {
  Job job;
  return load_machine("generic_vmc", job).value();
}

TEST(SelectRefusal, TakesAReamerDeeperThanItsFlutesOnlyOnAThinnerShank) {
  ToolRequirement r;
  r.classes = {CutterClass::kReamer};
  r.diameter_exact_mm = 12;
  r.depth_of_cut_mm = 44;  // the generic one's flutes
  r.reach_mm = 48;
  model::Cutter c = *std::find_if(library().begin(), library().end(),
                                  [](const auto& x) { return x.id == "generic/reamer_h7/12"; });
  ASSERT_DOUBLE_EQ(c.maximum_depth_of_cut_mm, 44.0);
  const auto asked = [&] { return select(r, {c}, material("mild_steel"), machine()); };
  EXPECT_EQ(asked().ranked.size(), 1U);
  for (const double shank : {12.0, 0.0}) {
    c.shank_diameter_mm = shank;
    ASSERT_EQ(asked().rejected.size(), 1U) << shank;
    EXPECT_EQ(asked().rejected[0].why,
              "flutes 44 mm are shorter than 47 mm, and its shank is as wide as the hole");
  }
  r.depth_of_cut_mm = 41;
  EXPECT_EQ(asked().ranked.size(), 1U) << "then its flutes stand out of the hole";
}

TEST(SelectRefusal, TakesNoTapWhoseLeadIsLongerThanTheHoleHasRoomFor) {
  ToolRequirement r;
  r.classes = {CutterClass::kTap};
  r.diameter_exact_mm = 8;
  r.thread_pitch_mm = 1.25;
  EXPECT_EQ(select(r, library(), material("mild_steel"), machine()).ranked.front().cutter.id,
            "generic/tap/M8");  // form B: 4 threads
  r.lead_threads_max = 3;
  const auto s = select(r, library(), material("mild_steel"), machine());
  ASSERT_EQ(s.ranked.size(), 1U);
  EXPECT_EQ(s.ranked.front().cutter.id, "generic/tap_blind/M8");
  EXPECT_TRUE(std::any_of(s.rejected.begin(), s.rejected.end(), [](const auto& x) {
    return x.what == "generic/tap/M8" && x.why == "its lead of 4 threads is above 3";
  }));
}

TEST(SelectRefusal, SaysWhatOfTheMachineStandsInTheWayOfCuttersThatWouldFit) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_min_mm = 10;
  r.diameter_max_mm = 12;
  model::Machine fast = machine();
  fast.spindle.rpm_min = 30000.0;
  fast.spindle.rpm_max = 40000.0;
  const auto s = select(r, library(), material("mild_steel"), fast);
  EXPECT_TRUE(s.ranked.empty());
  EXPECT_NE(s.would_fit.find(", if the machine could use it (of "), std::string::npos) << s.would_fit;
  // pi x 10 mm x 30000 1/min
  EXPECT_NE(s.would_fit.find("/10: the spindle's least speed 30000 1/min gives 942.5 m/min"),
            std::string::npos)
      << s.would_fit;
}

}  // namespace
}  // namespace capstan::tooling
