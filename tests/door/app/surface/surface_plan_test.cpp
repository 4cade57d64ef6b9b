#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"
#include "tests/support/stl_text.h"

// Surfaces with sharp creases, walls over curved floors and narrow places, from STL to a checked program.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A solid of 30 mm along y under this profile in x and z, from left to right, down to a level. A wall is two
/// places at one x; what stands beside it is a quad with a corner more.
geometry::Mesh under(const std::vector<geometry::Vec2>& top, double low) {
  geometry::Mesh m;
  const auto n = static_cast<std::uint32_t>(top.size());
  // By place and end: above, below.
  for (const geometry::Vec2 p : top) {
    for (const double y : {0.0, 30.0}) m.vertices.insert(m.vertices.end(), {{p.x, y, p.y}, {p.x, y, low}});
  }
  const auto wall = [&](std::uint32_t i) { return i + 1 < n && top[i].x == top[i + 1].x; };
  // Of the two places of a wall the first one's foot is that of both.
  const auto foot = [&](std::uint32_t i) { return i > 0 && wall(i - 1) ? i - 1 : i; };
  const auto at = [&](std::uint32_t i, std::uint32_t end, bool below) {
    return 4 * (below ? foot(i) : i) + 2 * end + (below ? 1 : 0);
  };
  const auto add = [&](std::vector<std::uint32_t> face, bool turned) {
    if (turned) std::reverse(face.begin(), face.end());
    for (std::size_t k = 1; k + 1 < face.size(); ++k) m.triangles.push_back({face[0], face[k], face[k + 1]});
  };
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    add({at(i, 0, false), at(i + 1, 0, false), at(i + 1, 1, false), at(i, 1, false)}, false);
    if (wall(i)) continue;
    add({at(i, 0, true), at(i, 1, true), at(i + 1, 1, true), at(i + 1, 0, true)}, false);
    for (const std::uint32_t end : {0U, 1U}) {
      // From the foot away from a wall beside it, which has a corner more where it stands lower.
      std::vector<std::uint32_t> face;
      if (i > 0 && wall(i - 1) && top[i - 1].y < top[i].y) {
        face = {at(i + 1, end, true), at(i + 1, end, false), at(i, end, false), at(i - 1, end, false),
                at(i, end, true)};
      } else if (wall(i + 1) && top[i + 2].y < top[i + 1].y) {
        face = {at(i, end, true), at(i + 1, end, true), at(i + 2, end, false), at(i + 1, end, false),
                at(i, end, false)};
      } else {
        face = {at(i, end, true), at(i + 1, end, true), at(i + 1, end, false), at(i, end, false)};
      }
      add(face, end == 1);
    }
  }
  add({at(0, 0, true), at(0, 0, false), at(0, 1, false), at(0, 1, true)}, false);
  add({at(n - 1, 0, true), at(n - 1, 1, true), at(n - 1, 1, false), at(n - 1, 0, false)}, false);
  return m;
}

class SurfacePlan : public ::testing::Test {
 protected:
  int plan(const geometry::Mesh& mesh, const std::string& more = "") {
    std::ofstream(folder_ / "s.stl") << ::capstan::testing::stl_text(mesh);
    const std::string line = "cd '" + folder_.string() + "' && " + command_quoted() +
                             " plan s.stl --material 'EN AW-6061' -o s.json -o s.ngc " + more + " >out 2>&1";
    const int status = std::system(line.c_str());
    said_ = slurp(folder_ / "out");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  std::string said_;
};

TEST_F(SurfacePlan, AValleyDrawnSharpKeepsTheRadiusOfTheLastBallAndSaysSo) {
  // Sides at 30 degrees: a ball of 3 mm leaves 3 (1 / cos 30 - 1) = 0.464 mm at its bottom.
  const double rise = 20.0 * std::tan(3.14159265358979 / 6.0);
  EXPECT_EQ(plan(under({{0, 10 + rise}, {20, 10}, {40, 10 + rise}}, 0.0)), 0) << said_;
  EXPECT_THAT(said_,
              HasSubstr("30 mm of its inside creases are drawn sharp, and a radius of 3 mm, that of the "
                        "last ball, stays: up to 0.464 mm high at (20, 15, 10)"));
  EXPECT_THAT(said_, HasSubstr("[CHK-REST]"));
  EXPECT_THAT(said_, Not(HasSubstr("CHK-LEFT")));
}

TEST_F(SurfacePlan, AGrooveWithAHollowFloorIsCutAlongItsWallsByAnEndMillAndFinishedByABall) {
  // 20 mm wide and 10 deep, its floor 0.5 mm deeper in the middle.
  std::vector<geometry::Vec2> top = {{0, 20}, {15, 20}};
  for (int i = -10; i <= 10; ++i) top.push_back({25.0 + i, 9.5 + 0.005 * i * i});
  top.insert(top.end(), {{35, 20}, {50, 20}});
  EXPECT_EQ(plan(under(top, 0.0)), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("Safe: 4 steps")) << "roughed, walls, evened out, finished";
}

TEST_F(SurfacePlan, OfAPartDrawnHighUpIsThatOfThePartAtZero) {
  std::string first;
  for (const double up : {0.0, 100.0}) {
    std::vector<geometry::Vec2> top;
    for (int i = -20; i <= 20; ++i) top.push_back({1.0 * i, up + 12.0 - 0.01 * i * i});
    ASSERT_EQ(plan(under(top, up)), 0) << said_;
    const std::string last = said_.substr(said_.rfind("Safe"));
    const std::string summary =
        last.substr(0, last.find(" tools"));  // the time has the coordinates' rounding
    if (up > 0.0) {
      EXPECT_EQ(summary, first);
    }
    first = summary;
  }
}

TEST_F(SurfacePlan, OfARawPieceThatIsThePartAlreadySaysWhatIsMissing) {
  EXPECT_EQ(plan(under({{0, 10}, {40, 10}}, 0.0)), 4) << said_;
  EXPECT_THAT(said_,
              HasSubstr("the raw piece is the surface already, and nothing of it is to be cut; say what "
                        "it is cut from (--stock block:+2)"));
}

}  // namespace
}  // namespace capstan::app
