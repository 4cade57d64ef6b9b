#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/finish/pass_writer.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/sweep.h"

// Finishing by area: what is steep at constant heights, and what a wider ball left. What is to be avoided,
// and what is said of ridges.

namespace capstan::toolpath::freeform {
namespace {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;
using Way = Run;  // a test has a Run of its own

constexpr double kSize = 30.0, kMiddle = 0.5 * kSize;

template <class F>
Mesh height_field(int n, int rows, const F& f) {
  Mesh m;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= n; ++i)
      m.vertices.push_back({kSize * i / n, kSize * j / rows, f(kSize * i / n, kSize * j / rows)});
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

/// A round cavity in a plane: radius 13 at the top, 6 deep, its wall 70 degrees steep.
double cavity(double x, double y) {
  const double inwards = 13.0 - std::hypot(x - kMiddle, y - kMiddle);
  return std::max(-6.0, std::min(0.0, -std::tan(70.0 / 180.0 * std::numbers::pi) * inwards));
}

/// A trough along y: two walls of 45 degrees, and between them, tangent to both, a round of radius 2 about
/// the line x = 15, z = 0. What a ball of radius R > 2 leaves in it is (R - 2) (1 / cos 45 deg - 1).
double trough(double x, double /*y*/) {
  const double u = std::abs(x - kMiddle), round = 2.0;
  const double edge = round * std::sqrt(0.5);
  return u < edge ? -std::sqrt(round * round - u * u) : -edge + (u - edge);
}

model::Cutter ball(double diameter) {
  model::Cutter c;
  c.id = "ball";
  c.cutter_class = model::CutterClass::kBallEndmill;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = 0.5 * diameter;
  c.maximum_depth_of_cut_mm = 40.0;
  return c;
}

FreeformJob job_on(const Mesh& mesh, const model::Cutter& c, double top) {
  FreeformJob task;
  task.surface = &mesh;
  task.cutter = c;
  task.top_z_mm = top;
  task.security_z_mm = top + 5.0;
  task.bottom_z_mm = geometry::bounds(mesh).lo.z;
  task.scallop_mm = 0.03;
  return task;
}

/// The lowest height of the cutter over where it may be at most, along all moves at feed.
double least_clearance(const Mesh& mesh, const model::Cutter& c, const model::CutterPath& path) {
  const DropCutter drop(mesh);
  const Toroid t = *toroid_of(model::profile_of(c));
  double out = 1e300;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int n = std::max(1, static_cast<int>(std::ceil(model::move_length(path, i) / 0.1)));
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = model::point_on_move(path, i, static_cast<double>(k) / n);
      const double z = drop.drop(t, p.x, p.y);
      if (z != DropCutter::kNoContact) out = std::min(out, p.z - z);
    }
  }
  return out;
}

/// The highest place over a surface, square to it, at least `beside` away from its rim.
template <class F, class Where>
double highest(const stock::HeightMap& map, const F& f, const Where& where) {
  double out = 0.0;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const double x = map.x_of(ix), y = map.y_of(iy), e = 1e-4;
      if (!where(x, y)) continue;
      const double slope = std::hypot(f(x + e, y) - f(x - e, y), f(x, y + e) - f(x, y - e)) / (2.0 * e);
      const double over = map.origin.z + static_cast<double>(map.at(ix, iy).top_mm) - f(x, y);
      out = std::max(out, (over - 0.5 * map.cell_mm * slope) / std::hypot(1.0, slope));
    }
  }
  return out;
}

