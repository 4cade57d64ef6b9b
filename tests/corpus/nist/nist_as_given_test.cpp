#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/corpus/session.h"

// The standard's example 1 in feature form: everything is bound, so the plan executes it. NIST's own
// interpreter made the list of motion that it is compared with. Where the two differ, a test says where and
// why.

namespace capstan::corpus {
namespace {

using testing::CanonMove;
using testing::CanonProgram;
using ::testing::ElementsAre;
using Kind = CanonMove::Kind;

constexpr double kPrinted = 5e-5;  // the lists have four decimals
constexpr double kPi = std::numbers::pi;

// What both must keep: from the file.
constexpr double kSecurityPlane = 30.0;
constexpr double kHoleDepth = 30.0;
constexpr double kHoleX = 20.0, kHoleY = 60.0;
constexpr double kDrillDiameter = 20.0,
                 kDrillTopAngle = 31.0;  // as written; a flank angle, see EXC-TIP-ANGLE
constexpr double kMillDiameter = 18.0;
constexpr double kPocketDepth = 30.0;
constexpr double kRoughLevel = 5.9;   // 29.5 mm (0.5 left on the bottom) in the fewest levels of at most 6.5
constexpr double kFinishLevel = 2.0;  // axial_cutting_depth of the finishing operation

// Where they differ.
constexpr double kNistStart =
    200.0;  // the list comes down from z = 200; Capstan from the machine's top to 30
constexpr double kNistTip =
    7.1378;  // its tip length of that drill: by APT corner data, edge radius counted in
constexpr double kBreakThrough = 1.0;  // Capstan: how far a through hole's cutter goes past the bottom
constexpr double kArcFit = 1e-3;       // Capstan rounds corners by arcs fitted this near to the exact offset

double our_tip() { return 0.5 * kDrillDiameter * std::tan(kDrillTopAngle * kPi / 180.0); }

struct Extent {
  double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
  void add(double x, double y) {
    x0 = std::min(x0, x);
    x1 = std::max(x1, x);
    y0 = std::min(y0, y);
    y1 = std::max(y1, y);
  }
};

/// Everything that stays on one level: arcs by many points, lines by their ends.
Extent extent_at(const std::vector<CanonMove>& moves, double z) {
  Extent e;
  for (const CanonMove& m : moves) {
    if (m.kind == Kind::kTraverse || std::abs(m.z - z) > kPrinted || std::abs(m.from_z - z) > kPrinted)
      continue;
    e.add(m.from_x, m.from_y);
    e.add(m.x, m.y);
    if (m.kind != Kind::kArc) continue;
    const double r = std::hypot(m.from_x - m.cx, m.from_y - m.cy);
    const double a0 = std::atan2(m.from_y - m.cy, m.from_x - m.cx);
    for (int i = 1; i < 64; ++i) {
      const double a = a0 + m.sweep * i / 64.0;
      e.add(m.cx + r * std::cos(a), m.cy + r * std::sin(a));
    }
  }
  return e;
}

/// Heights at which lines or arcs run level, highest first.
std::vector<double> levels(const std::vector<CanonMove>& moves) {
  std::vector<double> out;
  for (const CanonMove& m : moves) {
    const double run = std::hypot(m.x - m.from_x, m.y - m.from_y);
    if (m.kind == Kind::kTraverse || std::abs(m.z - m.from_z) > kPrinted || run < 20.0) continue;
    if (out.empty() || std::abs(out.back() - m.z) > kPrinted) out.push_back(m.z);
  }
  return out;
}

/// Twice the signed area of what is traced on one level outside `inner`: positive counter-clockwise.
double turn_of_outer_ring(const std::vector<CanonMove>& moves, double z, double x_outer) {
  double turn = 0.0;
  for (const CanonMove& m : moves) {
    if (m.kind != Kind::kFeed || std::abs(m.z - z) > kPrinted || std::abs(m.from_z - z) > kPrinted) continue;
    if (std::abs(m.x - x_outer) < 1e-3 && std::abs(m.from_x - x_outer) < 1e-3) turn += m.y - m.from_y;
  }
  return turn;
}

class CorpusNistAsGiven : public ::testing::Test {
 protected:
  void load() {
    session_ = planned(testing::corpus_folder() + "/iso14649/nist_ex1.stp", Reopen::kNothing);
    nist_ = testing::read_canon(testing::slurp(testing::corpus_folder() + "/iso14649/nist_ex1.can"));
    ours_ = interpreted(session_);
  }

