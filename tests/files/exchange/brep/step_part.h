#pragma once

#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::exchange::testing {

using geometry::Vec3;

/// A STEP file of flat-faced bodies, written instance by instance. Figures are in the unit of the context.
class StepPart {
 public:
  /// Adds an instance; returns its number.
  int add(const std::string& entity) {
    data_ << "#" << ++last_ << "=" << entity << ";\n";
    return last_;
  }
  static std::string list(const std::vector<int>& ids) {
    std::string out = "(";
    for (const int id : ids) out += (out.size() > 1 ? ",#" : "#") + std::to_string(id);
    return out + ")";
  }
  static std::string ref(int id) { return "#" + std::to_string(id); }
  static std::string real(double v) {
    std::ostringstream out;
    out.precision(17);
    out << std::showpoint << v;
    return out.str();
  }
  int point(Vec3 p) {
    return add("CARTESIAN_POINT('',(" + real(p.x) + "," + real(p.y) + "," + real(p.z) + "))");
  }
  int direction(Vec3 d) {
    return add("DIRECTION('',(" + real(d.x) + "," + real(d.y) + "," + real(d.z) + "))");
  }
  int placement(Vec3 at, Vec3 axis, Vec3 x) {
    const int p = point(at), a = direction(axis), d = direction(x);
    return add("AXIS2_PLACEMENT_3D(''," + ref(p) + "," + ref(a) + "," + ref(d) + ")");
  }
  int vertex(Vec3 p) { return add("VERTEX_POINT(''," + ref(point(p)) + ")"); }
  int oriented(int edge, bool forward) {
    return add("ORIENTED_EDGE('',*,*," + ref(edge) + (forward ? ",.T.)" : ",.F.)"));
  }
  int bound(const std::vector<int>& oriented_edges, bool outer) {
    const int loop = add("EDGE_LOOP(''," + list(oriented_edges) + ")");
    return add((outer ? "FACE_OUTER_BOUND(''," : "FACE_BOUND('',") + ref(loop) + ",.T.)");
  }
  int face(const std::string& name, const std::vector<int>& bounds, int surface, bool same_sense = true) {
    return add("ADVANCED_FACE('" + name + "'," + list(bounds) + "," + ref(surface) +
               (same_sense ? ",.T.)" : ",.F.)"));
  }

