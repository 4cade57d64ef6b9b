#include "planner/making/workholding/place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace capstan::workholding {
namespace {

using namespace tooling;

// A piece of 80 x 60 x 30 whose lower corner is the origin.
geometry::Box3 piece() {
  geometry::Box3 b;
  b.add({0, 0, 0});
  b.add({80, 60, 30});
  return b;
}

Result<HoldingFile> read(const std::string& setups, Job& job) {
  return read_holding("capstan_workholding: 1\nunit: mm\nsetups:\n" + setups, "holding.yaml", job);
}

/// The error of reading, or of placing the first set-up.
Diagnostic fault_of(const std::string& setups) {
  Job job;
  const auto file = read(setups, job);
  if (!file) return file.error();
  const auto placed = place(file->setups.front(), piece(), file->fixtures, file->file);
  return placed ? Diagnostic{} : placed.error();
}

const model::FixtureSolid& solid(const model::Workholding& h, const std::string& id) {
  const auto at = std::find_if(h.solids.begin(), h.solids.end(), [&](const auto& s) { return s.id == id; });
  return at == h.solids.end() ? h.solids.front() : *at;
}

TEST(Holding, EveryShippedFixtureIsReadAndSaysWhereItsNumbersAreFrom) {
  Job job;
  const auto fixtures = shipped_fixtures(job);
  ASSERT_TRUE(fixtures) << fixtures.error().message;
  EXPECT_GE(fixtures->size(), 8U);
  for (const Fixture& f : *fixtures) EXPECT_FALSE(f.source.empty()) << f.id;
}

TEST(Holding, AViseHoldsThePieceBetweenItsJawsAsHighAsItsParallelsLeave) {
  Job job;
  const auto file = read("  - {setup: 1, fixture: vise_125, fixed_jaw: +y, parallel: [8, 30]}\n", job);
  ASSERT_TRUE(file) << file.error().message;
  const auto h = place(file->setups.front(), piece(), file->fixtures);
  ASSERT_TRUE(h) << h.error().message;
  const auto& fixed = solid(*h, "vise.fixed_jaw");
  // Jaws of 40 on parallels of 30: 10 mm are held; the jaws are 125 wide about x = 40.
  EXPECT_DOUBLE_EQ(fixed.top_mm, 10.0);
  EXPECT_DOUBLE_EQ(fixed.bottom_mm, -30.0);
  EXPECT_EQ(fixed.outline[0], (geometry::Vec2{40 - 62.5, 60}));
  EXPECT_EQ(fixed.outline[2], (geometry::Vec2{40 + 62.5, 85}));
  EXPECT_TRUE(fixed.presses);
  EXPECT_DOUBLE_EQ(solid(*h, "vise.moving_jaw").outline[2].y, 0.0);
  EXPECT_DOUBLE_EQ(solid(*h, "vise.parallel_moving").top_mm, 0.0);
  EXPECT_EQ(h->pickup, (geometry::Vec3{0, 60, 30}));
  EXPECT_NE(h->pickup_text.find("X 0, Y 60, Z 30"), std::string::npos) << h->pickup_text;
}

TEST(Holding, AStrapClampLiesOnThePieceWithItsBoltBesideIt) {
  Job job;
  const auto file = read(
      "  - {setup: 1, fixture: plate_400x300, clamps: [{clamp: strap_clamp_m8, at: [8, 30], from: -x},"
      " {clamp: toe_clamp_m10, at: [80, 30], from: +x}]}\n",
      job);
  ASSERT_TRUE(file) << file.error().message;
  const auto h = place(file->setups.front(), piece(), file->fixtures);
  ASSERT_TRUE(h) << h.error().message;
  EXPECT_DOUBLE_EQ(solid(*h, "clamp 1").bottom_mm, 30.0);
  // Bolt of 16 x 16: 8 mm to the edge, 3 mm away from it.
  EXPECT_DOUBLE_EQ(solid(*h, "clamp 1.bolt").outline[2].x, -3.0);
  EXPECT_DOUBLE_EQ(solid(*h, "clamp 1.support").outline[0].x, 0.0);
  EXPECT_DOUBLE_EQ(solid(*h, "clamp 1.support").outline[2].x, 8.0);
  EXPECT_DOUBLE_EQ(solid(*h, "clamp 2").bottom_mm, 0.0);
  EXPECT_DOUBLE_EQ(solid(*h, "plate").top_mm, -12.0);
  EXPECT_DOUBLE_EQ(h->holding_force_n, 12000.0);
}

TEST(Holding, EachFaultHasOneErrorThatNamesIt) {
  const std::string clamped = "  - {setup: 1, fixture: plate_400x300, clamps: [{clamp: strap_clamp_m8, ";
  const std::vector<std::array<std::string, 3>> cases = {
      {"  - {setup: 1, fixture: vice_7}\n", "NAME-UNKNOWN", "vice_7"},
      {"  - {setup: 1, fixture: strap_clamp_m8}\n", "HOLD-KIND", "needs a plate"},
      {"  - {setup: 1, fixture: plate_400x300, clamps: [{clamp: vise_100, at: [0, 0], from: -x}]}\n",
       "HOLD-KIND", "no clamp"},
      {"  - {setup: 1, fixture: vise_100}\n  - {setup: 1, fixture: vise_100}\n", "HOLD-TWICE", "twice"},
      {"  - {setup: 1, fixture: vise_125, parallel: [8, 38]}\n", "HOLD-PARALLEL", "hold 2 mm"},
      {"  - {setup: 1, fixture: vise_125, parallel: [35, 30]}\n", "HOLD-PARALLEL", "do not fit"},
      {"  - {setup: 1, fixture: vise_125, offset: 200, parallel: [8, 30]}\n", "HOLD-CONTACT",
       "off the piece; at most 102.49 mm"},
      {"  - {setup: 1, fixture: vise_125, fixed_jaw: north}\n", "DATA-VALUE", "north"},
      {"  - {setup: 1, fixture: vise_125, clearance: -1}\n", "DATA-RANGE", "clearance"},
      {"  - {setup: 1, fixture: plate_400x300}\n", "HOLD-NOTHING", "nothing holds"},
      {clamped + "at: [8, 30], from: -x, bottom: 20}]}\n", "HOLD-INSIDE", "8 mm deep"},
      {clamped + "at: [-20, 30], from: -x}]}\n", "HOLD-CONTACT", "does not touch"},
      {clamped + "at: [60, 30], from: -x}]}\n", "HOLD-CONTACT", "bolt"},
      {clamped + "at: [8], from: -x}]}\n", "DATA-TYPE", "pair"},
  };
  for (const auto& [text, code, word] : cases) {
    const Diagnostic d = fault_of(text);
    EXPECT_EQ(d.code, code) << text << d.message;
    EXPECT_NE(d.message.find(word), std::string::npos) << d.message;
    EXPECT_EQ(d.file, "holding.yaml");
    EXPECT_GT(d.line, 0U) << d.message;
  }
}

TEST(Holding, AForceBelowZeroIsRefused) {
  Job job;
  const auto with = [&](const std::string& force) {
    return read(
        "  - {setup: 1, fixture: mine}\nfixtures:\n  - {id: mine, kind: plate, width: 400, length: 300, "
        "height: 40, support: 10, holding_force_n: " +
            force + "}\n",
        job);
  };
  EXPECT_TRUE(with("4000")) << with("4000").error().message;
  ASSERT_FALSE(with("-4000"));
  EXPECT_EQ(with("-4000").error().code, "DATA-RANGE");
  EXPECT_NE(with("-4000").error().message.find("holding_force_n is -4000"), std::string::npos);
}

TEST(Holding, AVisesOpeningMustTakeThePiece) {
  Job job;
  const auto file = read("  - {setup: 1, fixture: vise_100, fixed_jaw: -x}\n", job);
  ASSERT_TRUE(file);
  geometry::Box3 wide = piece();
  wide.hi.x = 130;  // vise_100 opens 125 mm
  const auto h = place(file->setups.front(), wide, file->fixtures);
  ASSERT_FALSE(h);
  EXPECT_EQ(h.error().code, "HOLD-OPENING");
  EXPECT_NE(h.error().message.find("130 mm"), std::string::npos) << h.error().message;
}

}  // namespace
}  // namespace capstan::workholding