  /// NIST's list has no markers: by the order of the tools, and the rise to the security plane between the
  /// two operations on the pocket.
  [[nodiscard]] std::vector<CanonMove> nist(const std::string& step) const {
    const long first = step == "face"    ? 14
                       : step == "drill" ? 52
                       : step == "ream"  ? 73
                       : step == "rough" ? 86
                                         : 207;
    const long last = step == "face"    ? 42
                      : step == "drill" ? 63
                      : step == "ream"  ? 76
                      : step == "rough" ? 206
                                        : 537;
    std::vector<CanonMove> out;
    for (const auto& m : nist_.moves) {
      if (m.line >= first && m.line <= last) out.push_back(m);
    }
    return out;
  }

  [[nodiscard]] std::vector<CanonMove> ours(const std::string& marker) const {
    std::vector<CanonMove> out;
    for (const auto& m : ours_.moves) {
      if (m.step == marker) out.push_back(m);
    }
    return testing::motion_below(out, kSecurityPlane);
  }

  Session session_;
  CanonProgram nist_, ours_;
};

#define CAPSTAN_NIST_EXAMPLE()                               \
  CAPSTAN_CORPUS_FILE(corpus_file, "iso14649/nist_ex1.stp"); \
  CAPSTAN_NEEDS_RS274();                                     \
  load();                                                    \
  ASSERT_EQ(session_.plan.steps.size(), 5U) << "of " << corpus_file

TEST_F(CorpusNistAsGiven, CallsTheSameToolsInTheSameOrder) {
  CAPSTAN_NIST_EXAMPLE();
  EXPECT_THAT(nist_.tools, ElementsAre("MILL 18MM", "SPIRAL_DRILL_20MM", "REAMER_22MM", "MILL 18MM"));
  EXPECT_EQ(ours_.tools, nist_.tools);
  EXPECT_THAT(step_ids(session_.plan), ElementsAre("WS FINISH PLANAR FACE1", "WS DRILL HOLE1",
                                                   "WS REAM HOLE1", "WS ROUGH POCKET1", "WS FINISH POCKET1"));
  EXPECT_TRUE(session_.plan.unplanned.empty());
}

TEST_F(CorpusNistAsGiven, CutsAtTheSameSpeedsAllClockwise) {
  CAPSTAN_NIST_EXAMPLE();
  // Each speed that something is cut at, by tool call; what is only withdrawn at is left out.
  const auto speeds = [](const CanonProgram& p) {
    std::vector<std::pair<std::string, double>> out;
    for (const CanonMove& m : p.moves) {
      if (m.kind == Kind::kTraverse || m.z > m.from_z) continue;
      const std::pair<std::string, double> now{m.tool, m.rpm};
      if (out.empty() || out.back() != now) out.push_back(now);
    }
    return out;
  };
  using P = std::pair<std::string, double>;
  EXPECT_THAT(speeds(nist_),
              ElementsAre(P{"MILL 18MM", 720.0}, P{"SPIRAL_DRILL_20MM", 720.0}, P{"SPIRAL_DRILL_20MM", 960.0},
                          P{"SPIRAL_DRILL_20MM", 480.0}, P{"REAMER_22MM", 1080.0}, P{"MILL 18MM", 1200.0}));
  EXPECT_EQ(speeds(ours_), speeds(nist_));
}

TEST_F(CorpusNistAsGiven, KeepsCoolantOnWhileCutting) {
  CAPSTAN_NIST_EXAMPLE();
  for (const auto* program : {&nist_, &ours_}) {
    for (const CanonMove& m : program->moves) {
      EXPECT_TRUE(m.flood || m.kind == Kind::kTraverse) << "line " << m.line;
    }
  }
}

/// Without points in the middle of a straight line in the plane: where the cutter's front is out of the
/// piece, the rest of a pass of roughing goes on as another move.
std::vector<CanonMove> whole_lines(const std::vector<CanonMove>& moves) {
  std::vector<CanonMove> out;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const bool goes_on = i > 0 && i + 1 < moves.size() && moves[i].kind == moves[i + 1].kind &&
                         moves[i - 1].x == moves[i].x && moves[i].x == moves[i + 1].x &&
                         moves[i - 1].z == moves[i].z && moves[i].z == moves[i + 1].z &&
                         (moves[i].y - moves[i - 1].y) * (moves[i + 1].y - moves[i].y) > 0.0;
    if (!goes_on) out.push_back(moves[i]);
  }
  return out;
}

// NIST's passes end 1.5 radii beside the piece, which reaches from Y0 to Y120; ours a radius and 1 mm.
TEST_F(CorpusNistAsGiven, FacesPointByPointButForHowFarPassesRunOut) {
  CAPSTAN_NIST_EXAMPLE();
  constexpr double kRadius = 9.0, kLength = 120.0, kBeside = 1.0;
  const auto theirs = testing::motion_below(nist("face"), kSecurityPlane);
  const auto mine = whole_lines(ours("WS%20FINISH%20PLANAR%20FACE1"));
  ASSERT_EQ(mine.size(), theirs.size());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const bool before = theirs[i].y < 0.0;
    EXPECT_EQ(mine[i].kind, theirs[i].kind) << i;
    EXPECT_NEAR(mine[i].x, theirs[i].x, kPrinted) << i;
    EXPECT_NEAR(theirs[i].y, before ? -1.5 * kRadius : kLength + 1.5 * kRadius, kPrinted) << i;
    EXPECT_NEAR(mine[i].y, before ? -kRadius - kBeside : kLength + kRadius + kBeside, kPrinted) << i;
    EXPECT_NEAR(mine[i].z, theirs[i].z, kPrinted) << i;
    EXPECT_EQ(mine[i].rpm, theirs[i].rpm) << i;
  }
  // NIST's list never states the face's feed; the file does: 0.040 m/s.
  EXPECT_EQ(theirs.front().feed_mm_min, 0.0);
  EXPECT_DOUBLE_EQ(mine.front().feed_mm_min, 0.040 * 60000.0);
}

