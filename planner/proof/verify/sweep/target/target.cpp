#include "planner/proof/verify/sweep/target/target.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh_form.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies.h"
#include "planner/proof/verify/findings.h"

namespace capstan::verify {

using geometry::Box3;
using geometry::Placement;
using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;
using volumes::Form;

namespace {

constexpr double kUpright = 1.0 - 1e-9;
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

bool representable(const Form& s) {
  switch (s.kind) {
    case ShapeKind::kToolpath:
    case ShapeKind::kSphericalCap:
    case ShapeKind::kRoundedEnd:
    case ShapeKind::kEdgeRound:
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

/// The widest area a cutter may be in anywhere above the bottom, feature frame.
Region widest(const Form& s) {
  const double grow = sideways(s);
  if (const auto* b = s.bore()) {
    const double thread = s.kind == ShapeKind::kThread ? 0.5 * b->thread_major_mm : 0.0;
    return geometry::disc({0.0, 0.0}, std::max({thread, b->top_radius_mm, b->bottom_radius_mm}) + grow);
  }
  const double wider = s.bevel() != nullptr ? s.bevel()->width_mm
                       : s.slope_rad > 0.0  ? s.depth_mm() * std::tan(s.slope_rad)
                                            : 0.0;
  return grow + wider > 0.0 ? geometry::offset(s.area, grow + wider) : s.area;
}

/// The square of the distance between a point and a line's piece.
double squared_distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double n = dot(d, d);
  const double t = n > 0.0 ? std::clamp(dot(p - a, d) / n, 0.0, 1.0) : 0.0;
  const Vec2 apart = p - (a + t * d);
  return dot(apart, apart);
}

bool crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double s1 = cross(b - a, c - a), s2 = cross(b - a, d - a);
  const double s3 = cross(d - c, a - c), s4 = cross(d - c, b - c);
  return ((s1 > 0.0) != (s2 > 0.0)) && ((s3 > 0.0) != (s4 > 0.0));
}

}  // namespace

Target::Target(const model::Plan& plan, const PartShapes& part, std::size_t setup)
    : plan_(plan),
      part_(part),
      frame_(workpiece_in(plan, setup)),
      stock_(placed(plan.stock.box, frame_)),
      part_box_(placed(part.part, frame_)) {
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
// as the operation says, but no deeper than what still counts as broken.
void Target::add_broken_edges() {
  for (const model::StepResult& step : plan_.steps) {
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(step.step);
    const model::Cutter* c = model::find_cutter(plan_, step.cutter_id);
    if (ws == nullptr || c == nullptr || !(c->point_angle_rad > 0.0)) continue;
    const bool cone = breaks_edges(c->cutter_class);
    const auto* op = plan_.model.get<model::SideFinishMilling>(ws->its_operation);
    if (!cone || op == nullptr) continue;
    const double depth = op->axial_cutting_depth.value_or(0.0);
    const PartShapes::Entry* e = part_.find(ws->its_feature);
    if (e == nullptr || !(depth > 0.0 && depth <= kMostEdgeBreakMm)) continue;
    for (const Form& s : e->shapes) {
      if (s.kind != ShapeKind::kPocket && s.kind != ShapeKind::kHole && s.kind != ShapeKind::kOutside)
        continue;
      const double width = depth * std::tan(0.5 * c->point_angle_rad);
      for (Form& edge : volumes::broken_edges(s, depth, width))
        add(bevels_.emplace_back(std::move(edge)), true);
    }
  }
}

bool Target::outside(Vec2 p) const {
  if (p.x < part_box_.lo.x || p.x > part_box_.hi.x || p.y < part_box_.lo.y || p.y > part_box_.hi.y)
    return true;
  if (!round_) return false;
  const Vec2 middle = 0.5 * (xy(stock_.lo) + xy(stock_.hi));
  return norm(p - middle) > *round_;
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
  for (int iy = 0; iy < grid.ny(); ++iy) {
    poll();
    for (int ix = 0; ix < grid.nx(); ++ix) {
      const Vec2 p = grid.centre(ix, iy);
      const bool there = !round_ || norm(p - 0.5 * (xy(stock_.lo) + xy(stock_.hi))) <= *round_;
      grid.stock[grid.index(ix, iy)] = there ? stock_.hi.z : Grid::kNothing;
      grid.base[grid.index(ix, iy)] = stock_.lo.z;
      const bool nothing = outside(p) || (plan_.target_mesh && !sheet_);
      grid.part[grid.index(ix, iy)] = nothing ? Grid::kNothing : part_box_.hi.z;
    }
  }
  if (plan_.target_mesh) fill_mesh(grid);
  for (const Cavity& c : cavities_) {
    const auto [y0, y1] = grid.rows(c.box.lo.y, c.box.hi.y);
    const auto [x0, x1] = grid.columns(c.box.lo.x, c.box.hi.x);
    for (int iy = y0; iy < y1; ++iy) {
      tick();
      for (int ix = x0; ix < x1; ++ix) {
        double& z = grid.part[grid.index(ix, iy)];
        if (z > c.floor_mm || c.open_bottom) z = std::min(z, floor_of(c, grid.centre(ix, iy)));
      }
    }
  }
  grid.find_top();
}

void Target::fill_mesh(Grid& grid) const {
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
  for (std::size_t i = 0; i < high.size(); ++i) {
    if (high[i] > Grid::kNothing || !sheet_) grid.part[i] = high[i];
  }
}

bool Target::guilty(Vec2 at, double z) const {
  if (plan_.target_mesh && grid_ != nullptr) return grid_->normal_depth(at, z) > allowed();
  // Not if the surface is as low within the tolerance sideways: then it is a wall that was grazed.
  const double reach = allowed();
  double side = reach;
  for (const Cavity& c : cavities_) side = std::max(side, reach + sideways(*c.shape));
  for (int i = 0; i < 16; ++i) {
    const double a = 2.0 * std::numbers::pi * (i % 8) / 8.0;
    const double r = i < 8 ? reach : side;
    if (height(at + Vec2{r * std::cos(a), r * std::sin(a)}) - reach <= z) return false;
  }
  return true;
}

std::size_t Target::level(double z) const {
  return static_cast<std::size_t>(std::upper_bound(levels_.begin(), levels_.end(), z + allowed()) -
                                  levels_.begin());
}

std::size_t Target::Walls::strip(double y) const {
  const double at = std::clamp((y - y0_mm) / strip_mm, 0.0, static_cast<double>(strips.size()) - 1.0);
  return static_cast<std::size_t>(at);
}

std::size_t Target::Walls::square_at(double at, double begin) const {
  return static_cast<std::size_t>(
      std::clamp((at - begin) / square_mm, 0.0, static_cast<double>(along) - 1.0));
}

bool Target::Walls::stands(Vec2 p) const {
  if (strips.empty()) return false;
  int winding = 0;
  for (const std::uint32_t i : strips[strip(p.y)]) {
    const Edge& e = edges[i];
    if ((e.a.y <= p.y) == (e.b.y <= p.y)) continue;
    const double x = e.a.x + (p.y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x);
    if (x > p.x) winding += e.b.y > e.a.y ? 1 : -1;
  }
  return winding != 0;
}

const Target::Walls& Target::walls(double z) {
  const std::size_t key = level(z);
  const auto found = walls_.find(key);
  if (found != walls_.end()) return found->second;
  Walls out;
  std::vector<geometry::Loop> loops;
  for (const Cavity& c : cavities_) {
    if (c.floor_mm > z + allowed() && !c.open_bottom) continue;
    Region r = c.area;
    for (const auto& [island, top] : c.islands) {
      if (top > z + allowed()) r = geometry::subtract(r, island);
    }
    loops.insert(loops.end(), r.loops.begin(), r.loops.end());
  }
  Region part = geometry::rectangle(xy(part_box_.lo), xy(part_box_.hi));
  if (round_)
    part = geometry::intersect(part, geometry::disc(0.5 * (xy(stock_.lo) + xy(stock_.hi)), *round_));
  out.region = loops.empty() ? part : geometry::subtract(part, geometry::clean(loops));
  for (const auto& loop : out.region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) out.edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
  constexpr std::size_t kStrips = 512;
  out.y0_mm = part_box_.lo.y;
  out.strip_mm = std::max((part_box_.hi.y - part_box_.lo.y) / kStrips, 1e-3);
  out.strips.resize(kStrips);
  for (std::uint32_t i = 0; i < out.edges.size(); ++i) {
    const auto& e = out.edges[i];
    const std::size_t last = out.strip(std::max(e.a.y, e.b.y));
    for (std::size_t k = out.strip(std::min(e.a.y, e.b.y)); k <= last; ++k) out.strips[k].push_back(i);
  }
  // About as many squares as edges, so that heights with few edges cost little.
  constexpr double kMostAlong = 128.0;
  out.along =
      static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(out.edges.size())), 1.0, kMostAlong));
  out.x0_mm = part_box_.lo.x;
  out.square_mm = std::max({part_box_.hi.x - part_box_.lo.x, part_box_.hi.y - part_box_.lo.y, 0.1}) /
                  static_cast<double>(out.along);
  out.squares.resize(out.along * out.along);
  for (std::uint32_t i = 0; i < out.edges.size(); ++i) {
    const auto& e = out.edges[i];
    const std::size_t last_y = out.square_at(std::max(e.a.y, e.b.y), out.y0_mm);
    const std::size_t last_x = out.square_at(std::max(e.a.x, e.b.x), out.x0_mm);
    for (std::size_t y = out.square_at(std::min(e.a.y, e.b.y), out.y0_mm); y <= last_y; ++y)
      for (std::size_t x = out.square_at(std::min(e.a.x, e.b.x), out.x0_mm); x <= last_x; ++x)
        out.squares[y * out.along + x].push_back(i);
  }
  return walls_.emplace(key, std::move(out)).first->second;
}

