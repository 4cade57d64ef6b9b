#include "planner/making/piece/raw_piece_limits.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/model/features/in_piece.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/plan/corner_rest.h"

namespace capstan::piece {
namespace {

using model::FeatureShape;
using model::ShapeKind;

constexpr double kNoRadius = 1e300;
constexpr std::ptrdiff_t kMostNamed = 4;  // places that a message names

model::PieceForm raw_piece(const Piece& piece) {
  return {piece.plan.stock.box, piece.plan.stock.cylinder_radius_mm};
}

model::PieceForm part_form(const Piece& piece) {
  return {part_box(piece), piece.plan.stock.cylinder_radius_mm};
}

/// True for shapes that cannot state a corner radius, and for a closed pocket whose file states none.
bool states_no_corner(const Piece& piece, const FeatureShape& s) {
  if (model::has(s.kind, model::ShapeTrait::kOutwards) || model::stops_at_walls(s)) return true;
  if (s.kind != ShapeKind::kPocket || s.open || s.corner_radius_mm > 0.0) return false;
  const auto* p = piece.plan.model.get<model::Pocket>(s.made_of.empty() ? s.feature : s.made_of.back());
  return p != nullptr && !p->orthogonal_radius.set();
}

/// A step is read as a strip on the right of its wall, out to the edge of the raw piece that the file states
/// (areas.cpp). Returns why not if the raw piece that is cut goes farther: that material would stay
/// unreported.
std::string wider_than_read(const Piece& piece, const FeatureShape& s) {
  if (s.kind != ShapeKind::kStep || s.spine.size() < 2) return {};
  const geometry::Vec2 along = s.spine.back() - s.spine.front();
  const geometry::Vec2 right = (1.0 / norm(along)) * geometry::Vec2{along.y, -along.x};
  const geometry::Box3 raw = geometry::transformed(piece.plan.stock.box, inverse(s.frame));
  double most = 0.0, read = 0.0;
  for (const geometry::Loop& loop : s.area.loops) {
    for (const geometry::Vec2 p : loop) read = std::max(read, dot(p - s.spine.front(), right));
  }
  for (const double x : {raw.lo.x, raw.hi.x}) {
    for (const double y : {raw.lo.y, raw.hi.y})
      most = std::max(most, dot(geometry::Vec2{x, y} - s.spine.front(), right));
  }
  constexpr double kSame = 1e-6;  // mm
  if (most <= read + kSame) return {};
  return "the raw piece goes on " + trimmed(most, 1) + " mm beyond its wall, and the step is " +
         trimmed(read, 1) +
         " mm wide as the file states it: state the raw piece in the file, or take a smaller one";
}

}  // namespace

std::string not_in_piece(const Piece& piece, const FeatureShape& s) {
  const model::PieceForm part = part_form(piece);
  if (const std::string wide = wider_than_read(piece, s); !wide.empty()) return wide;
  // Of a part that is given as a mesh the features are not all; what the nouns say of their ends holds there,
  // too.
  if (piece.plan.target_mesh)
    return model::square_corner(piece.plan.model, s, piece.shapes.whole, part, true);
  if (const std::string through = model::point_runs_through(s, raw_piece(piece), part); !through.empty())
    return through;
  if (const std::string floor = model::floor_below_part(s, raw_piece(piece), part); !floor.empty())
    return floor;
  if (model::buried(s, {}, part)) {
    if (const auto lid = model::buried(s, piece.shapes.whole, part))
      return "solid stands above it: " + model::to_text(*lid);
  }
  return model::square_corner(piece.plan.model, s, piece.shapes.whole, part);
}

std::string beyond_travel(const Piece& piece, const FeatureShape& s, double widest_mm) {
  const model::Machine& m = piece.plan.machine;
  const auto travel = [&](std::size_t axis) {
    return m.axes[axis].travel_max_mm - m.axes[axis].travel_min_mm;
  };
  const double x = travel(0), y = travel(1);
  if (!(x > 0.0) || !(y > 0.0) || s.area.empty()) return {};
  const geometry::Box2 b = geometry::bounds(s.area);
  const double length = std::max(b.hi.x - b.lo.x, b.hi.y - b.lo.y);
  // The cutter's middle comes within its radius of both ends; two places are no farther apart than corners.
  if (length - widest_mm <= std::hypot(x, y)) return {};
  return "it is " + trimmed(length, 1) + " mm long, and '" + m.id + "' travels " + trimmed(x, 1) + " x " +
         trimmed(y, 1) +
         " mm: no cutter that there is comes from one end to the other in one set-up; take a " +
         "larger machine, or cut it in parts";
}

double sharp_corner_of(const Piece& piece, const FeatureShape& s) {
  const bool open = s.kind == ShapeKind::kPocket && s.open && !(s.corner_radius_mm > 0.0);
  if (piece.plan.target_mesh || (!open && !states_no_corner(piece, s))) return 0.0;
  const auto corners = model::sharp_corners(s, piece.shapes.whole, part_form(piece));
  const bool any =
      std::any_of(corners.begin(), corners.end(), [](const model::SharpCorner& c) { return !c.open; });
  return any ? model::unstated_corner_mm(s) : 0.0;
}

double corner_in_material(const Piece& piece, const FeatureShape& s) {
  const double r = s.corner_radius_mm;
  if (s.kind != ShapeKind::kPocket || !(r > 0.0)) return r;
  const geometry::Box3 raw = geometry::transformed(piece.plan.stock.box, inverse(s.frame));
  const geometry::Box2 b = geometry::bounds(s.area);
  if (b.lo.x >= raw.lo.x && b.lo.y >= raw.lo.y && b.hi.x <= raw.hi.x && b.hi.y <= raw.hi.y) return r;
  // What a wider mill leaves: the corners, and passages that are hardly wider.
  constexpr double kWider = 1.5;     // times the radius
  constexpr double kNothing = 0.01;  // of r^2: chords of arcs
  const double wide = kWider * r, arc_mm = 0.002 * r;
  const auto left = geometry::subtract(
      s.area, geometry::offset(geometry::offset(s.area, -wide, arc_mm), wide + 2.0 * arc_mm, arc_mm));
  const auto in_raw =
      geometry::intersect(left, geometry::rectangle({raw.lo.x, raw.lo.y}, {raw.hi.x, raw.hi.y}));
  if (geometry::area(in_raw) > kNothing * r * r) return r;
  return std::max(r, 0.5 * std::min(b.hi.x - b.lo.x, b.hi.y - b.lo.y));
}

std::string drawn_square(const Piece& piece, const FeatureShape& s) {
  if (piece.plan.target_mesh) return {};
  return model::drawn_square(piece.plan.model, s, piece.shapes.whole, part_form(piece));
}

double narrowest_mill_mm(const Piece& piece, const std::vector<draft::StepDraft>& steps,
                         const FeatureShape& s) {
  if (s.kind == ShapeKind::kFreeform && piece.plan.target_mesh)
    return 2.0 * last_ball_mm(piece.plan, steps);
  double diameter = kNoRadius;
  const auto of_it = [&](const FeatureShape& other) {
    return other.feature == s.feature && other.member == s.member;
  };
  for (const draft::StepDraft& step : steps) {
    if (std::none_of(step.shapes.begin(), step.shapes.end(), of_it)) continue;
    const auto* ws = piece.plan.model.get<model::MachiningWorkingstep>(step.step);
    const bool made = std::any_of(piece.plan.steps.begin(), piece.plan.steps.end(),
                                  [&](const model::StepResult& r) { return r.step == step.step; });
    if (ws == nullptr || !made || !piece.plan.model.holds<model::MillingTypeOperation>(ws->its_operation))
      continue;
    diameter = std::min(diameter, step.cutter.cutting_diameter_mm);
  }
  return diameter < kNoRadius ? diameter : 0.0;
}

void tell_corners(const Piece& piece, const std::vector<draft::StepDraft>& steps, Job& job) {
  if (piece.plan.target_mesh) {
    tell_mesh_corners(piece.plan, steps, job);
    tell_mesh_creases(piece.plan, steps, job);
    return;
  }
  const model::PieceForm part = part_form(piece);
  for (const FeatureShape& s : piece.shapes.whole) {
    if (model::corner_rest_of(piece.plan, s.name)) continue;  // told with its reason (corner_rests.h)
    const bool open = s.kind == ShapeKind::kPocket && s.open && !(s.corner_radius_mm > 0.0);
    if (!open && !states_no_corner(piece, s)) continue;
    const double radius = 0.5 * narrowest_mill_mm(piece, steps, s);
    if (!(radius > 0.0)) continue;
    const auto corners = model::sharp_corners(s, piece.shapes.whole, part);
    if (corners.empty()) continue;
    std::vector<geometry::Vec3> at;
    for (const model::SharpCorner& c : corners) at.push_back(c.at);
    job.warn("PIP-CORNER", "feature '" + s.name + "': " +
                               (corners.size() == 1 ? "its inner corner at " : "its inner corners at ") +
                               some_places(at) + (corners.size() == 1 ? " is" : " are") +
                               " drawn sharp, and a radius of " + trimmed(radius, 3) +
                               " mm, that of the narrowest mill, stays; broach or erode what must be sharp");
  }
}

std::string some_places(const std::vector<geometry::Vec3>& at) {
  std::string out;
  for (const geometry::Vec3& p : at) {
    if (&p - at.data() == kMostNamed)
      return out + ", and " + std::to_string(at.size() - kMostNamed) + " more";
    out +=
        (out.empty() ? "(" : ", (") + trimmed(p.x, 2) + ", " + trimmed(p.y, 2) + ", " + trimmed(p.z, 2) + ")";
  }
  return out;
}

model::Proposal without_drills_at_edges(const Piece& piece, const FeatureShape& hole,
                                        const model::Proposal& p) {
  model::Proposal out = p;
  const std::string why = model::cuts_an_edge(hole, raw_piece(piece));
  if (why.empty()) return out;
  std::erase_if(out.chains, [](const std::vector<model::ProposedStep>& chain) {
    return std::any_of(chain.begin(), chain.end(), [](const model::ProposedStep& s) {
      return model::is_a(s.operation, model::TypeId::kDrillingTypeOperation);
    });
  });
  if (out.chains.size() < p.chains.size())
    out.rejected.push_back({"drilling at an edge", why + "; mill it, move it, or give a larger raw piece"});
  return out;
}

}  // namespace capstan::piece
