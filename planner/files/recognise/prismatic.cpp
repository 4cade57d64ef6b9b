#include "planner/files/recognise/prismatic.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "planner/files/recognise/view.h"

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using geometry::cross;
using geometry::dot;

/// Sides of the raw piece that a group opens to, beside those at right angles to `access`.
int open_sides(const Context& context, const std::vector<std::uint32_t>& patches, Direction3 access) {
  std::set<int> found;
  for (const std::uint32_t p : patches) {
    for (const std::uint32_t j : context.graph.patches[p].joins) {
      const Patch& other = context.graph.patches[context.graph.joins[j].other(p)];
      if (other.side >= 0 && perpendicular(other.axis, access)) found.insert(other.side);
    }
  }
  return static_cast<int>(found.size());
}

/// The profile of walls that run all round.
TypeId closed_profile(const Graph& graph, const View& view) {
  if (view.walls.empty()) return TypeId::kCircularClosedProfile;
  std::vector<Direction3> normals;
  normals.reserve(view.walls.size());
  for (const Surface& w : view.walls) normals.push_back(graph.patches[w.first].axis);
  if (normals.size() == 4 && std::all_of(normals.begin() + 1, normals.end(), [&](Direction3 n) {
        return parallel(n, normals[0]) || perpendicular(n, normals[0]);
      })) {
    return TypeId::kRectangularClosedProfile;
  }
  if (normals.size() < 3) return TypeId::kGeneralClosedProfile;
  const double exterior = 2.0 * std::numbers::pi / static_cast<double>(normals.size());
  for (const Direction3 n : normals) {
    const bool turned = std::any_of(normals.begin(), normals.end(), [&](Direction3 m) {
      return std::abs(std::acos(std::clamp(dot(n, m), -1.0, 1.0)) - exterior) < 10 * kSameAngleRad;
    });
    if (!turned) return TypeId::kGeneralClosedProfile;
  }
  return TypeId::kNgonClosedProfile;
}

/// Whether the cut of one wall through a face of the raw piece takes off a corner, not a strip: the faces at
/// its two ends are at right angles. Where other features took its ends, the raw piece itself is asked.
bool takes_a_corner(const Context& context, const Surface& wall, const View& view) {
  const Patch& w = context.graph.patches[wall.first];
  const Direction3 along = cross(w.axis, view.access);
  // The outermost faces across the wall's ends, by the place of the edge.
  std::optional<std::uint32_t> low;
  std::optional<std::uint32_t> high;
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const std::uint32_t p : wall.patches) {
    for (const std::uint32_t j : context.graph.patches[p].joins) {
      const Join& join = context.graph.joins[j];
      const Patch& other = context.graph.patches[join.other(p)];
      if (other.carrier != Carrier::kPlane || !perpendicular(other.axis, view.access)) continue;
      for (const std::uint32_t e : join.edges) {
        const double at = dot(context.brep.edges[e].middle, along);
        if (at < lowest) {
          lowest = at;
          low = join.other(p);
        }
        if (at > highest) {
          highest = at;
          high = join.other(p);
        }
      }
    }
  }
  if (low && high && *low != *high) {
    const Direction3 a = context.graph.patches[*low].axis;
    const Direction3 b = context.graph.patches[*high].axis;
    if (parallel(a, b)) return false;
    if (perpendicular(a, b)) return true;
  }
  // Corners of the raw piece's outline that lie on the side which was taken off.
  int off = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Point3 p{};
    bool upper = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool hi = (corner >> k & 1) != 0;
      p = p + (hi ? context.raw.hi[k] : context.raw.lo[k]) * context.raw.axis[k];
      if (parallel(context.raw.axis[k], view.access)) upper = hi;
    }
    if (upper && dot(p - w.point, w.axis) > kSameLengthMm) ++off;
  }
  return off == 1;
}

struct Kind {
  TypeId type;
  TypeId profile;
  std::string reason;
};

