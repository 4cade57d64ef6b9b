#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <numbers>
#include <random>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;
using model::CutterClass;
using model::MoveRole;

template <class F>
Mesh surface(int n, double size, const F& f) {
  Mesh m;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i)
      m.vertices.push_back({size * i / n, size * j / n, f(size * i / n, size * j / n)});
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

double waves(double x, double y) { return -6.0 + 4.0 * std::sin(0.16 * x) * std::cos(0.13 * y); }
/// A dome beside an upright step: what a height field can be worst at.
double dome_and_step(double x, double y) {
  const double r2 = (x - 20.0) * (x - 20.0) + (y - 25.0) * (y - 25.0);
  const double dome = r2 < 144.0 ? std::sqrt(144.0 - r2) - 14.0 : -14.0;
  return x > 40.0 ? std::max(dome, -3.0) : dome;
}

model::Cutter cutter(CutterClass kind, double diameter, double corner) {
  model::Cutter c;
  c.id = "t";
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 40.0;
  c.maximum_ramp_angle_rad = 3.0 * std::numbers::pi / 180.0;
  return c;
}

FreeformJob job_on(const Mesh& mesh, const model::Cutter& c) {
  FreeformJob task;
  task.surface = &mesh;
  task.cutter = c;
  task.top_z_mm = 0.0;
  task.security_z_mm = 10.0;
  task.bottom_z_mm = -20.0;
  task.feed_angle_rad = 0.3;
  task.axial_depth_mm = 2.0;
  task.stepover_mm = 4.0;
  return task;
}

/// Lowest distance of the path above where the cutter may be at most, by letting it down all along the feed
/// moves, and the largest height above it on cutting moves.
struct Clearance {
  double least = 1e300, most = -1e300;
};
Clearance clearance(const Mesh& mesh, const model::Cutter& c, const model::CutterPath& path,
                    double allowance) {
  const DropCutter drop(mesh);
  const Toroid t = *toroid_of(model::profile_of(c));
  Clearance out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int n = std::max(1, static_cast<int>(std::ceil(model::move_length(path, i) / 0.05)));
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = model::point_on_move(path, i, static_cast<double>(k) / n);
      const double z = drop.drop(t, p.x, p.y, allowance);
      if (z == DropCutter::kNoContact) continue;
      out.least = std::min(out.least, p.z - z);
      if (path.role[i] == MoveRole::kCut) out.most = std::max(out.most, p.z - z);
    }
  }
  return out;
}

/// Rapids stay out of material, and those that travel sideways run on the security plane.
void expect_safe_rapids(const model::CutterPath& path, const FreeformJob& task) {
  auto map =
      task.stock ? *task.stock : stock::from_box({{0, 0, task.bottom_z_mm}, {50, 50, task.top_z_mm}}, 0.25);
  const auto profile = model::profile_of(task.cutter);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double removed = stock::cut(map, profile, path, i);
    if (path.kind[i] != model::MoveKind::kRapid) continue;
    EXPECT_EQ(removed, 0.0) << i;
    if (xy(path.point(i)) != xy(path.point(i - 1))) {
      EXPECT_EQ(path.z[i], task.security_z_mm) << i;
      EXPECT_EQ(path.z[i - 1], task.security_z_mm) << i;
    }
  }
}

void save(const char* name, const model::CutterPath& path) {
  const char* folder = std::getenv("CAPSTAN_SAVE_PATHS");
  if (folder == nullptr) return;
  std::ofstream out(std::string(folder) + "/" + name + ".csv");
  for (std::size_t i = 0; i < path.size(); ++i) {
    out << path.x[i] << ' ' << path.y[i] << ' ' << path.z[i] << ' ' << static_cast<int>(path.kind[i]) << ' '
        << static_cast<int>(path.role[i]) << '\n';
  }
}

/// The least distance of the axis from a rectangle, over all that is cut.
double nearest_cut(const model::CutterPath& path, Vec2 lo, Vec2 hi) {
  double out = 1e300;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == model::MoveKind::kRapid) continue;
    const int n = std::max(1, static_cast<int>(std::ceil(model::move_length(path, i) / 0.05)));
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = model::point_on_move(path, i, static_cast<double>(k) / n);
      out = std::min(
          out, std::hypot(std::max({lo.x - p.x, 0.0, p.x - hi.x}), std::max({lo.y - p.y, 0.0, p.y - hi.y})));
    }
  }
  return out;
}