TEST_F(CorpusNistAsGiven, GoesToAndFromTheFaceAtTheSecurityPlaneInsteadOfTheTopOfTheMachine) {
  CAPSTAN_NIST_EXAMPLE();
  EXPECT_NEAR(nist("face").front().z, kNistStart, kPrinted);
  for (const CanonMove& m : ours_.moves) {
    constexpr double kFar = 1000.0;  // machine coordinates of G53, shifted by the interpreter
    if (m.step.empty() || std::abs(m.z) > kFar) continue;
    EXPECT_LE(m.z, kSecurityPlane + kPrinted) << m.line;
  }
}

TEST_F(CorpusNistAsGiven, DrillsInTheSamePhasesCountedFromItsOwnTip) {
  CAPSTAN_NIST_EXAMPLE();
  // Feed moves, each with its depth, speed and feed.
  const auto theirs = testing::motion_below(nist("drill"), kSecurityPlane);
  const auto mine = ours("WS%20DRILL%20HOLE1");
  std::vector<CanonMove> down_theirs, down_mine;
  std::copy_if(theirs.begin(), theirs.end(), std::back_inserter(down_theirs),
               [](const CanonMove& m) { return m.kind == Kind::kFeed && m.z < m.from_z && m.z < 0.0; });
  std::copy_if(mine.begin(), mine.end(), std::back_inserter(down_mine),
               [](const CanonMove& m) { return m.kind == Kind::kFeed && m.z < m.from_z && m.z < 0.0; });
  ASSERT_EQ(down_theirs.size(), 3U);
  ASSERT_EQ(down_mine.size(), 3U);
  // From the file: 960 rpm and 0.030 m/s; 0.75 and 0.50 of them for the first 2 mm (depth_of_start 2.0), then
  // whole to 8 mm, then 0.50 and 0.75 to the bottom; each depth is that of the full diameter.
  const double full[] = {2.0, 8.0, kHoleDepth};
  const double rpm[] = {0.75 * 960.0, 960.0, 0.50 * 960.0};
  const double feed[] = {0.50 * 1800.0, 1800.0, 0.75 * 1800.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(down_theirs[i].z, -(full[i] + kNistTip), kPrinted) << i;
    const double past = i == 2 ? kBreakThrough : 0.0;
    EXPECT_NEAR(down_mine[i].z, -(full[i] + our_tip() + past), kPrinted) << i;
    for (const CanonMove& m : {down_theirs[i], down_mine[i]}) {
      EXPECT_NEAR(m.x, kHoleX, kPrinted);
      EXPECT_NEAR(m.y, kHoleY, kPrinted);
      EXPECT_DOUBLE_EQ(m.rpm, rpm[i]) << i;
      EXPECT_DOUBLE_EQ(m.feed_mm_min, feed[i]) << i;
    }
  }
  // Withdrawn: NIST at feed to the retract plane 10 mm above, Capstan at rapid to the security plane.
  EXPECT_EQ(theirs.back().kind, Kind::kFeed);
  EXPECT_NEAR(theirs.back().z, 10.0, kPrinted);
  EXPECT_EQ(mine.back().kind, Kind::kFeed) << "the last feed move is the one down";
}

