#include "planner/files/exchange/cad/stl.h"

#include "planner/files/exchange/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tests/files/exchange/support.h"

namespace capstan::exchange {
namespace {

using geometry::Vec3;

// A tetrahedron with its right angle at the origin.
const std::vector<std::array<Vec3, 3>> kFaces = {{{{0, 0, 0}, {0, 2, 0}, {1, 0, 0}}},
                                                 {{{0, 0, 0}, {1, 0, 0}, {0, 0, 3}}},
                                                 {{{0, 0, 0}, {0, 0, 3}, {0, 2, 0}}},
                                                 {{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}}};

std::string ascii() {
  std::string out = "solid a name of words\n";
  for (const auto& f : kFaces) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3 p : f) {
      out += "   vertex " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid a name of words\n";
}

std::string binary(float replaced = 1.0F) {
  std::string out(80, 's');
  out.replace(0, 5, "solid");  // real files lie so
  const auto u32 = [&](std::uint32_t v) {
    for (int i = 0; i < 4; ++i) out += static_cast<char>((v >> (8 * i)) & 0xFFU);
  };
  u32(static_cast<std::uint32_t>(kFaces.size()));
  for (const auto& f : kFaces) {
    for (int i = 0; i < 3; ++i) u32(0);
    for (const Vec3 p : f) {
      for (const double c : {p.x, p.y, p.z}) {
        u32(std::bit_cast<std::uint32_t>(c == 1.0 ? replaced : static_cast<float>(c)));
      }
    }
    out += std::string(2, '\0');
  }
  return out;
}

TEST(Stl, AsciiAndBinaryGiveTheSameClosedMesh) {
  Job job;
  const auto a = read_stl(ascii(), "a.stl", job), b = read_stl(binary(), "b.stl", job);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->vertices, b->vertices);
  EXPECT_EQ(a->triangles, b->triangles);
  EXPECT_EQ(a->vertices.size(), 4U);
  // Volume by the divergence theorem: 1 x 2 x 3 / 6, positive as corners run counter-clockwise from outside.
  double volume = 0.0;
  for (const auto& t : a->triangles) {
    volume += dot(a->vertices[t[0]], cross(a->vertices[t[1]], a->vertices[t[2]])) / 6.0;
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(Stl, MeshBecomesAPlanWithAWorkpieceAndARegion) {
  for (const std::string& bytes : {ascii(), binary()}) {
    Job job;
    const auto plan = read_bytes(bytes, "part", ReadOptions{}, job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    ASSERT_NE(plan->target_mesh, nullptr);
    EXPECT_EQ(plan->target_mesh->triangles.size(), 4U);
    ASSERT_EQ(plan->kept.size(), 1U);
    EXPECT_TRUE(plan->model.holds<model::Region>(plan->kept[0]));
    EXPECT_TRUE(plan->project);
  }
}

TEST(Stl, BrokenMeshesAreRefusedWithAReason) {
  const std::pair<std::string, const char*> cases[] = {
      {ascii().substr(0, ascii().find("endsolid")), "STL-TRUNCATED"},
      {"solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0", "STL-TRUNCATED"},
      {"solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 zero\n", "STL-NUMBER"},
      {"solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
       "STL-SYNTAX"},
      {"solid x\nfacet normal 0 0 0\nouter loop\npoint 0 0 1\n", "STL-SYNTAX"},
      {"solid x\nendsolid x\n", "STL-EMPTY"},
      {binary(std::numeric_limits<float>::quiet_NaN()), "STL-NUMBER"},
  };
  for (const auto& [bytes, code] : cases) {
    Job job;
    const auto mesh = read_stl(bytes, "x.stl", job);
    ASSERT_FALSE(mesh) << code;
    EXPECT_EQ(mesh.error().code, code);
  }
}

TEST(Stl, TrianglesWithoutAreaAreLeftOutWithAWarning) {
  Job job;
  std::string s = ascii();
  s.insert(s.find("endsolid"),
           "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n");
  const auto mesh = read_stl(s, "x.stl", job);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), 4U);
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
}

TEST(Stl, BinaryMeshCutShortIsNotMistakenForAMesh) {
  Job job;
  const std::string s = binary();
  EXPECT_FALSE(read_bytes(s.substr(0, s.size() - 1), "x.stl", ReadOptions{}, job));
}

TEST(Stl, AMeshWithAnOpeningIsRefusedWithItsPlaceWhereAPlanIsReadOfIt) {
  std::string text = ascii();
  Job job;
  EXPECT_TRUE(read_bytes(text, "part.stl", {}, job));
  const auto at = text.rfind(" facet normal");
  text.erase(at, text.find("endsolid") - at);
  const auto plan = read_bytes(text, "part.stl", {}, job);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "STL-OPEN");
  EXPECT_NE(plan.error().message.find("1 x 2 x 3 mm, from (0, 0, 0)"), std::string::npos)
      << plan.error().message;
}

}  // namespace
}  // namespace capstan::exchange
