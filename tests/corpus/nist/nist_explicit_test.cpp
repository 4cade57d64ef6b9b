#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/corpus/session.h"

// The standard's example 1 as explicit toolpaths: executed move for move.

namespace capstan::corpus {
namespace {

using testing::CanonMove;
using ::testing::IsEmpty;

constexpr double kPrinted = 1.1e-4;  // four decimals in the file, and four in the list
constexpr double kAngle = 1e-4;      // rad, of those four decimals on a radius of a few mm
constexpr double kSecurityPlane = 30.0;

struct Both {
  std::vector<CanonMove> ours, nist;
};

Both motion(const Session& session) {
  const auto path = testing::corpus_folder() + "/iso14649/nist_ex1E.can";
  return {testing::motion_below(interpreted(session).moves, kSecurityPlane),
          testing::motion_below(testing::read_canon(testing::slurp(path)).moves, kSecurityPlane)};
}

TEST(CorpusNistExplicit, MovesAsNistsInterpreterDoes) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, Reopen::kNothing);
  EXPECT_THAT(reasons_unplanned(session.plan), IsEmpty());
  const auto [ours, nist] = motion(session);
  ASSERT_GT(nist.size(), 400U);
  for (std::size_t i = 0; i < std::min(ours.size(), nist.size()); ++i) {
    const CanonMove& a = ours[i];
    const CanonMove& b = nist[i];
    const bool same = a.kind == b.kind && std::abs(a.x - b.x) < kPrinted && std::abs(a.y - b.y) < kPrinted &&
                      std::abs(a.z - b.z) < kPrinted && std::abs(a.cx - b.cx) < 1e-3 &&
                      std::abs(a.cy - b.cy) < 1e-3 && std::abs(a.sweep - b.sweep) < kAngle;
    ASSERT_TRUE(same) << "move " << i << " (line " << b.line << " of NIST's list, step " << a.step << "): to "
                      << a.x << " " << a.y << " " << a.z << " sweep " << a.sweep << " instead of " << b.x
                      << " " << b.y << " " << b.z << " sweep " << b.sweep;
  }
  EXPECT_EQ(ours.size(), nist.size());
}

TEST(CorpusNistExplicit, CutsWithTheSameToolsSpeedsAndFeeds) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, Reopen::kNothing);
  const auto [ours, nist] = motion(session);
  ASSERT_EQ(ours.size(), nist.size());
  for (std::size_t i = 0; i < nist.size(); ++i) {
    EXPECT_EQ(ours[i].tool, nist[i].tool) << nist[i].line;
    if (nist[i].kind == CanonMove::Kind::kTraverse) continue;
    EXPECT_DOUBLE_EQ(ours[i].rpm, nist[i].rpm) << nist[i].line;
    // NIST's list never states the face's feed; the file does: 0.040 m/s.
    const double feed = nist[i].feed_mm_min == 0.0 ? 2400.0 : nist[i].feed_mm_min;
    EXPECT_DOUBLE_EQ(ours[i].feed_mm_min, feed) << nist[i].line;
  }
}

TEST(CorpusNistExplicit, HelicesStayHelices) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  CAPSTAN_NEEDS_RS274();
  const Session session = planned(path, Reopen::kNothing);
  // Twenty levels, each entered by an arc that goes down; the first of rough and finish in more than a turn.
  int down = 0, long_ones = 0;
  for (const CanonMove& m : motion(session).ours) {
    if (m.kind != CanonMove::Kind::kArc || m.z > m.from_z - kPrinted) continue;
    ++down;
    long_ones += std::abs(m.sweep) > 2.0 * 3.14159265358979323846;
  }
  EXPECT_EQ(down, 20);
  EXPECT_EQ(long_ones, 2);
}

TEST(CorpusNistExplicit, IsToldExactlyWhatIsBadMachiningInIt) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  const Session session = planned(path, Reopen::kNothing);
  std::vector<std::string> bad;
  const auto add = [&](const std::string& step, std::initializer_list<const char*> what) {
    for (const char* w : what) bad.push_back(std::string(w) + " " + step);
  };
  for (const char* pass : {"A", "B"}) {
    add("WS FINISH PLANAR FACE1 " + std::string(pass), {"18 CHK-FEED-TOOL"});
  }
  add("WS DRILL HOLE1", {"17 CHK-POWER", "17 CHK-TORQUE", "18 CHK-FEED-TOOL"});
  add("WS REAM HOLE1", {"15 CHK-SPINDLE-STOPPED", "17 CHK-POWER", "17 CHK-TORQUE", "18 CHK-FEED-TOOL"});
  // Each level of the pocket is entered by a helix as steep as 10 degrees.
  for (const char* level : {"A", "B", "C", "D", "D~2"}) {
    add("WS ROUGH POCKET1 " + std::string(level),
        {"14 CHK-RAMP", "17 CHK-POWER", "17 CHK-TORQUE", "18 CHK-FEED-TOOL", "21 CHK-DEFLECTION"});
  }
  // Finishing goes through what roughing left, 0.5 mm on the floor: only its last helix enters material.
  for (const char level : std::string("ABCDEFGHIJKLMN")) {
    add("WS FINISH POCKET1 " + std::string(1, level), {"18 CHK-FEED-TOOL"});
  }
  add("WS FINISH POCKET1 P", {"14 CHK-RAMP", "18 CHK-FEED-TOOL"});
  EXPECT_EQ(findings_of_program(session), bad);
  // The loads of given paths are known, so the plan states what machine they need and how far its tools bend;
  // that the tools are carbide is assumed, as the file does not say what they are made of; the reamer turns
  // faster than one of carbide bears.
  std::vector<std::string> of_plan = {"16 CHK-TOOL-MATERIAL ", "17 CHK-MACHINE-POWER ",
                                      "17 CHK-MACHINE-TORQUE "};
  for (const std::string& f : bad) {
    const std::string step = f.substr(f.find("WS "));
    const bool reamed = step == "WS REAM HOLE1";
    if (reamed && f.starts_with("17 CHK-POWER")) of_plan.push_back("16 CHK-SPEED-MATERIAL " + step);
    if (f.starts_with("21 CHK-DEFLECTION")) of_plan.push_back("21 CHK-BENDING " + step);
    of_plan.push_back(f);
  }
  EXPECT_EQ(findings_of_plan(session), of_plan) << all_findings(session);
}

}  // namespace
}  // namespace capstan::corpus
