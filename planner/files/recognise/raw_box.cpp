#include <algorithm>
#include <limits>

#include "planner/files/recognise/graph.h"

namespace capstan::recognise {
namespace {

using exchange::Brep;
using exchange::Carrier;
using geometry::cross;
using geometry::dot;

/// A direction of plane faces, and how much area looks along it, either way.
struct Weighted {
  Direction3 axis;
  double area = 0;
};

std::vector<Weighted> plane_directions(const Graph& graph) {
  std::vector<Weighted> found;
  for (const Patch& p : graph.patches) {
    if (p.carrier != Carrier::kPlane) continue;
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const Weighted& w) { return parallel(w.axis, p.axis); });
    if (same == found.end()) {
      found.push_back({p.axis, p.area});
    } else {
      same->area += p.area;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Weighted& a, const Weighted& b) { return a.area > b.area; });
  return found;
}

/// Any direction at right angles: the one nearest to an axis of the frame.
Direction3 any_perpendicular(Direction3 a) {
  const Direction3 least = std::abs(a.x) <= std::abs(a.y) && std::abs(a.x) <= std::abs(a.z)
                               ? Direction3{1, 0, 0}
                           : std::abs(a.y) <= std::abs(a.z) ? Direction3{0, 1, 0}
                                                            : Direction3{0, 0, 1};
  return geometry::normalised(least - dot(least, a) * a);
}

/// Frames that the raw piece could have: two directions of plane faces at right angles, and the third. Only
/// the directions with the most area are tried.
std::vector<std::array<Direction3, 3>> frames(const Graph& graph) {
  constexpr std::size_t kTried = 12;
  std::vector<Weighted> planes = plane_directions(graph);
  if (planes.size() > kTried) planes.resize(kTried);
  std::vector<std::array<Direction3, 3>> found;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t k = i + 1; k < planes.size(); ++k) {
      const Direction3 z = planes[i].axis;
      if (!perpendicular(planes[k].axis, z)) continue;
      const Direction3 x = geometry::normalised(planes[k].axis - dot(planes[k].axis, z) * z);
      found.push_back({x, cross(z, x), z});
    }
  }
  if (!found.empty()) return found;
  // No two planes at right angles: turn with the largest surface that has an axis.
  const Patch* largest = nullptr;
  for (const Patch& p : graph.patches) {
    if (geometry::norm(p.axis) > 0.5 && (largest == nullptr || p.area > largest->area)) largest = &p;
  }
  const Direction3 z = largest == nullptr ? Direction3{0, 0, 1} : largest->axis;
  const Direction3 x = any_perpendicular(z);
  return {{x, cross(z, x), z}};
}

void add(RawBox& box, Point3 p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = dot(p, box.axis[k]);
    box.lo[k] = std::min(box.lo[k], along);
    box.hi[k] = std::max(box.hi[k], along);
  }
}

/// The extreme points of a circle or an arc. Of an arc only what lies on it: seen from the centre, the middle
/// is in the middle of it.
void add_circle(RawBox& box, const exchange::Edge& edge) {
  const bool whole = geometry::norm(edge.end - edge.start) < kSameLengthMm && edge.length > kSameLengthMm;
  const Direction3 to_middle = geometry::normalised(edge.middle - edge.centre);
  const double half = edge.radius > 0 ? 0.5 * edge.length / edge.radius : 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Direction3 in_plane = box.axis[k] - dot(box.axis[k], edge.axis) * edge.axis;
    const double reach = geometry::norm(in_plane);
    if (reach < kSameAngleRad) continue;
    for (const double sign : {-1.0, 1.0}) {
      const Direction3 to = (sign / reach) * in_plane;
      if (whole || std::acos(std::clamp(dot(to, to_middle), -1.0, 1.0)) < half) {
        add(box, edge.centre + edge.radius * to);
      }
    }
  }
}

RawBox box_along(const Brep& brep, const exchange::Body& body, const std::array<Direction3, 3>& frame) {
  RawBox box;
  box.axis = frame;
  box.lo.fill(std::numeric_limits<double>::max());
  box.hi.fill(std::numeric_limits<double>::lowest());
  const auto inside = [&](std::uint32_t f) {
    return f >= body.first_face && f - body.first_face < body.face_count;
  };
  for (const exchange::Edge& edge : brep.edges) {
    if (!inside(edge.face[0])) continue;
    add(box, edge.start);
    add(box, edge.end);
    add(box, edge.middle);
    if (edge.curve == exchange::Curve::kCircle) add_circle(box, edge);
  }
  for (std::uint32_t f = body.first_face; f < body.first_face + body.face_count; ++f) {
    const exchange::Face& face = brep.faces[f];
    for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
      for (const std::uint32_t corner : brep.triangles[t]) add(box, brep.points[corner]);
    }
  }
  return box;
}

/// The side of a box that a patch lies on, or -1.
int side_of(const RawBox& box, const Patch& p) {
  if (p.carrier != Carrier::kPlane) return -1;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double along = dot(p.point, box.axis[at]);
    if (same_direction(p.axis, box.axis[at]) && std::abs(along - box.hi[at]) < kSameLengthMm)
      return 2 * k + 1;
    if (same_direction(p.axis, -1.0 * box.axis[at]) && std::abs(along - box.lo[at]) < kSameLengthMm)
      return 2 * k;
  }
  return -1;
}

}  // namespace

RawBox make_raw_box(const Brep& brep, const exchange::Body& body, Graph& graph) {
  RawBox best;
  double most = -1.0;
  for (const auto& frame : frames(graph)) {
    const RawBox box = box_along(brep, body, frame);
    double on_sides = 0.0;
    for (const Patch& p : graph.patches) {
      if (side_of(box, p) >= 0) on_sides += p.area;
    }
    // Of frames as good as each other the first stays: areas differ in rounding when a part is turned.
    if (on_sides > most * (1.0 + 1e-9)) {
      most = on_sides;
      best = box;
    }
  }
  for (Patch& p : graph.patches) p.side = side_of(best, p);
  return best;
}

}  // namespace capstan::recognise
