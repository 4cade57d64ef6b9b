#include "tests/files/recognise/blocks.h"

#include <array>
#include <map>
#include <utility>

#include "tests/files/recognise/planar_step.h"

namespace capstan::testing {

using exchange::Point3;

exchange::Brep blocks(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& z,
                      const std::function<bool(std::size_t, std::size_t, std::size_t)>& filled) {
  using Corner = std::array<std::size_t, 3>;
  const std::array<const std::vector<double>*, 3> grid{&x, &y, &z};
  const auto solid = [&](Corner at) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (at[k] >= grid[k]->size() - 1) return false;  // also what wrapped below zero
    }
    return filled(at[0], at[1], at[2]);
  };
  const auto point = [&](Corner c) { return Point3{x[c[0]], y[c[1]], z[c[2]]}; };
  exchange::Brep brep;
  std::map<std::pair<Corner, Corner>, std::uint32_t> known;
  const auto side = [&](std::size_t k, bool upper, Corner lo) {
    const std::size_t u = (k + 1) % 3;
    const std::size_t v = (k + 2) % 3;
    Corner a = lo;
    if (upper) ++a[k];
    Corner b = a;
    ++b[u];
    Corner c = b;
    ++c[v];
    Corner d = a;
    ++d[v];
    std::array<Corner, 4> around{a, b, c, d};
    if (!upper) around = {a, d, c, b};
    exchange::Face face;
    face.carrier = exchange::Carrier::kPlane;
    face.point = point(a);
    (k == 0 ? face.axis.x : k == 1 ? face.axis.y : face.axis.z) = upper ? 1.0 : -1.0;
    face.name = std::to_string(brep.faces.size());
    exchange::Loop loop;
    for (std::size_t i = 0; i < 4; ++i) {
      const Corner from = around[i];
      const Corner to = around[(i + 1) % 4];
      const bool forward = from < to;
      const auto [at, fresh] = known.emplace(forward ? std::pair(from, to) : std::pair(to, from),
                                             static_cast<std::uint32_t>(brep.edges.size()));
      if (fresh) {
        exchange::Edge edge;
        edge.curve = exchange::Curve::kLine;
        edge.start = point(forward ? from : to);
        edge.end = point(forward ? to : from);
        brep.edges.push_back(edge);
      }
      loop.edges.push_back(at->second);
      loop.forward.push_back(forward);
    }
    face.loops.push_back(std::move(loop));
    brep.faces.push_back(std::move(face));
  };
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      for (std::size_t l = 0; l + 1 < z.size(); ++l) {
        const Corner at{i, j, l};
        if (!solid(at)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          Corner below = at;
          Corner above = at;
          --below[k];
          ++above[k];
          if (!solid(below)) side(k, false, at);
          if (!solid(above)) side(k, true, at);
        }
      }
    }
  }
  complete_planar(brep);
  exchange::Body body;
  body.solid = true;
  body.face_count = static_cast<std::uint32_t>(brep.faces.size());
  brep.bodies.push_back(body);
  return brep;
}

}  // namespace capstan::testing
