#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "tests/support/paths/outlines.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kNone = DropCutter::kNoContact;

/// The referee: the highest of z(p) - outline(distance) over the points p of each triangle, found by search
/// alone. Over one triangle that is a concave function, so rows and then places in a row are narrowed by
/// golden section around the best of a dense sample. No closed form of a contact is used.
class Referee {
 public:
  Referee(const MillEnd& t, Vec2 axis) : t_(t), axis_(axis) {}

  double over(const Mesh& mesh) {
    for (const auto& t : mesh.triangles) {
      const Vec3 c[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
      triangle(c);
      for (int k = 0; k < 3; ++k) edge(c[k], c[(k + 1) % 3]);
    }
    return best_;
  }

 private:
  [[nodiscard]] double value(Vec3 p) const {
    const double h = t_.height(norm(xy(p) - axis_));
    return std::isinf(h) ? kNone : p.z - h;
  }

  template <class F>
  static double peak(double lo, double hi, const F& f, int samples) {
    double at = lo;
    double best = kNone;
    for (int k = 0; k <= samples; ++k) {
      const double x = lo + (hi - lo) * k / samples;
      const double v = f(x);
      if (v > best) {
        best = v;
        at = x;
      }
    }
    if (best == kNone) return kNone;
    double a = std::max(lo, at - (hi - lo) / samples);
    double b = std::min(hi, at + (hi - lo) / samples);
    constexpr double kGolden = 0.6180339887498949;
    double m = at;
    double fm = best;
    for (int k = 0; k < 70 && b - a > 1e-13; ++k) {  // keeps a point that is known to be feasible inside
      const bool right = b - m > m - a;
      const double x = right ? m + (1.0 - kGolden) * (b - m) : m - (1.0 - kGolden) * (m - a);
      const double fx = f(x);
      if (fx > fm) {
        (right ? a : b) = m;
        m = x;
        fm = fx;
      } else {
        (right ? b : a) = x;
      }
    }
    return std::max(best, fm);
  }

  void edge(Vec3 a, Vec3 b) {
    best_ = std::max(best_, peak(
                                0.0, 1.0, [&](double u) { return value(a + u * (b - a)); }, 200));
  }

  void triangle(const Vec3 (&c)[3]) {
    const auto [ylo, yhi] = std::minmax({c[0].y, c[1].y, c[2].y});
    const double lo = std::max(ylo, axis_.y - t_.radius());
    const double hi = std::min(yhi, axis_.y + t_.radius());
    if (lo >= hi) return;
    const double top = std::max({c[0].z, c[1].z, c[2].z});
    if (top <= best_) return;
    best_ = std::max(best_, peak(
                                lo, hi, [&](double y) { return row(c, y); }, 24));
  }

  [[nodiscard]] double row(const Vec3 (&c)[3], double y) const {
    Vec3 ends[3];
    int n = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3& a = c[k];
      const Vec3& b = c[(k + 1) % 3];
      if (a.y == b.y || (y - a.y) * (y - b.y) > 0.0) continue;
      ends[n++] = a + ((y - a.y) / (b.y - a.y)) * (b - a);
    }
    if (n < 2) return kNone;
    Vec3 p = ends[0];
    Vec3 q = ends[1];
    if (n == 3 && std::abs(ends[2].x - p.x) > std::abs(q.x - p.x)) q = ends[2];
    if (p.x > q.x) std::swap(p, q);
    const double half2 = t_.radius() * t_.radius() - (y - axis_.y) * (y - axis_.y);
    if (half2 < 0.0) return kNone;
    const double lo = std::max(p.x, axis_.x - std::sqrt(half2));
    const double hi = std::min(q.x, axis_.x + std::sqrt(half2));
    if (lo > hi) return kNone;
    const double slope = q.x > p.x ? (q.z - p.z) / (q.x - p.x) : 0.0;
    return peak(
        lo, hi,
        [&](double x) {
          return value({x, y, std::min(std::max(p.z, q.z), p.z + slope * (x - p.x))});
        },
        8);
  }

  MillEnd t_;
  Vec2 axis_;
  double best_ = kNone;
};

Mesh wavy(int n, double size, double height) {
  Mesh m;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = size * i / n;
      const double y = size * j / n;
      m.vertices.push_back({x, y, height * std::sin(0.5 * x) * std::cos(0.37 * y + 0.2 * x)});
    }
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

