#pragma once

/// The inner loop of level sweeps, compiled more than once for the instruction sets a processor may have. All
/// variants do the same operations on the same eight lanes in the same order: their results are equal to the
/// bit. Nothing but the language itself is included here, so that no shared inline function can be compiled
/// for a processor that is not there.
namespace capstan::stock::rows {

inline constexpr int kLanes = 8;
inline constexpr int kBins = 64;
inline constexpr int kPieces = 12;
/// Thinner removals are skipped, mm: single precision cannot distinguish them from rounding.
inline constexpr float kThinnest = 2e-5F;

/// One piece of the cutter's outline, as geometry::ProfilePiece, in the form that is cheapest to evaluate.
enum class Form { kLevel, kSlant, kBall, kRound };  // kBall: an arc about a point of the axis
struct Piece {
  Form form = Form::kLevel;
  float r0 = 0.0F, r0_squared = 0.0F, z0 = 0.0F, slope = 0.0F;
  float radius = 0.0F, radius_squared = 0.0F, rc = 0.0F, zc = 0.0F;
};

/// Columns of a height map; (x0, y0) is the centre of cell (0, 0).
struct Grid {
  float* top = nullptr;
  float* low = nullptr;
  float* share = nullptr;
  double x0 = 0.0, y0 = 0.0, cell = 0.0;
  int nx = 0, ny = 0;
};

/// A track of a cutter: straight from a to b, round about a centre, or standing (a = b); level, or straight
/// and of a flat, a ball, a bull nose or a cone.
struct Work {
  Piece piece[kPieces];
  int pieces = 0;
  double radius = 0.0;
  double tip = 0.0;                 ///< lowest, above the floor; may lie below it
  double start = 0.0, slope = 0.0;  ///< height of the tip at a, and what it rises per length
  double ax = 0.0, ay = 0.0, bx = 0.0, by = 0.0;
  double ux = 1.0, uy = 0.0;  ///< unit feed direction; X of the section is measured across it
  double length = 0.0;        ///< from a to b
  bool arc = false;           ///< at most a half turn
  double ex = 0.0, ey = 0.0;  ///< unit vectors from the arc's centre to a and b
  double gx = 0.0, gy = 0.0;
  double arc_radius = 0.0, turn = 1.0;  ///< turn: +1 counter-clockwise
  double reach = 0.0;                   ///< cells whose centre is farther from the chord are not touched
  double inner = 0.0;                   ///< cells whose centre is nearer to the chord are covered as a whole
  bool half = false;                    ///< only cells on the side of a to which (hx, hy) points
  double hx = 0.0, hy = 0.0;
  double hollow = 0.0;  ///< cells nearer than this to a are cut already
};

/// Sums of a removal; see Tally.
struct Sums {
  double volume = 0.0, x = 0.0, y = 0.0;  ///< over cell area
  float left = 1e30F, right = -1e30F;     ///< centres of touched cells
  float low[kBins], high[kBins];
};

using Kernel = void (*)(const Grid&, const Work&, Sums&);

[[nodiscard]] Kernel portable();
[[nodiscard]] Kernel avx2();    ///< null if the compiler or the processor lacks it
[[nodiscard]] Kernel avx512();  ///< as above
[[nodiscard]] Kernel best();    ///< chosen once

}  // namespace capstan::stock::rows
