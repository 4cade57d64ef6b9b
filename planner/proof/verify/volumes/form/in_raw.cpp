#include "planner/proof/verify/volumes/form/in_raw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"

// Forms against the piece that they are cut from, by lines along a form's axis.
//
// A line is cut by exact spans: where the piece is (the sides of its box, the chord of its bar), less what
// each other form takes of it (from its floor to its top, for a form whose axis is parallel; from step to
// step for one that lies across). What is left above the form's top on a line, and on four lines a hair
// aside, is a lid; in corners where two outlines meet something always stays on one line. Over an outside a
// line ends at the height of what stands beyond the nearest point of its outline: higher than that there is
// raw piece only.
//
// The planner samples the same places by points in the form's frame (model/features/shape/in_piece.cpp); here
// places are judged in the workpiece's frame or by spans, so that one mistake does not pass both.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;

namespace {

constexpr double kSquare = 1.0 - 1e-9;
constexpr double kEndless = 1e300;
constexpr int kLines = 36;        // along a side of the form's area; default, unsourced
constexpr double kStepMm = 0.25;  // along a line through a form that lies across it; default, unsourced
constexpr int kMostSteps = 400;
constexpr double kAsideMm = 0.2;  // of the lines beside a line; default, unsourced
constexpr double kLidMm = 0.02;   // how far a form's top and floor may be off; default, unsourced
constexpr double kThinMm =
    0.1;  // thinner lids between what others take are rounding of a file; default, unsourced

/// Whether a lid counts. One that begins where the form's top may be off has had that taken away already.
bool counts(const std::pair<double, double>& span) {
  constexpr double kTraceMm = 1e-6;
  const bool on_top = span.first <= kLidMm + kTraceMm;
  return span.second - span.first >= (on_top ? kTraceMm : kThinMm);
}

double along(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// The axis of the workpiece that a form's z runs along, and to which side; none for a tilted form.
struct Axis {
  int number = 0;
  double sign = 1.0;
};
std::optional<Axis> axis_of(const Form& f) {
  for (int i = 0; i < 3; ++i) {
    const double part = along(f.frame().z, i);
    if (std::abs(part) >= kSquare) return Axis{i, part > 0.0 ? 1.0 : -1.0};
  }
  return std::nullopt;
}

/// How far a place of the workpiece lies beyond the side of the box that the form's z comes out of from
/// below: above 0 below the underside.
double below_underside(const Box3& box, const Axis& axis, Vec3 p) {
  return axis.sign > 0.0 ? along(box.lo, axis.number) - along(p, axis.number)
                         : along(p, axis.number) - along(box.hi, axis.number);
}

/// Pieces of a line by the way along it, in order and apart.
using Spans = std::vector<std::pair<double, double>>;

Spans common(const Spans& a, const Spans& b) {
  Spans out;
  for (const auto& [a0, a1] : a) {
    for (const auto& [b0, b1] : b) {
      if (std::max(a0, b0) < std::min(a1, b1)) out.emplace_back(std::max(a0, b0), std::min(a1, b1));
    }
  }
  return out;
}

void cut_out(Spans& spans, double from, double to) {
  if (!(from < to)) return;
  const auto met = [&](const auto& span) { return span.first < to && from < span.second; };
  if (std::none_of(spans.begin(), spans.end(), met)) return;
  Spans out;
  for (const auto& [lo, hi] : spans) {
    if (lo < std::min(hi, from)) out.emplace_back(lo, std::min(hi, from));
    if (std::max(lo, to) < hi) out.emplace_back(std::max(lo, to), hi);
  }
  spans = std::move(out);
}

/// A line of the workpiece: `start`, and a direction of length 1.
struct Line {
  Vec3 start, way;
  [[nodiscard]] Vec3 at(double t) const { return start + t * way; }
};

/// What of the line lies in the piece.
Spans within(const Piece& piece, const Line& line) {
  double from = -kEndless, to = kEndless;
  for (int i = 0; i < 3; ++i) {
    const double s = along(line.start, i), w = along(line.way, i);
    const double lo = along(piece.box.lo, i) - s, hi = along(piece.box.hi, i) - s;
    if (std::abs(w) < 1e-12) {
      if (lo > 0.0 || hi < 0.0) return {};
      continue;
    }
    from = std::max(from, std::min(lo / w, hi / w));
    to = std::min(to, std::max(lo / w, hi / w));
  }
  if (piece.round_mm) {
    const Vec3 middle = 0.5 * (piece.box.lo + piece.box.hi);
    const Vec2 s = xy(line.start - middle), w = xy(line.way);
    // |s + t w|^2 = r^2
    const double a = dot(w, w), b = dot(s, w), c = dot(s, s) - *piece.round_mm * *piece.round_mm;
    if (a < 1e-12) {
      if (c > 0.0) return {};
    } else {
      const double square = b * b - a * c;
      if (square <= 0.0) return {};
      from = std::max(from, (-b - std::sqrt(square)) / a);
      to = std::min(to, (-b + std::sqrt(square)) / a);
    }
  }
  return from < to ? Spans{{from, to}} : Spans{};
}

/// Takes from the spans what the form takes away.
void take(const Form& f, const Line& line, Spans& spans) {
  const Vec3 start = f.frame().to_local(line.start);
  const double rise = dot(line.way, f.frame().z);
  if (std::abs(rise) < kSquare) {  // it lies across
    if (spans.empty()) return;
    const double from = spans.front().first, to = spans.back().second;
    const int steps = std::clamp(static_cast<int>(std::ceil((to - from) / kStepMm)), 1, kMostSteps);
    const double step = (to - from) / steps;
    for (int i = 0; i < steps; ++i) {
      if (takes(f, line.at(from + (i + 0.5) * step))) cut_out(spans, from + i * step, from + (i + 1) * step);
    }
    return;
  }
  const auto floor = floor_at(f, xy(start));
  if (!floor) return;
  const bool out_below = f.solid.through && *floor <= -f.depth_mm() + kLidMm;
  const double low = out_below ? -kEndless : *floor - kLidMm;
  const double high = f.kind == ShapeKind::kFace ? kEndless : kLidMm;
  if (rise > 0.0) {
    cut_out(spans, low - start.z, high - start.z);
  } else {
    cut_out(spans, start.z - high, start.z - low);
  }
}

/// A wall on each side of the cutter, and a floor.
bool walled(const Form& f) {
  return f.kind == ShapeKind::kPocket || f.kind == ShapeKind::kSlot || f.kind == ShapeKind::kHole;
}

/// Begins below what others take away from above.
bool lies_below(const Form& f) {
  switch (f.kind) {
    case ShapeKind::kFace:
    case ShapeKind::kChamfer:
    case ShapeKind::kEdgeRound:
    case ShapeKind::kSphericalCap:
    case ShapeKind::kRoundedEnd:
    case ShapeKind::kFreeform:
    case ShapeKind::kToolpath:
      return false;
    default:
      return true;
  }
}

/// How high the part is over a place of the form's frame: to the lowest floor of the faces there, else to
/// `most`.
double part_over(const Form& f, const std::vector<Form>& others, Vec2 p, double most) {
  for (const Form& o : others) {
    if (o.kind != ShapeKind::kFace || dot(o.frame().z, f.frame().z) < kSquare) continue;
    if (!geometry::contains(o.area, xy(o.frame().to_local(f.frame().to_parent({p.x, p.y, 0.0}))))) continue;
    most = std::min(most, dot(o.frame().origin - f.frame().origin, f.frame().z) - o.depth_mm());
  }
  return most;
}

/// The height of what stands beyond the nearest point of the form's outlines, form's frame. Of points that
/// are farther by less than `slack` the lowest counts. `foot`: the piece as it lies under the form.
double beside_outline(const Form& f, const std::vector<Form>& others, Vec2 p, const geometry::Box2& foot,
                      double slack, double most) {
  std::vector<std::pair<double, double>> stands;  // how far, how high
  double nearest_mm = kEndless;
  const auto loop = [&](const geometry::Loop& l) {
    for (std::size_t i = 0; i < l.size(); ++i) {
      const Vec2 a = l[i], d = l[(i + 1) % l.size()] - a;
      const double share = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-300), 0.0, 1.0);
      const Vec2 on = a + share * d;
      const double far = norm(on - p);
      if (far > nearest_mm + slack || !(far > 0.0)) continue;
      const Vec2 beyond = on + (kAsideMm / far) * (on - p);
      if (beyond.x < foot.lo.x || beyond.x > foot.hi.x || beyond.y < foot.lo.y || beyond.y > foot.hi.y)
        continue;
      const auto floor = floor_at(f, beyond);
      if (floor && *floor <= -kLidMm) continue;  // it takes that away, too
      nearest_mm = std::min(nearest_mm, far);
      stands.emplace_back(far, part_over(f, others, beyond, most));
    }
  };
  for (const geometry::Loop& l : f.area.loops) loop(l);
  for (const Island& i : f.islands) {
    for (const geometry::Loop& l : i.area.loops) loop(l);
  }
  for (const auto& [far, high] : stands) {
    if (far <= nearest_mm + slack) most = std::min(most, high);
  }
  return most;
}

}  // namespace

