#include <gtest/gtest.h>

#include "planner/making/step/cut/cuts.h"

namespace capstan::step {
namespace {

optimise::CutQuestion question() {
  optimise::CutQuestion q;
  q.cutter.id = "mill";
  q.cutter.cutting_diameter_mm = 10.0;
  q.material.kc11_n_mm2 = 1800.0;
  q.depth_mm = 5.0;
  q.width_mm = 6.0;
  return q;
}

optimise::CutAnswer answer(double feed_mm_min) {
  optimise::CutAnswer a;
  a.feasible = true;
  a.feed_mm_min = feed_mm_min;
  return a;
}

TEST(KnownCuts, GiveTheAnswerOfTheSameQuestion) {
  KnownCuts known;
  EXPECT_EQ(known.find(question()), nullptr);
  known.keep(question(), answer(500.0));
  ASSERT_NE(known.find(question()), nullptr);
  EXPECT_EQ(known.find(question())->feed_mm_min, 500.0);
}

TEST(KnownCuts, TakeAnotherCutterOfOneIdForAnotherQuestion) {
  KnownCuts known;
  known.keep(question(), answer(500.0));
  optimise::CutQuestion longer = question();
  longer.cutter.stick_out_mm = 60.0;
  EXPECT_EQ(known.find(longer), nullptr);
  known.keep(longer, answer(120.0));
  EXPECT_EQ(known.find(longer)->feed_mm_min, 120.0);
  EXPECT_EQ(known.find(question())->feed_mm_min, 500.0);
}

// Once left out of the key: these five changed nothing in it.
TEST(KnownCuts, TakeEveryOtherDifferenceForAnotherQuestion) {
  using optimise::CutQuestion;
  KnownCuts known;
  known.keep(question(), answer(500.0));
  const std::pair<const char*, void (*)(CutQuestion&)> changes[] = {
      {"material", [](CutQuestion& q) { q.material.kc11_n_mm2 = 2600.0; }},
      {"machine", [](CutQuestion& q) { q.machine.spindle.rpm_max = 4000.0; }},
      {"aim", [](CutQuestion& q) { q.aim = optimise::Aim::kCost; }},
      {"earning", [](CutQuestion& q) { q.earning_per_min = 2.0; }},
      {"eased limit",
       [](CutQuestion& q) {
         q.eased = {"spindle_power", 1.1};
       }},
      {"given speed", [](CutQuestion& q) { q.n_rpm = 3000.0; }},
      {"surface", [](CutQuestion& q) { q.surface_ra_um = 3.2; }},
  };
  for (const auto& [what, change] : changes) {
    CutQuestion q = question();
    change(q);
    EXPECT_EQ(known.find(q), nullptr) << what;
  }
}

}  // namespace
}  // namespace capstan::step
