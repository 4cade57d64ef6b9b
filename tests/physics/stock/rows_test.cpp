#include "planner/physics/stock/sweep/rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "planner/physics/stock/height_map.h"

namespace capstan::stock {
namespace {

using rows::Form;

rows::Work random_work(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  rows::Work w;
  w.radius = 2.0 + 4.0 * u(random);
  const auto r = static_cast<float>(w.radius);
  switch (random() % 4) {
    case 0:
      w.pieces = 1;
      break;
    case 1:
      w.piece[0] = {.form = Form::kBall, .radius = r, .radius_squared = r * r, .zc = r};
      w.pieces = 1;
      break;
    case 2: {
      const float disc = 0.7F * r;
      w.piece[1] = {.form = Form::kRound,
                    .r0 = disc,
                    .r0_squared = disc * disc,
                    .radius = r - disc,
                    .rc = disc,
                    .zc = r - disc};
      w.pieces = 2;
      break;
    }
    default:
      w.piece[1] = {.form = Form::kSlant, .r0 = 1.0F, .r0_squared = 1.0F, .slope = 0.6F};
      w.pieces = 2;
  }
  w.tip = 8.0 - 9.0 * u(random);
  w.ax = 30.0 * u(random);
  w.ay = 30.0 * u(random);
  const double turned = 6.283 * u(random);
  w.ux = std::cos(turned);
  w.uy = std::sin(turned);
  w.length = u(random) < 0.2 ? 0.0 : 3.0 * u(random);
  w.bx = w.ax + w.length * w.ux;
  w.by = w.ay + w.length * w.uy;
  w.hx = w.ux;
  w.hy = w.uy;
  w.half = w.length > 0.0 && u(random) < 0.5;
  w.inner = w.radius - 0.3;
  w.reach = w.radius + 0.3;
  if (w.length > 0.0 && u(random) < 0.4) {
    w.arc = true;
    w.arc_radius = 4.0;
    w.ex = w.uy;
    w.ey = -w.ux;
    const double sweep = 0.7;
    w.gx = w.ex * std::cos(sweep) - w.ey * std::sin(sweep);
    w.gy = w.ex * std::sin(sweep) + w.ey * std::cos(sweep);
    w.bx = w.ax + w.arc_radius * (w.gx - w.ex);
    w.by = w.ay + w.arc_radius * (w.gy - w.ey);
    w.length = std::hypot(w.bx - w.ax, w.by - w.ay);
    w.reach += 0.3;
    w.inner -= 0.3;
  }
  if (!w.arc && w.length > 0.0 && u(random) < 0.5) {
    w.slope = 1.6 * (u(random) - 0.5);
    w.start = w.tip - std::min(0.0, w.slope * w.length);
    w.half = w.half && w.slope > 0.0;
  }
  return w;
}

rows::Sums run(rows::Kernel kernel, HeightMap& map, const rows::Work& w) {
  const rows::Grid grid{.top = map.top.data(),
                        .low = map.low.data(),
                        .share = map.share.data(),
                        .x0 = map.x_of(0),
                        .y0 = map.y_of(0),
                        .cell = map.cell_mm,
                        .nx = map.nx,
                        .ny = map.ny};
  rows::Sums sums;
  kernel(grid, w, sums);
  return sums;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Rows, EveryVariantGivesTheSameBits) {
  int compared = 0;
  for (const rows::Kernel other : {rows::avx2(), rows::avx512()}) {
    if (other == nullptr) continue;  // not a variant of this processor
    std::mt19937 random(3);
    HeightMap a = from_cylinder({{0.0, 0.0, 0.0}, {30.0, 30.0, 8.0}}, 14.3, 0.17);
    HeightMap b = a;
    for (int k = 0; k < 800; ++k) {
      const rows::Work w = random_work(random);
      const rows::Sums x = run(rows::portable(), a, w);
      const rows::Sums y = run(other, b, w);
      ASSERT_EQ(std::memcmp(&x, &y, sizeof(x)), 0) << k;
      ASSERT_TRUE(same_bits(a.top, b.top) && same_bits(a.low, b.low) && same_bits(a.share, b.share)) << k;
      ++compared;
    }
  }
  if (compared == 0) GTEST_SKIP() << "this processor has the portable variant only";
}

TEST(Rows, WhatIsTakenIsWhatTheMapLost) {
  std::mt19937 random(4);
  HeightMap map = from_box({{0.0, 0.0, 0.0}, {31.3, 29.1, 8.0}}, 0.17);
  double taken = 0.0;
  const double before = volume(map);
  for (int k = 0; k < 300; ++k) {
    taken += run(rows::best(), map, random_work(random)).volume * map.cell_mm * map.cell_mm;
  }
  EXPECT_NEAR(before - volume(map), taken, 1e-5 * taken);
}

}  // namespace
}  // namespace capstan::stock
