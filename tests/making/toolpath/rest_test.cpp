#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;

double length_of_cut(const GeneratedPath& g) {
  double out = 0.0;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (g.path.kind[i] == model::MoveKind::kRapid) continue;
    out += norm(g.path.point(i) - g.path.point(i - 1));
  }
  return out;
}

/// What is measured of a wide cutter and a narrow one after it.
struct Outcome {
  double residual_mm = 0.0;  ///< highest material over the floor where the narrow cutter reaches
  double rest_share = 0.0;   ///< length of its path against clearing everything with it
};

Outcome cut_both(const Region& area, double wide, double narrow, double depth, double allowance,
                 const std::string& name) {
  Outcome out;
  const auto prepared = [&](double d) {
    PathJob t = area_job(area, depth, d);
    t.axial_depth_mm = 4.0;
    t.radial_depth_mm = 0.4 * d;
    t.allowance_side_mm = allowance;
    t.allowance_bottom_mm = 0.2;
    return t;
  };
  Job job;
  PathJob first = prepared(wide);
  first.rest_follows = true;
  PathJob second = prepared(narrow);
  second.cleared_by = Cleared{wide, 0.0, allowance};
  const auto a = generate(first, job);
  const auto b = generate(second, job);
  EXPECT_TRUE(a) << name << ": " << a.error().message;
  EXPECT_TRUE(b) << name << ": " << b.error().message;
  if (!a || !b) return out;
  EXPECT_THAT(job.diagnostics(), testing::IsEmpty()) << name;
  plot(*b, area, name);
  EXPECT_THAT(rule_breaks(second, *b), testing::IsEmpty()) << name;
  EXPECT_LE(gouge_mm(*b, area, 0.5 * narrow + allowance, -1e-6), 0.003) << name;
  const auto box = geometry::bounds(area);
  HeightMap map(box.lo - Vec2{5, 5}, box.hi + Vec2{5, 5}, 0.25, 0.0);
  EXPECT_THAT(map.run(*a, first.cutter).faults, testing::IsEmpty()) << name;
  EXPECT_THAT(map.run(*b, second.cutter).faults, testing::IsEmpty()) << name;
  const double margin = 0.5 * narrow + allowance;
  const Region can = geometry::offset(geometry::offset(area, -margin), 0.5 * narrow - 0.3);
  out.residual_mm = map.highest(can) + depth - 0.2;
  PathJob whole = second;
  whole.cleared_by.reset();
  const auto all = generate(whole, job);
  EXPECT_TRUE(all);
  if (all) out.rest_share = length_of_cut(*b) / length_of_cut(*all);
  return out;
}

TEST(RestMachining, CutsOnlyTheCornersThatSixteenLeftInAPocketOfRadiusSix) {
  const Region pocket = geometry::rounded_rectangle({0, 0}, {100, 60}, 6.0);
  const Outcome o = cut_both(pocket, 16.0, 10.0, 12.0, 0.3, "rest_corners");
  EXPECT_NEAR(o.residual_mm, 0.0, 1e-4);
  EXPECT_LT(o.rest_share, 0.25) << "four corners against the whole floor";
}

TEST(RestMachining, EntersPassagesThatTheWideCutterCouldNot) {
  Region pocket = geometry::rounded_rectangle({0, 0}, {100, 60}, 6.0);
  pocket = geometry::subtract(pocket, geometry::rectangle({45, -1}, {55, 24}));
  pocket = geometry::subtract(pocket, geometry::rectangle({45, 36}, {55, 61}));  // a gate of 12 mm
  const Outcome o = cut_both(pocket, 20.0, 8.0, 8.0, 0.3, "rest_gate");
  EXPECT_NEAR(o.residual_mm, 0.0, 1e-4);
  EXPECT_LT(o.rest_share, 0.6);
}

TEST(RestMachining, GoesIntoTheSolidWhereTheWideCutterNeverWas) {
  // Two chambers: the smaller one is too narrow for the first cutter.
  const Region pocket =
      geometry::unite(geometry::rounded_rectangle({0, 0}, {50, 50}, 6.0),
                      geometry::unite(geometry::rectangle({49, 20}, {70, 29}),
                                      geometry::rounded_rectangle({69, 18}, {90, 31}, 4.5)));
  const Outcome o = cut_both(pocket, 16.0, 8.0, 6.0, 0.2, "rest_chamber");
  EXPECT_NEAR(o.residual_mm, 0.0, 1e-4);
}

TEST(RestMachining, LeavesNoFeatherEdgesOnFinishedWalls) {
  // A finishing pair without allowance, measured on a fine grid along the walls.
  const Region pocket = geometry::rounded_rectangle({0, 0}, {40, 30}, 4.0);
  PathJob first = area_job(pocket, 3.0, 14.0);
  first.rest_follows = true;
  PathJob second = area_job(pocket, 3.0, 7.0);
  second.cleared_by = Cleared{14.0, 0.0, 0.0};
  Job job;
  const auto a = generate(first, job);
  const auto b = generate(second, job);
  ASSERT_TRUE(a && b);
  HeightMap map({-2, -2}, {42, 32}, 0.05, 0.0);
  map.run(*a, first.cutter);
  EXPECT_THAT(map.run(*b, second.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(pocket, -0.04)), -3.0, 1e-4);
}

TEST(RestMachining, SaysWhenTheWideCutterLeftNothing) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, 40}, 10.0), 5.0, 12.0);
  t.cleared_by = Cleared{16.0, 0.0, 0.0};
  Job job;
  const auto g = generate(t, job);
  ASSERT_FALSE(g);
  EXPECT_EQ(g.error().code, "TPA-NO-REST");
}

TEST(RestMachining, HoldsForPocketsWithIslandsOfManyKinds) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(12.0, 78.0);
    Region pocket = geometry::rounded_rectangle({0, 0}, {90, 90}, 5.5);
    for (int i = 0; i < 3; ++i) {
      const Vec2 p{at(random), at(random)};
      pocket = geometry::subtract(
          pocket, i == 0 ? geometry::disc(p, 6.0) : geometry::rectangle(p - Vec2{4, 7}, p + Vec2{5, 3}));
    }
    pocket = geometry::offset(geometry::offset(pocket, -4.5), 4.5);
    const Outcome o = cut_both(pocket, 15.0, 8.0, 5.0, 0.25, "rest_islands_" + std::to_string(seed));
    EXPECT_NEAR(o.residual_mm, 0.0, 1e-4) << seed;
  }
}

}  // namespace
}  // namespace capstan::toolpath