/// What an open chain of walls is, with a floor or without.
Kind open_kind(const Context& context, const View& view) {
  const auto normal = [&](std::size_t i) { return context.graph.patches[view.walls[i].first].axis; };
  const std::size_t walls = view.walls.size();
  const bool floor = !view.floors.empty();
  if (view.islands > 0 && walls == 0 && view.bends.empty()) {
    if (floor) return {TypeId::kPlanarFace, TypeId::kNone, "a plane around material that stays"};
    return {TypeId::kGeneralOutsideProfile, TypeId::kClosedProfile, "walls all round the material"};
  }
  if (walls + view.floors.size() <= 1 && view.bends.empty()) {
    if (floor ? along_raw(context.raw, view.access) : walls == 1 && along_raw(context.raw, normal(0))) {
      return {TypeId::kPlanarFace, TypeId::kNone, "a plane below the raw piece without walls"};
    }
    return {TypeId::kChamfer, TypeId::kNone, "one oblique plane between convex edges"};
  }
  if (walls == 0 && !view.bends.empty()) {
    return {floor ? TypeId::kOpenPocket : TypeId::kGeneralOutsideProfile, TypeId::kPartialCircularProfile,
            floor ? "a curved wall and a floor" : "a curved wall"};
  }
  if (walls == 0) return {TypeId::kPlanarFace, TypeId::kNone, "planes below the raw piece without walls"};
  if (walls == 1) {
    if (along_raw(context.raw, normal(0))) {
      return {TypeId::kStep, TypeId::kVeeProfile,
              "a wall and a floor at right angles, open on all other sides"};
    }
    if (takes_a_corner(context, view.walls[0], view)) {
      return {TypeId::kOpenPocket, TypeId::kLinearProfile, "an oblique wall and a floor take a corner off"};
    }
    return {TypeId::kStep, TypeId::kLinearProfile, "an oblique wall and a floor, from side to side"};
  }
  if (walls == 2) {
    const bool opposite = parallel(normal(0), normal(1));
    const bool square = perpendicular(normal(0), normal(1)) && along_raw(context.raw, normal(0));
    if (opposite && !view.bends.empty() && !floor) {
      return {TypeId::kSlot, TypeId::kRoundedUProfile, "two parallel walls and a rounded end"};
    }
    if (opposite && floor) return {TypeId::kSlot, TypeId::kSquareUProfile, "two parallel walls and a floor"};
    if (floor && square) {
      return {TypeId::kOpenPocket, TypeId::kVeeProfile,
              "two walls at right angles and a floor, open on two sides"};
    }
    if (floor) return {TypeId::kOpenPocket, TypeId::kOpenProfile, "two oblique walls and a floor"};
    if (square)
      return {TypeId::kStep, TypeId::kVeeProfile, "two walls at right angles, open on all other sides"};
    return {TypeId::kSlot, TypeId::kVeeProfile, "two walls that meet in a line"};
  }
  const bool u = walls == 3 && (parallel(normal(0), normal(1)) || parallel(normal(0), normal(2)) ||
                                parallel(normal(1), normal(2)));
  if (u && !floor) return {TypeId::kSlot, TypeId::kSquareUProfile, "three walls in the form of a U"};
  if (u) return {TypeId::kOpenPocket, TypeId::kSquareUProfile, "three walls in the form of a U and a floor"};
  return {floor ? TypeId::kOpenPocket : TypeId::kGeneralOutsideProfile, TypeId::kOpenProfile,
          "an open chain of walls"};
}

/// Sizes that differ by less are equal but for rounding.
constexpr double kSameSizeMm = 1e-6;

struct Size {
  double width = 0;
  double length = 0;
};

/// The least width across a wall, and the length at right angles to it. Widths that differ in rounding are
/// one, so that the order of walls does not matter.
Size size_across(const Context& context, const std::vector<std::uint32_t>& patches, const View& view) {
  Size best{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  for (const Surface& wall : view.walls) {
    const Direction3 across = context.graph.patches[wall.first].axis;
    const Size size{extent_along(context, patches, across).length(),
                    extent_along(context, patches, cross(across, view.access)).length()};
    const bool same = std::abs(size.width - best.width) < kSameSizeMm;
    if (same ? size.length < best.length : size.width < best.width) best = size;
  }
  return best;
}

double least_radius(const Graph& graph, const std::vector<Surface>& of) {
  double least = std::numeric_limits<double>::max();
  for (const Surface& s : of) {
    const Patch& p = graph.patches[s.first];
    if (p.outward) continue;
    least = std::min(least, p.carrier == Carrier::kTorus ? p.minor_radius : p.radius);
  }
  return least;
}

/// From the top of the walls to the floor, or to their lower end where there is none. Walls may go on below
/// the floor, where a deeper feature shares them.
double depth_of(const Context& context, const View& view, const std::vector<std::uint32_t>& patches) {
  const Extent all = extent_along(context, patches, view.access);
  if (view.floors.empty()) return all.length();
  return all.hi - dot(context.graph.patches[view.floors.front().first].point, view.access);
}

/// From the side of the raw piece that a tool enters to the lowest point of some patches, mm.
double below_raw(const Context& context, Direction3 access, const std::vector<std::uint32_t>& patches) {
  double top = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = dot(context.raw.axis[k], access);
    top += along > 0 ? along * context.raw.hi[k] : along * context.raw.lo[k];
  }
  return top - extent_along(context, patches, access).lo;
}