TEST(KeptOut, OfWhatHoldsThePieceTheCutterStaysItsRadiusAway) {
  const Mesh mesh = surface(60, 50.0, waves);
  const Vec2 lo{18, 20}, hi{26, 30};
  Job job;
  for (const bool last : {false, true}) {
    const auto c =
        last ? cutter(CutterClass::kBallEndmill, 6.0, 3.0) : cutter(CutterClass::kEndmill, 8.0, 0.0);
    FreeformJob task = job_on(mesh, c);
    if (last) task.stepover_mm = 1.0;
    const auto make = [&] { return last ? finish(task, job) : rough(task, job); };
    const auto over = make();
    ASSERT_TRUE(over) << over.error().message;
    EXPECT_EQ(nearest_cut(over->path, lo, hi), 0.0);
    task.avoid = geometry::rectangle(lo, hi);
    const auto around = make();
    ASSERT_TRUE(around) << around.error().message;
    const double radius = 0.5 * c.cutting_diameter_mm;
    EXPECT_GE(nearest_cut(around->path, lo, hi), radius);
    EXPECT_LE(nearest_cut(around->path, lo, hi), 1.1 * radius) << "and not farther than it must";
  }
}

TEST(ScallopStepover, LeavesThatRidgeOnAPlane) {
  const double s = scallop_stepover(3.0, 0.02);
  EXPECT_NEAR(3.0 - std::sqrt(9.0 - s * s / 4.0), 0.02, 1e-12);
}

TEST(Finish, LiesBetweenTheSurfaceAndItsTolerance) {
  const Mesh mesh = surface(60, 50.0, waves);
  const auto ball = cutter(CutterClass::kBallEndmill, 6.0, 3.0);
  FreeformJob task = job_on(mesh, ball);
  task.stepover_mm = 0.0;
  task.scallop_mm = 0.05;
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  save("finish_waves", out->path);
  const Clearance c = clearance(mesh, ball, out->path, 0.0);
  std::printf("[ figures  ] finish: %zu points, %.2e to %.2e mm above the surface (z), stepover %.3f mm\n",
              out->path.size(), c.least, c.most, out->stepover_mm);
  EXPECT_GE(c.least, 0.0);
  EXPECT_LE(c.most, 1.3 * task.tolerance_mm);  // along z; the tolerance holds along the normal
  EXPECT_LE(out->stepover_mm, scallop_stepover(3.0, 0.05) + 1e-12);
  expect_safe_rapids(out->path, task);
}

TEST(Finish, ClimbsAnUprightStepWithoutAGouge) {
  const Mesh mesh = surface(100, 50.0, dome_and_step);
  for (const auto& c :
       {cutter(CutterClass::kBallEndmill, 6.0, 3.0), cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0)}) {
    FreeformJob task = job_on(mesh, c);
    task.stepover_mm = 1.0;
    task.allowance_mm = 0.2;
    Job job;
    const auto out = finish(task, job);
    ASSERT_TRUE(out) << out.error().message;
    EXPECT_GE(clearance(mesh, c, out->path, 0.2).least, 0.0);
    expect_safe_rapids(out->path, task);
  }
}

/// The highest place over a plane z = -20 + slope y, square to it, after a finish of it; mm.
double highest_over(double slope, const FreeformPath& finished, const model::Cutter& ball) {
  auto map = stock::from_box({{0, 0, -21}, {20, 20, 20}}, 0.05);
  stock::cut(map, model::profile_of(ball), finished.path);
  double highest = 0.0;
  for (double y = 6.0; y < 14.0; y += 0.05) {
    for (const double x : {8.0, 10.0, 12.0}) {
      const double over = stock::height_at(map, {x, y}) - (-20.0 + slope * y) - 0.025 * slope;
      highest = std::max(highest, over / std::hypot(1.0, slope));
    }
  }
  return highest;
}