TEST_F(CorpusNistAsGiven, ReamsThroughAndComesOutStoppedAsGiven) {
  CAPSTAN_NIST_EXAMPLE();
  const auto theirs = nist("ream");
  const auto mine = ours("WS%20REAM%20HOLE1");
  // NIST feeds all the way from the drill's retract plane; Capstan comes down to 2 mm at the same feed.
  ASSERT_EQ(theirs.size(), 2U);
  EXPECT_NEAR(theirs[0].z, -kHoleDepth, kPrinted);
  ASSERT_EQ(mine.size(), 3U);
  EXPECT_NEAR(mine[1].z, -(kHoleDepth + kBreakThrough), kPrinted);
  for (const CanonMove& m : {theirs[0], mine[0], mine[1]}) {
    EXPECT_DOUBLE_EQ(m.rpm, 1080.0);
    EXPECT_DOUBLE_EQ(m.feed_mm_min, 0.030 * 60000.0);
  }
  // spindle_stop_at_bottom is true in the file: both withdraw with the spindle stopped, at feed, to z = 10.
  for (const CanonMove& m : {theirs[1], mine[2]}) {
    EXPECT_EQ(m.kind, Kind::kFeed);
    EXPECT_NEAR(m.z, 10.0, kPrinted);
    EXPECT_DOUBLE_EQ(m.rpm, 0.0);
  }
  EXPECT_THAT(codes(session_.bound, Severity::kWarning), ::testing::Contains("TPA-GIVEN"));
}

TEST_F(CorpusNistAsGiven, RoughsThePocketToTheSameLevelsAndExtents) {
  CAPSTAN_NIST_EXAMPLE();
  const auto theirs = nist("rough");
  const auto mine = ours("WS%20ROUGH%20POCKET1");
  const auto z = levels(theirs);
  ASSERT_EQ(z.size(), 5U);
  for (std::size_t i = 0; i < z.size(); ++i)
    EXPECT_NEAR(z[i], -kRoughLevel * static_cast<double>(i + 1), kPrinted);
  const auto our_z = levels(mine);
  ASSERT_EQ(our_z.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_NEAR(our_z[i], z[i], kPrinted);
    // Pocket 50 x 80 about (70, 70), cutter radius 9, 1 mm left on the side.
    for (const auto* moves : {&theirs, &mine}) {
      const Extent e = extent_at(*moves, z[i]);
      EXPECT_NEAR(e.x0, 70.0 - 25.0 + 0.5 * kMillDiameter + 1.0, kPrinted);
      EXPECT_NEAR(e.x1, 70.0 + 25.0 - 0.5 * kMillDiameter - 1.0, kPrinted);
      EXPECT_NEAR(e.y0, 70.0 - 40.0 + 0.5 * kMillDiameter + 1.0, kPrinted);
      EXPECT_NEAR(e.y1, 70.0 + 40.0 - 0.5 * kMillDiameter - 1.0, kPrinted);
      // rotation_direction is .CW.: down the right side.
      EXPECT_LT(turn_of_outer_ring(*moves, z[i], e.x1), 0.0);
    }
  }
}

