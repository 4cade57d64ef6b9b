#include "planner/proof/verify/sweep/target/target.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/mesh_form.h"
#include "planner/ground/memo/packed.h"
#include "planner/ground/memo/remembered.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/findings.h"

namespace capstan::verify {

using geometry::Box3;
using geometry::Placement;
using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using memo::Key;
using memo::Stage;
using model::ShapeKind;
using volumes::Form;

namespace {

constexpr double kUpright = 1.0 - 1e-9;
constexpr double kSquare = 1e-9;          ///< sine of a turn that counts as none
constexpr double kMostEdgeBreakMm = 1.0;  ///< deeper is a chamfer, and must be a feature; default, unsourced

Region moved(const Region& r, const Placement& to) {
  std::vector<geometry::Loop> loops;
  for (const auto& loop : r.loops) {
    geometry::Loop out;
    out.reserve(loop.size());
    for (const Vec2 p : loop) out.push_back(xy(to.to_parent({p.x, p.y, 0.0})));
    if (to.z.z < 0.0) std::reverse(out.begin(), out.end());
    loops.push_back(std::move(out));
  }
  return {std::move(loops)};
}

/// Heights as runs of equal ones: most of a part is level.
struct Runs {
  std::vector<std::uint32_t> lengths;
  std::vector<double> heights;