/// Random triangles through each other: folds, borders, wrong orientation, upright and flat ones, duplicates,
/// needles and points.
Mesh dirty(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 20.0);
  std::uniform_real_distribution<double> small(-3.0, 3.0);
  Mesh m = wavy(8, 20.0, 2.0);
  for (int k = 0; k < 40; ++k) {
    const Vec3 a{u(random), u(random), small(random)};
    Vec3 b = a + Vec3{small(random), small(random), small(random)};
    Vec3 c = a + Vec3{small(random), small(random), small(random)};
    if (k % 5 == 1) b = a + Vec3{0.0, 0.0, 2.0};  // upright
    if (k % 5 == 2) b.z = c.z = a.z;              // level
    if (k % 5 == 3) c = a + 0.5 * (b - a);        // no area
    if (k % 10 == 4) c = a;                       // a needle of no width
    const auto n = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {a, b, c});
    m.triangles.push_back({n, n + 1, n + 2});
    if (k % 3 == 0) m.triangles.push_back({n, n + 2, n + 1});  // its own back
    if (k % 4 == 0) {                                          // a fold: three triangles at one edge
      m.vertices.push_back(a + Vec3{small(random), small(random), -2.0});
      m.triangles.push_back({n, n + 1, n + 3});
      m.vertices.push_back(a + Vec3{small(random), small(random), -2.5});
      m.triangles.push_back({n, n + 1, n + 4});
    }
  }
  return m;
}

MillEnd lens() { return *mill_end_of(test::lens()); }
MillEnd barrel() { return *mill_end_of(test::barrel()); }
MillEnd tapered_ball() { return *mill_end_of(test::tapered_ball()); }
MillEnd cone() { return *mill_end_of(geometry::cone_profile(6.0, 2.0, 20.0, 1.0)); }
MillEnd pointed() { return *mill_end_of(geometry::cone_profile(6.0, 2.0, 20.0)); }

const Toroid kBall{0.0, 3.0};
const Toroid kFlat{3.0, 0.0};
const Toroid kBull{2.0, 1.0};
const Toroid kNearlyFlat{2.99, 0.01};

void compare(const Mesh& mesh, const MillEnd& t, int points, unsigned seed) {
  const DropCutter cutter(mesh);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-4.0, 24.0);
  double gouge = 0.0;
  double high = 0.0;
  for (int k = 0; k < points; ++k) {
    const Vec2 p{u(random), u(random)};
    const double z = cutter.drop(t, p.x, p.y);
    const double referee = Referee(t, p).over(mesh);
    if (referee == kNone && z == kNone) continue;
    if (referee == kNone) {
      // The disc touches less than the referee's samples can find.
      continue;
    }
    gouge = std::max(gouge, referee - z);
    high = std::max(high, z - referee);
  }
  std::printf("[ figures  ] radius %.2f ball %.2f: lowest below the referee %.3g mm, highest above %.3g mm\n",
              t.radius(), t.ball_mm(), gouge, high);
  EXPECT_LT(gouge, 1e-9);
  EXPECT_LT(high, 1e-6);
}

class DropCutterAgainstReferee : public testing::TestWithParam<MillEnd> {};
INSTANTIATE_TEST_SUITE_P(Cutters, DropCutterAgainstReferee,
                         testing::Values(kBall, kFlat, kBull, kNearlyFlat, lens(), barrel(), tapered_ball(),
                                         cone(), pointed()));

TEST_P(DropCutterAgainstReferee, AgreesOnAWavyMesh) { compare(wavy(16, 20.0, 3.0), GetParam(), 60, 3); }
TEST_P(DropCutterAgainstReferee, AgreesOnDirtyMeshes) {
  for (const unsigned seed : {1U, 2U, 3U}) compare(dirty(seed), GetParam(), 60, seed + 50);
}