TEST(Waterline, CutsASteepWallAtConstantHeightsWithTheWallOnItsRight) {
  const Mesh mesh = height_field(60, 60, cavity);
  const auto c = ball(6.0);
  FreeformJob task = job_on(mesh, c, 0.5);
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_GE(least_clearance(mesh, c, out->path), -1e-9);
  // The wall has 70 x 6.4 mm, and passes 0.9 mm apart; a raster would be level on plane and floor only.
  double around = 0.0, wall = 0.0;
  for (std::size_t i = 1; i < out->path.size(); ++i) {
    const Vec3 a = out->path.point(i - 1), b = out->path.point(i);
    if (out->path.role[i] != MoveRole::kCut || a.z != b.z || a.z > -1.0 || a.z < -5.5) continue;
    const double turn = (a.x - kMiddle) * (b.y - kMiddle) - (a.y - kMiddle) * (b.x - kMiddle);
    wall += norm(b - a);
    if (turn > 0.0) around += norm(b - a);  // counter-clockwise in a cavity: the wall on the right
  }
  EXPECT_GT(wall, 200.0);
  EXPECT_GT(around, 0.99 * wall);  // but for links
  auto map = stock::from_box({{0, 0, -7}, {kMiddle, kMiddle, 0.5}}, 0.05);
  stock::cut(map, model::profile_of(c), out->path);
  const double over = highest(map, cavity, [](double x, double y) {
    const double r = std::hypot(x - kMiddle, y - kMiddle);
    return r < 13.0 && r > 12.0;  // the wall, above what the ball leaves at its foot
  });
  EXPECT_LE(over, task.scallop_mm + task.tolerance_mm + 0.005);
}

TEST(RestFinish, CutsWhereTheWiderBallLeftAndNowhereElse) {
  const Mesh mesh = height_field(300, 1, trough);
  const auto wide = ball(10.0), narrow = ball(3.0);
  auto map = stock::from_box({{8, 8, -3}, {22, 22, 6}}, 0.1);
  FreeformJob first = job_on(mesh, wide, 14.0);
  first.area = geometry::rectangle({5, 8}, {25, 22});
  Job job;
  const auto before = finish(first, job);
  ASSERT_TRUE(before) << before.error().message;
  stock::cut(map, model::profile_of(wide), before->path);
  // Near its middle, where what stays stands square on it.
  const auto inside = [](double x, double y) { return std::abs(x - kMiddle) < 0.15 && y > 10.0 && y < 20.0; };
  const double left = (5.0 - 2.0) * (std::sqrt(2.0) - 1.0);
  EXPECT_NEAR(highest(map, trough, inside), left, 0.05);

  FreeformJob rest = job_on(mesh, narrow, 14.0);
  rest.after = wide;
  rest.area = first.area;
  rest.stock = &map;
  const auto after = finish(rest, job);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_GE(least_clearance(mesh, narrow, after->path), -1e-9);
  // The wider ball touches the walls where they are (5 - 2) tan 45 deg farther out than the round, along
  // them.
  const double touched = (2.0 + 3.0) * std::sqrt(0.5);
  for (std::size_t i = 1; i < after->path.size(); ++i) {
    if (after->path.role[i] != MoveRole::kCut) continue;
    EXPECT_LT(std::abs(after->path.x[i] - kMiddle), touched + 2.0 * 0.25) << i;
  }
  auto finished = map;
  stock::cut(finished, model::profile_of(narrow), after->path);
  EXPECT_LE(highest(finished, trough, inside), rest.scallop_mm + rest.tolerance_mm + 0.01);
}

// Of a plane the wider ball leaves nothing.
TEST(RestFinish, HasNothingToCutWhereTheWiderBallReachesAll) {
  const Mesh mesh = height_field(4, 4, [](double x, double) { return 0.2 * x; });
  FreeformJob task = job_on(mesh, ball(4.0), 8.0);
  task.after = ball(10.0);
  Job job;
  const auto out = finish(task, job);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, kNothingToCut);
  task.after = ball(3.0);
  EXPECT_EQ(finish(task, job).error().code, "FRF-CUTTER");
}

const double kFlank = std::tan(std::numbers::pi / 3.0);
/// It rises across passes along x: those between others are needed all over it.
double flank(double /*x*/, double y) { return kFlank * y; }

/// The least distance of the axis from a rectangle, over all that is done at feed.
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

TEST(KeptOutOfAFinish, PassesBetweenOthersEndBeforeIt) {
  const Mesh mesh = height_field(2, 2, flank);
  const Vec2 lo{12, 12}, hi{18, 18};
  for (const double angle : {0.0, 0.3}) {
    FreeformJob task = job_on(mesh, ball(6.0), 53.0);
    task.feed_angle_rad = angle;
    task.avoid = geometry::rectangle(lo, hi);
    Job job;
    const auto out = finish(task, job);
    ASSERT_TRUE(out) << out.error().message;
    EXPECT_GE(nearest_cut(out->path, lo, hi), 3.0 - 1e-5) << angle;
    EXPECT_LE(nearest_cut(out->path, lo, hi), 3.3) << angle;
  }
}