  static std::string packed(const std::vector<double>& cells) {
    Runs runs;
    for (const double z : cells) {
      if (runs.heights.empty() || runs.heights.back() != z) {
        runs.heights.push_back(z);
        runs.lengths.push_back(0);
      }
      ++runs.lengths.back();
    }
    std::string bytes;
    memo::pack(bytes, runs);
    return bytes;
  }
  /// False, and nothing is written, where they are not of so many cells.
  static bool unpacked_into(const std::string& bytes, std::vector<double>& cells) {
    const auto runs = memo::unpacked<Runs>(bytes);
    if (!runs || runs->lengths.size() != runs->heights.size()) return false;
    if (std::accumulate(runs->lengths.begin(), runs->lengths.end(), std::uint64_t{0}) != cells.size())
      return false;
    auto to = cells.begin();
    for (std::size_t i = 0; i < runs->lengths.size(); ++i)
      to = std::fill_n(to, runs->lengths[i], runs->heights[i]);
    return true;
  }
};

/// Beside a box, seen along its z.
bool beside(const Box3& box, Vec3 p) {
  return p.x < box.lo.x || p.x > box.hi.x || p.y < box.lo.y || p.y > box.hi.y;
}

bool representable(const Form& s) {
  switch (s.kind) {
    case ShapeKind::kToolpath:
    case ShapeKind::kSphericalCap:
    case ShapeKind::kRoundedEnd:
    case ShapeKind::kFreeform:
      return false;
    default:
      return true;
  }
}

/// How far beyond its nominal walls the feature's tolerances let a cutter go.
double sideways(const Form& s) {
  double out = 0.0;
  for (const volumes::Limits* t : {&s.width, &s.length, &s.diameter}) {
    if (t->given) out = std::max(out, 0.5 * t->upper_mm);
  }
  return out;
}

/// Radius of a bore where it is widest.
double radius_of(const Form& s, const volumes::Bore& b) {
  const double thread = s.kind == ShapeKind::kThread ? 0.5 * b.thread_major_mm : 0.0;
  return std::max({thread, b.top_radius_mm, b.bottom_radius_mm});
}

/// How far an area that is no bore's reaches beyond itself above its bottom.
double wider(const Form& s) {
  if (s.bevel() != nullptr) return s.bevel()->width_mm;
  return s.slope_rad > 0.0 ? s.depth_mm() * std::tan(s.slope_rad) : 0.0;
}

/// The widest area a cutter may be in anywhere above the bottom, feature frame.
Region widest(const Form& s) {
  const double grow = sideways(s);
  if (const auto* b = s.bore()) return geometry::disc({0.0, 0.0}, radius_of(s, *b) + grow);
  return grow + wider(s) > 0.0 ? geometry::offset(s.area, grow + wider(s)) : s.area;
}

bool apart(const geometry::Box2& a, const geometry::Box2& b) {
  return a.hi.x < b.lo.x || b.hi.x < a.lo.x || a.hi.y < b.lo.y || b.hi.y < a.lo.y;
}

}  // namespace

geometry::Box2 seen_of(const Form& s, const Placement& in_setup) {
  constexpr double kChordsMm = 0.01;  // more than the chords of `widest` leave an arc
  const auto* bore = s.bore();
  const geometry::Box2 own = bore == nullptr ? geometry::bounds(s.area) : geometry::Box2{{}, {}};
  if (own.lo.x > own.hi.x) return own;  // no area
  const double more = sideways(s) + kChordsMm + (bore == nullptr ? wider(s) : radius_of(s, *bore));
  const Placement at = compose(in_setup, s.frame());
  Box3 out;
  for (const double x : {own.lo.x - more, own.hi.x + more})
    for (const double y : {own.lo.y - more, own.hi.y + more}) out.add(at.to_parent({x, y, 0.0}));
  return {xy(out.lo), xy(out.hi)};
}

Target::Target(const model::Plan& plan, const PartShapes& part, std::size_t setup,
               const std::optional<geometry::Box2>& near)
    : plan_(plan),
      part_(part),
      frame_(workpiece_in(plan, setup)),
      stock_(placed(plan.stock.box, frame_)),
      part_box_(placed(part.part, frame_)),
      turned_(std::abs(frame_.z.z) > kUpright &&
              std::min(std::abs(frame_.x.x), std::abs(frame_.x.y)) > kSquare),
      near_(near) {
  if (plan.target_mesh) {
    const geometry::MeshForm form = geometry::form_of(*plan.target_mesh);
    sheet_ = form.kind == geometry::MeshForm::Kind::kSheet;
    inside_out_ = form.inside_out;
  }
  if (plan.stock.cylinder_radius_mm && std::abs(frame_.z.z) > kUpright)
    round_ = *plan.stock.cylinder_radius_mm;
  for (const auto& e : part.entries) {
    if (e.piece) continue;
    for (const auto& s : e.shapes) add(s);
  }
  add_broken_edges();
  for (const Cavity& c : cavities_) {
    levels_.push_back(c.floor_mm);
    for (const auto& [region, top] : c.islands) levels_.push_back(top);
  }
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
}

void Target::add(const Form& s, bool bevel) {
  const Placement at = compose(frame_, s.frame());
  if (std::abs(at.z.z) < kUpright) return;
  const bool below = at.z.z < 0.0;
  if (below && !s.solid.through) return;  // from the other side: seen from here the surface stays
  if (!representable(s)) return;
  sideways_mm_ = std::max(sideways_mm_, sideways(s));
  if (near_ && apart(seen_of(s, frame_), *near_)) return;
  Cavity c;
  c.shape = &s;
  c.bevel = bevel;
  c.frame = at;
  c.area = moved(widest(s), at);
  c.box = geometry::bounds(c.area);
  c.deeper_mm = s.depth.given ? std::max(0.0, s.depth.upper_mm) : 0.0;
  const double thread = s.kind == ShapeKind::kThread ? s.bore()->thread_depth_mm : 0.0;
  const double depth = std::max(s.depth_mm() + (s.kind == ShapeKind::kHole ? s.tip_mm : 0.0), thread);
  c.floor_mm = at.origin.z - depth - c.deeper_mm;
  c.open_bottom = s.solid.through || below || c.floor_mm <= stock_.lo.z + part_.tolerance_mm;
  if (below) c.floor_mm = stock_.lo.z;
  // What an outside leaves may be as small as its tolerance says.
  double smaller = 0.0;
  for (const volumes::Limits* t : {&s.width, &s.length}) {
    if (s.kind == ShapeKind::kOutside && t->given) smaller = std::max(smaller, -0.5 * t->lower_mm);
  }
  for (const auto& i : s.islands) {
    const Region stays = smaller > 0.0 ? geometry::offset(i.area, -smaller) : i.area;
    c.islands.emplace_back(moved(stays, at), at.origin.z + i.top_mm);
  }
  cavities_.push_back(std::move(c));
}

// A finishing step with a cone along the side of a feature that is no chamfer breaks its upper edge, as deep
// as the operation says, but no deeper than what still counts as broken. So does a spot that goes deeper than
// the hole is wide there: as deep as its cone stands over the hole's edge.
void Target::add_broken_edges() {
  for (const model::StepResult& step : plan_.steps) {
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(step.step);
    const model::Cutter* c = model::find_cutter(plan_, step.cutter_id);
    if (ws == nullptr || c == nullptr || !(c->point_angle_rad > 0.0)) continue;
    const double slope = std::tan(0.5 * c->point_angle_rad);
    const auto* along = plan_.model.get<model::SideFinishMilling>(ws->its_operation);
    const auto* spots = plan_.model.get<model::CenterDrilling>(ws->its_operation);
    const bool mills = along != nullptr && breaks_edges(c->cutter_class);
    const bool bores = spots != nullptr && c->cutter_class == model::CutterClass::kSpotDrill;
    const PartShapes::Entry* e = part_.find(ws->its_feature);
    if (e == nullptr || !(mills || bores)) continue;
    double widest = 0.0;  // bore: the edge on the top of a compound is its
    for (const Form& s : e->shapes)
      widest = std::max(widest, s.bore() == nullptr ? 0.0 : s.bore()->top_radius_mm);
    for (const Form& s : e->shapes) {
      if (bores && (s.bore() == nullptr || s.bore()->top_radius_mm < widest)) continue;
      if (s.kind != ShapeKind::kPocket && s.kind != ShapeKind::kHole && s.kind != ShapeKind::kOutside)
        continue;
      const double depth =
          mills ? along->axial_cutting_depth.value_or(0.0)
                : spots->cutting_depth.value_or(0.0) - (widest - 0.5 * c->tip_diameter_mm) / slope;
      if (!(depth > 0.0 && depth <= kMostEdgeBreakMm)) continue;
      for (Form& edge : volumes::broken_edges(s, depth, depth * slope))
        add(bevels_.emplace_back(std::move(edge)), true);
    }
  }
}

bool Target::outside(Vec2 p) const {
  if (p.x < part_box_.lo.x || p.x > part_box_.hi.x || p.y < part_box_.lo.y || p.y > part_box_.hi.y)
    return true;
  if (turned_ && !round_ && beside(part_.part, frame_.to_local({p.x, p.y, frame_.origin.z}))) return true;
  if (!round_) return false;
  const Vec2 middle = 0.5 * (xy(stock_.lo) + xy(stock_.hi));
  return norm(p - middle) > *round_;
}

bool Target::beside_stock(Vec2 p) const {
  if (round_) return norm(p - 0.5 * (xy(stock_.lo) + xy(stock_.hi))) > *round_;
  return turned_ && beside(plan_.stock.box, frame_.to_local({p.x, p.y, frame_.origin.z}));
}

Region Target::outline(const Box3& box) const {
  if (!turned_ || round_) {
    const Box3 there = placed(box, frame_);
    return geometry::rectangle(xy(there.lo), xy(there.hi));
  }
  return moved(geometry::rectangle(xy(box.lo), xy(box.hi)), frame_);
}

double Target::floor_of(const Cavity& c, Vec2 p) const {
  if (p.x < c.box.lo.x || p.x > c.box.hi.x || p.y < c.box.lo.y || p.y > c.box.hi.y) return 1e300;
  const Vec3 local = c.frame.to_local({p.x, p.y, 0.0});
  const Vec2 q{local.x, local.y};
  const Form& s = *c.shape;
  if (s.kind == ShapeKind::kThread && norm(q) <= 0.5 * s.bore()->thread_major_mm)
    return c.open_bottom ? Grid::kNothing : c.floor_mm;
  const auto floor = volumes::floor_at(s, q);
  if (!floor) return 1e300;
  const bool at_bottom = *floor <= -s.depth_mm() + 1e-9;
  if (at_bottom && c.open_bottom) return Grid::kNothing;
  return c.frame.origin.z + *floor - c.deeper_mm;
}

double Target::height(Vec2 p) const {
  if (outside(p)) return Grid::kNothing;
  double z = part_box_.hi.z;
  for (const Cavity& c : cavities_) z = std::min(z, floor_of(c, p));
  return z;
}

void Target::fill(Grid& grid) {
  grid_ = &grid;
  grid.floor = stock_.lo.z;
  grid.begin_level(stock_.hi.z, stock_.lo.z);
  poll();
  for (int iy = 0; iy < grid.ny() && (turned_ || round_); ++iy) {
    poll();
    for (int ix = 0; ix < grid.nx(); ++ix)
      if (beside_stock(grid.centre(ix, iy))) grid.stock[grid.index(ix, iy)] = Grid::kNothing;
  }
  if (turned_ || round_) grid.find_top();
  if (memo_ == nullptr || near_) return fill_part(grid);
  const Key key = memo::key_of(Stage::kPart, of_setup_, std::string("part"));
  if (const auto bytes = memo_->find(Stage::kPart, key)) {
    if (Runs::unpacked_into(*bytes, grid.part)) return;
    memo_->reject(Stage::kPart);
  }
  fill_part(grid);
  poll();
  std::string bytes = Runs::packed(grid.part);
  poll();
  memo_->keep(Stage::kPart, key, std::move(bytes));
}

void Target::fill_piece(Grid& grid) const {
  if (plan_.target_mesh && !sheet_) {
    std::fill(grid.part.begin(), grid.part.end(), Grid::kNothing);
    return;
  }
  // Where the sides lie along the axes, rows are alike.
  const bool alike = !turned_ && !round_;
  const auto beside_row = [&](double y) { return y < part_box_.lo.y || y > part_box_.hi.y; };
  for (int iy = 0; iy < grid.ny(); ++iy) {
    poll();
    const auto row = grid.part.begin() + static_cast<std::ptrdiff_t>(grid.index(0, iy));
    const bool beside = beside_row(grid.centre(0, iy).y);
    if (alike && iy > 0 && beside == beside_row(grid.centre(0, iy - 1).y)) {
      std::copy(row - grid.nx(), row, row);
      continue;
    }
    for (int ix = 0; ix < grid.nx(); ++ix)
      row[ix] = outside(grid.centre(ix, iy)) ? Grid::kNothing : part_box_.hi.z;
  }
}

void Target::remember(memo::Memo& memo, const Key& of_setup) {
  memo_ = &memo;
  of_setup_ = of_setup;
}

void Target::fill_part(Grid& grid) const {
  fill_piece(grid);
  if (plan_.target_mesh) fill_mesh(grid);
  for (const Cavity& c : cavities_) {
    const auto [y0, y1] = grid.rows(c.box.lo.y, c.box.hi.y);
    const auto [x0, x1] = grid.columns(c.box.lo.x, c.box.hi.x);
    // Where the floor is level all over a block of cells it is asked for once.
    constexpr int kBlock = 16;
    for (int by = y0; by < y1; by += kBlock) {
      tick(16);
      for (int bx = x0; bx < x1; bx += kBlock) {
        const int ty = std::min(by + kBlock, y1), tx = std::min(bx + kBlock, x1);
        const Vec2 first = grid.centre(bx, by), middle = 0.5 * (first + grid.centre(tx - 1, ty - 1));
        const Vec3 local = c.frame.to_local({middle.x, middle.y, 0.0});
        const bool level = volumes::level_about(*c.shape, {local.x, local.y}, norm(middle - first));
        const double floor = level ? floor_of(c, middle) : 0.0;
        for (int iy = by; iy < ty; ++iy) {
          for (int ix = bx; ix < tx; ++ix) {
            double& z = grid.part[grid.index(ix, iy)];
            if (z > c.floor_mm || c.open_bottom)
              z = std::min(z, level ? floor : floor_of(c, grid.centre(ix, iy)));
          }
        }
      }
    }
  }
}

std::vector<double> Target::heights_of_mesh(const Grid& grid) const {
  const geometry::Mesh& mesh = *plan_.target_mesh;
  std::vector<double> high(grid.part.size(), Grid::kNothing);
  for (const auto& t : mesh.triangles) {
    tick();
    const Vec3 a = frame_.to_parent(mesh.vertices[t[0]]);
    const Vec3 b = frame_.to_parent(mesh.vertices[t[1]]);
    const Vec3 c = frame_.to_parent(mesh.vertices[t[2]]);
    const double twice = cross(xy(b) - xy(a), xy(c) - xy(a));
    if (std::abs(twice) < 1e-12) continue;
    const auto [y0, y1] = grid.rows(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}));
    const auto [x0, x1] = grid.columns(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}));
    for (int iy = y0; iy < y1; ++iy) {
      tick();
      for (int ix = x0; ix < x1; ++ix) {
        const Vec2 p = grid.centre(ix, iy);
        const double u = cross(xy(b) - p, xy(c) - p) / twice;
        const double v = cross(xy(c) - p, xy(a) - p) / twice;
        const double w = 1.0 - u - v;
        if (u < -1e-12 || v < -1e-12 || w < -1e-12) continue;
        double& z = high[grid.index(ix, iy)];
        z = std::max(z, u * a.z + v * b.z + w * c.z);
      }
    }
  }
  return high;
}

