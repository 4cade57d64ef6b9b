#include <gtest/gtest.h>

#include <algorithm>
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

/// Length of the cuts at one height of which a cutter of this radius sweeps nothing that stands, told on a
/// grid.
double idle_mm(const GeneratedPath& before, const model::Cutter& wide, const GeneratedPath& g,
               const model::Cutter& cutter, const Region& area, double* whole_mm) {
  constexpr double kCell = 0.05;
  const auto box = geometry::bounds(area);
  const auto nx = static_cast<std::size_t>((box.hi.x - box.lo.x) / kCell) + 1;
  const auto ny = static_cast<std::size_t>((box.hi.y - box.lo.y) / kCell) + 1;
  std::vector<bool> stands(nx * ny, true);
  const auto sweep = [&](Vec2 p, double r) {
    bool met = false;
    for (std::size_t j = 0; j < ny; ++j) {
      const double y = box.lo.y + kCell * static_cast<double>(j);
      if (std::abs(y - p.y) > r) continue;
      for (std::size_t i = 0; i < nx; ++i) {
        const Vec2 q{box.lo.x + kCell * static_cast<double>(i), y};
        if (!stands[j * nx + i] || norm(q - p) > r) continue;
        stands[j * nx + i] = false;
        met = met || geometry::contains(area, q);
      }
    }
    return met;
  };
  const auto run = [&](const GeneratedPath& path, double r) {
    double idle = 0.0;
    *whole_mm = 0.0;
    for (std::size_t i = 1; i < path.path.size(); ++i) {
      if (path.path.role[i] != model::MoveRole::kCut || path.path.z[i] != path.path.z[i - 1]) continue;
      const double way = model::move_length(path.path, i);
      const int n = std::max(1, static_cast<int>(std::ceil(way / 0.2)));
      for (int k = 1; k <= n; ++k) {
        const auto p = model::point_on_move(path.path, i, static_cast<double>(k) / n);
        if (!sweep({p.x, p.y}, r)) idle += way / n;
      }
      *whole_mm += way;
    }
    return idle;
  };
  run(before, 0.5 * wide.cutting_diameter_mm + 0.02);
  return run(g, 0.5 * cutter.cutting_diameter_mm);
}

// The ring round a corner's rest is closed; from its end back to its beginning there is nothing to cut.
TEST(RestMachining, DoesNotGoBackThroughAirAtTheFeedOfACut) {
  PathJob second = area_job(geometry::rounded_rectangle({0, 0}, {30, 20}, 2.0), 3.0, 3.0);
  second.cleared_by = Cleared{12.0, 0.0, 0.0};
  PathJob first = area_job(second.shape.area, 3.0, 12.0);
  first.rest_follows = true;
  Job job;
  const auto wide = generate(first, job);
  const auto g = generate(second, job);
  ASSERT_TRUE(wide && g);
  EXPECT_THAT(rule_breaks(second, *g), testing::IsEmpty());
  double whole_mm = 0.0;
  const double idle = idle_mm(*wide, first.cutter, *g, second.cutter, second.shape.area, &whole_mm);
  EXPECT_LT(idle, 0.4 * whole_mm) << "of " << whole_mm << " mm";
}

TEST(RestMachining, CutsAllLevelsOfACornerBeforeTheNextCorner) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, 40}, 2.0), 4.0, 3.0);
  t.axial_depth_mm = 1.0;
  t.cleared_by = Cleared{12.0, 0.0, 0.0};
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  int corners = 0, rapids = 0;
  Vec2 last{30, 20};
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const auto p = g->path.point(i), before = g->path.point(i - 1);
    if (g->path.kind[i] == model::MoveKind::kRapid && norm(Vec2{p.x - before.x, p.y - before.y}) > 1e-6)
      ++rapids;
    if (g->path.role[i] != model::MoveRole::kCut) continue;
    if ((p.x < 30) != (last.x < 30) || (p.y < 20) != (last.y < 20) || corners == 0) ++corners;
    last = {p.x, p.y};
  }
  EXPECT_EQ(corners, 4);
  EXPECT_EQ(rapids, 3) << "from corner to corner, not from level to level";
  HeightMap map({-2, -2}, {62, 42}, 0.2, 0.0);
  PathJob first = area_job(t.shape.area, 4.0, 12.0);
  first.rest_follows = true;
  const auto wide = generate(first, job);
  ASSERT_TRUE(wide);
  map.run(*wide, first.cutter);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(t.shape.area, -0.3)), -4.0, 1e-4) << "something stays in a corner";
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

/// A corner radius clears less at the floor than the flank takes; the flank reaches the rest all the same.
TEST(RestMachining, OfACutterWithACornerRadiusReachesEveryCorner) {
  const double corner = 4.2;
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, 40}, corner), 6.0, 8.0);
  t.cutter.cutter_class = model::CutterClass::kBullnoseEndmill;
  t.cutter.corner_radius_mm = 2.0;
  t.cleared_by = Cleared{12.0, 0.0, 0.0};
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  for (const Vec2 middle :
       {Vec2{corner, corner}, {60 - corner, corner}, {60 - corner, 40 - corner}, {corner, 40 - corner}}) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < g->path.size(); ++i) {
      const auto p = g->path.point(i);
      nearest = std::min(nearest, norm(Vec2{p.x, p.y} - middle));
    }
    // The centres of a cutter of 4 mm in a corner of 4.2 lie 0.2 mm about its middle.
    EXPECT_LT(nearest, 0.25) << middle.x << ' ' << middle.y;
  }
}

}  // namespace
}  // namespace capstan::toolpath
