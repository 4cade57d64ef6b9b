#include "planner/files/exchange/cad/stl.h"

#include "planner/files/exchange/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

using Facets = std::vector<std::array<Vec3, 3>>;

std::string ascii_of(const Facets& facets, const std::string& normal = "0 0 0") {
  std::string out = "solid s\n";
  for (const auto& f : facets) {
    out += "facet normal " + normal + "\nouter loop\n";
    for (const Vec3 p : f)
      out += "vertex " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid s\n";
}

/// A sheet of n x n squares of 10 mm, z = 0.01 x y, all of it facing up.
Facets sheet(int n) {
  Facets out;
  const auto at = [](int x, int y) { return Vec3{10.0 * x, 10.0 * y, 1.0 * x * y}; };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      out.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      out.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return out;
}

/// A box, its lowest and highest corners given.
Facets box(Vec3 lo, Vec3 hi) {
  const auto at = [&](int i) {
    return Vec3{(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z};
  };
  Facets out;
  for (const auto& t : {std::array{0, 2, 3},
                        {0, 3, 1},
                        {4, 5, 7},
                        {4, 7, 6},
                        {0, 1, 5},
                        {0, 5, 4},
                        {2, 6, 7},
                        {2, 7, 3},
                        {0, 4, 6},
                        {0, 6, 2},
                        {1, 3, 7},
                        {1, 7, 5}})
    out.push_back({at(t[0]), at(t[1]), at(t[2])});
  return out;
}

struct Judged {
  std::vector<std::string> codes;
  std::map<std::string, std::string> texts;
  Result<model::Plan> plan;
};
Judged judged(const std::string& text, const std::optional<MeshUnit>& unit = {}) {
  Job job;
  ReadOptions options;
  options.mesh_unit = unit;
  Judged out{{}, {}, read_bytes(text, "s.stl", options, job)};
  for (const Diagnostic& d : job.diagnostics()) {
    out.codes.push_back(d.code);
    out.texts[d.code] = d.message;
  }
  return out;
}

std::size_t facing_down(const geometry::Mesh& m) {
  return static_cast<std::size_t>(std::count_if(m.triangles.begin(), m.triangles.end(), [&](const auto& t) {
    return cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]).z < 0.0;
  }));
}

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(JudgedMesh, ACleanSolidAndACleanSheetAreToldNothingButThatASheetIsOne) {
  EXPECT_THAT(judged(ascii_of(box({0, 0, 0}, {40, 30, 20}))).codes, IsEmpty());
  EXPECT_THAT(judged(ascii_of(sheet(4))).codes, ElementsAre("STL-SHEET"));
  EXPECT_THAT(judged(ascii_of(sheet(4), "0 0 1")).codes, ElementsAre("STL-SHEET"));
}

TEST(JudgedMesh, TrianglesOfASheetThatFaceAgainstTheirNeighboursAreTurnedAndCounted) {
  Facets facets = sheet(4);
  for (const std::size_t i : {5U, 12U, 30U}) std::swap(facets[i][0], facets[i][1]);
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan) << to_text(j.plan.error());
  EXPECT_THAT(j.codes, ElementsAre("STL-TURNED", "STL-SHEET"));
  EXPECT_THAT(j.texts.at("STL-TURNED"), HasSubstr("3 of 32 triangles"));
  EXPECT_EQ(facing_down(*j.plan->target_mesh), 0U);
}

TEST(JudgedMesh, TrianglesOfASolidThatFaceAgainstTheirNeighboursAreTurned) {
  Facets facets = box({0, 0, 0}, {40, 30, 20});
  std::swap(facets[2][0], facets[2][1]);
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan);
  EXPECT_THAT(j.codes, ElementsAre("STL-TURNED"));
  EXPECT_EQ(facing_down(*j.plan->target_mesh), 2U) << "the underside alone";
}

TEST(JudgedMesh, ASheetThatFacesDownIsTurnedAndSaid) {
  Facets facets = sheet(3);
  for (auto& f : facets) std::swap(f[0], f[1]);
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan);
  EXPECT_THAT(j.codes, ElementsAre("STL-SHEET", "STL-FACES-DOWN"));
  EXPECT_EQ(facing_down(*j.plan->target_mesh), 0U);
}

TEST(JudgedMesh, NormalsThatAreStatedAgainstTheOrderOfCornersAreCounted) {
  const Judged j = judged(ascii_of(sheet(2), "0 0 -1"));
  EXPECT_THAT(j.codes, ElementsAre("STL-NORMAL", "STL-SHEET"));
  EXPECT_THAT(j.texts.at("STL-NORMAL"), HasSubstr("8 of 8 triangles"));
  EXPECT_THAT(judged(ascii_of(sheet(2), "nan 0 1")).codes, ElementsAre("STL-SHEET"))
      << "as if it stated none";
}

