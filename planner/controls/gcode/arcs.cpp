#include "planner/controls/gcode/arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/controls/gcode/words.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec2;
using geometry::Vec3;

// An arc shorter than this many units of the last decimal has no shape left after rounding.
constexpr double kShortest = 20.0;

Vec3 rounded_point(Vec3 p, int decimals) {
  return {rounded(p.x, decimals), rounded(p.y, decimals), rounded(p.z, decimals)};
}

}  // namespace

int centre_decimals(int decimals) { return std::max(decimals, std::min(decimals + 2, kMostDecimals)); }

Result<std::vector<ArcPiece>> arc_pieces(const model::CutterPath& path, std::size_t move, Vec3 from,
                                         int decimals) {
  const Vec2 centre{path.cx[move], path.cy[move]};
  const double unit = std::pow(10.0, -decimals);
  const double radius = norm(xy(path.point(move)) - centre);
  const double other = norm(xy(path.point(move - 1)) - centre);
  if (!(std::abs(radius - other) <= 10.0 * unit)) {
    return fail("OUT-ARC", "the arc starts at radius " + shortest(other) + " mm and ends at " +
                               shortest(radius) + " mm");
  }
  const double sweep = model::arc_sweep(path, move);
  const int count = sweep > std::numbers::pi + 1e-6 ? 2 : 1;
  const double part = sweep / count;
  const double sagitta = radius * (1.0 - std::cos(0.5 * part));
  std::vector<ArcPiece> out;
  Vec3 at = from;
  for (int k = 1; k <= count; ++k) {
    const Vec3 exact = k == count ? path.point(move) : model::point_on_move(path, move, double(k) / count);
    ArcPiece piece;
    piece.to = rounded_point(exact, decimals);
    const Vec2 chord = xy(piece.to) - xy(at);
    const double length = norm(chord);
    piece.line = sagitta < 0.5 * unit || radius * part < kShortest * unit || length <= 0.0;
    if (!piece.line) {
      const Vec2 u = (1.0 / length) * chord;
      const Vec2 middle = 0.5 * (xy(at) + xy(piece.to));
      const Vec2 relative = centre - (dot(centre - middle, u) * u) - xy(at);
      piece.i = rounded(relative.x, centre_decimals(decimals));
      piece.j = rounded(relative.y, centre_decimals(decimals));
      const double first = std::hypot(piece.i, piece.j);
      const double last = norm(xy(at) + Vec2{piece.i, piece.j} - xy(piece.to));
      if (!(std::abs(first - last) <= unit) || first <= 0.0) {
        return fail("OUT-ARC", "the radii of the arc do not agree after rounding");
      }
    }
    out.push_back(piece);
    at = piece.to;
  }
  return out;
}

}  // namespace capstan::controls::gcode
