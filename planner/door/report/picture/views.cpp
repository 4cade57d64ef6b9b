#include "planner/door/report/picture/views.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "planner/door/report/picture/thinned.h"
#include "planner/ground/base/number.h"
#include "planner/ground/geometry/moved.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::report::picture {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;

/// Corners of the raw piece in the set-up's frame; of a bar the corners of the polygon that stands for it.
std::vector<Vec3> piece_corners(const model::Plan& plan, std::size_t setup) {
  std::vector<Vec3> out;
  const Box3& box = plan.stock.box;
  if (box.empty()) return out;
  const geometry::Placement piece = model::placed_in(plan, setup);
  for (const double z : {box.lo.z, box.hi.z}) {
    if (plan.stock.cylinder_radius_mm) {
      constexpr int kCorners = 180;
      const Vec3 middle = 0.5 * (box.lo + box.hi);
      const double r = *plan.stock.cylinder_radius_mm;
      for (int i = 0; i < kCorners; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kCorners;
        out.push_back(piece.to_parent({middle.x + r * std::cos(a), middle.y + r * std::sin(a), z}));
      }
      continue;
    }
    for (const double x : {box.lo.x, box.hi.x})
      for (const double y : {box.lo.y, box.hi.y}) out.push_back(piece.to_parent({x, y, z}));
  }
  return out;
}