// Across a slope of angle t passes lie 1 / cos t farther apart along it, and their ridges are 1 / cos^2 t
// times as high: 4 times on 60 degrees.
TEST(Finish, PutsPassesBetweenOthersWhereTheSurfaceSlopesAcrossThem) {
  const double slope = std::tan(std::numbers::pi / 3.0);
  const Mesh mesh = surface(4, 20.0, [&](double, double y) { return -20.0 + slope * y; });
  const auto ball = cutter(CutterClass::kBallEndmill, 6.0, 3.0);
  FreeformJob task = job_on(mesh, ball);
  task.top_z_mm = 20.0;
  task.security_z_mm = 30.0;
  task.stepover_mm = 0.0;
  task.scallop_mm = 0.05;
  task.feed_angle_rad = 0.0;
  Job job;
  const auto across = finish(task, job);
  ASSERT_TRUE(across) << across.error().message;
  // A cell of the map stands for places up to half of it higher up the slope.
  EXPECT_LE(highest_over(slope, *across, ball), 0.05 + task.tolerance_mm + 0.005);
  EXPECT_EQ(job.count(Severity::kWarning), 0U);
  // Along the slope they are as far apart as on a level surface, and none lies between.
  task.feed_angle_rad = 0.5 * std::numbers::pi;
  const auto along = finish(task, job);
  ASSERT_TRUE(along) << along.error().message;
  task.scallop_mm = 0.0;
  task.stepover_mm = along->stepover_mm;
  const auto given = finish(task, job);
  ASSERT_TRUE(given);
  EXPECT_EQ(along->path, given->path);
}

TEST(Finish, ScallopsOnAPlaneHaveTheHeightAskedFor) {
  const Mesh mesh = surface(4, 50.0, [](double, double) { return -5.0; });
  const auto ball = cutter(CutterClass::kBallEndmill, 6.0, 3.0);
  FreeformJob task = job_on(mesh, ball);
  task.stepover_mm = 0.0;
  task.scallop_mm = 0.05;
  task.feed_angle_rad = 0.0;
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  auto map = stock::from_box({{0, 0, -10}, {50, 50, -4.5}}, 0.05);
  stock::cut(map, model::profile_of(ball), out->path);
  double highest = -1e300;
  for (double y = 10.0; y < 40.0; y += 0.05) highest = std::max(highest, stock::height_at(map, {25.0, y}));
  EXPECT_LE(highest, -5.0 + 0.05 + task.tolerance_mm);
  EXPECT_GE(highest, -5.0 + 0.04);
}

TEST(Rough, NeverCutsIntoTheAllowanceAndTakesMostOfTheStock) {
  const Mesh mesh = surface(100, 50.0, dome_and_step);
  for (const auto& c :
       {cutter(CutterClass::kEndmill, 8.0, 0.0), cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0),
        cutter(CutterClass::kBallEndmill, 8.0, 4.0)}) {
    FreeformJob task = job_on(mesh, c);
    task.allowance_mm = 0.3;
    Job job;
    const auto out = rough(task, job);
    ASSERT_TRUE(out) << out.error().message;
    save(c.corner_radius_mm == 0.0   ? "rough_flat"
         : c.corner_radius_mm == 4.0 ? "rough_ball"
                                     : "rough_bull",
         out->path);
    const Clearance clear = clearance(mesh, c, out->path, 0.3);
    auto map = stock::from_box({{0, 0, -20}, {50, 50, 0}}, 0.25);
    const auto target = stock::from_mesh(mesh, -20.0, 0.25);
    const double before = stock::volume(map) - stock::volume(target);
    stock::cut(map, model::profile_of(c), out->path);
    const double after = stock::volume(map) - stock::volume(target);
    std::printf(
        "[ figures  ] rough: %zu moves, %zu levels, least clearance %.2e mm, %.1f %% of %.0f mm3 taken\n",
        out->path.size(), out->levels_z_mm.size(), clear.least, 100.0 * (1.0 - after / before), before);
    EXPECT_GE(clear.least, 0.0);
    EXPECT_EQ(out->levels_z_mm.size(), 7U);
    EXPECT_GT(1.0 - after / before, 0.90);  // allowance and terraces stay
    expect_safe_rapids(out->path, task);
  }
}

TEST(Rough, EntersOnlyByWaysTheCutterKnows) {
  const Mesh mesh = surface(60, 50.0, waves);
  FreeformJob task = job_on(mesh, cutter(CutterClass::kEndmill, 8.0, 0.0));
  task.allowance_mm = 0.3;
  auto map = stock::from_box({{-20, -20, -20}, {70, 70, 0}}, 0.25);  // no way in from beside
  const stock::HeightMap whole = map;
  task.stock = &whole;
  Job job;
  const auto out = rough(task, job);
  ASSERT_TRUE(out);
  const auto profile = model::profile_of(task.cutter);
  int ramps = 0;
  for (std::size_t i = 1; i < out->path.size(); ++i) {
    const double removed = stock::cut(map, profile, out->path, i);
    EXPECT_TRUE(out->path.role[i] != MoveRole::kPlunge || removed < 0.5) << i;
    if (out->path.role[i] != MoveRole::kRamp) continue;
    ++ramps;
    const Vec3 d = out->path.point(i) - out->path.point(i - 1);
    EXPECT_LE(-d.z, norm(xy(d)) * std::tan(task.cutter.maximum_ramp_angle_rad) + 1e-9) << i;
  }
  EXPECT_GT(ramps, 0);
  // Without a ramp and without teeth in the centre there is no way in.
  task.cutter.maximum_ramp_angle_rad = 0.0;
  const auto none = rough(task, job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "FRF-EMPTY");
  EXPECT_GT(job.count(Severity::kWarning), 0U);
}