  /// Flat faces over corners, each counter-clockwise seen from outside; edges are shared. `more[i]` are
  /// further bounds of face i. Names count from `first_name`. Returns the faces.
  std::vector<int> flat_faces(const std::vector<Vec3>& corners, const std::vector<std::vector<int>>& faces,
                              const std::map<int, int>& more = {}, int first_name = 0) {
    std::vector<int> vertices, out;
    for (const Vec3& c : corners) vertices.push_back(vertex(c));
    std::map<std::array<int, 2>, int> edges;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::vector<int> loop;
      const auto at = [&](std::size_t k) { return faces[f][k % faces[f].size()]; };
      for (std::size_t k = 0; k < faces[f].size(); ++k) {
        const int a = at(k), b = at(k + 1);
        const auto known = edges.find({b, a});
        if (known != edges.end()) {
          loop.push_back(oriented(known->second, false));
          continue;
        }
        const Vec3 from = corners[static_cast<std::size_t>(a)],
                   way = corners[static_cast<std::size_t>(b)] - from;
        const double length = norm(way);
        const int p = point(from), d = direction(length > 0 ? (1.0 / length) * way : Vec3{1, 0, 0});
        const int v = add("VECTOR(''," + ref(d) + ",1.)");
        const int line = add("LINE(''," + ref(p) + "," + ref(v) + ")");
        const int edge = add("EDGE_CURVE(''," + ref(vertices[static_cast<std::size_t>(a)]) + "," +
                             ref(vertices[static_cast<std::size_t>(b)]) + "," + ref(line) + ",.T.)");
        edges[{a, b}] = edge;
        loop.push_back(oriented(edge, true));
      }
      std::vector<int> bounds{bound(loop, true)};
      if (const auto m = more.find(static_cast<int>(f)); m != more.end()) bounds.push_back(m->second);
      const Vec3 o = corners[static_cast<std::size_t>(at(0))];
      const Vec3 x = geometry::normalised(corners[static_cast<std::size_t>(at(1))] - o);
      const Vec3 n =
          geometry::normalised(cross(x, corners[static_cast<std::size_t>(at(faces[f].size() - 1))] - o));
      const int plane = add("PLANE(''," + ref(placement(o, n, x)) + ")");
      out.push_back(face(std::to_string(first_name + static_cast<int>(f)), bounds, plane));
    }
    return out;
  }
  /// The corners of a box, x fastest, and its faces: bottom, top, front (-y), back, left (-x), right.
  static std::vector<Vec3> box_corners(Vec3 lo, Vec3 hi) {
    std::vector<Vec3> out;
    for (int i = 0; i < 8; ++i)
      out.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
    return out;
  }
  static std::vector<std::vector<int>> box_faces() {
    return {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  }
  int solid(const std::vector<int>& faces, const std::string& name = "") {
    const int shell = add("CLOSED_SHELL(''," + list(faces) + ")");
    return add("MANIFOLD_SOLID_BREP('" + name + "'," + ref(shell) + ")");
  }
  int box(Vec3 lo, Vec3 hi, const std::string& name = "") {
    return solid(flat_faces(box_corners(lo, hi), box_faces()), name);
  }
  /// A box with a through hole along z. The hole's face has a seam, or two bounds without one.
  int box_with_hole(Vec3 lo, Vec3 hi, Vec3 centre, double radius, bool seam) {
    std::array<int, 2> circle{}, corner{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double z = i == 0 ? lo.z : hi.z;
      corner[i] = vertex({centre.x + radius, centre.y, z});
      const int curve = add("CIRCLE(''," + ref(placement({centre.x, centre.y, z}, {0, 0, 1}, {1, 0, 0})) +
                            "," + real(radius) + ")");
      circle[i] = add("EDGE_CURVE(''," + ref(corner[i]) + "," + ref(corner[i]) + "," + ref(curve) + ",.T.)");
    }
    auto faces = flat_faces(
        box_corners(lo, hi), box_faces(),
        {{0, bound({oriented(circle[0], true)}, false)}, {1, bound({oriented(circle[1], false)}, false)}});
    std::vector<int> bounds;
    if (seam) {
      const int p = point({centre.x + radius, centre.y, lo.z}), d = direction({0, 0, 1});
      const int v = add("VECTOR(''," + ref(d) + ",1.)");
      const int line = add("LINE(''," + ref(p) + "," + ref(v) + ")");
      const int edge =
          add("EDGE_CURVE(''," + ref(corner[0]) + "," + ref(corner[1]) + "," + ref(line) + ",.T.)");
      bounds = {bound({oriented(circle[1], true), oriented(edge, false), oriented(circle[0], false),
                       oriented(edge, true)},
                      true)};
    } else {
      bounds = {bound({oriented(circle[1], true)}, true), bound({oriented(circle[0], false)}, false)};
    }
    const int surface =
        add("CYLINDRICAL_SURFACE(''," + ref(placement({centre.x, centre.y, lo.z}, {0, 0, 1}, {1, 0, 0})) +
            "," + real(radius) + ")");
    faces.push_back(face("hole", bounds, surface, false));
    return solid(faces, "drilled");
  }
  int sheet(const std::vector<int>& faces) {
    const int shell = add("OPEN_SHELL(''," + list(faces) + ")");
    return add("SHELL_BASED_SURFACE_MODEL(''," + list({shell}) + ")");
  }
  /// "mm" or "inch".
  int context(const std::string& unit = "mm") {
    int length = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    if (unit == "inch") {
      const int measure = add("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4)," + ref(length) + ")");
      const int dimensions = add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
      length = add("(CONVERSION_BASED_UNIT('INCH'," + ref(measure) + ")LENGTH_UNIT()NAMED_UNIT(" +
                   ref(dimensions) + "))");
    }
    const int angle = add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    const int solid_angle = add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    const int spread = add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6)," + ref(length) +
                           ",'distance_accuracy_value','')");
    return add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((" + ref(spread) +
               "))GLOBAL_UNIT_ASSIGNED_CONTEXT((" + ref(length) + "," + ref(angle) + "," + ref(solid_angle) +
               "))REPRESENTATION_CONTEXT('',''))");
  }
  /// A product whose shape these items are.
  void product(const std::vector<int>& items, int in_context,
               const std::string& representation = "ADVANCED_BREP_SHAPE_REPRESENTATION") {
    const int application = add("APPLICATION_CONTEXT('automotive design')");
    const int about = add("PRODUCT_CONTEXT(''," + ref(application) + ",'mechanical')");
    const int part = add("PRODUCT('part','part','',(" + ref(about) + "))");
    const int formation = add("PRODUCT_DEFINITION_FORMATION('',''," + ref(part) + ")");
    const int stage = add("PRODUCT_DEFINITION_CONTEXT('part definition'," + ref(application) + ",'design')");
    const int definition = add("PRODUCT_DEFINITION('design',''," + ref(formation) + "," + ref(stage) + ")");
    const int shape = add("PRODUCT_DEFINITION_SHAPE('',''," + ref(definition) + ")");
    const int held = add(representation + "(''," + list(items) + "," + ref(in_context) + ")");
    add("SHAPE_DEFINITION_REPRESENTATION(" + ref(shape) + "," + ref(held) + ")");
  }
  [[nodiscard]] std::string text(
      const std::string& schema = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }") const {
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','2026-01-01T00:00:00',(''),('"
           "'),'','','');\n"
           "FILE_SCHEMA(('" +
           schema + "'));\nENDSEC;\nDATA;\n" + data_.str() + "ENDSEC;\nEND-ISO-10303-21;\n";
  }

 private:
  int last_ = 0;
  std::ostringstream data_;
};

}  // namespace capstan::exchange::testing