/// The convex outline of points, counter-clockwise (Andrew's monotone chain).
geometry::Loop outline_of(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  geometry::Loop out;
  for (int side = 0; side < 2; ++side) {
    const std::size_t from = out.size();
    for (const Vec2 p : points) {
      while (out.size() >= from + 2 &&
             geometry::cross(out.back() - out[out.size() - 2], p - out.back()) <= 0.0)
        out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return out;
}

/// Lines along the moves of one kind, in one view, arcs as chords.
class Traced {
 public:
  /// A point that the line goes on to, or begins at where it was broken.
  void to(Vec2 from, Vec2 p) {
    if (broken_) lines_.push_back({from});
    broken_ = false;
    lines_.back().push_back(p);
  }
  void stop() { broken_ = true; }
  [[nodiscard]] const std::vector<Polyline>& lines() const { return lines_; }

 private:
  std::vector<Polyline> lines_;
  bool broken_ = true;
};

/// The number of chords of an arc that leave it by no more than kThinning.
int chords_of(const model::CutterPath& path, std::size_t i, double scale) {
  const double radius =
      scale * geometry::norm(geometry::xy(path.point(i - 1)) - Vec2{path.cx[i], path.cy[i]});
  if (radius <= kThinning) return 1;
  // 2 acos(1 - e / r), from below; above 0 for any radius.
  const double step = 2.0 * std::sqrt(2.0 * kThinning / radius);
  return std::max(1, static_cast<int>(std::ceil(model::arc_sweep(path, i) / step)));
}

/// What a shape takes of the piece, from above.
geometry::Region taken(const model::FeatureShape& shape) {
  geometry::Region out = shape.area;
  for (const model::Island& island : shape.islands) out = geometry::subtract(out, island.area);
  return out;
}

Lines closed_lines(std::vector<Polyline> lines, Colour fill, Colour stroke) {
  return {.lines = std::move(lines), .closed = true, .fill = fill, .stroke = stroke, .width = 0.7};
}

void draw(const model::FeatureShape& shape, const geometry::Placement& piece, const geometry::Region& raw,
          const Views& views, Group& into) {
  const geometry::Placement frame = geometry::compose(piece, shape.frame);
  if (model::lean_rad(frame) > model::kUprightRad) return;  // its area is no plan of it
  const geometry::Region area = geometry::intersect(geometry::moved(taken(shape), frame), raw);
  if (area.empty()) return;
  std::vector<Polyline> loops;
  for (const geometry::Loop& loop : area.loops) {
    loops.emplace_back();
    for (const Vec2 p : loop) loops.back().push_back(views.above({p.x, p.y, 0.0}));
  }
  Lines from_above = closed_lines(thinned(loops, 2000), kFeatureFill, kFeatureEdge);
  // A face is the whole top: what lies in it would not be seen on its colour.
  if (shape.kind == model::ShapeKind::kFace) from_above.fill.reset();
  into.shapes.emplace_back(std::move(from_above));
  const geometry::Box2 b = geometry::bounds(area);
  const double top = std::min(frame.origin.z, views.box.hi.z), bottom = frame.origin.z - shape.depth_mm;
  Lines front{.lines = {{views.front({b.lo.x, 0.0, top}), views.front({b.lo.x, 0.0, bottom}),
                         views.front({b.hi.x, 0.0, bottom}), views.front({b.hi.x, 0.0, top})}},
              .closed = true,
              .stroke = kFeatureEdge,
              .width = 0.7};
  into.shapes.emplace_back(std::move(front));
}

/// The features that steps of the set-up are of, each once, in the order of the steps.
std::vector<model::Ref<model::ManufacturingFeature>> features_in(const model::Plan& plan, std::size_t setup) {
  std::vector<model::Ref<model::ManufacturingFeature>> out;
  std::set<model::AnyRef> seen;
  for (const model::StepResult& s : plan.steps) {
    if (s.setup != setup) continue;
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    if (ws != nullptr && ws->its_feature.set() && seen.insert(ws->its_feature).second)
      out.push_back(ws->its_feature);
  }
  return out;
}

/// The fixtures that end above the piece, or the others, as far as the views show them.
Group fixtures_in(const model::SetupResult& setup, const Views& views, bool above_piece, double piece_top) {
  Group out{.title = "what holds the piece"};
  const Box3& shown = views.box;
  const geometry::Region sheet = geometry::rectangle(geometry::xy(shown.lo), geometry::xy(shown.hi));
  for (const model::FixtureSolid& f : setup.holding.solids) {
    if ((f.top_mm > piece_top) != above_piece) continue;
    const geometry::Region area = geometry::intersect(geometry::clean({f.outline}), sheet);
    const double bottom = std::max(f.bottom_mm, shown.lo.z), top = std::min(f.top_mm, shown.hi.z);
    if (area.empty() || bottom >= top) continue;
    std::vector<Polyline> loops;
    for (const geometry::Loop& loop : area.loops) {
      loops.emplace_back();
      for (const Vec2 p : loop) loops.back().push_back(views.above({p.x, p.y, 0.0}));
    }
    const geometry::Box2 b = geometry::bounds(area);
    out.shapes.emplace_back(closed_lines(std::move(loops), kFixtureFill, kFixtureEdge));
    out.shapes.emplace_back(
        closed_lines({{views.front({b.lo.x, 0.0, bottom}), views.front({b.hi.x, 0.0, bottom}),
                       views.front({b.hi.x, 0.0, top}), views.front({b.lo.x, 0.0, top})}},
                     kFixtureFill, kFixtureEdge));
  }
  return out;
}

/// The box with what of the fixtures lies no farther from it than 0.3 of its longest side: the table that a
/// piece stands on would leave no room for the piece.
Box3 with_fixtures(const Box3& box, const model::Workholding& holding) {
  const Vec3 size = box.size();
  const double reach = 0.3 * std::max({size.x, size.y, size.z});
  const Vec3 far{reach, reach, reach};
  const Box3 most{box.lo - far, box.hi + far};
  const auto held_in = [&](Vec3 p) -> Vec3 {
    return {std::clamp(p.x, most.lo.x, most.hi.x), std::clamp(p.y, most.lo.y, most.hi.y),
            std::clamp(p.z, most.lo.z, most.hi.z)};
  };
  Box3 out = box;
  for (const model::FixtureSolid& f : holding.solids) {
    Box3 solid;
    for (const Vec2 p : f.outline) {
      solid.add({p.x, p.y, f.bottom_mm});
      solid.add({p.x, p.y, f.top_mm});
    }
    const bool apart = solid.empty() || solid.hi.x < most.lo.x || solid.lo.x > most.hi.x ||
                       solid.hi.y < most.lo.y || solid.lo.y > most.hi.y || solid.hi.z < most.lo.z ||
                       solid.lo.z > most.hi.z;
    if (apart) continue;
    out.add(held_in(solid.lo));
    out.add(held_in(solid.hi));
  }
  return out;
}

/// The largest of 1, 2 and 5 times a power of ten that is no larger.
double round_below(double v) {
  const double power = std::pow(10.0, std::floor(std::log10(v)));
  const double digit = v / power;
  return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

Lines stroke_of(std::vector<Polyline> lines, Colour colour, double width, bool dashed = false) {
  return {.lines = std::move(lines), .stroke = colour, .width = width, .dashed = dashed};
}

void axis(Vec2 from, Vec2 to, const char* name, Colour colour, Group& into) {
  const Vec2 along = (1.0 / geometry::norm(to - from)) * (to - from), across{-along.y, along.x};
  into.shapes.emplace_back(stroke_of({{from, to}}, colour, 1.2));
  into.shapes.emplace_back(Lines{
      .lines = {{to + 6.0 * along, to + 2.5 * across, to - 2.5 * across}}, .closed = true, .fill = colour});
  into.shapes.emplace_back(Words{.at = to + 12.0 * along + Vec2{-3.0, 3.5}, .text = name, .colour = colour});
}

}  // namespace

Views views_of(const model::Plan& plan, std::size_t setup, const std::vector<std::size_t>& steps, Vec2 at) {
  Views v{.at = at};
  for (const Vec3 p : piece_corners(plan, setup)) v.box.add(p);
  for (const std::size_t n : steps) {
    const auto& path = plan.steps[n].path;
    if (path == nullptr || path->size() == 0) continue;
    const Box3 b = model::bounds(*path);
    v.box.add(b.lo);
    v.box.add(b.hi);
  }
  if (v.box.empty()) v.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Box3 with_zero = v.box;
  with_zero.add({0.0, 0.0, 0.0});
  const Vec3 size = v.box.size(), grown = with_zero.size();
  const double near = 1.5 * std::max({size.x, size.y, size.z});
  if (grown.x <= near && grown.y <= near && grown.z <= near) v.box = with_zero;
  v.box = with_fixtures(v.box, plan.setups[setup].holding);
  constexpr double kLeast = 1e-3;  // mm: of what has no extent at all
  const Vec3 whole = v.box.size();
  v.scale =
      std::min(kViewsWide / std::max(whole.x, kLeast), kViewsHigh / std::max(whole.y + whole.z, kLeast));
  v.front_y = at.y + v.scale * whole.y + kViewsApart;
  v.size = {v.scale * whole.x, v.scale * (whole.y + whole.z) + kViewsApart};
  return v;
}

PieceDrawn piece_in(const model::Plan& plan, std::size_t setup, const Views& views) {
  PieceDrawn out;
  const auto add = [&out](Group g, bool& any) {
    if (g.shapes.empty()) return;
    any = true;
    out.groups.push_back(std::move(g));
  };
  const std::vector<Vec3> corners = piece_corners(plan, setup);
  std::vector<Vec2> above, front;
  double top = corners.empty() ? 1e300 : -1e300;
  for (const Vec3 p : corners) {
    above.push_back(geometry::xy(p));
    front.push_back({p.x, p.z});
    top = std::max(top, p.z);
  }
  const model::SetupResult& held = plan.setups[setup];
  add(fixtures_in(held, views, false, top), out.fixtures);
  if (!corners.empty()) {
    const geometry::Loop outline = outline_of(above);
    Polyline seen_above, seen_front;
    for (const Vec2 p : outline) seen_above.push_back(views.above({p.x, p.y, 0.0}));
    for (const Vec2 p : outline_of(front)) seen_front.push_back(views.front({p.x, 0.0, p.y}));
    Group raw{.title = "raw piece"};
    raw.shapes.emplace_back(closed_lines({seen_above}, kPieceFill, kPieceEdge));
    raw.shapes.emplace_back(closed_lines({seen_front}, kPieceFill, kPieceEdge));
    add(std::move(raw), out.piece);
    const geometry::Placement piece = model::placed_in(plan, setup);
    const geometry::Region raw_area = geometry::clean({outline});
    for (const auto feature : features_in(plan, setup)) {
      const auto shapes = model::shapes_of(plan.model, feature);
      if (!shapes) continue;  // said where the plan is read
      Group g{.title = plan.model.get<model::ManufacturingFeature>(feature)->its_id.value_or("")};
      for (const model::FeatureShape& s : *shapes) draw(s, piece, raw_area, views, g);
      add(std::move(g), out.features);
    }
  }
  add(fixtures_in(held, views, true, top), out.fixtures);
  return out;
}

Group path_in(const model::StepResult& step, Colour colour, const Views& views, std::size_t most) {
  Group out;
  if (step.path == nullptr || step.path->size() == 0) return out;
  const model::CutterPath& path = *step.path;
  Traced rapid_above, rapid_front, feed_above, feed_front;
  Dots entries{.radius = 1.8, .fill = colour};
  std::set<std::pair<long, long>> marked;  // a dot where there is one already is not seen
  const auto mark = [&](Vec2 p) {
    if (marked.emplace(std::lround(p.x), std::lround(p.y)).second) entries.at.push_back(p);
  };
  bool at_feed = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == model::MoveKind::kDwell) continue;
    const bool rapid = path.kind[i] == model::MoveKind::kRapid;
    if (rapid == at_feed) {
      (at_feed ? feed_above : rapid_above).stop();
      (at_feed ? feed_front : rapid_front).stop();
    }
    if (!rapid && !at_feed) {
      mark(views.above(path.point(i - 1)));
      mark(views.front(path.point(i - 1)));
    }
    at_feed = !rapid;
    const int n = model::is_arc(path.kind[i]) ? chords_of(path, i, views.scale) : 1;
    Vec3 from = path.point(i - 1);
    for (int k = 1; k <= n; ++k) {
      const Vec3 to = k == n ? path.point(i) : model::point_on_move(path, i, static_cast<double>(k) / n);
      (rapid ? rapid_above : feed_above).to(views.above(from), views.above(to));
      (rapid ? rapid_front : feed_front).to(views.front(from), views.front(to));
      from = to;
    }
  }
  for (const Traced* t : {&rapid_above, &rapid_front})
    out.shapes.emplace_back(stroke_of(thinned(t->lines(), most), kRapid, 0.6, true));
  for (const Traced* t : {&feed_above, &feed_front})
    out.shapes.emplace_back(stroke_of(thinned(t->lines(), most), colour, 0.8));
  if (entries.at.size() > most) entries.at.resize(most);
  out.shapes.emplace_back(std::move(entries));
  return out;
}

