// Branch and bound over a tree of boxes. What a node can hold the cutter at is bounded twice. By its box: its
// highest point, met by the cutter's lowest one over the box. By its plane: a plane holds a rotating outline
// at one place, and falls short of that elsewhere by at least the square of the distance there times a
// number; so of a smooth surface only the few triangles about the contact are looked at. Derived (held_by).
#include "planner/making/toolpath/freeform/drop_cutter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/freeform/drop_tree.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// Along an edge at distance w from the axis, rising with `slope` >= 0: how far ahead of the foot the
/// cutter's outline has that slope.
double touch_ahead(const Toroid& t, double w, double slope) {
  const double r = t.ball_mm;
  if (slope <= 0.0) return std::sqrt(std::max(0.0, t.disc_mm * t.disc_mm - w * w));
  const double limit2 = t.radius() * t.radius() - w * w;
  if (limit2 <= 0.0) return 0.0;
  if (r <= 0.0) return std::sqrt(limit2);
  if (t.disc_mm <= 0.0) return slope * std::sqrt(std::max(0.0, (r - w) * (r + w)) / (1.0 + slope * slope));
  // f(u) = (d - disc) u - slope d sqrt(ball^2 - (d - disc)^2), d = sqrt(w^2 + u^2): one sign change on [lo,
  // hi]. Newton's step where it stays inside, else the middle.
  double lo = std::sqrt(std::max(0.0, t.disc_mm * t.disc_mm - w * w));
  double hi = std::sqrt(limit2);
  double u = 0.5 * (lo + hi);
  for (int k = 0; k < 100; ++k) {
    const double d = std::sqrt(w * w + u * u);
    const double off = d - t.disc_mm;
    const double root = std::sqrt(std::max(1e-300, (r - off) * (r + off)));
    const double f = off * u - slope * d * root;
    (f < 0.0 ? lo : hi) = u;
    const double grow = u / d;  // dd/du
    const double slant = grow * u + off - slope * grow * (root - d * off / root);
    double next = u - f / slant;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    const double step = std::abs(next - u);
    u = next;
    if (step < 1e-13 * hi || hi - lo < 1e-13 * hi) break;
  }
  return u;
}

/// Height of the outline where `distance` may exceed the radius by rounding.
double height_within(const Toroid& t, double distance) {
  const double off = std::min(distance - t.disc_mm, t.ball_mm);
  if (off <= 0.0) return 0.0;
  return t.ball_mm - std::sqrt((t.ball_mm - off) * (t.ball_mm + off));
}

/// How far from the axis a facet of this normal touches, and where the tip is when it touches at height z.
double touch_radius(const Toroid& t, double nxy, double /*nz*/) { return t.ball_mm * nxy + t.disc_mm; }
double tip_when_at(const Toroid& t, double z, double nz, double /*aside*/) {
  return z - t.ball_mm * (1.0 - nz);  // of a level facet z itself, to the last bit
}

double level_radius(const Toroid& t) { return t.disc_mm; }
double radius_of(const Toroid& t) { return t.radius(); }

/// Where a plane holds the cutter: the tip's height above the plane's at the axis, the distance of the
/// contact from the axis, and by how much a contact elsewhere holds it lower, per square of the distance
/// between both.
struct Held {
  double above_mm = 0.0, at_mm = 0.0, lower_per_mm2 = 0.0;
};
/// With the contact at distance c on the side to which a plane of slope g rises, another point of it at (r,
/// a) about the axis holds the tip lower by (g c - h(c)) - (g r - h(r)) + g r (1 - cos a). The outline h
/// bends by 1 / ball at least outside of the disc, so that the first two are (c - r)^2 / 2 ball or more, and
/// within the disc half of g (c - r) or more; the square of the distance is (c - r)^2 + 2 c r (1 - cos a).
Held held_by(const Toroid& t, double rise, double lift) {
  Held out{rise * t.disc_mm + t.ball_mm * lift, t.disc_mm + t.ball_mm * rise / (1.0 + lift), 0.0};
  const double across = rise > 0.0 ? 0.5 * rise / out.at_mm : t.disc_mm > 0.0 ? 0.0 : 1e300;
  out.lower_per_mm2 = t.ball_mm > 0.0 ? std::min(0.5 / t.ball_mm, across) : across;
  return out;
}

