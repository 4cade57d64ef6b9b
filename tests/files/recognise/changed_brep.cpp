#include "tests/files/recognise/changed_brep.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <sstream>

#include "tests/files/recognise/planar_step.h"

namespace capstan::testing {
namespace {

using exchange::Brep;
using exchange::Point3;
using geometry::cross;
using geometry::dot;

/// A rotation that is as likely as any other: a unit quaternion of four normal numbers.
std::array<Point3, 3> rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double w = normal(random);
  Point3 v{normal(random), normal(random), normal(random)};
  const double length = std::sqrt(w * w + dot(v, v));
  w /= length;
  v = (1.0 / length) * v;
  const auto turn = [&](Point3 p) { return p + 2.0 * cross(v, cross(v, p) + w * p); };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

std::vector<std::uint32_t> order(std::size_t count, std::mt19937_64& random) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::shuffle(numbers.begin(), numbers.end(), random);
  return numbers;
}

/// Cuts an edge at its middle; every loop that walks it walks both halves. Returns the number of the second
/// half.
std::uint32_t cut(Brep& brep, std::uint32_t e) {
  const auto second = static_cast<std::uint32_t>(brep.edges.size());
  exchange::Edge half = brep.edges[e];
  half.start = brep.edges[e].end = brep.edges[e].middle;
  brep.edges.push_back(half);
  for (exchange::Face& face : brep.faces) {
    for (exchange::Loop& loop : face.loops) {
      for (std::size_t i = 0; i < loop.edges.size(); ++i) {
        if (loop.edges[i] != e) continue;
        const auto at = static_cast<std::ptrdiff_t>(loop.forward[i] ? i + 1 : i);
        loop.edges.insert(loop.edges.begin() + at, second);
        loop.forward.insert(loop.forward.begin() + at, loop.forward[i]);
        break;
      }
    }
  }
  return second;
}

Point3 from(const Brep& brep, const exchange::Loop& loop, std::size_t i) {
  const exchange::Edge& edge = brep.edges[loop.edges[i]];
  return loop.forward[i] ? edge.start : edge.end;
}

bool convex(const Brep& brep, const exchange::Face& face) {
  if (face.carrier != exchange::Carrier::kPlane || face.loops.size() != 1) return false;
  const Point3 outward = (face.same_sense ? 1.0 : -1.0) * face.axis;
  const exchange::Loop& loop = face.loops[0];
  const std::size_t n = loop.edges.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point3 a = from(brep, loop, i);
    const Point3 b = from(brep, loop, (i + 1) % n);
    const Point3 c = from(brep, loop, (i + 2) % n);
    if (dot(cross(b - a, c - b), outward) < 1e-6) return false;
  }
  return true;
}

}  // namespace

Brep turned(const Brep& brep, std::mt19937_64& random, double scale) {
  const std::array<Point3, 3> to = rotation(random);
  std::uniform_real_distribution<double> anywhere(-100.0, 100.0);
  const Point3 shift{anywhere(random), anywhere(random), anywhere(random)};
  const auto direction = [&](Point3 p) { return p.x * to[0] + p.y * to[1] + p.z * to[2]; };
  const auto point = [&](Point3 p) { return scale * direction(p) + shift; };
  Brep moved = brep;
  for (exchange::Face& face : moved.faces) {
    face.point = point(face.point);
    face.axis = direction(face.axis);
    face.radius *= scale;
    face.minor_radius *= scale;
    face.area *= scale * scale;
  }
  moved.box = {};
  for (exchange::Edge& edge : moved.edges) {
    edge.start = point(edge.start);
    edge.end = point(edge.end);
    edge.middle = point(edge.middle);
    edge.centre = point(edge.centre);
    edge.axis = direction(edge.axis);
    edge.radius *= scale;
    edge.minor_radius *= scale;
    edge.length *= scale;
    moved.box.add(edge.start);
    moved.box.add(edge.end);
  }
  for (Point3& p : moved.points) p = point(p);
  return moved;
}