/// Width across, length along the longest border of an oblique plane, and the least angle to a neighbour
/// there. A border counts whole, however many edges it was split into.
std::vector<Parameter> chamfer_sizes(const Context& context, const std::vector<std::uint32_t>& patches) {
  struct Border {
    Direction3 along;
    double length = 0;
    double angle = 0;
  };
  std::vector<Border> borders;
  for (const std::uint32_t p : patches) {
    for (const std::uint32_t j : context.graph.patches[p].joins) {
      for (const std::uint32_t e : context.graph.joins[j].edges) {
        const exchange::Edge& edge = context.brep.edges[e];
        if (edge.curve != exchange::Curve::kLine) continue;
        const double angle = std::abs(std::numbers::pi - edge.dihedral);
        const auto same = std::find_if(borders.begin(), borders.end(), [&](const Border& b) {
          return parallel(b.along, edge.axis) && std::abs(b.angle - angle) < kSameAngleRad;
        });
        if (same == borders.end()) {
          borders.push_back({edge.axis, edge.length, angle});
        } else {
          same->length += edge.length;
        }
      }
    }
  }
  if (borders.empty()) return {};
  const Border longest = *std::max_element(
      borders.begin(), borders.end(), [](const Border& a, const Border& b) { return a.length < b.length; });
  double angle = longest.angle;
  for (const Border& b : borders) {
    if (parallel(b.along, longest.along)) angle = std::min(angle, b.angle);
  }
  const Direction3 across = cross(context.graph.patches[patches.front()].axis, longest.along);
  return {{"width", extent_along(context, patches, across).length()},
          {"length", extent_along(context, patches, longest.along).length()},
          {"angle_to_plane", angle}};
}

}  // namespace

std::vector<std::uint32_t> faces_of(const Graph& graph, const std::vector<std::uint32_t>& patches) {
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t p : patches) {
    faces.insert(faces.end(), graph.patches[p].faces.begin(), graph.patches[p].faces.end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

Extent extent_along(const Context& context, const std::vector<std::uint32_t>& patches, Direction3 along) {
  Extent found{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const std::uint32_t p : patches) {
    for (const std::uint32_t f : context.graph.patches[p].faces) {
      for (const exchange::Loop& loop : context.brep.faces[f].loops) {
        for (const std::uint32_t e : loop.edges) {
          const exchange::Edge& edge = context.brep.edges[e];
          for (const Point3 q : {edge.start, edge.middle, edge.end}) {
            found.lo = std::min(found.lo, dot(q, along));
            found.hi = std::max(found.hi, dot(q, along));
          }
        }
      }
    }
  }
  return found;
}

std::optional<Feature> prismatic(const Context& context, const std::vector<std::uint32_t>& patches) {
  std::vector<View> found = views(context, patches);
  if (found.empty()) return std::nullopt;
  View& best = found.front();
  tell_rings(context, best);
  Feature feature;
  feature.access = best.access;
  feature.walls = static_cast<int>(best.walls.size());
  feature.through = best.floors.empty();
  feature.open_sides = open_sides(context, patches, best.access);
  feature.faces = faces_of(context.graph, patches);
  if (best.closed) {
    feature.type = TypeId::kClosedPocket;
    feature.profile = closed_profile(context.graph, best);
    feature.reason =
        "walls all round" + std::string(feature.through ? ", open at both ends" : " and a floor");
  } else {
    const Kind kind = open_kind(context, best);
    feature.type = kind.type;
    feature.profile = kind.profile;
    feature.reason = kind.reason;
  }
  if (feature.type == TypeId::kChamfer) {
    feature.parameters = chamfer_sizes(context, patches);
    feature.alternatives.push_back({TypeId::kPlanarFace, feature.access, "mill it as an inclined plane"});
    return feature;
  }
  const double depth = feature.type == TypeId::kPlanarFace ? below_raw(context, best.access, patches)
                                                           : depth_of(context, best, patches);
  feature.parameters.push_back({"depth", depth});
  if (best.slope > 0) feature.parameters.push_back({"slope", best.slope});
  if (best.islands > 0) feature.parameters.push_back({"islands", static_cast<double>(best.islands)});
  if (best.walls.size() >= 2) {
    const Size size = size_across(context, patches, best);
    feature.parameters.push_back({"width", size.width});
    feature.parameters.push_back({"length", size.length});
  }
  if (const double radius = least_radius(context.graph, best.bends);
      radius < std::numeric_limits<double>::max()) {
    feature.parameters.push_back({"orthogonal_radius", radius});
  }
  if (const double radius = least_radius(context.graph, best.blends);
      radius < std::numeric_limits<double>::max()) {
    feature.parameters.push_back({"planar_radius", radius});
  }
  for (std::size_t i = 1; i < found.size(); ++i) {
    feature.alternatives.push_back(
        {feature.type, found[i].access, found[i].floors.empty() ? "along its walls" : "from another side"});
  }
  return feature;
}

}  // namespace capstan::recognise
