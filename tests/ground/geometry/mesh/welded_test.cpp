#include "planner/ground/geometry/mesh/welded.h"

#include <gtest/gtest.h>

#include <random>

namespace capstan::geometry {
namespace {

/// As welded() says, by looking at all pairs.
std::vector<std::uint32_t> by_all_pairs(const Mesh& m) {
  std::vector<std::uint32_t> out(m.vertices.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) {
    out[i] = i;
    for (std::uint32_t j = 0; j < i && out[i] == i; ++j)
      if (out[j] == j && norm(m.vertices[j] - m.vertices[i]) <= kWeldMm) out[i] = j;
  }
  return out;
}

TEST(Welded, GivesWhatLookingAtAllPairsGives) {
  for (const double side : {0.004, 0.02, 0.5, 100.0}) {  // of the box that vertices lie in, mm
    for (unsigned seed = 1; seed <= 5; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> in(-0.5 * side, 0.5 * side);
      Mesh m;
      for (int i = 0; i < 400; ++i) m.vertices.push_back({in(random), in(random), in(random)});
      for (int i = 0; i < 400; ++i) {  // and as many beside them, most of them within the weld
        const Vec3 v = m.vertices[random() % 400U];
        m.vertices.push_back(v + (kWeldMm / side) * Vec3{in(random), in(random), in(random)});
      }
      EXPECT_EQ(welded(m), by_all_pairs(m)) << side << " " << seed;
    }
  }
}

}  // namespace
}  // namespace capstan::geometry