TEST_F(CorpusNistAsGiven, EntersThePocketByAHelixWhereNistFeedsDownAndRampsByPlunging) {
  CAPSTAN_NIST_EXAMPLE();
  // NIST: one helix of radius 7.2 from z = 15 in air to the first level, and a straight plunge into the core
  // of each next level, by an end mill whose tool data do not say that it cuts to the centre.
  const auto theirs = nist("rough");
  const auto plunges = [](const std::vector<CanonMove>& moves) {
    return std::count_if(moves.begin(), moves.end(), [](const CanonMove& m) {
      return m.kind == Kind::kFeed && m.z < m.from_z - kPrinted && m.z < -kPrinted &&
             std::hypot(m.x - m.from_x, m.y - m.from_y) < kPrinted;
    });
  };
  EXPECT_EQ(plunges(theirs), 4);
  EXPECT_EQ(
      std::count_if(theirs.begin(), theirs.end(),
                    [](const CanonMove& m) { return m.kind == Kind::kArc && m.z < m.from_z - kPrinted; }),
      5);
  // Capstan: one helix about the pocket's middle for all levels, radius 0.45 of the diameter so that no core
  // stands; the levels below are entered straight down through its bore, and nothing is plunged into the
  // solid.
  const auto mine = ours("WS%20ROUGH%20POCKET1");
  int helices = 0;
  double bored_to = 1e300;
  for (const CanonMove& m : mine) {
    const bool down = m.kind == Kind::kFeed && m.z < m.from_z - kPrinted && m.z < -kPrinted &&
                      std::hypot(m.x - m.from_x, m.y - m.from_y) < kPrinted;
    if (down && helices > 0) {
      EXPECT_LE(std::hypot(m.x - 70.0, m.y - 70.0), 0.45 * kMillDiameter + 1e-3);
      EXPECT_GE(m.z, bored_to - kPrinted);
    }
    if (m.kind == Kind::kArc && m.z < m.from_z - kPrinted) bored_to = std::min(bored_to, m.z);
    if (m.kind != Kind::kArc || m.z > m.from_z - kPrinted) continue;
    ++helices;
    EXPECT_NEAR(m.cx, 70.0, kPrinted);
    EXPECT_NEAR(m.cy, 70.0, kPrinted);
    EXPECT_NEAR(std::hypot(m.from_x - m.cx, m.from_y - m.cy), 0.45 * kMillDiameter, 1e-3);
  }
  EXPECT_EQ(helices, 1);
}

TEST_F(CorpusNistAsGiven, FinishesThePocketToTheSameLevelsAndExtents) {
  CAPSTAN_NIST_EXAMPLE();
  const auto theirs = nist("finish");
  const auto mine = ours("WS%20FINISH%20POCKET1");
  const auto z = levels(theirs);
  const auto our_z = levels(mine);
  ASSERT_EQ(z.size(), 15U);
  ASSERT_EQ(our_z.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_NEAR(z[i], -kFinishLevel * static_cast<double>(i + 1), kPrinted);
    EXPECT_NEAR(our_z[i], z[i], kPrinted);
    for (const auto* moves : {&theirs, &mine}) {
      const Extent e = extent_at(*moves, z[i]);
      EXPECT_NEAR(e.x0, 70.0 - 25.0 + 0.5 * kMillDiameter, kArcFit) << i;
      EXPECT_NEAR(e.x1, 70.0 + 25.0 - 0.5 * kMillDiameter, kArcFit) << i;
      EXPECT_NEAR(e.y0, 70.0 - 40.0 + 0.5 * kMillDiameter, kArcFit) << i;
      EXPECT_NEAR(e.y1, 70.0 + 40.0 - 0.5 * kMillDiameter, kArcFit) << i;
      EXPECT_LT(turn_of_outer_ring(*moves, z[i], 86.0), 0.0);
    }
  }
  EXPECT_NEAR(z.back(), -kPocketDepth, kPrinted);
}

