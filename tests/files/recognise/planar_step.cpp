#include "tests/files/recognise/planar_step.h"

#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "planner/files/p21/read/parse.h"

namespace capstan::testing {
namespace {

using exchange::Brep;
using exchange::Point3;

struct Reader {
  const p21::File& file;

  [[nodiscard]] std::optional<p21::Value> parameters(const p21::Value& reference,
                                                     std::string_view keyword) const {
    if (!reference.is(p21::Kind::kReference)) return std::nullopt;
    const auto found = file.find(reference.reference());
    if (!found || found->keyword() != keyword) return std::nullopt;
    return found->parameters();
  }
  [[nodiscard]] std::optional<Point3> triple(const p21::Value& reference, std::string_view keyword) const {
    const auto found = parameters(reference, keyword);
    if (!found || (*found)[1].size() != 3) return std::nullopt;
    const p21::Value xyz = (*found)[1];
    return Point3{xyz[0].as_real(), xyz[1].as_real(), xyz[2].as_real()};
  }
  [[nodiscard]] std::optional<Point3> vertex(const p21::Value& reference) const {
    const auto found = parameters(reference, "VERTEX_POINT");
    return found ? triple((*found)[1], "CARTESIAN_POINT") : std::nullopt;
  }
};

bool is_true(const p21::Value& v) { return v.is(p21::Kind::kEnumeration) && v.enumeration() == "T"; }

/// The edge's index in `brep`, which is made at its first use.
std::optional<std::uint32_t> edge_of(const Reader& reader, const p21::Value& reference,
                                     std::map<std::uint64_t, std::uint32_t>& known, Brep& brep) {
  const auto curve = reader.parameters(reference, "EDGE_CURVE");
  if (!curve) return std::nullopt;
  const auto [at, fresh] =
      known.emplace(reference.reference(), static_cast<std::uint32_t>(brep.edges.size()));
  if (!fresh) return at->second;
  auto start = reader.vertex((*curve)[1]);
  auto end = reader.vertex((*curve)[2]);
  if (!start || !end) return std::nullopt;
  exchange::Edge edge;
  edge.curve = exchange::Curve::kLine;
  edge.start = *start;
  edge.end = *end;
  brep.edges.push_back(edge);
  return at->second;
}

std::optional<exchange::Face> face_of(const Reader& reader, const p21::Instance& instance,
                                      std::map<std::uint64_t, std::uint32_t>& known, Brep& brep) {
  const p21::Value of_face = instance.parameters();
  const auto plane = reader.parameters(of_face[2], "PLANE");
  if (!plane) return std::nullopt;
  const auto placement = reader.parameters((*plane)[1], "AXIS2_PLACEMENT_3D");
  if (!placement) return std::nullopt;
  const auto point = reader.triple((*placement)[1], "CARTESIAN_POINT");
  const auto axis = reader.triple((*placement)[2], "DIRECTION");
  if (!point || !axis) return std::nullopt;
  exchange::Face face;
  face.carrier = exchange::Carrier::kPlane;
  face.point = *point;
  face.axis = geometry::normalised(*axis);
  face.same_sense = is_true(of_face[3]);
  face.id = static_cast<std::int64_t>(instance.id());
  face.name = of_face[0].as_text();
  for (std::size_t b = 0; b < of_face[1].size(); ++b) {
    auto bound = reader.parameters(of_face[1][b], "FACE_BOUND");
    if (!bound) bound = reader.parameters(of_face[1][b], "FACE_OUTER_BOUND");
    if (!bound) return std::nullopt;
    const auto chain = reader.parameters((*bound)[1], "EDGE_LOOP");
    if (!chain) return std::nullopt;
    const bool kept = is_true((*bound)[2]);
    exchange::Loop loop;
    for (std::size_t i = 0; i < (*chain)[1].size(); ++i) {
      const std::size_t k = kept ? i : (*chain)[1].size() - 1 - i;
      const auto oriented = reader.parameters((*chain)[1][k], "ORIENTED_EDGE");
      if (!oriented) return std::nullopt;
      const auto edge = edge_of(reader, (*oriented)[3], known, brep);
      if (!edge) return std::nullopt;
      loop.edges.push_back(*edge);
      // The loop of a bound runs around the face's normal, whatever the sense of the surface.
      loop.forward.push_back(is_true((*oriented)[4]) == kept);
    }
    face.loops.push_back(std::move(loop));
  }
  return face;
}

}  // namespace

void complete_planar(Brep& brep) {
  struct Use {
    std::uint32_t face;
    bool forward;
  };
  std::vector<std::vector<Use>> uses(brep.edges.size());
  for (std::uint32_t f = 0; f < brep.faces.size(); ++f) {
    exchange::Face& face = brep.faces[f];
    const Point3 outward = (face.same_sense ? 1.0 : -1.0) * face.axis;
    face.area = 0.0;
    double largest = -1.0;
    std::size_t outer = 0;
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
      const exchange::Loop& loop = face.loops[l];
      double area = 0.0;
      for (std::size_t i = 0; i < loop.edges.size(); ++i) {
        const exchange::Edge& edge = brep.edges[loop.edges[i]];
        const Point3 a = (loop.forward[i] ? edge.start : edge.end) - face.point;
        const Point3 b = (loop.forward[i] ? edge.end : edge.start) - face.point;
        area += 0.5 * geometry::dot(geometry::cross(a, b), outward);
        uses[loop.edges[i]].push_back({f, loop.forward[i]});
      }
      face.area += area;
      if (area > largest) {
        largest = area;
        outer = l;
      }
    }
    if (outer != 0) std::swap(face.loops[0], face.loops[outer]);
  }
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    exchange::Edge& edge = brep.edges[e];
    const Point3 along = edge.end - edge.start;
    edge.length = geometry::norm(along);
    edge.middle = 0.5 * (edge.start + edge.end);
    edge.axis = edge.length > 0.0 ? (1.0 / edge.length) * along : Point3{};
    if (uses[e].size() != 2) continue;
    Use a = uses[e][0];
    Use b = uses[e][1];
    if (a.face > b.face) std::swap(a, b);
    edge.face = {a.face, b.face};
    const auto outward = [&](std::uint32_t f) {
      return (brep.faces[f].same_sense ? 1.0 : -1.0) * brep.faces[f].axis;
    };
    const Point3 walked = (a.forward ? 1.0 : -1.0) * edge.axis;
    const double sine = geometry::dot(geometry::cross(outward(a.face), outward(b.face)), walked);
    const double cosine = geometry::dot(outward(a.face), outward(b.face));
    const double turn = std::atan2(sine, cosine);
    edge.dihedral = std::numbers::pi - turn;
    edge.convexity = std::abs(turn) < exchange::kSmoothAngleRad ? exchange::Convexity::kSmooth
                     : turn > 0.0                               ? exchange::Convexity::kConvex
                                                                : exchange::Convexity::kConcave;
  }
}

Brep read_planar_step(const std::string& bytes) {
  Job job;
  const auto file = p21::parse(bytes, "part.step", {}, job);
  if (!file) return {};
  Brep brep;
  brep.unit = "mm";
  const Reader reader{*file};
  std::map<std::uint64_t, std::uint32_t> known;
  for (const p21::Instance instance : *file) {
    if (instance.is_complex() || instance.keyword() != "ADVANCED_FACE") continue;
    auto face = face_of(reader, instance, known, brep);
    if (!face) return {};
    brep.faces.push_back(std::move(*face));
  }
  complete_planar(brep);
  for (const exchange::Edge& edge : brep.edges) {
    brep.box.add(edge.start);
    brep.box.add(edge.end);
  }
  exchange::Body body;
  body.solid = true;
  body.face_count = static_cast<std::uint32_t>(brep.faces.size());
  for (const exchange::Face& face : brep.faces) {
    body.area += face.area;
    const Point3 outward = (face.same_sense ? 1.0 : -1.0) * face.axis;
    body.volume += face.area * geometry::dot(face.point, outward) / 3.0;
  }
  brep.bodies.push_back(body);
  return brep;
}

}  // namespace capstan::testing
