#include "planner/files/exchange/brep/one_body.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

constexpr std::uint32_t kGone = 0xffffffffU;

/// The number of a body from 0, where `asked` is one from 1.
std::optional<std::size_t> by_number(const Brep& shape, const std::string& asked) {
  std::size_t n = 0;
  const char* const end = asked.data() + asked.size();
  const auto read = std::from_chars(asked.data(), end, n);
  if (read.ec != std::errc() || read.ptr != end || n < 1 || n > shape.bodies.size()) return std::nullopt;
  return n - 1;
}

/// Leaves out what is stated of other bodies' faces alone.
template <class Stated>
void keep_of(const std::set<std::int64_t>& ids, std::vector<Stated>& all) {
  std::erase_if(all, [&](const Stated& s) {
    return !s.faces.empty() &&
           std::none_of(s.faces.begin(), s.faces.end(), [&](std::int64_t id) { return ids.count(id) != 0; });
  });
}

Brep alone(const Brep& shape, std::size_t number) {
  Brep out = shape;
  Body body = shape.bodies[number];
  const std::uint32_t first = body.first_face, end = first + body.face_count;
  out.faces.assign(shape.faces.begin() + first, shape.faces.begin() + end);
  out.points.clear();
  out.triangles.clear();
  out.edges.clear();
  out.box = {};
  std::vector<std::uint32_t> edge_to(shape.edges.size(), kGone), point_to(shape.points.size(), kGone);
  for (std::size_t e = 0; e < shape.edges.size(); ++e) {
    Edge edge = shape.edges[e];
    if (edge.face[0] < first || edge.face[0] >= end) continue;  // both neighbours are of one body
    for (std::uint32_t& f : edge.face) f -= first;
    edge_to[e] = static_cast<std::uint32_t>(out.edges.size());
    out.edges.push_back(edge);
  }
  std::set<std::int64_t> ids;
  for (Face& f : out.faces) {
    ids.insert(f.id);
    for (Loop& l : f.loops) {
      for (std::uint32_t& e : l.edges) e = edge_to[e];
    }
    const std::uint32_t from = f.first_triangle;
    f.first_triangle = static_cast<std::uint32_t>(out.triangles.size());
    for (std::uint32_t t = from; t < from + f.triangle_count; ++t) {
      auto corners = shape.triangles[t];
      for (std::uint32_t& c : corners) {
        if (point_to[c] == kGone) {
          point_to[c] = static_cast<std::uint32_t>(out.points.size());
          out.points.push_back(shape.points[c]);
          out.box.add(shape.points[c]);
        }
        c = point_to[c];
      }
      out.triangles.push_back(corners);
    }
  }
  body.first_face = 0;
  out.bodies = {std::move(body)};
  keep_of(ids, out.pmi.sizes);
  keep_of(ids, out.pmi.zones);
  keep_of(ids, out.pmi.datums);
  keep_of(ids, out.pmi.textures);
  return out;
}

}  // namespace

std::string bodies_in_words(const Brep& shape) {
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t i = 0; i < shape.bodies.size() && i < kMost; ++i) {
    const Body& b = shape.bodies[i];
    out += (i == 0 ? "" : "; ") + std::to_string(i + 1) + (b.name.empty() ? "" : " '" + b.name + "'") + " (" +
           (b.solid ? "solid" : "sheet") + ", " + counted(b.face_count, "face", "faces") + ")";
  }
  if (shape.bodies.size() > kMost) out += "; and " + std::to_string(shape.bodies.size() - kMost) + " more";
  return out;
}

Result<Brep> one_body(const Brep& shape, const std::string& asked, const std::string& file) {
  const auto wrong = [&](const std::string& what) {
    return fail({.code = "CAD-BODIES",
                 .message = what + "; there are: " + bodies_in_words(shape),
                 .file = file,
                 .expected = "the number or the name of one solid"});
  };
  auto at = by_number(shape, asked);
  for (std::size_t i = 0; at && i < shape.bodies.size(); ++i) {
    if (i != *at && shape.bodies[i].name == asked)
      return wrong("'" + asked + "' is the number of one body and the name of another");
  }
  for (std::size_t i = 0; !at && i < shape.bodies.size(); ++i) {
    if (shape.bodies[i].name != asked) continue;
    const auto again = std::count_if(shape.bodies.begin(), shape.bodies.end(),
                                     [&](const Body& b) { return b.name == asked; });
    if (again > 1) return wrong(std::to_string(again) + " bodies have the name '" + asked + "'");
    at = i;
  }
  if (!at) return wrong("no body has the number or the name '" + asked + "'");
  if (!shape.bodies[*at].solid) return wrong("body '" + asked + "' is a sheet, without an inside");
  return alone(shape, *at);
}

}  // namespace capstan::exchange
