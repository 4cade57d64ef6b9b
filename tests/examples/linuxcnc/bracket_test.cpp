// The bracket (examples/bracket.p21) cut on a running control, workingstep by workingstep, with eight tools:
// where the machine ended, and what was cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/examples/linuxcnc/cut_block.h"
#include "tests/examples/linuxcnc/scenarios.h"

namespace capstan::linuxcnc {
namespace {

/// Path tolerance of the last pass, 0.01 (G64), and as much for rounding, mm.
constexpr double kSame = 0.02;
/// What a rapid move out of a cut may still go on with the feed before it, mm: the path tolerance (G64
/// P0.01).
constexpr double kBlend = 0.01;
constexpr std::size_t kSteps = 14;
/// Of examples/bracket.p21, mm: the raw piece, whose top is 1 mm over the finished one at Z0, and Z0 on the
/// machine (scenarios.py, BRACKET_Z).
constexpr double kWidth = 120.0, kDepth = 80.0, kOver = 1.0, kThickness = 30.0, kZero = -64.0;
/// Over the raw piece, where planning leaves it to the default (rule default.retract_plane), mm.
constexpr double kRetractPlane = 5.0;

/// examples/bracket_magazine.tbl. The tap, T8, as its core: the thread is no part of the height map.
const std::map<int, Mill> kMagazine = {{1, {120.0, 100.0}}, {2, {102.0, 10.0}}, {3, {125.0, 6.6}},
                                       {4, {97.0, 7.98}},   {5, {125.0, 7.8}},  {7, {116.0, 5.0}},
                                       {8, {103.0, 5.0}},   {9, {125.0, 7.5}},  {10, {106.0, 8.0075}}};

/// A feature as it is in the drawing: its outline, and its floor below the raw top.
struct Feature {
  double x, y, half_x, half_y, corner;
  double floor;
  bool through = false;  ///< at least so deep

  /// Distance to the outline, negative inside of it.
  [[nodiscard]] double outside(double px, double py) const {
    const double dx = std::abs(px - x) - (half_x - corner), dy = std::abs(py - y) - (half_y - corner);
    return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - corner;
  }
};

Feature hole(double x, double y, double diameter, double floor, bool through) {
  return {x, y, 0.5 * diameter, 0.5 * diameter, 0.5 * diameter, floor, through};
}

/// The bracket, shallow ones first.
std::vector<Feature> bracket() {
  const double through = -kOver - kThickness;
  std::vector<Feature> out = {
      {48.0, 40.0, 25.0, 18.0, 6.0, -kOver - 12.0},   // pocket
      {105.0, 40.0, 5.0, 1000.0, 0.0, -kOver - 8.0},  // slot, open at both ends
      hole(48.0, 10.0, 11.0, -kOver - 6.5, false),    // counterbore
      hole(48.0, 70.0, 5.0, -kOver - 17.0, true),     // core of M6: its point is deeper
      hole(48.0, 10.0, 6.6, through, true),           // below the counterbore
  };
  for (const double x : {10.0, 86.0}) {
    out.push_back(hole(x, 40.0, 8.0, through, true));  // dowels
    for (const double y : {10.0, 70.0}) out.push_back(hole(x, y, 6.6, through, true));
  }
  return out;
}

/// The greatest distance, mm, by which a block differs from the bracket: of each point its height over or
/// under where it is to be, or its distance to the nearest outline, whichever is less.
double differs_from_bracket(const CutBlock& block) {
  const std::vector<Feature> features = bracket();
  double worst = 0.0;
  for (int j = 0; j < block.ny(); ++j) {
    for (int i = 0; i < block.nx(); ++i) {
      const double x = i * CutBlock::kCell + CutBlock::kPoint, y = j * CutBlock::kCell + CutBlock::kPoint;
      double floor = -kOver, nearest = 1e9;
      bool through = false;
      for (const Feature& f : features) {
        const double out = f.outside(x, y);
        nearest = std::min(nearest, std::abs(out));
        if (out < 0.0 && f.floor < floor) floor = f.floor, through = f.through;
      }
      const double over = block.at(i, j) - floor;
      worst = std::max(worst, std::min(nearest, through ? std::max(over, 0.0) : std::abs(over)));
    }
  }
  return worst;
}

/// What is gone of a block, in cells times mm.
double removed(const CutBlock& block) {
  double out = 0.0;
  for (int j = 0; j < block.ny(); ++j)
    for (int i = 0; i < block.nx(); ++i) out -= block.at(i, j);
  return out;
}

class BracketAtTheControl : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!scenarios().absent.empty()) GTEST_SKIP() << scenarios().absent;
    ASSERT_EQ(scenarios().failed, "");
  }
  static const Outcome& outcome() { return scenarios().outcomes.at("bracket"); }
  static const std::vector<Record>& steps() {
    static const std::vector<Record> kSplit = workingsteps(scenarios().record, outcome().mark);
    return kSplit;
  }
};

