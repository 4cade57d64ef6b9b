#include "planner/files/recognise/holes.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "planner/files/recognise/rings.h"

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using exchange::Convexity;
using geometry::dot;

bool round_carrier(const Patch& p) { return p.carrier == Carrier::kCylinder || p.carrier == Carrier::kCone; }

bool on_axis(const Patch& axis, Point3 p) {
  return geometry::norm(geometry::cross(p - axis.point, axis.axis)) < kSameLengthMm;
}

/// Whether a patch is turned about the axis of another: a cylinder, a cone, a torus about it, a sphere on it.
bool coaxial(const Patch& axis, const Patch& p) {
  switch (p.carrier) {
    case Carrier::kCylinder:
    case Carrier::kCone:
    case Carrier::kTorus:
      return parallel(axis.axis, p.axis) && on_axis(axis, p.point);
    case Carrier::kSphere:
      return on_axis(axis, p.point);
    default:
      return false;
  }
}

/// Whether a plane is the floor of a wider cylinder about the axis.
bool is_shelf(const Graph& graph, const Patch& axis, std::uint32_t plane, const std::vector<bool>& round) {
  return std::any_of(
      graph.patches[plane].joins.begin(), graph.patches[plane].joins.end(), [&](std::uint32_t j) {
        const Join& join = graph.joins[j];
        const std::uint32_t other = join.other(plane);
        return join.convexity == Convexity::kConcave && round[other] && coaxial(axis, graph.patches[other]);
      });
}

struct Stack {
  std::vector<std::uint32_t> patches;
  bool whole = true;  ///< nothing but what turns about the axis is tied to it
};

/// All that is tied to a round patch and turns about its axis: further cylinders and cones, shelves, the
/// bottom.
Stack stack_from(const Context& context, std::uint32_t first, const std::vector<bool>& usable,
                 const std::vector<bool>& round) {
  const Graph& graph = context.graph;
  const Patch& axis = graph.patches[first];
  Stack stack;
  std::set<std::uint32_t> seen{first};
  std::vector<std::uint32_t> open{first};
  while (!open.empty()) {
    const std::uint32_t p = open.back();
    open.pop_back();
    stack.patches.push_back(p);
    const bool plane = graph.patches[p].carrier == Carrier::kPlane;
    for (const std::uint32_t j : graph.patches[p].joins) {
      const Join& join = graph.joins[j];
      const std::uint32_t other = join.other(p);
      const Patch& q = graph.patches[other];
      const bool tied = join.convexity == Convexity::kConcave || join.convexity == Convexity::kSmooth;
      const bool turns = !q.outward ? coaxial(axis, q) && (round[other] || !round_carrier(q)) : false;
      const bool flat = q.carrier == Carrier::kPlane && parallel(q.axis, axis.axis) && !plane;
      if (turns && usable[other]) {
        if (seen.insert(other).second) open.push_back(other);
      } else if (flat && usable[other] && (tied || is_shelf(graph, axis, other, round))) {
        if (seen.insert(other).second) open.push_back(other);
      } else if (tied && seen.count(other) == 0) {
        stack.whole = false;  // a wall, an island, another feature's floor
      }
    }
  }
  std::sort(stack.patches.begin(), stack.patches.end());
  return stack;
}

struct Section {
  std::uint32_t patch = 0;
  double lo = 0;
  double hi = 0;
  double radius = 0;  ///< the larger one of a cone
};