std::vector<Group> marks_in(const Views& views) {
  constexpr Colour kX{192, 57, 43}, kY{44, 138, 74}, kZ{42, 94, 168};
  constexpr double kAxis = 24.0;
  std::vector<Group> out;
  const Box3& b = views.box;
  if (b.lo.x <= 0.0 && b.hi.x >= 0.0 && b.lo.y <= 0.0 && b.hi.y >= 0.0 && b.lo.z <= 0.0 && b.hi.z >= 0.0) {
    Group zero{.title = "zero"};
    const Vec2 above = views.above({}), front = views.front({});
    axis(above, above + Vec2{kAxis, 0.0}, "X", kX, zero);
    axis(above, above + Vec2{0.0, -kAxis}, "Y", kY, zero);
    axis(front, front + Vec2{kAxis, 0.0}, "X", kX, zero);
    axis(front, front + Vec2{0.0, -kAxis}, "Z", kZ, zero);
    zero.shapes.emplace_back(Dots{.at = {above, front}, .radius = 2.6, .fill = kInk});
    out.push_back(std::move(zero));
  }
  Group names{.title = "views"};
  // At the right: the zero, whose axis reaches above the view from the front, mostly is at the left.
  const double right = views.at.x + views.size.x;
  names.shapes.emplace_back(
      Words{.at = {right, views.at.y - 5.0}, .text = "from above", .colour = kGrey, .ends_there = true});
  names.shapes.emplace_back(Words{
      .at = {right, views.front_y - 5.0}, .text = "from the front", .colour = kGrey, .ends_there = true});
  out.push_back(std::move(names));
  Group bar{.title = "scale"};
  const double mm = round_below(0.25 * kViewsWide / views.scale);
  const double y = views.at.y + views.size.y + 14.0, x = views.at.x, end = x + mm * views.scale;
  bar.shapes.emplace_back(stroke_of(
      {{{x, y - 3.0}, {x, y + 3.0}}, {{x, y}, {end, y}}, {{end, y - 3.0}, {end, y + 3.0}}}, kInk, 1.0));
  bar.shapes.emplace_back(Words{.at = {end + 6.0, y + 3.5}, .text = trimmed(mm, 6) + " mm", .colour = kInk});
  out.push_back(std::move(bar));
  return out;
}

}  // namespace capstan::report::picture
