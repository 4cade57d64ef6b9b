#include "planner/ground/geometry/mesh/mesh_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace capstan::geometry {
namespace {

using Kind = MeshForm::Kind;

/// A box of 4 x 3 x 2 from the origin, twelve triangles facing outwards.
Mesh box() {
  Mesh m;
  for (int i = 0; i < 8; ++i) m.vertices.push_back({i & 1 ? 4.0 : 0.0, i & 2 ? 3.0 : 0.0, i & 4 ? 2.0 : 0.0});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

/// A sheet of n x n squares of 1 mm, z = 0.1 x y.
Mesh sheet(std::uint32_t n) {
  Mesh m;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x)
      m.vertices.push_back({double(x), double(y), 0.1 * double(x) * double(y)});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      m.triangles.push_back({a, a + 1, a + n + 2});
      m.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return m;
}

TEST(MeshForm, ABoxIsASolidAndLackingAnyTriangleItIsNot) {
  EXPECT_EQ(form_of(box()).kind, Kind::kSolid);
  for (std::size_t i = 0; i < 12; ++i) {
    Mesh m = box();
    m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    const MeshForm f = form_of(m);
    EXPECT_EQ(f.kind, Kind::kBroken) << i;
    EXPECT_EQ(f.open_edges, 3U) << i;
    EXPECT_NE(f.fault.find("1 opening"), std::string::npos) << f.fault;
  }
}

TEST(MeshForm, ABoxWithoutItsTopIsNoSheetAndWithoutItsBottomIsOne) {
  Mesh open_above = box();
  open_above.triangles.erase(open_above.triangles.begin() + 2, open_above.triangles.begin() + 4);
  EXPECT_EQ(form_of(open_above).kind, Kind::kBroken);
  Mesh open_below = box();
  open_below.triangles.erase(open_below.triangles.begin(), open_below.triangles.begin() + 2);
  EXPECT_EQ(form_of(open_below).kind, Kind::kSheet);
}

// A tray of 40 x 30 mm, 10 deep, its floor and walls of 1 degree of draft, without its top: all of it faces
// down.
TEST(MeshForm, ADraftedTrayWithoutItsTopIsNoSheet) {
  const double in = 10.0 * std::tan(std::numbers::pi / 180.0);
  Mesh m;
  for (const double z : {0.0, -10.0}) {
    const double d = z < 0.0 ? in : 0.0;
    m.vertices.insert(m.vertices.end(), {{d, d, z}, {40 - d, d, z}, {40 - d, 30 - d, z}, {d, 30 - d, z}});
  }
  m.triangles = {{4, 6, 5}, {4, 7, 6}};  // the floor, seen from beneath
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t k = (i + 1) % 4;
    m.triangles.push_back({i, 4 + i, 4 + k});
    m.triangles.push_back({i, 4 + k, k});
  }
  const MeshForm f = form_of(m);
  EXPECT_EQ(f.kind, Kind::kBroken);
  EXPECT_NE(f.fault.find("it faces down and has walls"), std::string::npos) << f.fault;
  for (auto& t : m.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(form_of(m).kind, Kind::kSheet) << "seen from above it is a cavity";
}

TEST(MeshForm, CornersWithinTheWeldAreOneAndThoseBeyondAreNot) {
  for (const double apart : {0.5 * kWeldMm, 3.0 * kWeldMm}) {
    Mesh m = box();
    m.vertices.push_back({4.0 + apart, 3.0, 2.0});
    for (auto& v : m.triangles.back()) v = v == 7 ? 8 : v;
    EXPECT_EQ(form_of(m).kind == Kind::kSolid, apart < kWeldMm) << apart;
  }
}

TEST(MeshForm, ACornerInTheMiddleOfAnEdgeLeavesNoOpening) {
  Mesh m = box();
  // The edge from 1 to 5 gets a corner on one side only.
  m.vertices.push_back({4.0, 0.0, 1.0});
  m.triangles.back() = {1, 7, 8};
  m.triangles.push_back({8, 7, 5});
  EXPECT_EQ(form_of(m).kind, Kind::kSolid);
}

TEST(MeshForm, TrianglesThatFaceInwardsAreSaid) {
  Mesh m = box();
  EXPECT_FALSE(form_of(m).inside_out);
  std::swap(m.triangles[0][0], m.triangles[0][1]);
  EXPECT_EQ(form_of(m).turned_edges, 3U);
  EXPECT_EQ(form_of(m).kind, Kind::kSolid);
  std::swap(m.triangles[0][0], m.triangles[0][1]);
  for (auto& t : m.triangles) std::swap(t[0], t[1]);
  EXPECT_TRUE(form_of(m).inside_out);
}

TEST(MeshForm, ASheetIsOneUntilItHasAHole) {
  Mesh m = sheet(5);
  const MeshForm whole = form_of(m);
  EXPECT_EQ(whole.kind, Kind::kSheet);
  EXPECT_NEAR(area(whole.outline), 25.0, 1e-6);
  m.triangles.erase(m.triangles.begin() + 24);  // of the square in the middle, from (2, 2)
  const MeshForm holed = form_of(m);
  EXPECT_EQ(holed.kind, Kind::kBroken);
  EXPECT_NE(holed.fault.find("1 x 1 x 0.5 mm, from (2, 2, 0.4)"), std::string::npos) << holed.fault;
}

TEST(MeshForm, ASheetThatFoldsOverItselfIsNone) {
  Mesh m = sheet(3);
  for (auto& v : m.vertices) {
    if (v.x > 2.5) v.x = 1.5;  // the last column goes back under the one before
  }
  EXPECT_EQ(form_of(m).kind, Kind::kBroken);
}

}  // namespace
}  // namespace capstan::geometry