// Lines on either side of it do not follow each other.
TEST(KeptOutOfAFinish, NoPassIsPutWhereItLiesAcrossTheWholeWidth) {
  const Mesh mesh = height_field(2, 2, flank);
  const Vec2 lo{-5, 14}, hi{35, 16};
  FreeformJob task = job_on(mesh, ball(6.0), 53.0);
  task.avoid = geometry::rectangle(lo, hi);
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_GE(nearest_cut(out->path, lo, hi), 3.0 - 1e-5);
  const auto [least, most] = std::minmax_element(out->path.y.begin(), out->path.y.end());
  EXPECT_LT(*least, 1.0);
  EXPECT_GT(*most, 29.0);
}

TEST(KeptOutOfAFinish, WaysAtConstantHeightsEndBeforeIt) {
  const Mesh mesh = height_field(60, 60, cavity);
  const Vec2 lo{24, 13}, hi{34, 17};
  FreeformJob task = job_on(mesh, ball(6.0), 0.5);
  task.avoid = geometry::rectangle(lo, hi);
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_GE(nearest_cut(out->path, lo, hi), 3.0 - 1e-5);
}

/// Puts passes together over a plane z = -10.
struct Writing {
  Mesh mesh = height_field(2, 2, [](double, double) { return -10.0; });
  FreeformJob task = job_on(mesh, ball(6.0), 0.0);
  DropCutter drop{mesh};
  Job job;
  [[nodiscard]] PassWriter writer() const {
    PassWriter out(task, drop, *mill_end_of(model::profile_of(task.cutter)), 1.0, job);
    out.link_within(3.0);
    return out;
  }
};

std::ptrdiff_t entries(const model::CutterPath& path) {
  return std::count(path.role.begin(), path.role.end(), MoveRole::kPlunge);
}

TEST(PassWriter, LinksDoNotCutTheCornerOfWhatIsAvoided) {
  Writing w;
  // From one end to the other 2.56 mm, 2.75 mm from the corner.
  const double far = 3.03 * std::cos(std::numbers::pi / 9.0), near = 3.03 * std::sin(std::numbers::pi / 9.0);
  const Way first{{5.0, 14.0 - near, -10.0}, {14.0 - far, 14.0 - near, -10.0}};
  const Way second{{14.0 - near, 14.0 - far, -10.0}, {14.0 - near, 5.0, -10.0}};
  for (const bool avoided : {false, true}) {
    if (avoided) w.task.avoid = geometry::rectangle({14, 14}, {16, 16});
    PassWriter writer = w.writer();
    writer.add(first);
    writer.add(second);
    EXPECT_EQ(entries(writer.finished()), avoided ? 2 : 1);
  }
}

TEST(PassWriter, LevelsOfAnOpenFlankAllRunTheSameWay) {
  const Writing w;
  std::vector<Level> levels;
  for (int k = 0; k < 3; ++k) {
    const double x = 10.0 + 0.4 * k, z = -1.0 - k;
    levels.push_back({z, {{{x, 5.0, z}, {x, 25.0, z}}}});
  }
  PassWriter writer = w.writer();
  writer.add_levels(levels);
  const auto path = writer.finished();
  int cuts = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.role[i] != MoveRole::kCut) continue;
    ++cuts;
    EXPECT_GT(path.y[i], path.y[i - 1]) << i;
  }
  EXPECT_EQ(cuts, 3);
}

TEST(PassWriter, ALevelWaitsForAllWaysAboveIt) {
  Writing w;
  w.task.to_and_fro = false;  // no links
  // The lower one begins beside the end of the first, and runs below the second.
  const Way first{{10.0, 5.0, -1.0}, {10.0, 10.0, -1.0}}, second{{10.0, 11.0, -1.0}, {10.0, 16.0, -1.0}};
  const Way lower{{10.5, 10.0, -2.0}, {10.5, 16.0, -2.0}};
  PassWriter writer = w.writer();
  writer.add_levels({{-1.0, {first, second}}, {-2.0, {lower}}});
  const auto path = writer.finished();
  std::vector<double> heights;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.role[i] == MoveRole::kCut) heights.push_back(path.z[i]);
  }
  EXPECT_EQ(heights, (std::vector<double>{-1.0, -1.0, -2.0}));
}