std::string cuts_an_edge(const Form& f, const Piece& raw) {
  const Bore* b = f.bore();
  const auto axis = axis_of(f);
  if (b == nullptr || raw.box.empty() || !axis) return {};
  const double r = f.kind == ShapeKind::kThread ? std::max(0.5 * b->thread_major_mm, b->top_radius_mm)
                                                : std::min(b->top_radius_mm, b->bottom_radius_mm);
  // The rim on either side of the axis, along the sides of the box that the axis is parallel to.
  double beyond = -kEndless;
  for (int i = 0; i < 3; ++i) {
    if (i == axis->number) continue;
    const double middle = along(f.frame().origin, i);
    beyond = std::max({beyond, along(raw.box.lo, i) - (middle - r), middle + r - along(raw.box.hi, i)});
  }
  if (raw.round_mm && axis->number == 2) {
    const Vec3 off = f.frame().origin - 0.5 * (raw.box.lo + raw.box.hi);
    beyond = std::max(beyond, norm(xy(off)) + r - *raw.round_mm);
  }
  if (beyond <= kBeyondMm) return {};
  return (beyond > r ? "its axis lies " + trimmed(beyond - r, 3) + " mm outside the raw piece"
                     : "its circle of " + trimmed(2.0 * r, 3) + " mm runs " + trimmed(beyond, 3) +
                           " mm out over the edge of the raw piece") +
         ": a drill is pushed aside there and breaks";
}