TEST(Paths, ADirtyMeshIsNotGouged) {
  Mesh mesh = surface(40, 50.0, waves);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(0.0, 50.0);
  std::uniform_real_distribution<double> small(-4.0, 4.0);
  for (int k = 0; k < 60; ++k) {  // splinters through the surface: folds, borders, upright and backward ones
    const Vec3 a{u(random), u(random), -6.0 + small(random)};
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(),
                         {a, a + Vec3{small(random), small(random), small(random)},
                          a + Vec3{k % 4 == 0 ? 0.0 : small(random), k % 4 == 0 ? 0.0 : small(random), 1.5}});
    mesh.triangles.push_back({n, n + 1, n + 2});
    if (k % 3 == 0) mesh.triangles.push_back({n + 2, n + 1, n});
  }
  mesh.triangles.erase(mesh.triangles.begin() + 300, mesh.triangles.begin() + 340);  // and a hole
  const auto ball = cutter(CutterClass::kBallEndmill, 6.0, 3.0);
  FreeformJob task = job_on(mesh, ball);
  task.top_z_mm = 2.0;
  task.allowance_mm = 0.1;
  task.tolerance_mm = 0.02;
  Job job;
  const auto first = rough(task, job);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_GE(clearance(mesh, ball, first->path, 0.1).least, 0.0);
  task.stepover_mm = 1.5;
  const auto second = finish(task, job);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_GE(clearance(mesh, ball, second->path, 0.1).least, 0.0);
}

TEST(Rough, ComesInFromTheSideWhereTheAreaReachesBeyondTheStock) {
  const Mesh mesh = surface(20, 50.0, [](double x, double) { return x > 25.0 ? -1.0 : -9.0; });
  const auto map = stock::from_box({{0, 0, -10}, {50, 50, 0}}, 0.25);
  FreeformJob task = job_on(mesh, cutter(CutterClass::kEndmill, 8.0, 0.0));
  task.stock = &map;
  task.allowance_mm = 0.2;
  task.feed_angle_rad = 0.0;
  task.beside_is_free = true;
  task.area = geometry::rectangle({-6.0, -6.0}, {56.0, 56.0});
  Job job;
  const auto out = rough(task, job);
  ASSERT_TRUE(out) << out.error().message;
  int ramps = 0;
  for (const MoveRole r : out->path.role) ramps += r == MoveRole::kRamp;
  EXPECT_EQ(ramps, 0);
  EXPECT_EQ(job.count(Severity::kWarning), 0U);
  EXPECT_GE(clearance(mesh, task.cutter, out->path, 0.2).least, 0.0);
  expect_safe_rapids(out->path, task);
}

TEST(Rough, ComesInFromBesideWhereTheSurfaceEndsWithTheStock) {
  const Mesh mesh = surface(20, 50.0, [](double x, double) { return -2.0 - 0.12 * x; });
  FreeformJob task = job_on(mesh, cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0));
  task.allowance_mm = 0.3;
  task.feed_angle_rad = 0.0;
  const auto ramps = [&](const stock::HeightMap& stock) {
    task.stock = &stock;
    Job job;
    const auto out = rough(task, job);
    EXPECT_TRUE(out.has_value());
    int n = 0;
    for (const MoveRole r : out->path.role) n += r == MoveRole::kRamp;
    EXPECT_GE(clearance(mesh, task.cutter, out->path, 0.3).least, 0.0);
    return n;
  };
  const auto alike = stock::from_box({{0, 0, -20}, {50, 50, 0}}, 0.25);
  EXPECT_EQ(ramps(alike), 0);
  expect_safe_rapids(rough(task, *std::make_unique<Job>())->path, task);
  // Beside the surface stands what must stay: no way in through it.
  const auto wider = stock::from_box({{-20, -20, -20}, {70, 70, 0}}, 0.25);
  EXPECT_GT(ramps(wider), 0);
}

