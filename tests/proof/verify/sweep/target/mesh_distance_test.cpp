#include "planner/proof/verify/sweep/target/mesh_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"

namespace capstan::verify {
namespace {

using geometry::Mesh;
using geometry::Vec3;

TEST(NearestOnTriangle, IsTheFootOrTheNearestEdgeOrCorner) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  EXPECT_EQ(nearest_on_triangle({1, 1, 3}, a, b, c), (Vec3{1, 1, 0}));
  EXPECT_EQ(nearest_on_triangle({1, -2, 3}, a, b, c), (Vec3{1, 0, 0}));
  EXPECT_EQ(nearest_on_triangle({7, -2, 3}, a, b, c), b);
  EXPECT_EQ(nearest_on_triangle({3, 3, -1}, a, b, c), (Vec3{2, 2, 0}));
  // Of no area: its edges count.
  EXPECT_EQ(nearest_on_triangle({1, 1, 0}, a, b, a), (Vec3{1, 0, 0}));
}

TEST(MeshDistance, IsThatOfTheNearestOfAllTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(0.0, 20.0), aside(-1.5, 1.5);
  Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3 p{at(random), at(random), 0.2 * at(random)};
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back(p + Vec3{aside(random), aside(random), aside(random)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const MeshDistance distance(mesh);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{1.5 * at(random) - 5.0, 1.5 * at(random) - 5.0, 0.5 * at(random) - 2.0};
    double least = 3.0;
    for (const auto& t : mesh.triangles)
      least = std::min(least, norm(p - nearest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                           mesh.vertices[t[2]])));
    EXPECT_EQ(distance.from(p, 3.0).mm, least);
  }
}

/// Slivers across the axes, each with all of the mesh in its box.
Mesh slivers(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double y = 0.01 * i;
    for (const Vec3 p : {Vec3{0, y, 0}, Vec3{100, 100 + y, 1}, Vec3{100, 100.01 + y, 1}})
      mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

TEST(MeshDistance, OfLongSliversAcrossTheAxesIsThatOfTheNearest) {
  const Mesh mesh = slivers(1000);
  const MeshDistance distance(mesh);
  for (const Vec3 p : {Vec3{50, 55, 3}, Vec3{10, 40, 0}, Vec3{70, 20, -1}, Vec3{-2, 3, 0}}) {
    double least = 50.0;
    for (const auto& t : mesh.triangles)
      least = std::min(least, norm(p - nearest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                           mesh.vertices[t[2]])));
    EXPECT_EQ(distance.from(p, 50.0).mm, least);
  }
}

TEST(MeshDistance, StopsWhenItIsAsked) {
  const Mesh mesh = slivers(1000);
  const MeshDistance distance(mesh);
  Job job;
  job.request_stop();
  const StopScope scope(job);
  EXPECT_THROW((void)MeshDistance{mesh}, Stopped);
  EXPECT_THROW((void)distance.from({50, 55, 3}, 50.0), Stopped);
}

}  // namespace
}  // namespace capstan::verify
