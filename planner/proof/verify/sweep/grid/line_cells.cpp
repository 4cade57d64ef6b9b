// The squared distance s of a centre from the line, and two straight floors a + b s under the outline's
// heights (outline.h), need neither root nor table: two or four cells side by side are compared with them at
// once. Of those that pass, a sphere is compared by its own height at the lower end, and by that of the
// cylinder which it sweeps on the line without ends (way.h): two roots for as many cells. What is told here
// is a bound, so that the two say the same of a cut.
#include "planner/proof/verify/sweep/grid/line_cells.h"

#include <algorithm>
#include <cmath>

namespace capstan::verify {

using geometry::Vec2;

namespace {

constexpr double kSlack = 1e-6;    // mm, mm2: more than rounding
constexpr double kPointMm = 1e-9;  // a line that is no longer is a point
/// mm of a height by a root: at the rim, where it has none, what coordinates of 10 m lose in the square of a
/// distance of 100 mm is 1e-9 mm2.
constexpr double kRootSlack = 1e-4;

std::uint64_t all_of(int count) {
  return count < 64 ? (std::uint64_t{1} << static_cast<unsigned>(count)) - 1 : ~std::uint64_t{0};
}

#if defined(__SSE2__)

/// kWidth cells at once; those behind the last whole kWidth are all marked.
#define CAPSTAN_MARKS(SMALLER, GREATER, ROOT, BITS)                                                 \
  typedef double Cells __attribute__((vector_size(8 * kWidth)));                                    \
  Cells ahead{};                                                                                    \
  for (int i = 0; i < kWidth; ++i) ahead[i] = i;                                                    \
  const double ey = first.y - l.a.y;                                                                \
  const Cells ax = Cells{} + (first.x - l.a.x), wide = Cells{} + cell, from_y = Cells{} + ey;       \
  const Cells per = Cells{} + l.per.x, start = Cells{} + ey * l.per.y, none{}, one = Cells{} + 1.0; \
  const Cells dx = Cells{} + l.d.x, dy = Cells{} + l.d.y, most = Cells{} + l.most;                  \
  const Cells a0 = Cells{} + l.floors[0].at_0, b0 = Cells{} + l.floors[0].per_square;               \
  const Cells a1 = Cells{} + l.floors[1].at_0, b1 = Cells{} + l.floors[1].per_square;               \
  const bool sphere = l.sphere.has_value();                                                         \
  const LineCells::Line::Sphere ball = sphere ? *l.sphere : LineCells::Line::Sphere{};              \
  const Cells square = Cells{} + ball.square, nearest = Cells{} + ball.nearest;                     \
  const Cells from_z = Cells{} + ball.start, rise = Cells{} + ball.rise;                            \
  const Cells upright = Cells{} + ball.upright;                                                     \
  const Cells on = Cells{} + static_cast<double>(kWidth);                                           \
  std::uint64_t out = 0;                                                                            \
  int i = 0;                                                                                        \
  for (; i + kWidth <= count; i += kWidth, ahead += on) {                                           \
    const Cells ex = ax + ahead * wide;                                                             \
    const Cells foot = ex * per + start;                                                            \
    const Cells t = SMALLER(GREATER(foot, none), one);                                              \
    const Cells rx = ex - t * dx, ry = from_y - t * dy;                                             \
    const Cells s = rx * rx + ry * ry;                                                              \
    const Cells low = a0 + b0 * s, high = a1 + b1 * s;                                              \
    Cells stands;                                                                                   \
    __builtin_memcpy(&stands, stock + i, sizeof(stands));                                           \
    int bits = BITS(GREATER(low, high), stands, s, most);                                           \
    if (bits != 0 && sphere) {                                                                      \
      const Cells near = nearest - ROOT(GREATER(square - s, none));                                 \
      const Cells fx = ex - foot * dx, fy = from_y - foot * dy;                                     \
      const Cells over = ROOT(GREATER(square - (fx * fx + fy * fy), none));                         \
      bits &= BITS(GREATER(near, from_z + foot * rise - upright * over), stands, s, most);          \
    }                                                                                               \
    out |= static_cast<std::uint64_t>(static_cast<unsigned>(bits)) << static_cast<unsigned>(i);     \
  }                                                                                                 \
  return out | (all_of(count) & ~all_of(i))

std::uint64_t marks_by_two(const LineCells::Line& l, const double* stock, int count, Vec2 first,
                           double cell) {
  constexpr int kWidth = 2;
#define CAPSTAN_BITS(floor, stands, s, most)                        \
  (__builtin_ia32_movmskpd(__builtin_ia32_cmpltpd(floor, stands)) & \
   __builtin_ia32_movmskpd(__builtin_ia32_cmplepd(s, most)))
  CAPSTAN_MARKS(__builtin_ia32_minpd, __builtin_ia32_maxpd, __builtin_ia32_sqrtpd, CAPSTAN_BITS);
#undef CAPSTAN_BITS
}

[[gnu::target("avx2")]] std::uint64_t marks_by_four(const LineCells::Line& l, const double* stock, int count,
                                                    Vec2 first, double cell) {
  constexpr int kWidth = 4;
  constexpr int kLess = 0x11, kNotMore = 0x12;  // ordered, quiet
#define CAPSTAN_BITS(floor, stands, s, most)                                   \
  (__builtin_ia32_movmskpd256(__builtin_ia32_cmppd256(floor, stands, kLess)) & \
   __builtin_ia32_movmskpd256(__builtin_ia32_cmppd256(s, most, kNotMore)))
  CAPSTAN_MARKS(__builtin_ia32_minpd256, __builtin_ia32_maxpd256, __builtin_ia32_sqrtpd256, CAPSTAN_BITS);
#undef CAPSTAN_BITS
}

#undef CAPSTAN_MARKS

#endif

}  // namespace

bool LineCells::takes_four() {
#if defined(__SSE2__)
  static const bool four = __builtin_cpu_supports("avx2") != 0;
  return four;
#else
  return false;
#endif
}

LineCells::LineCells(const CutterOutline& o, Vec2 a, Vec2 d, double from_z, double to_z, bool four)
    : line_{a, d, {}, o.radius() * o.radius() + kSlack, o.floors(), std::nullopt}, four_(four) {
  const double square = dot(d, d), zmin = std::min(from_z, to_z), dz = to_z - from_z;
  const bool point = square <= kPointMm * kPointMm;
  if (!point) line_.per = (1.0 / square) * d;
  for (auto& f : line_.floors) f.at_0 += zmin - kSlack;
  if (const geometry::ProfilePiece* ball = o.ball()) {
    const double upright = point ? 1.0 : std::sqrt(1.0 + dz * dz / square);
    const double centre = ball->zc_mm - kRootSlack * upright;
    line_.sphere = {ball->radius_mm * ball->radius_mm, zmin + centre, (point ? zmin : from_z) + centre,
                    point ? 0.0 : dz, upright};
  }
}

std::uint64_t LineCells::marks(const double* stock, int count, Vec2 first, double cell) const {
#if defined(__SSE2__)
  return four_ ? marks_by_four(line_, stock, count, first, cell)
               : marks_by_two(line_, stock, count, first, cell);
#else
  (void)stock, (void)first, (void)cell;
  return all_of(count);
#endif
}

}  // namespace capstan::verify