Mesh plane(double slope) {
  Mesh m;
  m.vertices = {{-50, -50, -50 * slope}, {50, -50, 50 * slope}, {50, 50, 50 * slope}, {-50, 50, -50 * slope}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  return m;
}

TEST(DropCutter, RestsOnAnInclinedPlaneAsTangencySays) {
  const double slope = 0.6;
  const DropCutter d(plane(slope));
  const double root = std::sqrt(1.0 + slope * slope);
  // Axis over the origin: the ball's centre is 3 off the plane; the flat's rim leads by R uphill.
  EXPECT_NEAR(d.drop(kBall, 0.0, 0.0), 3.0 * root - 3.0, 1e-12);
  EXPECT_NEAR(d.drop(kFlat, 0.0, 0.0), 3.0 * slope, 1e-12);
  EXPECT_NEAR(d.drop(kBull, 0.0, 0.0), 2.0 * slope + root - 1.0, 1e-12);
}

TEST(DropCutter, KeepsTheAllowanceAlongTheNormal) {
  const double slope = 0.6;
  const DropCutter d(plane(slope));
  const double root = std::sqrt(1.0 + slope * slope);
  for (const MillEnd& t : {MillEnd(kBall), MillEnd(kFlat), MillEnd(kBull), lens(), barrel(), tapered_ball(),
                           cone(), pointed()}) {
    EXPECT_NEAR(d.drop(t, 0.0, 0.0, 0.25) - d.drop(t, 0.0, 0.0), 0.25 * root, 1e-12);
  }
}

TEST(DropCutter, SaysNothingBesideTheMesh) {
  const DropCutter d(plane(0.0));
  EXPECT_EQ(d.drop(kBall, 53.001, 0.0), kNone);
  EXPECT_EQ(d.drop(kFlat, 52.999, 0.0), 0.0);
  EXPECT_EQ(DropCutter(Mesh{}).drop(kBall, 0.0, 0.0), kNone);
}

TEST(DropCutter, ManyPointsGiveWhatSinglePointsGiveOnAnyNumberOfThreads) {
  const DropCutter d(wavy(40, 20.0, 3.0));
  std::vector<Vec2> points;
  for (int j = 0; j < 60; ++j) {
    for (int i = 0; i < 60; ++i) points.push_back({20.0 * (j % 2 == 0 ? i : 59 - i) / 59.0, 20.0 * j / 59.0});
  }
  for (const Toroid& t : {kBall, kFlat, kBull}) {
    Job one;
    Job four;
    four.threads = 4;
    const auto a = d.drop(t, points, 0.1, one);
    EXPECT_EQ(a, d.drop(t, points, 0.1, four));
    for (std::size_t i = 0; i < points.size(); i += 7)
      EXPECT_EQ(a[i], d.drop(t, points[i].x, points[i].y, 0.1));
  }
}

TEST(DropCutter, IsClearAtAHeightWhereItsOwnIsNoHigher) {
  // Level ground between the waves: there the height of many contacts is just the one asked for.
  Mesh mesh = wavy(40, 20.0, 3.0);
  for (Vec3& v : mesh.vertices) v.z = std::max(v.z, 0.0);
  const DropCutter d(mesh);
  std::mt19937 random(7);
  const auto drawn = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
  };
  for (const Toroid& t : {kBall, kFlat, kBull}) {
    std::uint32_t hint = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec2 p{drawn(-5.0, 25.0), drawn(-5.0, 25.0)};
      const double allowance = i % 2 == 0 ? 0.0 : 0.3, own = d.drop(t, p.x, p.y, allowance);
      EXPECT_EQ(d.meets(t, p, allowance, hint), own != kNone);
      const double z = i % 3 == 0 ? own : drawn(-3.0, 4.0);
      if (std::isfinite(z)) {
        EXPECT_EQ(d.is_clear(t, p, z, allowance, hint), own <= z) << p.x << " " << p.y << " at " << z;
      }
    }
  }
}

TEST(MillEnd, OfAToroidWrittenAsAnOutlineDropsToTheSamePlace) {
  const Mesh mesh = wavy(16, 20.0, 3.0);
  const DropCutter d(mesh);
  for (const Toroid& t : {kBall, kFlat, kBull}) {
    const auto profile = geometry::bull_profile(2.0 * t.radius(), t.ball_mm, 20.0);
    const MillEnd outline = *geometry::convex_outline(profile);
    EXPECT_DOUBLE_EQ(outline.ball_mm(), t.ball_mm);
    for (int k = 0; k < 400; ++k) {
      const double x = 20.0 * (k % 20) / 19.0, y = k / 20;
      EXPECT_NEAR(d.drop(outline, x, y, 0.2), d.drop(t, x, y, 0.2), 1e-9) << x << ' ' << y;
    }
  }
}

TEST(MillEnd, TheLargestBallThatRollsInsideIsThatOfItsSharpestPlace) {
  EXPECT_DOUBLE_EQ(barrel().ball_mm(), 1.0);
  EXPECT_DOUBLE_EQ(lens().ball_mm(), 0.0);  // its rim
  EXPECT_DOUBLE_EQ(pointed().ball_mm(), 0.0);
}

TEST(MillEnd, IsNoneForAHollowOutline) {
  geometry::CutterProfile hollow{.pieces = {{.r0_mm = 0.0, .r1_mm = 2.0, .slope = 1.0},
                                            {.r0_mm = 2.0, .r1_mm = 4.0, .z0_mm = 2.0, .slope = 0.5}},
                                 .radius_mm = 4.0,
                                 .cutting_length_mm = 10.0};
  EXPECT_FALSE(mill_end_of(hollow));
  hollow.pieces[1].slope = 1.5;
  EXPECT_TRUE(mill_end_of(hollow));
}

TEST(ToroidOf, KnowsFlatBallAndBullAndRefusesCones) {
  const auto bull = toroid_of(geometry::bull_profile(10.0, 1.0, 20.0));
  ASSERT_TRUE(bull);
  EXPECT_DOUBLE_EQ(bull->disc_mm, 4.0);
  EXPECT_DOUBLE_EQ(bull->ball_mm, 1.0);
  EXPECT_DOUBLE_EQ(toroid_of(geometry::ball_profile(10.0, 20.0))->disc_mm, 0.0);
  EXPECT_DOUBLE_EQ(toroid_of(geometry::flat_profile(10.0, 20.0))->ball_mm, 0.0);
  EXPECT_FALSE(toroid_of(geometry::cone_profile(10.0, 2.0, 20.0)));
}

}  // namespace
}  // namespace capstan::toolpath::freeform
