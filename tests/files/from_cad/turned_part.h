#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "tests/files/exchange/brep/step_part.h"

namespace capstan::testing {

using exchange::testing::StepPart;
using geometry::Vec2;
using geometry::Vec3;

/// A place of the wall of a bore: the radius at a height. `fillet_mm`: the wall comes to it by a fillet.
struct BoreAt {
  double r = 0.0, z = 0.0, fillet_mm = 0.0;
};

/// The faces of a bore along z from its mouth inwards, and the bounds that its ends cut into other faces.
struct BoreFaces {
  std::vector<int> faces;
  int mouth = 0;
  std::optional<int> exit;  ///< none: it ends in a floor or in a point
};

inline BoreFaces bore(StepPart& step, Vec2 at, const std::vector<BoreAt>& wall) {
  BoreFaces out;
  struct Ring {
    int vertex = 0, edge = 0;
  };
  const auto place = [&](double z) { return step.placement({at.x, at.y, z}, {0, 0, 1}, {1, 0, 0}); };
  const auto edge = [&](int from, int to, int curve) {
    return step.add("EDGE_CURVE(''," + StepPart::ref(from) + "," + StepPart::ref(to) + "," +
                    StepPart::ref(curve) + ",.T.)");
  };
  const auto circle = [&](int placed, double r) {
    return step.add("CIRCLE(''," + StepPart::ref(placed) + "," + StepPart::real(r) + ")");
  };
  std::vector<Ring> rings;
  for (const BoreAt& b : wall) {
    Ring ring{step.vertex({at.x + b.r, at.y, b.z}), 0};
    if (b.r > 0.0) ring.edge = edge(ring.vertex, ring.vertex, circle(place(b.z), b.r));
    rings.push_back(ring);
  }
  for (std::size_t i = 0; i + 1 < wall.size(); ++i) {
    const BoreAt &p = wall[i], &q = wall[i + 1];
    if (p.z == q.z) {
      std::vector<int> bounds{step.bound({step.oriented(rings[i].edge, true)}, true)};
      if (q.r > 0.0) bounds.push_back(step.bound({step.oriented(rings[i + 1].edge, false)}, false));
      out.faces.push_back(
          step.face("floor", bounds, step.add("PLANE(''," + StepPart::ref(place(q.z)) + ")")));
      continue;
    }
    int curve = 0, surface = 0;
    if (q.fillet_mm > 0.0) {
      const double f = q.fillet_mm;
      curve = circle(step.placement({at.x + q.r, at.y, q.z + f}, {0, -1, 0}, {1, 0, 0}), f);
      surface = step.add("TOROIDAL_SURFACE(''," + StepPart::ref(place(q.z + f)) + "," + StepPart::real(q.r) +
                         "," + StepPart::real(f) + ")");
    } else {
      const Vec3 from{at.x + q.r, at.y, q.z}, to{at.x + p.r, at.y, p.z};
      const int start = step.point(from), way = step.direction(geometry::normalised(to - from));
      const int along = step.add("VECTOR(''," + StepPart::ref(way) + ",1.)");
      curve = step.add("LINE(''," + StepPart::ref(start) + "," + StepPart::ref(along) + ")");
      const std::string head = StepPart::ref(place(p.z)) + "," + StepPart::real(p.r);
      surface = p.r == q.r ? step.add("CYLINDRICAL_SURFACE(''," + head + ")")
                           : step.add("CONICAL_SURFACE(''," + head + "," +
                                      StepPart::real(std::atan2(p.r - q.r, p.z - q.z)) + ")");
    }
    const int seam = edge(rings[i + 1].vertex, rings[i].vertex, curve);
    std::vector<int> round{step.oriented(rings[i].edge, true), step.oriented(seam, false)};
    if (q.r > 0.0) round.push_back(step.oriented(rings[i + 1].edge, false));
    round.push_back(step.oriented(seam, true));
    out.faces.push_back(step.face("bore", {step.bound(round, true)}, surface, false));
  }
  out.mouth = step.bound({step.oriented(rings.front().edge, false)}, false);
  const bool through = wall.size() > 1 && wall.back().r > 0.0 && wall.back().z != wall[wall.size() - 2].z;
  if (through) out.exit = step.bound({step.oriented(rings.back().edge, true)}, false);
  return out;
}

/// A block of 40 x 40 x 20 mm with one bore in its top.
inline std::string bored(const std::vector<BoreAt>& wall) {
  StepPart step;
  const BoreFaces hole = bore(step, {20, 20}, wall);
  std::map<int, int> more{{1, hole.mouth}};
  if (hole.exit) more[0] = *hole.exit;
  auto faces = step.flat_faces(StepPart::box_corners({0, 0, 0}, {40, 40, 20}), StepPart::box_faces(), more);
  faces.insert(faces.end(), hole.faces.begin(), hole.faces.end());
  step.product({step.solid(faces, "bored")}, step.context());
  return step.text();
}

/// A corner of a section; `centre`: the side to the next corner is an arc about it, of at most half a turn.
struct Corner {
  Vec2 at;
  std::optional<Vec2> centre;
};

/// A prism along z over a section, counter-clockwise, from 0 to a height.
inline std::string extruded(const std::vector<Corner>& section, double height) {
  StepPart step;
  const std::size_t n = section.size();
  const auto ref = [](int id) { return StepPart::ref(id); };
  std::vector<int> vertices[2], rims[2], uprights;
  const auto line = [&](Vec3 from, Vec3 to) {
    const int start = step.point(from), way = step.direction(geometry::normalised(to - from));
    const int along = step.add("VECTOR(''," + ref(way) + ",1.)");
    return step.add("LINE(''," + ref(start) + "," + ref(along) + ")");
  };
  const auto edge = [&](int from, int to, int curve) {
    return step.add("EDGE_CURVE(''," + ref(from) + "," + ref(to) + "," + ref(curve) + ",.T.)");
  };
  const auto left = [&](std::size_t i) {  // the arc turns left: it bulges out of the section
    const Vec2 a = section[i].at, b = section[(i + 1) % n].at;
    return cross(a - *section[i].centre, b - *section[i].centre) > 0.0;
  };
  const auto up = [](Vec2 p, double z) { return Vec3{p.x, p.y, z}; };
  for (const std::size_t k : {0U, 1U}) {
    const double z = k == 0 ? 0.0 : height;
    for (const Corner& c : section) vertices[k].push_back(step.vertex(up(c.at, z)));
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 a = section[i].at, b = section[(i + 1) % n].at;
      int curve = 0;
      if (section[i].centre) {
        const int placed = step.placement(up(*section[i].centre, z), {0, 0, left(i) ? 1.0 : -1.0}, {1, 0, 0});
        curve =
            step.add("CIRCLE(''," + ref(placed) + "," + StepPart::real(norm(a - *section[i].centre)) + ")");
      } else {
        curve = line(up(a, z), up(b, z));
      }
      rims[k].push_back(edge(vertices[k][i], vertices[k][(i + 1) % n], curve));
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    uprights.push_back(
        edge(vertices[0][i], vertices[1][i], line(up(section[i].at, 0.0), up(section[i].at, height))));
  std::vector<int> faces, top, bottom;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = section[i].at, b = section[(i + 1) % n].at;
    const int bound = step.bound({step.oriented(rims[0][i], true), step.oriented(uprights[(i + 1) % n], true),
                                  step.oriented(rims[1][i], false), step.oriented(uprights[i], false)},
                                 true);
    const std::string name = "side " + std::to_string(i);
    if (section[i].centre) {
      const int placed = step.placement(up(*section[i].centre, 0.0), {0, 0, 1}, {1, 0, 0});
      faces.push_back(step.face(name, {bound},
                                step.add("CYLINDRICAL_SURFACE(''," + ref(placed) + "," +
                                         StepPart::real(norm(a - *section[i].centre)) + ")"),
                                left(i)));
    } else {
      const Vec3 d = geometry::normalised(up(b - a, 0.0));
      faces.push_back(step.face(
          name, {bound}, step.add("PLANE(''," + ref(step.placement(up(a, 0.0), {d.y, -d.x, 0.0}, d)) + ")")));
    }
    top.push_back(step.oriented(rims[1][i], true));
    bottom.push_back(step.oriented(rims[0][n - 1 - i], false));
  }
  faces.push_back(
      step.face("top", {step.bound(top, true)},
                step.add("PLANE(''," + ref(step.placement({0, 0, height}, {0, 0, 1}, {1, 0, 0})) + ")")));
  faces.push_back(
      step.face("bottom", {step.bound(bottom, true)},
                step.add("PLANE(''," + ref(step.placement({0, 0, 0}, {0, 0, -1}, {1, 0, 0})) + ")")));
  step.product({step.solid(faces, "prism")}, step.context());
  return step.text();
}

}  // namespace capstan::testing