TEST(PassWriter, AddsNoMoreOnceItIsToStop) {
  Writing w;
  w.job.request_stop();
  const Way run{{5.0, 5.0, -10.0}, {6.0, 5.0, -10.0}};
  PassWriter writer = w.writer();
  writer.add_levels({{-10.0, {run}}});
  writer.add_nearest_first({{5.0, run}}, {0.0, 1.0});
  EXPECT_TRUE(writer.empty());
  const auto out = finish(w.task, w.job);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, "FRF-STOPPED");
}

TEST(Ridges, OfAStatedStepoverAreToldWithShareAndHeight) {
  const Mesh mesh = height_field(2, 2, flank);
  const auto said = [&](double stepover, double angle) {
    FreeformJob task = job_on(mesh, ball(6.0), 53.0);
    task.stepover_mm = stepover;
    task.feed_angle_rad = angle;
    Job job;
    EXPECT_TRUE(finish(task, job));
    std::string out;
    for (const Diagnostic& d : job.diagnostics()) {
      if (d.code == "FRF-SCALLOP") out += d.message;
    }
    return out;
  };
  const double level = scallop_stepover(3.0, 0.03), up = 0.5 * std::numbers::pi;
  // Passes are twice as far apart along it, and ridges four times as high.
  const std::string across = said(level, 0.0);
  EXPECT_NE(across.find(" % of what the passes run over"), std::string::npos) << across;
  EXPECT_NE(across.find("higher than 0.03 mm, up to 0.1"), std::string::npos) << across;
  EXPECT_NE(across.find("a smaller stepover"), std::string::npos) << across;
  EXPECT_EQ(said(level, up), "");
  EXPECT_EQ(said(0.0, 0.0), "") << "passes between them leave none";
}

// Beside the flank an upright step lies between the same two passes.
TEST(Ridges, AnUprightStepElsewhereLeavesASlopeItsPasses) {
  const auto both = [](double x, double y) {
    return x < 10.0 ? flank(x, y) : y < kMiddle - 0.25 ? 0.0 : kFlank * kMiddle;
  };
  const Mesh mesh = height_field(60, 60, both);
  FreeformJob task = job_on(mesh, ball(6.0), 53.0);
  Job job;
  const auto out = finish(task, job);
  ASSERT_TRUE(out) << out.error().message;
  auto map = stock::from_box({{3, 12, 0}, {7, 18, 40}}, 0.05);
  stock::cut(map, model::profile_of(task.cutter), out->path);
  const double over = highest(map, flank, [](double x, double y) {
    return x > 4.0 && x < 6.0 && y > kMiddle - 1.5 && y < kMiddle + 1.5;
  });
  EXPECT_LE(over, task.scallop_mm + task.tolerance_mm + 0.005);
}

// The left half lies at the stock's height: on the right 0.2 mm stand, on it and up to it all goes over.
TEST(FinishOfAStock, LeavesOutWhatLiesAtItsHeightAlready) {
  const Mesh level = height_field(6, 6, [](double, double) { return 0.0; });
  stock::HeightMap map = stock::from_box({{0, 0, -5}, {kSize, kSize, 0.2}}, 0.25);
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      if (map.x_of(ix) < kMiddle) map.top[map.index(ix, iy)] = 5.0F;
    }
  }
  const model::Cutter c = ball(6.0);
  FreeformJob task = job_on(level, c, 0.2);
  task.area = geometry::rectangle({0, 0}, {kSize, kSize});
  Job job;
  for (const bool known : {false, true}) {
    task.stock = known ? &map : nullptr;
    const auto made = finish(task, job);
    ASSERT_TRUE(made) << made.error().message;
    double least = 1e300, most = -1e300;
    for (std::size_t i = 1; i < made->path.size(); ++i) {
      if (made->path.role[i] != MoveRole::kCut) continue;
      least = std::min({least, made->path.x[i], made->path.x[i - 1]});
      most = std::max(most, made->path.x[i]);
    }
    EXPECT_NEAR(most, kSize, 0.1);
    if (known) {
      EXPECT_LE(least, kMiddle);
      EXPECT_GE(least, kMiddle - 3.0) << "no farther than a radius beside it";
    } else {
      EXPECT_NEAR(least, 0.0, 0.1);
    }
  }
}

}  // namespace
}  // namespace capstan::toolpath::freeform