std::string point_runs_through(const Form& f, const Piece& raw, const Piece& part) {
  const Bore* b = f.bore();
  const auto axis = axis_of(f);
  if (b == nullptr || f.kind != ShapeKind::kHole || !(f.tip_mm > 0.0) || raw.box.empty() || !axis) return {};
  if (!std::isfinite(f.tip_mm)) return "the point of its drill has no end; state a tip_angle in radians";
  // Where depth and point end in the workpiece; the part may end above the raw piece.
  const Vec3 floor = f.frame().to_parent({0.0, 0.0, -f.depth_mm()});
  const Vec3 point = f.frame().to_parent({0.0, 0.0, -f.depth_mm() - f.tip_mm});
  const auto below = [&](const Piece& p, Vec3 at) {
    return p.box.empty() ? -kEndless : below_underside(p.box, *axis, at);
  };
  const bool of_part = below(part, point) > below(raw, point) + kBeyondMm;
  const double by = std::max(below(part, point), below(raw, point));
  if (by <= kBeyondMm || std::max(below(part, floor), below(raw, floor)) > kBeyondMm) return {};
  const double full = 2.0 * std::atan(b->bottom_radius_mm / f.tip_mm) * 180.0 / std::numbers::pi;
  return "the point of its drill (" + trimmed(full, 1) + " degrees, " + trimmed(f.tip_mm, 3) +
         " mm long, below a depth of " + trimmed(f.depth_mm(), 3) +
         " mm) runs through the underside of the " + (of_part ? "finished part" : "raw piece") + " by " +
         trimmed(by, 3) + " mm; give the hole a flat bottom, make it " + trimmed(by, 3) +
         " mm less deep, or through";
}

std::string floor_below_part(const Form& f, const Piece& raw, const Piece& part) {
  const auto axis = axis_of(f);
  if (!walled(f) || f.solid.through || f.area.empty() || raw.box.empty() || part.box.empty() || !axis)
    return {};
  const Vec3 floor = f.frame().to_parent({0.0, 0.0, -f.depth_mm()});
  const double by = below_underside(part.box, *axis, floor);
  const double below_raw = below_underside(raw.box, *axis, floor);
  // Only what ends between the two undersides is cut off with the rest of the raw piece.
  if (by <= kBeyondMm || below_raw > kBeyondMm || by <= below_raw + kBeyondMm) return {};
  // What lies beside the part is cut off with all of its floor.
  const auto b = geometry::bounds(f.area);
  Box3 floor_box;
  for (const Vec2 corner : {b.lo, b.hi}) floor_box.add(f.frame().to_parent({corner.x, corner.y, 0.0}));
  for (int i = 0; i < 3; ++i) {
    if (i == axis->number) continue;
    if (along(floor_box.lo, i) > along(part.box.hi, i) || along(floor_box.hi, i) < along(part.box.lo, i))
      return {};
  }
  return "its floor, " + trimmed(f.depth_mm(), 3) + " mm deep, lies " + trimmed(by, 3) +
         " mm below the underside of the finished part, in what is cut off there: make it through, make it " +
         trimmed(by, 3) + " mm less deep, or state the finished part's true size";
}