TEST_F(BracketAtTheControl, EachWorkingstepIsBoundAndCutInItsOrder) {
  EXPECT_EQ(outcome().said, std::vector<std::string>{});
  std::vector<int> all;
  for (std::size_t n = 1; n <= kSteps; ++n) all.push_back(static_cast<int>(n));
  EXPECT_EQ(outcome().bound, all);
  EXPECT_EQ(outcome().cut, all);
  EXPECT_EQ(std::set(outcome().bound_ids.begin(), outcome().bound_ids.end()).size(), kSteps);
  EXPECT_NEAR(outcome().z_mm, kRetracted, 1e-6);
  EXPECT_EQ(outcome().rpm, 0.0);
}

TEST_F(BracketAtTheControl, EachWorkingstepTurnsTheToolThatItWasBoundTo) {
  ASSERT_EQ(steps().size(), kSteps);
  ASSERT_EQ(outcome().bound_tools.size(), kSteps);
  std::set<int> called;
  for (std::size_t n = 0; n < kSteps; ++n) {
    const Record& r = steps()[n];
    for (std::size_t s = 0; s < r.size(); ++s)
      ASSERT_TRUE(r.rpm[s] == 0.0 || r.tool[s] == outcome().bound_tools[n]) << outcome().bound_ids[n];
    called.insert(outcome().bound_tools[n]);
  }
  EXPECT_EQ(called, (std::set{1, 2, 3, 4, 7, 8, 9, 10}));
}

TEST_F(BracketAtTheControl, IsCutAsItIsDrawn) {
  ASSERT_EQ(steps().size(), kSteps);
  CutBlock block(kWidth, kDepth, kZero + kOver);
  double before = 0.0;
  for (std::size_t n = 0; n < kSteps; ++n) {
    block.cut(steps()[n], outcome().mark, kMagazine);
    const double now = removed(block);
    EXPECT_TRUE(now > before || outcome().bound_ids[n] == "M6 tap") << outcome().bound_ids[n];
    before = now;
  }
  EXPECT_LE(differs_from_bracket(block), kSame);
  EXPECT_FALSE(block.struck());
  EXPECT_LE(block.rapid_mm(), kSame);
}

TEST_F(BracketAtTheControl, NoRapidMoveGoesSidewaysBelowTheRetractPlane) {
  double farthest = 0.0;  // of each rapid move, mm
  std::size_t seen = 0;   // periods of rapid moves below the plane: none would say nothing of them
  for (const Record& r : steps()) {
    double aside = 0.0;
    for (std::size_t s = 1; s < r.size(); ++s) {
      const auto tool = kMagazine.find(r.tool[s]);
      const bool below = tool != kMagazine.end() && r.rpm[s] != 0.0 &&
                         r.z_mm[s] - tool->second.length_mm < kZero + kOver + kRetractPlane - kSame;
      if (r.kind[s] != kRapid || !below) {
        aside = 0.0;
        continue;
      }
      ++seen;
      aside += std::hypot(r.x_mm[s] - r.x_mm[s - 1], r.y_mm[s] - r.y_mm[s - 1]);
      farthest = std::max(farthest, aside);
    }
  }
  EXPECT_GT(seen, 0u);
  EXPECT_LE(farthest, kBlend);
}

}  // namespace
}  // namespace capstan::linuxcnc