Feature hole_of(const Context& context, const Stack& stack, std::uint32_t first) {
  const Graph& graph = context.graph;
  const Direction3 axis = graph.patches[first].axis;
  std::vector<Section> sections;
  std::optional<Direction3> out;  // from the bottom
  bool conical_bottom = false;
  for (const std::uint32_t p : stack.patches) {
    const Patch& patch = graph.patches[p];
    const Extent extent = extent_along(context, {p}, axis);
    if (patch.carrier == Carrier::kCylinder) sections.push_back({p, extent.lo, extent.hi, patch.radius});
    if (patch.carrier == Carrier::kCone) {
      // A cone that closes: its apex is on its boundary, or within what it spans.
      const double base = dot(patch.point, axis);
      const double slope = std::tan(patch.half_angle) * (dot(patch.axis, axis) > 0 ? 1.0 : -1.0);
      const double at_lo = patch.radius + (extent.lo - base) * slope;
      const double at_hi = patch.radius + (extent.hi - base) * slope;
      if (std::min(at_lo, at_hi) < 0.02 * std::max(at_lo, at_hi)) {
        conical_bottom = true;
        out = at_lo < at_hi ? axis : -1.0 * axis;
      } else {
        sections.push_back({p, extent.lo, extent.hi, std::max(at_lo, at_hi)});
      }
    }
    if (patch.carrier == Carrier::kSphere) {
      const double centre = dot(patch.point, axis);
      out = extent.hi + extent.lo < 2.0 * centre ? axis : -1.0 * axis;
    }
  }
  // A plane that the stack does not go on behind is its bottom; others are shelves.
  double least = std::numeric_limits<double>::max();
  double largest = 0.0;
  for (const Section& s : sections) {
    if (graph.patches[s.patch].carrier == Carrier::kCylinder) least = std::min(least, s.radius);
    largest = std::max(largest, s.radius);
  }
  bool shelf = false;
  std::optional<std::uint32_t> bottom;
  for (const std::uint32_t p : stack.patches) {
    const Patch& patch = graph.patches[p];
    if (patch.carrier != Carrier::kPlane) continue;
    const bool goes_on = std::any_of(patch.joins.begin(), patch.joins.end(), [&](std::uint32_t j) {
      const Join& join = graph.joins[j];
      return join.convexity == Convexity::kConvex &&
             std::binary_search(stack.patches.begin(), stack.patches.end(), join.other(p));
    });
    (goes_on ? shelf : conical_bottom) = goes_on ? true : conical_bottom;
    if (!goes_on) {
      bottom = p;
      out = patch.axis;
    }
  }
  Feature feature;
  feature.through = !out.has_value();
  if (!out) {
    // Through: from the wider end, else from the upper one along the axis.
    double at_top = 0.0;
    double at_bottom = 0.0;
    const Extent all = extent_along(context, stack.patches, axis);
    for (const Section& s : sections) {
      if (s.hi > all.hi - kSameLengthMm) at_top = std::max(at_top, s.radius);
      if (s.lo < all.lo + kSameLengthMm) at_bottom = std::max(at_bottom, s.radius);
    }
    out = at_bottom > at_top + kSameLengthMm ? -1.0 * axis : axis;
  }
  feature.access = *out;
  const double sign = dot(*out, axis) > 0 ? 1.0 : -1.0;
  std::sort(sections.begin(), sections.end(), [&](const Section& a, const Section& b) {
    return sign > 0 ? a.hi > b.hi : a.lo < b.lo;  // from the mouth inwards
  });
  const bool cone_at_mouth =
      !sections.empty() && graph.patches[sections.front().patch].carrier == Carrier::kCone;
  if (sections.empty() || least == std::numeric_limits<double>::max()) least = largest;
  const bool stepped = std::any_of(sections.begin(), sections.end(), [&](const Section& s) {
    return graph.patches[s.patch].carrier == Carrier::kCylinder && s.radius > least + kSameLengthMm;
  });
  feature.type = stepped || shelf ? TypeId::kCounterboreHole
                 : cone_at_mouth  ? TypeId::kCountersunkHole
                                  : TypeId::kRoundHole;
  feature.profile = TypeId::kCircularClosedProfile;
  feature.faces = faces_of(graph, stack.patches);
  feature.reason = std::string("a whole ") +
                   (least < largest ? "stack of coaxial cylinders and cones" : "cylinder") +
                   " with the material outside, " +
                   (feature.through  ? "open at both ends"
                    : conical_bottom ? "with a conical bottom"
                    : bottom         ? "with a flat bottom"
                                     : "with a rounded bottom");
  feature.parameters.push_back({"diameter", 2.0 * least});
  feature.parameters.push_back({"depth", extent_along(context, stack.patches, axis).length()});
  for (const Section& s : sections) {
    if (s.radius < least + kSameLengthMm) continue;
    const bool cone = graph.patches[s.patch].carrier == Carrier::kCone;
    feature.parameters.push_back({cone ? "countersink_diameter" : "counterbore_diameter", 2.0 * s.radius});
    feature.parameters.push_back({cone ? "countersink_depth" : "counterbore_depth", s.hi - s.lo});
    if (cone) feature.parameters.push_back({"angle", 2.0 * graph.patches[s.patch].half_angle});
  }
  if (!conical_bottom)
    feature.alternatives.push_back({TypeId::kClosedPocket, *out, "mill it as a circular pocket"});
  return feature;
}

}  // namespace

std::vector<Feature> take_holes(const Context& context, std::vector<bool>& taken) {
  const Graph& graph = context.graph;
  std::vector<bool> usable(graph.patches.size());
  std::vector<bool> round(graph.patches.size(), false);
  for (std::uint32_t p = 0; p < graph.patches.size(); ++p) {
    usable[p] = !taken[p];
    const Patch& patch = graph.patches[p];
    round[p] = !taken[p] && round_carrier(patch) && !patch.outward && runs_round(context, patch);
  }
  std::vector<Feature> found;
  for (std::uint32_t p = 0; p < graph.patches.size(); ++p) {
    if (!round[p] || taken[p] || graph.patches[p].carrier != Carrier::kCylinder) continue;
    const Stack stack = stack_from(context, p, usable, round);
    if (!stack.whole) continue;
    for (const std::uint32_t member : stack.patches) {
      taken[member] = true;
      usable[member] = false;
    }
    found.push_back(hole_of(context, stack, p));
  }
  return found;
}

}  // namespace capstan::recognise
