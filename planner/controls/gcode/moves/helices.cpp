#include "planner/controls/gcode/moves/helices.h"

#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kSame = 1e-6;  ///< rad, mm: what computing leaves
/// An end that near to where the helix began is neither clearly before nor behind it after rounding, rad.
constexpr double kUnclear = 0.1;
/// Units of the last decimal by which the centre may move: each half turn is off by two of it and by how the
/// start was rounded, 0.71 units, which is less than the 2 units that an arc may be off.
constexpr double kMostMoved = 0.5;

struct Arcs {
  const model::StepResult& step;
  const model::CutterPath& path;
  [[nodiscard]] double feed(std::size_t i) const {
    return step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min;
  }
  [[nodiscard]] double rpm(std::size_t i) const {
    return step.schedule ? step.schedule->spindle_rpm[i] : step.spindle_rpm;
  }
  [[nodiscard]] Vec2 centre(std::size_t i) const { return {path.cx[i], path.cy[i]}; }
  [[nodiscard]] double slope(std::size_t i) const {
    return (path.z[i] - path.z[i - 1]) / model::arc_sweep(path, i);
  }
  /// Whether arc `i` goes on with the helix of arc `first`.
  [[nodiscard]] bool goes_on(std::size_t first, std::size_t i) const {
    return path.kind[i] == path.kind[first] && norm(centre(i) - centre(first)) < kSame &&
           std::abs(slope(i) - slope(first)) < kSame && feed(i) == feed(first) && rpm(i) == rpm(first);
  }
};

}  // namespace

std::optional<Helix> helix_at(const model::StepResult& step, std::size_t move, Vec3 from,
                              const ArcForm& form) {
  const model::CutterPath& path = *step.path;
  if (!model::is_arc(path.kind[move])) return std::nullopt;
  const Arcs arcs{step, path};
  if (std::abs(arcs.slope(move)) < kSame) return std::nullopt;
  double turned = 0.0;
  std::size_t last = move;
  for (std::size_t i = move; i < path.size() && (i == move || arcs.goes_on(move, i)); ++i) {
    // The one before ends at a half turn, where the control's helix can be held against the path's.
    if (std::abs(turned - kPi * std::round(turned / kPi)) > kSame) break;
    turned += model::arc_sweep(path, i);
    last = i;
  }
  if (turned < 2.0 * kPi + kSame) return std::nullopt;
  Helix h;
  h.last_move = last;
  h.to = {rounded(path.x[last], form.decimals), rounded(path.y[last], form.decimals),
          rounded(path.z[last], form.decimals)};
  h.further_turns = static_cast<int>(std::ceil(turned / (2.0 * kPi) - kSame)) - 1;
  const double rest = turned - 2.0 * kPi * h.further_turns;
  const bool whole = xy(h.to) == xy(from);
  if (whole ? std::abs(rest - 2.0 * kPi) > kSame : rest < kUnclear || rest > 2.0 * kPi - kUnclear)
    return std::nullopt;
  Vec2 centre = arcs.centre(move) - xy(from);
  if (!whole) {  // onto the perpendicular bisector of the rounded chord: both radii are equal there
    const Vec2 chord = xy(h.to) - xy(from);
    const Vec2 u = (1.0 / norm(chord)) * chord;
    const double moved = dot(centre - 0.5 * chord, u);
    // All turns go with the centre, and every half turn lies twice as far off.
    if (std::abs(moved) > kMostMoved * std::pow(10.0, -form.decimals)) return std::nullopt;
    centre = centre - moved * u;
  }
  h.i = rounded(centre.x, form.centre_decimals());
  h.j = rounded(centre.y, form.centre_decimals());
  return h;
}

}  // namespace capstan::controls::gcode