Brep shuffled(const Brep& brep, std::mt19937_64& random) {
  Brep other = brep;
  const std::vector<std::uint32_t> edges = order(brep.edges.size(), random);
  std::vector<std::uint32_t> edge_at(edges.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    other.edges[e] = brep.edges[edges[e]];
    edge_at[edges[e]] = e;
  }
  for (const exchange::Body& body : brep.bodies) {
    const std::vector<std::uint32_t> faces = order(body.face_count, random);
    std::vector<std::uint32_t> face_at(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      other.faces[body.first_face + f] = brep.faces[body.first_face + faces[f]];
      face_at[faces[f]] = f;
    }
    for (exchange::Edge& edge : other.edges) {
      if (edge.face[0] < body.first_face || edge.face[0] - body.first_face >= body.face_count) continue;
      for (std::uint32_t& f : edge.face) f = body.first_face + face_at[f - body.first_face];
      std::sort(edge.face.begin(), edge.face.end());
    }
  }
  for (exchange::Face& face : other.faces) {
    for (exchange::Loop& loop : face.loops) {
      for (std::uint32_t& e : loop.edges) e = edge_at[e];
    }
  }
  return other;
}

Brep split(const Brep& brep, std::mt19937_64& random, std::size_t count) {
  Brep other = brep;
  std::size_t done = 0;
  for (const std::uint32_t f : order(brep.faces.size(), random)) {
    if (done == count) break;
    if (!convex(other, other.faces[f])) continue;
    const std::size_t n = other.faces[f].loops[0].edges.size();
    const std::uint32_t near = other.faces[f].loops[0].edges[0];
    const std::uint32_t far = other.faces[f].loops[0].edges[n / 2];
    const Point3 a = other.edges[near].middle;
    const Point3 b = other.edges[far].middle;
    cut(other, near);
    cut(other, far);
    exchange::Edge between;
    between.curve = exchange::Curve::kLine;
    between.start = a;
    between.end = b;
    const auto e = static_cast<std::uint32_t>(other.edges.size());
    other.edges.push_back(between);
    // The loop from a to b stays, the rest becomes the second face.
    const exchange::Loop whole = other.faces[f].loops[0];
    exchange::Loop kept;
    exchange::Loop rest;
    std::size_t first = 0;
    while (geometry::norm(from(other, whole, first) - a) > 1e-12) ++first;
    bool before = true;
    for (std::size_t i = 0; i < whole.edges.size(); ++i) {
      const std::size_t k = (first + i) % whole.edges.size();
      if (geometry::norm(from(other, whole, k) - b) < 1e-12) before = false;
      (before ? kept : rest).edges.push_back(whole.edges[k]);
      (before ? kept : rest).forward.push_back(whole.forward[k]);
    }
    kept.edges.push_back(e);
    kept.forward.push_back(false);
    rest.edges.push_back(e);
    rest.forward.push_back(true);
    exchange::Face second = other.faces[f];
    other.faces[f].loops[0] = kept;
    second.loops[0] = rest;
    other.faces.push_back(second);
    ++other.bodies[0].face_count;
    ++done;
    complete_planar(other);
  }
  return other;
}

std::vector<std::string> summary(const exchange::Brep& brep, const recognise::Recognition& found,
                                 double scale) {
  const auto names = [&](const std::vector<std::uint32_t>& faces) {
    std::set<std::string> sorted;
    for (const std::uint32_t f : faces)
      sorted.insert(brep.faces[f].name + "#" + std::to_string(brep.faces[f].id));
    std::string text;
    for (const std::string& name : sorted) text += " " + name;
    return text;
  };
  std::vector<std::string> lines{"raw" + names(found.on_raw)};
  for (const recognise::Feature& f : found.features) {
    std::ostringstream line;
    line << static_cast<int>(f.type) << ' ' << static_cast<int>(f.profile) << ' ' << f.walls << ' '
         << f.through << ' ' << f.open_sides << names(f.faces);
    for (const recognise::Parameter& p : f.parameters) {
      line << ' ' << p.name << ' '
           << std::lround((p.name == "islands" || is_angle(p) ? p.value : p.value / scale) * 1e4);
    }
    lines.push_back(line.str());
  }
  for (const recognise::Rest& r : found.unrecognised) lines.push_back(r.reason + names(r.faces));
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace capstan::testing