TEST(JudgedMesh, TrianglesThatAreThereTwiceAreTakenOnce) {
  for (const Facets& once : {sheet(2), box({0, 0, 0}, {40, 30, 20})}) {
    Facets facets = once;
    for (auto f : once) facets.push_back({f[1], f[2], f[0]});  // the same one, from another corner on
    const Judged j = judged(ascii_of(facets));
    ASSERT_TRUE(j.plan) << to_text(j.plan.error());
    EXPECT_EQ(j.codes.front(), "STL-TWICE");
    EXPECT_EQ(j.texts.count("STL-CROWDED"), 0U);
    EXPECT_THAT(j.texts.at("STL-TWICE"), HasSubstr(std::to_string(once.size()) + " triangles"));
    EXPECT_EQ(j.plan->target_mesh->triangles.size(), once.size());
  }
}

TEST(JudgedMesh, ASheetThatIsDrawnFromBothSidesIsOneSheet) {
  Facets facets = sheet(2);
  for (const auto& f : sheet(2)) facets.push_back({f[1], f[0], f[2]});
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan) << to_text(j.plan.error());
  EXPECT_THAT(j.codes, ElementsAre("STL-TWICE", "STL-SHEET"));
  EXPECT_EQ(facing_down(*j.plan->target_mesh), 0U);
}

TEST(JudgedMesh, BodiesThatTouchKeepTheFacesBetweenThem) {
  Facets facets = box({0, 0, 0}, {40, 30, 20});
  for (const auto& f : box({40, 0, 0}, {80, 30, 20})) facets.push_back(f);
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan) << to_text(j.plan.error());
  EXPECT_EQ(j.plan->target_mesh->triangles.size(), 24U);
  EXPECT_EQ(j.texts.count("STL-TWICE"), 0U);
}

// A cap of 40 x 30 over a stem of 20 x 30: 2 x 10 x 30 mm2 face down.
TEST(JudgedMesh, WhatFacesDownAboveTheUndersideIsSaidWithItsArea) {
  const std::vector<std::array<double, 2>> xz{{10, 0},  {30, 0}, {30, 10}, {40, 10},
                                              {40, 20}, {0, 20}, {0, 10},  {10, 10}};
  Facets facets;
  for (std::size_t i = 0; i < xz.size(); ++i) {
    const auto &a = xz[i], &b = xz[(i + 1) % xz.size()];
    facets.push_back({Vec3{a[0], 0, a[1]}, Vec3{a[0], 30, a[1]}, Vec3{b[0], 30, b[1]}});
    facets.push_back({Vec3{a[0], 0, a[1]}, Vec3{b[0], 30, b[1]}, Vec3{b[0], 0, b[1]}});
  }
  for (const auto& t :
       {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 7}, {2, 3, 4}, {7, 2, 4}, {7, 4, 5}, {7, 5, 6}}) {
    for (const double y : {0.0, 30.0}) {
      std::array<Vec3, 3> f{};
      for (std::size_t k = 0; k < 3; ++k) f[k] = {xz[t[k]][0], y, xz[t[k]][1]};
      if (y > 0.0) std::swap(f[1], f[2]);
      facets.push_back(f);
    }
  }
  const Judged j = judged(ascii_of(facets));
  ASSERT_TRUE(j.plan) << to_text(j.plan.error());
  // 600 mm2; beside the underside there are 2 x 600 (front and back), 4 x 300 (upright), 600 and 1,200 on
  // top.
  EXPECT_THAT(j.codes, ElementsAre("STL-UNDERCUT"));
  EXPECT_THAT(j.texts.at("STL-UNDERCUT"), HasSubstr("600 mm2 of the mesh (14.3 %"));
}

TEST(JudgedMesh, AMeshAsSmallAsOneInInchesIsAskedAboutUntilItsUnitIsStated) {
  const std::string plate = ascii_of(box({0, 0, 0}, {4, 3, 0.5}));
  const Judged unstated = judged(plate);
  EXPECT_THAT(unstated.codes, ElementsAre("STL-INCH"));
  EXPECT_THAT(unstated.texts.at("STL-INCH"), HasSubstr("4 x 3 x 0.5 mm"));
  EXPECT_THAT(judged(plate, MeshUnit{1.0, "mm", "said"}).codes, IsEmpty());
  const Judged inch = judged(plate, MeshUnit{25.4, "inch", "said"});
  EXPECT_THAT(inch.codes, IsEmpty());
  ASSERT_TRUE(inch.plan);
  const geometry::Box3 box = geometry::bounds(*inch.plan->target_mesh);
  EXPECT_DOUBLE_EQ(box.hi.x, 101.6);
  EXPECT_DOUBLE_EQ(box.hi.z, 12.7);
  ASSERT_EQ(inch.plan->provenance.size(), 1U);
  EXPECT_EQ(inch.plan->provenance[0], (model::Provenance{"mesh unit", "inch", "said"}));
}

}  // namespace
}  // namespace capstan::exchange
