#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/removal/parts.h"

// What no cutter reaches from above of a part that is given as a mesh is said.

namespace capstan::testing::removal {
namespace {

// An STL of an outline in XZ, extruded along Y from 0 to 20; `caps` are its triangles by corner.
std::string extruded(const std::vector<std::pair<double, double>>& outline,
                     const std::vector<std::array<std::size_t, 3>>& caps) {
  std::ostringstream out;
  out << "solid s\n";
  const auto facet = [&](const std::array<std::array<double, 3>, 3>& t) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const auto& v : t) out << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    out << "endloop\nendfacet\n";
  };
  const auto at = [&](std::size_t i, double y) {
    return std::array<double, 3>{outline[i].first, y, outline[i].second};
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t k = (i + 1) % outline.size();
    facet({at(i, 0), at(k, 0), at(k, 20)});
    facet({at(i, 0), at(k, 20), at(i, 20)});
  }
  for (const auto& c : caps) {
    facet({at(c[0], 0), at(c[2], 0), at(c[1], 0)});
    facet({at(c[0], 20), at(c[1], 20), at(c[2], 20)});
  }
  out << "endsolid s\n";
  return out.str();
}

std::vector<std::string> left_below(const std::string& stl, const std::string& code = "CHK-LEFT-BELOW") {
  PlanOptions options;
  options.material = "EN AW-6061";
  options.stock_allowance_mm = 2.0;
  std::vector<std::string> out;
  const PlanOutput plan = plan_bytes(stl, "s.stl", options);
  EXPECT_TRUE(plan.planned);
  for (const PlanMessage& m : plan.findings) {
    if (m.code == code) out.push_back(m.text);
  }
  return out;
}

// A cap of 26 mm over a stem of 10 mm, 20 mm long: twice 8 x 20 mm2 of it face down.
TEST(MeshFromAbove, WhatStandsUnderAnUndercutIsSaidWithItsAreaAndABoxHasNone) {
  const auto tee =
      left_below(extruded({{10, 0}, {10, 6}, {2, 6}, {2, 10}, {28, 10}, {28, 6}, {20, 6}, {20, 0}},
                          {{0, 7, 1}, {7, 6, 1}, {3, 2, 1}, {3, 1, 6}, {3, 6, 5}, {3, 5, 4}}));
  ASSERT_FALSE(tee.empty());  // of the plan and of its program
  EXPECT_NE(tee.front().find("under 320 mm2 of the part that face down"), std::string::npos) << tee.front();
  EXPECT_EQ(left_below(extruded({{0, 0}, {0, 10}, {30, 10}, {30, 0}}, {{0, 3, 2}, {0, 2, 1}})).size(), 0U);
}

TEST(MeshFromAbove, WhatOfTheRawPieceStaysUnderThePartIsSaid) {
  // The raw piece is 2 mm larger all round, and the box ends at z = 0.
  const auto slab =
      left_below(extruded({{0, 0}, {0, 10}, {30, 10}, {30, 0}}, {{0, 3, 2}, {0, 2, 1}}), "CHK-LEFT-UNDER");
  ASSERT_FALSE(slab.empty());
  EXPECT_NE(slab.front().find("under the part"), std::string::npos) << slab.front();
  EXPECT_NE(slab.front().find("2 mm of the raw piece stay"), std::string::npos) << slab.front();
}

}  // namespace
}  // namespace capstan::testing::removal
