#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/removal/parts.h"

// Closed meshes whose walls stand upright, in a block 3 mm larger all round. Nothing holds what stands below
// the mesh: it is the block's underside that the walls go down to.

namespace capstan::testing::removal {
namespace {

constexpr double kGrown = 3.0;
constexpr double kOver = 2.0;

/// Triangles as an ASCII STL.
class Mesh {
 public:
  void triangle(Point a, Point b, Point c) {
    out_ << "facet normal 0 0 0\nouter loop\n";
    for (const Point& p : {a, b, c}) out_ << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    out_ << "endloop\nendfacet\n";
  }
  /// Counter-clockwise, seen from outside.
  void quad(Point a, Point b, Point c, Point d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  /// The wall below a side that has the solid on its left.
  void wall(Point a, Point b, double foot) { quad({a.x, a.y, foot}, {b.x, b.y, foot}, b, a); }
  [[nodiscard]] std::string text() const { return "solid part\n" + out_.str() + "endsolid part\n"; }

 private:
  std::ostringstream out_;
};

Part made_of(const std::string& name, const Mesh& mesh, Point size, Target target) {
  PlanOptions options;
  options.material = "EN AW-6061";
  options.stock_allowance_mm = kGrown;
  const Box raw{{-kGrown, -kGrown, -size.z - kGrown}, {size.x + kGrown, size.y + kGrown, kGrown}};
  return {name, mesh.text(), raw, std::move(target), {}, options};
}

void underside(Mesh& m, const std::vector<Point>& outline, double low) {
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const auto foot = [&](std::size_t k) { return Point{outline[k].x, outline[k].y, low}; };
    m.triangle(foot(0), foot(i + 1), foot(i));
  }
}

}  // namespace

// 40 x 30 x 16 mm.
Part mesh_box() {
  Mesh m;
  const std::vector<Point> top = {{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}};
  underside(m, top, -16);
  for (std::size_t i = 0; i < 4; ++i) m.wall(top[i], top[(i + 1) % 4], -16);
  m.quad(top[0], top[1], top[2], top[3]);
  return made_of("mesh_box", m, {40, 30, 16}, Target(box({0, 0, -16 - kGrown}, {40, 30, 0})));
}

// 40 x 30 x 16 mm, its right half 6 mm lower.
Part mesh_step() {
  Mesh m;
  const std::vector<Point> outline = {{0, 0, 0},   {20, 0, 0},  {40, 0, 0},
                                      {40, 30, 0}, {20, 30, 0}, {0, 30, 0}};
  underside(m, outline, -16);
  const auto low = [](Point p, double z) { return Point{p.x, p.y, z}; };
  for (const auto& [a, b] : {std::pair{5, 0}, std::pair{0, 1}, std::pair{4, 5}}) {
    const Point p = outline[static_cast<std::size_t>(a)], q = outline[static_cast<std::size_t>(b)];
    m.wall(low(p, -6), low(q, -6), -16);
    m.wall(p, q, -6);
  }
  for (const auto& [a, b] : {std::pair{1, 2}, std::pair{2, 3}, std::pair{3, 4}}) {
    m.wall(low(outline[static_cast<std::size_t>(a)], -6), low(outline[static_cast<std::size_t>(b)], -6), -16);
  }
  m.quad(outline[0], outline[1], outline[4], outline[5]);
  m.quad(low(outline[1], -6), low(outline[2], -6), low(outline[3], -6), low(outline[4], -6));
  m.wall(outline[1], outline[4], -6);
  Target t(box({0, 0, -16 - kGrown}, {40, 30, 0}));
  t.cut(box({20, -kOver, -6}, {40 + kOver, 30 + kOver, kOver}));
  return made_of("mesh_step", m, {40, 30, 16}, t);
}

// 44 x 36 x 16 mm with a pocket of 26 x 20 mm, corners R6, 8 mm deep.
Part mesh_pocket() {
  constexpr double kX0 = 9, kY0 = 8, kX1 = 35, kY1 = 28, kR = 6, kDepth = 8;
  constexpr std::size_t kChords = 16;  // of a corner: they lie 0.007 mm inside its arc
  Mesh m;
  const std::vector<Point> outer = {{44, 0, 0}, {44, 36, 0}, {0, 36, 0}, {0, 0, 0}};
  underside(m, outer, -16);
  for (std::size_t i = 0; i < 4; ++i) m.wall(outer[i], outer[(i + 1) % 4], -16);
  const std::vector<Point> centres = {
      {kX1 - kR, kY0 + kR, 0}, {kX1 - kR, kY1 - kR, 0}, {kX0 + kR, kY1 - kR, 0}, {kX0 + kR, kY0 + kR, 0}};
  std::vector<Point> rim;
  for (std::size_t q = 0; q < 4; ++q) {
    for (std::size_t k = 0; k <= kChords; ++k) {
      const double a =
          0.5 * std::numbers::pi * (static_cast<double>(q) - 1.0 + static_cast<double>(k) / kChords);
      rim.push_back({centres[q].x + kR * std::cos(a), centres[q].y + kR * std::sin(a), 0});
    }
  }
  const auto at = [](Point p, double z) { return Point{p.x, p.y, z}; };
  const Point middle{0.5 * (kX0 + kX1), 0.5 * (kY0 + kY1), -kDepth};
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Point a = rim[i], b = rim[(i + 1) % rim.size()];
    m.triangle(middle, at(a, -kDepth), at(b, -kDepth));
    m.wall(b, a, -kDepth);
    const std::size_t q = i / (kChords + 1);
    m.triangle(outer[q], b, a);
    if (i % (kChords + 1) == kChords) m.triangle(outer[q], outer[(q + 1) % 4], b);
  }
  Target t(box({0, 0, -16 - kGrown}, {44, 36, 0}));
  t.cut(prism(rounded_rectangle(kX0, kY0, kX1, kY1, kR), -kDepth, kOver));
  return made_of("mesh_pocket", m, {44, 36, 16}, t);
}

}  // namespace capstan::testing::removal
