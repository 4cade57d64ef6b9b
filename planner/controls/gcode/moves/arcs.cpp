#include "planner/controls/gcode/moves/arcs.h"

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

/// Where along the arc, as shares of its whole, a piece ends: at quadrants, or after at most half a turn.
std::vector<double> piece_ends(const model::CutterPath& path, std::size_t move, double sweep,
                               bool quadrants) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  constexpr double kSame = 1e-6;  // rad: an end that near to a quadrant is on it
  std::vector<double> out;
  if (!quadrants) {
    if (sweep > std::numbers::pi + 1e-6) out.push_back(0.5);
  } else {
    const Vec2 spoke = xy(path.point(move - 1)) - Vec2{path.cx[move], path.cy[move]};
    const double begin = std::atan2(spoke.y, spoke.x);
    const double way = path.kind[move] == model::MoveKind::kArcCw ? -1.0 : 1.0;
    // Turned so far that the next axis is reached, and a quarter more each time.
    double turned = way > 0.0 ? kQuarter * std::ceil(begin / kQuarter) - begin
                              : begin - kQuarter * std::floor(begin / kQuarter);
    for (; turned < sweep - kSame; turned += kQuarter) {
      if (turned > kSame) out.push_back(turned / sweep);
    }
  }
  out.push_back(1.0);
  return out;
}

/// The centre from the arc's start, rounded: of the four corners of its cell the one that makes both radii
/// agree best with each other and with that of the exact centre.
Vec2 rounded_centre(Vec2 relative, Vec2 chord, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  const auto off = [&](Vec2 c) {
    return std::abs(norm(c) - norm(c - chord)) + std::abs(norm(c) - norm(relative));
  };
  Vec2 best{rounded(relative.x, decimals), rounded(relative.y, decimals)};
  const Vec2 low{std::floor(relative.x / unit) * unit, std::floor(relative.y / unit) * unit};
  for (const Vec2 corner : {low, low + Vec2{unit, 0.0}, low + Vec2{0.0, unit}, low + Vec2{unit, unit}}) {
    const Vec2 c{rounded(corner.x, decimals), rounded(corner.y, decimals)};
    if (off(c) < off(best) - 1e-12) best = c;
  }
  return best;
}

}  // namespace

int ArcForm::centre_decimals() const {
  return std::max(decimals, std::min(decimals + more_centre_decimals, kMostDecimals));
}

Result<std::vector<ArcPiece>> arc_pieces(const model::CutterPath& path, std::size_t move, Vec3 from,
                                         const ArcForm& form) {
  const int decimals = form.decimals;
  const Vec2 centre{path.cx[move], path.cy[move]};
  const double unit = std::pow(10.0, -decimals);
  const double radius = norm(xy(path.point(move)) - centre);
  const double other = norm(xy(path.point(move - 1)) - centre);
  if (!(std::abs(radius - other) <= 10.0 * unit)) {
    return fail("OUT-ARC", "the arc starts at radius " + shortest(other) + " mm and ends at " +
                               shortest(radius) + " mm");
  }
  if (form.largest_radius_mm > 0.0 && radius > form.largest_radius_mm) {
    return fail("OUT-ARC", "the arc has a radius of " + trimmed(radius, 3) + " mm; the control takes " +
                               trimmed(form.largest_radius_mm, 3) + " mm at most");
  }
  const double sweep = model::arc_sweep(path, move);
  std::vector<ArcPiece> out;
  Vec3 at = from;
  double done = 0.0;
  for (const double end : piece_ends(path, move, sweep, form.quadrants)) {
    const double part = sweep * (end - done);
    const double sagitta = radius * (1.0 - std::cos(0.5 * part));
    done = end;
    const Vec3 exact = end == 1.0 ? path.point(move) : model::point_on_move(path, move, end);
    ArcPiece piece;
    piece.to = rounded_point(exact, decimals);
    const Vec2 chord = xy(piece.to) - xy(at);
    const double length = norm(chord);
    piece.line = sagitta < 0.5 * unit || radius * part < kShortest * unit || length <= 0.0;
    if (!piece.line) {
      const Vec2 u = (1.0 / length) * chord;
      const Vec2 middle = 0.5 * (xy(at) + xy(piece.to));
      const Vec2 relative = centre - (dot(centre - middle, u) * u) - xy(at);
      const Vec2 c = form.more_centre_decimals > 0 ? Vec2{rounded(relative.x, form.centre_decimals()),
                                                          rounded(relative.y, form.centre_decimals())}
                                                   : rounded_centre(relative, chord, form.centre_decimals());
      piece.i = c.x;
      piece.j = c.y;
      const double first = std::hypot(piece.i, piece.j);
      const double last = norm(xy(at) + Vec2{piece.i, piece.j} - xy(piece.to));
      const double closure = form.closure_mm > 0.0 ? form.closure_mm : unit;
      if (!(std::abs(first - last) <= closure) || first <= 0.0) {
        return fail("OUT-ARC", "the radii of the arc do not agree after rounding");
      }
    }
    out.push_back(piece);
    at = piece.to;
  }
  return out;
}

}  // namespace capstan::controls::gcode