void Target::fill_mesh(Grid& grid) const {
  const std::vector<double> high = heights_of_mesh(grid);
  for (std::size_t i = 0; i < high.size(); ++i) {
    if (high[i] > Grid::kNothing || !sheet_) grid.part[i] = high[i];
  }
}

std::vector<double> Target::before_features(const Grid& grid) const {
  std::vector<double> out = heights_of_mesh(grid);
  for (int iy = 0; iy < grid.ny() && sheet_; ++iy) {
    poll();
    for (int ix = 0; ix < grid.nx(); ++ix) {
      double& z = out[grid.index(ix, iy)];
      if (z <= Grid::kNothing && !outside(grid.centre(ix, iy))) z = part_box_.hi.z;
    }
  }
  return out;
}

bool Target::is_gouge(Vec2 at, double z) const {
  if (plan_.target_mesh && grid_ != nullptr) return grid_->normal_depth(at, z) > allowed();
  // Not if the surface is as low within the tolerance sideways: then it is a wall that was grazed.
  const double reach = allowed();
  const double side = reach + sideways_mm_;
  for (int i = 0; i < 16; ++i) {
    const double a = 2.0 * std::numbers::pi * (i % 8) / 8.0;
    const double r = i < 8 ? reach : side;
    if (height(at + Vec2{r * std::cos(a), r * std::sin(a)}) - reach <= z) return false;
  }
  return true;
}

void Target::describe(std::string& bytes) const {
  memo::pack(bytes, frame_);
  memo::pack(bytes, stock_);
  memo::pack(bytes, part_box_);
  memo::pack(bytes, round_);
  if (turned_) {
    memo::pack(bytes, plan_.stock.box);
    memo::pack(bytes, part_.part);
  }
  for (const Form& b : bevels_) memo::pack(bytes, b);
}

std::string Target::undecided(model::AnyRef feature) const {
  const PartShapes::Entry* e = part_.find(feature);
  if (e == nullptr) return "the step has no feature";
  if (!e->fault.empty()) return e->fault;
  for (const auto& s : e->shapes) {
    if (s.kind == ShapeKind::kFreeform && plan_.target_mesh) continue;
    if (!representable(s)) return "a " + std::string(model::to_text(s.kind)) + " is not held as heights";
    if (std::abs(compose(frame_, s.frame()).z.z) < kUpright) return "it is tilted against the tool axis";
  }
  return {};
}

}  // namespace capstan::verify