TEST_F(CorpusNistAsGiven, FinishesTheWallOnEveryLevelAndTheFloorOnTheLast) {
  CAPSTAN_NIST_EXAMPLE();
  // NIST clears the whole pocket again on each of the fifteen levels, mostly through air; Capstan cuts what
  // roughing left: the wall on each level, the floor on the last.
  const auto inner = [](const std::vector<CanonMove>& moves, double z) {
    return std::any_of(moves.begin(), moves.end(), [z](const CanonMove& m) {
      constexpr double kInside = 62.5;  // within the wall pass and its arcs in and out
      return m.kind == Kind::kFeed && std::abs(m.z - z) < kPrinted && std::abs(m.from_z - z) < kPrinted &&
             m.x > kInside && m.x < 79.0 && std::abs(m.y - m.from_y) > 20.0 &&
             std::abs(m.x - m.from_x) < kPrinted;  // a pass beside the wall, not the way to the next level
    });
  };
  const auto theirs = nist("finish");
  const auto mine = ours("WS%20FINISH%20POCKET1");
  for (int i = 1; i <= 15; ++i) {
    const double z = -kFinishLevel * i;
    EXPECT_TRUE(inner(theirs, z)) << z;
    EXPECT_EQ(inner(mine, z), i == 15) << z;
  }
}

TEST_F(CorpusNistAsGiven, FeedsThePocketAsGiven) {
  CAPSTAN_NIST_EXAMPLE();
  for (const auto& moves :
       {nist("rough"), nist("finish"), ours("WS%20ROUGH%20POCKET1"), ours("WS%20FINISH%20POCKET1")}) {
    for (const CanonMove& m : moves) {
      if (m.kind == Kind::kTraverse) continue;
      EXPECT_DOUBLE_EQ(m.feed_mm_min, 0.040 * 60000.0) << m.line;
      EXPECT_DOUBLE_EQ(m.rpm, 1200.0) << m.line;
    }
  }
}

TEST_F(CorpusNistAsGiven, IsToldExactlyWhatIsBadMachiningInIt) {
  CAPSTAN_NIST_EXAMPLE();
  // 0.83 and 0.5 mm per tooth in steel, 1.9 to 2.8 mm per revolution drilling, 1.7 reaming, with the power
  // and torque that asks for in drilling, reaming and roughing; and a reamer withdrawn with the spindle
  // stopped. Of the plan, too: the bending that it predicts, and 75 m/min of the reamer, more than such a
  // tool of carbide bears, which it is taken for: the file does not say what it is made of. Nothing else. The
  // work is St 50.
  const std::vector<std::string> bad_steps = {"18 CHK-FEED-TOOL WS FINISH PLANAR FACE1",
                                              "17 CHK-POWER WS DRILL HOLE1",
                                              "17 CHK-TORQUE WS DRILL HOLE1",
                                              "18 CHK-FEED-TOOL WS DRILL HOLE1",
                                              "15 CHK-SPINDLE-STOPPED WS REAM HOLE1",
                                              "16 CHK-SPEED-MATERIAL WS REAM HOLE1",
                                              "17 CHK-POWER WS REAM HOLE1",
                                              "17 CHK-TORQUE WS REAM HOLE1",
                                              "18 CHK-FEED-TOOL WS REAM HOLE1",
                                              "17 CHK-POWER WS ROUGH POCKET1",
                                              "17 CHK-TORQUE WS ROUGH POCKET1",
                                              "18 CHK-FEED-TOOL WS ROUGH POCKET1",
                                              "21 CHK-BENDING WS ROUGH POCKET1",
                                              "18 CHK-FEED-TOOL WS FINISH POCKET1"};
  // The plan says, too, what machine such cuts would need.
  std::vector<std::string> bad_plan = {"16 CHK-TOOL-MATERIAL ", "17 CHK-MACHINE-POWER ",
                                       "17 CHK-MACHINE-TORQUE "};
  bad_plan.insert(bad_plan.end(), bad_steps.begin(), bad_steps.end());
  EXPECT_EQ(findings_of_plan(session_), bad_plan) << all_findings(session_);
  // A program says nothing of what was predicted.
  std::vector<std::string> bad = bad_steps;
  std::erase_if(bad, [](const std::string& f) {
    return f.find("CHK-SPEED-MATERIAL") != f.npos || f.find("CHK-BENDING") != f.npos ||
           f.find("CHK-WALL-ERROR") != f.npos;
  });
  EXPECT_EQ(findings_of_program(session_), bad);
}

}  // namespace
}  // namespace capstan::corpus