// Its rapids went down beside the drawn piece as if a sawn one were no larger.
TEST(Rough, RapidsEndAboveARawPieceThatIsNearerThanAMillimetre) {
  const Mesh mesh = surface(20, 50.0, [](double x, double) { return -2.0 - 0.12 * x; });
  FreeformJob task = job_on(mesh, cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0));
  task.allowance_mm = 0.3;
  task.feed_angle_rad = 0.0;
  const auto piece = stock::from_box({{0, 0, -20}, {50, 50, 0}}, 0.25);
  task.stock = &piece;
  Job job;
  const auto out = rough(task, job);
  ASSERT_TRUE(out) << out.error().message;
  const model::CutterPath& path = out->path;
  const auto profile = model::profile_of(task.cutter);
  stock::HeightMap left = piece;
  int near = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 p = path.point(i);
    // Raw is what still stands as high as the piece does.
    if (path.kind[i] == model::MoveKind::kRapid && stock::max_height(left, xy(p), 4.0 + 0.9) >= 0.0) {
      ++near;
      EXPECT_GE(p.z, 0.0) << p.x << ' ' << p.y;
    }
    stock::cut(left, profile, path, i);
  }
  EXPECT_GT(near, 0);
}

TEST(Finish, ReachesTheRimOfASurfaceThatRisesInwards) {
  // A roof: both sides rise to the middle, at 35 degrees.
  const double rise = std::tan(35.0 * std::numbers::pi / 180.0);
  const auto roof = [&](double x, double) { return -18.0 + rise * std::min(x, 50.0 - x); };
  const Mesh mesh = surface(50, 50.0, roof);
  for (const double angle : {0.0, 0.5 * std::numbers::pi}) {
    FreeformJob task = job_on(mesh, cutter(CutterClass::kBallEndmill, 10.0, 5.0));
    task.feed_angle_rad = angle;
    task.stepover_mm = 0.5;
    Job job;
    const auto out = finish(task, job);
    ASSERT_TRUE(out) << out.error().message;
    EXPECT_GE(clearance(mesh, task.cutter, out->path, 0.0).least, 0.0);
    auto map = stock::from_box({{0, 0, -20}, {50, 50, 0}}, 0.1);
    stock::cut(map, model::profile_of(task.cutter), out->path);
    // Ridges of half a millimetre's step on this slope, and the tolerance.
    const double allowed =
        (0.5 * 0.5 / (8.0 * 5.0) / std::pow(std::cos(std::atan(rise)), 2.0) + 0.01 + 0.005) /
        std::cos(std::atan(rise));
    for (double y = 2.0; y < 48.0; y += 1.0) {
      for (const double x : {0.15, 49.85})
        EXPECT_LE(stock::height_at(map, {x, y}) - roof(x, y), allowed + 0.1 * rise) << x << ' ' << y;
    }
  }
}

TEST(Paths, DoNotDependOnTheNumberOfThreads) {
  const Mesh mesh = surface(60, 50.0, waves);
  FreeformJob task = job_on(mesh, cutter(CutterClass::kBallEndmill, 6.0, 3.0));
  task.allowance_mm = 0.2;
  Job one;
  Job four;
  four.threads = 4;
  EXPECT_EQ(rough(task, one)->path, rough(task, four)->path);
  EXPECT_EQ(finish(task, one)->path, finish(task, four)->path);
}

TEST(Paths, ImpossibleTasksAreRefusedByName) {
  const Mesh mesh = surface(4, 50.0, waves);
  Job job;
  FreeformJob task = job_on(mesh, cutter(CutterClass::kEndmill, 6.0, 0.0));
  EXPECT_EQ(finish(task, job).error().code, "FRF-CUTTER");
  task.stepover_mm = 7.0;
  EXPECT_EQ(rough(task, job).error().code, "FRF-VALUE");
  task.stepover_mm = 3.0;
  task.security_z_mm = -8.0;
  EXPECT_EQ(rough(task, job).error().code, "FRF-VALUE");
  task.surface = nullptr;
  EXPECT_EQ(rough(task, job).error().code, "FRF-EMPTY");
  task = job_on(mesh, cutter(CutterClass::kEndmill, 6.0, 0.0));
  task.top_z_mm = -19.0;  // below everything the cutter can reach
  task.security_z_mm = 5.0;
  EXPECT_EQ(rough(task, job).error().code, kNothingToCut);
}

}  // namespace
}  // namespace capstan::toolpath::freeform