std::string buried(const Form& f, const std::vector<Form>& others, const Piece& part, double& above_mm) {
  if (!lies_below(f) || f.area.empty() || part.box.empty() || !axis_of(f)) return {};
  Box3 box;  // of the part, form's frame
  for (const double x : {part.box.lo.x, part.box.hi.x}) {
    for (const double y : {part.box.lo.y, part.box.hi.y}) {
      for (const double z : {part.box.lo.z, part.box.hi.z}) box.add(f.frame().to_local({x, y, z}));
    }
  }
  if (box.hi.z <= kLidMm) return {};
  const geometry::Box2 foot{{box.lo.x, box.lo.y}, {box.hi.x, box.hi.y}};
  const auto bounds = geometry::bounds(f.area);
  const Vec2 lo{std::max(bounds.lo.x, foot.lo.x), std::max(bounds.lo.y, foot.lo.y)};
  const Vec2 hi{std::min(bounds.hi.x, foot.hi.x), std::min(bounds.hi.y, foot.hi.y)};
  if (!(lo.x < hi.x && lo.y < hi.y)) return {};
  // The solid that nobody takes over a place, from the form's top up to `top`; the way along a line is the
  // height in the form's frame.
  const auto solid_over = [&](Vec2 p, double top) {
    const Line line{f.frame().to_parent({p.x, p.y, 0.0}), f.frame().z};
    Spans spans = common(within(part, line), {{kLidMm, top}});
    for (const Form& o : others) {
      if (spans.empty()) break;
      take(o, line, spans);
    }
    return spans;
  };
  // Wide below a narrower hole on its axis and open at the underside: it is cut from below.
  const bool open_below = f.solid.through || -f.depth_mm() <= box.lo.z + kLidMm;
  if (f.bore() != nullptr && open_below && !others.empty()) {
    const Spans over_axis = solid_over({0.0, 0.0}, box.hi.z);
    if (std::none_of(over_axis.begin(), over_axis.end(), counts)) return {};
  }
  const Vec2 cell = (1.0 / kLines) * (hi - lo);
  double above = 0.0, volume = 0.0;
  Vec3 at;
  for (int i = 0; i < kLines * kLines; ++i) {
    tick(4);
    const Vec2 p{lo.x + (i % kLines + 0.5) * cell.x, lo.y + (i / kLines + 0.5) * cell.y};
    const auto own = floor_at(f, p);
    if (!own || *own > -kLidMm) continue;
    const double top =
        f.kind == ShapeKind::kOutside ? beside_outline(f, others, p, foot, norm(cell), box.hi.z) : box.hi.z;
    Spans lid = solid_over(p, top);
    for (const Vec2 aside :
         {Vec2{kAsideMm, 0.0}, Vec2{-kAsideMm, 0.0}, Vec2{0.0, kAsideMm}, Vec2{0.0, -kAsideMm}}) {
      if (lid.empty()) break;
      lid = common(lid, solid_over(p + aside, top));
    }
    for (const auto& span : lid) {
      if (!counts(span)) continue;
      const auto [from, to] = span;
      volume += cell.x * cell.y * (to - from);
      if (to <= above) continue;
      above = to;
      at = f.frame().to_parent({p.x, p.y, above});
    }
  }
  if (!(above > 0.0)) return {};
  above_mm = above;
  return "up to " + trimmed(above, 3) + " mm of the piece stand above its top, at (" + trimmed(at.x, 2) +
         ", " + trimmed(at.y, 2) + ", " + trimmed(at.z, 2) + ") (about " + trimmed(volume, 0) +
         " mm3), and no feature takes them away; place its top on the surface, or add the feature that opens "
         "it";
}

double unstated_corner_mm(double depth_mm) {
  constexpr double kLeastMm = 3.0, kOfDepth = 1.0 / 6.0;
  return std::max(kLeastMm, kOfDepth * depth_mm);
}

}  // namespace capstan::verify::volumes