double Target::wall_gouge(const Move& m, double radius, double height_mm, Vec2& at) {
  if (plan_.target_mesh) return 0.0;
  const double low = std::min(m.from.z, m.to.z) + height_mm;
  if (low + allowed() >= part_box_.hi.z) return 0.0;
  const bool changes = level(m.from.z + height_mm) != level(m.to.z + height_mm);
  const int n = std::max(pieces_of(m, kChordMm), changes ? 16 : 1);
  double worst = 0.0;
  Vec3 a = m.from;
  for (int i = 1; i <= n; ++i) {
    const Vec3 b = point_of(m, static_cast<double>(i) / n);
    // While falling from one level to the next the higher end decides; the last piece is judged at its end.
    const double z = (i == n ? std::min(a.z, b.z) : std::max(a.z, b.z)) + height_mm;
    if (z + allowed() < part_box_.hi.z) {
      const Walls& w = walls(z);
      const Vec2 p = i == n && changes ? xy(b) : xy(a);
      double squared = 1e300;
      const double reach = radius - allowed();
      const double x0 = std::min(p.x, b.x) - reach, x1 = std::max(p.x, b.x) + reach;
      const double y0 = std::min(p.y, b.y) - reach, y1 = std::max(p.y, b.y) + reach;
      // An edge that lies in several squares is merely looked at again.
      const std::size_t last_y = w.square_at(y1, w.y0_mm), last_x = w.square_at(x1, w.x0_mm);
      for (std::size_t iy = w.square_at(y0, w.y0_mm); iy <= last_y; ++iy) {
        for (std::size_t ix = w.square_at(x0, w.x0_mm); ix <= last_x; ++ix) {
          for (const std::uint32_t index : w.squares[iy * w.along + ix]) {
            const auto& e = w.edges[index];
            if (std::max(e.a.x, e.b.x) < x0 || std::min(e.a.x, e.b.x) > x1 || std::max(e.a.y, e.b.y) < y0 ||
                std::min(e.a.y, e.b.y) > y1) {
              continue;
            }
            if (crossing(p, xy(b), e.a, e.b)) squared = 0.0;
            squared = std::min({squared, squared_distance(p, e.a, e.b), squared_distance(xy(b), e.a, e.b),
                                squared_distance(e.a, p, xy(b)), squared_distance(e.b, p, xy(b))});
          }
        }
      }
      const double near = std::sqrt(squared);
      double into = radius - near;
      if (near > std::max(reach, kChordMm) && w.stands(xy(b))) {
        into = radius;
      }
      if (into > allowed() && into > worst) {
        worst = into;
        at = xy(b);
      }
    }
    a = b;
  }
  return worst;
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