// The same of any convex outline. Along an edge its height is convex, too: what is highest has one sign
// change.

using geometry::ConvexOutline;

double radius_of(const ConvexOutline& o) { return o.radius_mm; }
double level_radius(const ConvexOutline& o) { return o.level_radius(); }
double height_within(const ConvexOutline& o, double distance) { return o.height(distance); }

double touch_radius(const ConvexOutline& o, double nxy, double nz) {
  return nxy > 0.0 ? o.touch_radius(nxy / nz) : 0.0;
}
double tip_when_at(const ConvexOutline& o, double z, double /*nz*/, double aside) {
  return z - o.height(aside);
}

Held held_by(const ConvexOutline& o, double rise, double /*lift*/) {
  const double at = rise > 0.0 ? o.touch_radius(rise) : 0.0;
  return {rise * at - o.height(at), at, 0.0};
}

double touch_ahead(const ConvexOutline& o, double w, double slope) {
  const double level = o.level_radius();
  if (slope <= 0.0) return std::sqrt(std::max(0.0, level * level - w * w));
  const double limit2 = o.radius_mm * o.radius_mm - w * w;
  if (limit2 <= 0.0) return 0.0;
  double lo = 0.0, hi = std::sqrt(limit2);
  for (int k = 0; k < 100 && hi - lo > 1e-13 * o.radius_mm; ++k) {
    const double u = 0.5 * (lo + hi);
    const double d = std::sqrt(w * w + u * u);
    // The outline rises by `slope` along the edge where it rises by slope d / u outwards.
    (o.touch_radius(slope * d / u) > d ? lo : hi) = u;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

double MillEnd::radius() const {
  return std::visit([](const auto& s) { return radius_of(s); }, shape_);
}

double MillEnd::height(double r) const {
  if (r > radius()) return std::numeric_limits<double>::infinity();
  return std::visit([r](const auto& s) { return height_within(s, r); }, shape_);
}

double MillEnd::touch_radius(double slope) const {
  const double root = std::sqrt(1.0 + slope * slope);
  return std::visit([&](const auto& s) { return freeform::touch_radius(s, slope / root, 1.0 / root); },
                    shape_);
}

double MillEnd::ball_mm() const {
  if (const auto* t = std::get_if<Toroid>(&shape_)) return t->ball_mm;
  return std::get<ConvexOutline>(shape_).sharpest_radius();
}

template <class F>
decltype(auto) MillEnd::grown(double by_mm, const F& f) const {
  if (const auto* t = std::get_if<Toroid>(&shape_))
    return f(Toroid{.disc_mm = t->disc_mm, .ball_mm = t->ball_mm + by_mm});
  return f(geometry::grown(std::get<ConvexOutline>(shape_), by_mm));
}

std::optional<MillEnd> mill_end_of(const geometry::CutterProfile& profile) {
  if (const auto t = toroid_of(profile)) return MillEnd(*t);
  if (const auto o = geometry::convex_outline(profile)) return MillEnd(*o);
  return std::nullopt;
}

std::optional<Toroid> toroid_of(const geometry::CutterProfile& profile) {
  Toroid out{.disc_mm = profile.radius_mm, .ball_mm = 0.0};
  double r = 0.0;
  for (const geometry::ProfilePiece& p : profile.pieces) {
    if (p.radius_mm > 0.0) {
      if (&p != &profile.pieces.back() || std::abs(p.rc_mm - r) > 1e-9 || !geometry::ends_upright(p))
        return std::nullopt;
      out = {.disc_mm = p.rc_mm, .ball_mm = p.radius_mm};
    } else if (p.slope != 0.0 || p.z0_mm != 0.0) {
      return std::nullopt;
    }
    r = p.r1_mm;
  }
  if (!(profile.radius_mm > 0.0) || profile.pieces.empty()) return std::nullopt;
  return out;
}

template <class Outline>
void DropCutter::leaf(const Leaf& l, const Outline& t, double x, double y, double& best) const {
  for (std::uint32_t i = l.facet0; i < l.facet1; ++i) {
    const Facet& f = facets_[i];
    const double reach = touch_radius(t, f.nxy, f.nz);
    const Vec2 p{x - reach * f.lean.x, y - reach * f.lean.y};
    // A point on a shared side belongs to both.
    const auto right_of = [&](Vec2 a, Vec2 b) {
      const Vec2 side = b - a;
      return cross(side, p - a) < -1e-13 * (std::abs(side.x) + std::abs(side.y));
    };
    if (right_of(f.a, f.b) || right_of(f.b, f.c) || right_of(f.c, f.a)) continue;
    const double z = std::min(f.top, f.z + dot(f.slope, p - f.a));
    best = std::max(best, tip_when_at(t, z, f.nz, reach));
  }
  const double radius = radius_of(t);
  const double radius2 = radius * radius;
  for (std::uint32_t i = l.vertex0; i < l.vertex1; ++i) {
    const Vec3& v = vertices_[i];
    if (v.z <= best) continue;
    const double d2 = (v.x - x) * (v.x - x) + (v.y - y) * (v.y - y);
    if (d2 <= radius2) best = std::max(best, v.z - height_within(t, std::sqrt(d2)));
  }
  for (std::uint32_t i = l.edge0; i < l.edge1; ++i) {
    const Edge& e = edges_[i];
    const Vec2 rel{x - e.a.x, y - e.a.y};
    const double w = cross(e.unit, rel);
    const double half2 = radius2 - w * w;
    if (half2 < 0.0) continue;
    const double along = dot(e.unit, rel);
    const double half = std::sqrt(half2);
    const double lo = std::max(-along, -half);
    const double hi = std::min(e.length - along, half);
    if (lo > hi) continue;
    // No contact is higher than the edge's highest point within reach with the outline's least height there.
    const double aside = std::abs(w);
    const double nearest = std::sqrt(w * w + std::pow(std::max({lo, -hi, 0.0}), 2));
    const double top = e.z + e.slope * (along + (e.slope >= 0.0 ? hi : lo));
    if (top <= best || top - height_within(t, nearest) <= best) continue;
    const double ahead = touch_ahead(t, aside, std::abs(e.slope));
    const double u = std::clamp(e.slope >= 0.0 ? ahead : -ahead, lo, hi);
    best = std::max(best, e.z + e.slope * (along + u) - height_within(t, std::sqrt(w * w + u * u)));
  }
}

/// No contact with a node is higher than this; not above `best`: it need not be looked into.
template <class Outline>
double DropCutter::bound(std::uint32_t node, const Outline& t, double x, double y, double best) const {
  const Node& n = nodes_[node];
  const double radius = radius_of(t), level = level_radius(t);
  const double dx = std::max({n.xlo - x, 0.0, x - n.xhi});
  const double dy = std::max({n.ylo - y, 0.0, y - n.yhi});
  const double d2 = dx * dx + dy * dy;
  if (d2 > radius * radius) return kNoContact;
  const double by_box = d2 <= level * level ? n.top : n.top - height_within(t, std::sqrt(d2));
  const Plane& p = planes_[node];
  if (p.rise < 0.0 || by_box <= best) return by_box;
  const Held held = held_by(t, p.rise, p.lift);
  const double by_plane = p.base + p.slope.x * x + p.slope.y * y + held.above_mm;
  if (by_plane <= best) return by_plane;
  const double far = p.rise > 0.0 ? held.at_mm / p.rise : 0.0;
  const double cx = x + far * p.slope.x, cy = y + far * p.slope.y;
  const double off_x = std::max({n.xlo - cx, 0.0, cx - n.xhi});
  const double off_y = std::max({n.ylo - cy, 0.0, cy - n.yhi});
  const double off2 = off_x * off_x + off_y * off_y;
  return std::min(by_box, by_plane - held.lower_per_mm2 * off2);
}

/// The highest contact of those above `from_mm`, or the first one above `to_mm`; `from_mm`: there is none.
template <class Outline>
double DropCutter::search(const Outline& t, double x, double y, std::uint32_t& hint, double from_mm,
                          double to_mm) const {
  tick();
  double best = from_mm;
  if (nodes_.empty()) return best;
  leaf(leaves_[hint], t, x, y, best);
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  std::array<Entry, kDeepestTree + 2> stack;
  std::size_t n = 0;
  if (best > to_mm) return best;
  stack[n++] = {0, bound(0, t, x, y, best)};
  while (n > 0) {
    const Entry top = stack[--n];
    if (!(top.bound > best)) continue;
    const Node& node = nodes_[top.node];
    if (node.left == node.right) {
      if (node.left == hint) continue;
      const double before = best;
      leaf(leaves_[node.left], t, x, y, best);
      if (best > before) hint = node.left;
      if (best > to_mm) return best;
      continue;
    }
    Entry near{node.left, bound(node.left, t, x, y, best)};
    Entry far{node.right, bound(node.right, t, x, y, best)};
    if (far.bound > near.bound) std::swap(near, far);
    if (far.bound > best) stack[n++] = far;
    if (near.bound > best) stack[n++] = near;
  }
  return best;
}

double DropCutter::drop(const MillEnd& cutter, double x, double y, double allowance_mm) const {
  std::uint32_t hint = 0;
  return drop(cutter, x, y, allowance_mm, hint);
}

double DropCutter::drop(const MillEnd& cutter, double x, double y, double allowance_mm,
                        std::uint32_t& hint) const {
  return cutter.grown(allowance_mm, [&](const auto& grown) { return search(grown, x, y, hint); }) +
         allowance_mm;
}

bool DropCutter::is_clear(const MillEnd& cutter, Vec2 p, double z_mm, double allowance_mm,
                          std::uint32_t& hint) const {
  return cutter.grown(allowance_mm, [&](const auto& grown) {
    // Contacts so near to the height that rounding tells are looked at to the last.
    const double at = z_mm - allowance_mm, rounding = 1e-13 * (1.0 + std::abs(z_mm) + allowance_mm);
    return !(search(grown, p.x, p.y, hint, at - rounding, at + rounding) + allowance_mm > z_mm);
  });
}

bool DropCutter::meets(const MillEnd& cutter, Vec2 p, double allowance_mm, std::uint32_t& hint) const {
  return cutter.grown(allowance_mm, [&](const auto& grown) {
    return search(grown, p.x, p.y, hint, kNoContact, kNoContact) > kNoContact;
  });
}

std::vector<double> DropCutter::drop(const MillEnd& cutter, const std::vector<Vec2>& points,
                                     double allowance_mm, const Job& job) const {
  std::vector<double> out(points.size());
  constexpr std::size_t kChunk = 1024;
  cutter.grown(allowance_mm, [&](const auto& grown) {
    parallel_for(job, (points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      std::uint32_t hint = 0;
      const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < end; ++i) {
        out[i] = search(grown, points[i].x, points[i].y, hint) + allowance_mm;
      }
    });
  });
  return out;
}

// --- making the tree
// ----------------------------------------------------------------------------------------

class DropCutter::Builder {
 public:
  Builder(DropCutter& out, const geometry::Mesh& mesh)
      : out_(out), mesh_(weld(mesh)), tree_(build_tree(mesh_)) {}

  void run() {
    out_.bounds_ = geometry::bounds(mesh_);
    if (mesh_.triangles.empty()) return;
    const std::vector<bool> hidden = valley_edges(mesh_, tree_.edges);
    std::vector<bool> edge_done(tree_.edges.size());
    std::vector<bool> vertex_done(mesh_.vertices.size());
    for (const LeafRange& range : tree_.leaves) {
      Leaf l;
      l.facet0 = size(out_.facets_);
      l.edge0 = size(out_.edges_);
      l.vertex0 = size(out_.vertices_);
      for (std::uint32_t k = range.first; k < range.last; ++k) {
        const std::uint32_t t = tree_.order[k];
        facet(t);
        for (int side = 0; side < 3; ++side) {
          const std::uint32_t v = mesh_.triangles[t][static_cast<std::size_t>(side)];
          if (!vertex_done[v]) out_.vertices_.push_back(mesh_.vertices[v]);
          vertex_done[v] = true;
          const std::uint32_t e = tree_.edge_of[t][static_cast<std::size_t>(side)];
          if (!edge_done[e] && !hidden[e]) edge(tree_.edges[e]);
          edge_done[e] = true;
        }
      }
      l.facet1 = size(out_.facets_);
      l.edge1 = size(out_.edges_);
      l.vertex1 = size(out_.vertices_);
      out_.leaves_.push_back(l);
    }
    for (const TreeNode& n : tree_.nodes) {
      out_.nodes_.push_back({n.box.lo.x, n.box.lo.y, n.box.hi.x, n.box.hi.y, n.box.hi.z, n.left, n.right});
    }
    for (const NodePlane& p : tree_.planes) {
      Plane made;
      if (p.made) {
        made = {p.slope, p.base_mm, norm(p.slope), 0.0};
        made.lift = std::hypot(1.0, made.rise) - 1.0;
      }
      out_.planes_.push_back(made);
    }
  }

 private:
  template <class T>
  static std::uint32_t size(const std::vector<T>& v) {
    return static_cast<std::uint32_t>(v.size());
  }

  void facet(std::uint32_t t) {
    const auto& corner = mesh_.triangles[t];
    const Vec3 a = mesh_.vertices[corner[0]];
    Vec3 b = mesh_.vertices[corner[1]];
    Vec3 c = mesh_.vertices[corner[2]];
    Vec3 n = cross(b - a, c - a);
    if (n.z < 0.0) {
      std::swap(b, c);
      n = -1.0 * n;
    }
    const double length = norm(n);
    // Facets as steep as this are represented by their edges: between them they are nowhere higher.
    if (!(length > 0.0) || n.z < 1e-9 * length) return;
    n = {n.x / length, n.y / length, n.z / length};  // of a level facet exactly (0, 0, 1)
    Facet f{.a = xy(a),
            .b = xy(b),
            .c = xy(c),
            .z = a.z,
            .top = std::max({a.z, b.z, c.z}),
            .slope = {-n.x / n.z, -n.y / n.z},
            .lean = {},
            .nxy = std::hypot(n.x, n.y),
            .nz = n.z};
    if (f.nxy > 0.0) f.lean = {n.x / f.nxy, n.y / f.nxy};
    out_.facets_.push_back(f);
  }

  void edge(const MeshEdge& e) {
    const Vec3 a = mesh_.vertices[e.a];
    const Vec3 b = mesh_.vertices[e.b];
    const Vec2 d = xy(b) - xy(a);
    const double length = norm(d);
    if (length < 1e-12) return;  // upright: its upper end says it all
    out_.edges_.push_back(
        {.a = xy(a), .unit = (1.0 / length) * d, .z = a.z, .length = length, .slope = (b.z - a.z) / length});
  }

  DropCutter& out_;
  geometry::Mesh mesh_;
  Tree tree_;
};

DropCutter::DropCutter(const geometry::Mesh& mesh) { Builder(*this, mesh).run(); }

}  // namespace capstan::toolpath::freeform
